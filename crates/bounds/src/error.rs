//! What can go wrong: one enum for the crate.

use naga::Span;

/// Anything that stops an evaluation.
///
/// Values that a real machine may leave undefined are no errors: they are *results*, marked indeterminate or undecided.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The module has no such entry point.
    #[error("no entry point `{name}`; the module has: {available}")]
    NoEntryPoint {
        /// The name asked for.
        name: String,
        /// The names there are, separated by commas.
        available: String,
    },
    /// The entry point belongs to another stage than the call.
    #[error("entry point `{name}` is a {found} shader, but {wanted} was asked for")]
    WrongStage {
        /// The entry point.
        name: String,
        /// Its stage.
        found: &'static str,
        /// The stage the call evaluates.
        wanted: &'static str,
    },
    /// A part of the IR that this evaluator leaves out; the crate documentation lists them.
    #[error("unsupported: {what}")]
    Unsupported {
        /// The construct.
        what: String,
        /// Where it stands in the source.
        span: Span,
    },
    /// The values given to pipeline constants do not fit the module.
    #[error("pipeline constants cannot be applied")]
    Overrides(#[from] Box<naga::back::pipeline_constants::PipelineConstantError>),
    /// A resource the shader uses has no value.
    #[error(
        "nothing is bound at group {group}, binding {binding} (`{name}`); add a {expected} to the bindings"
    )]
    MissingBinding {
        /// Bind group.
        group: u32,
        /// Binding number.
        binding: u32,
        /// Variable name in the shader.
        name: String,
        /// What must be bound there.
        expected: &'static str,
    },
    /// The bytes or scalars of a buffer do not fit the variable's type.
    #[error("buffer at group {group}, binding {binding} (`{name}`): {reason}")]
    Buffer {
        /// Bind group.
        group: u32,
        /// Binding number.
        binding: u32,
        /// Variable name in the shader.
        name: String,
        /// What is wrong and what to do.
        reason: String,
    },
    /// A texture whose size, format or dimension does not fit.
    #[error("texture: {reason}")]
    Texture {
        /// What is wrong and what to do.
        reason: String,
    },
    /// A stage input has no value, or one of the wrong shape.
    #[error("stage input {input}: {reason}")]
    Input {
        /// `location N` or the name of the built-in.
        input: String,
        /// What is wrong and what to do.
        reason: String,
    },
    /// A declared range is no range.
    #[error("range [{lo}, {hi}] is empty or not a number; give lo <= hi")]
    EmptyRange {
        /// Lower end.
        lo: f64,
        /// Upper end.
        hi: f64,
    },
    /// A sidecar of input ranges is wrong, or does not fit the shader.
    #[error(transparent)]
    Ranges(Box<crate::ranges::Report>),
    /// The shader executed more operations than it was allowed; it probably does not end.
    #[error(
        "the operation budget of {budget} operations for each invocation is used up; raise `Limits::operations` if the shader does end"
    )]
    Budget {
        /// Operations allowed for each invocation.
        budget: u64,
        /// The loop that was running.
        span: Span,
    },
    /// Calls and blocks are nested too deeply.
    #[error("calls and blocks are nested more than {limit} deep")]
    Depth {
        /// The limit.
        limit: u32,
        /// The construct that exceeded it.
        span: Span,
    },
    /// An evaluation would need more memory than allowed.
    #[error("the evaluation needs {needed} bytes, more than the limit of {limit}; {what}")]
    Memory {
        /// Bytes needed.
        needed: u64,
        /// Bytes allowed.
        limit: u64,
        /// What needs them.
        what: String,
    },
}

impl Error {
    /// The place in the source, for those errors that have one.
    pub fn span(&self) -> Option<Span> {
        match self {
            Self::Unsupported { span, .. } | Self::Budget { span, .. } | Self::Depth { span, .. } => {
                Some(*span)
            }
            Self::NoEntryPoint { .. }
            | Self::WrongStage { .. }
            | Self::Overrides(_)
            | Self::MissingBinding { .. }
            | Self::Buffer { .. }
            | Self::Texture { .. }
            | Self::Input { .. }
            | Self::EmptyRange { .. }
            | Self::Ranges(_)
            | Self::Memory { .. } => None,
        }
    }
}

/// The crate's result type.
pub type Result<T, E = Error> = std::result::Result<T, E>;
