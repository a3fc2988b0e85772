//! From a source to a naga module, and naga's complaints to diagnostics.

use std::error::Error;
use std::ops::Range;

use naga::valid::{Capabilities, ModuleInfo, ValidationError, ValidationFlags, Validator};
use naga::{Module, Span, WithSpan};

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Source;
use crate::target::Stage;

/// Parses; the module may still break rules.
pub(crate) fn parse(name: &str, source: &Source) -> Result<Module, Diagnostic> {
    match source {
        Source::Wgsl(text) => parse_wgsl(name, text),
        Source::Spirv(bytes) => parse_spirv(name, bytes),
        Source::Glsl { text, stage } => parse_glsl(name, text, *stage),
    }
}

fn parse_wgsl(name: &str, text: &str) -> Result<Module, Diagnostic> {
    naga::front::wgsl::Frontend::new().parse(text).map_err(|error| {
        let places = error
            .labels()
            .filter_map(|(span, label)| Some((range_in(text, span)?, label.to_owned())));
        let mut diagnostic = Diagnostic::new(Code::Parse, error.message()).at(name, text, places);
        diagnostic.notes = error.notes().map(str::to_owned).collect();
        diagnostic
    })
}

fn parse_spirv(name: &str, bytes: &[u8]) -> Result<Module, Diagnostic> {
    // Positions stay as the module has them: what is flipped on the way in would have to be flipped on the way out.
    let options = naga::front::spv::Options {
        adjust_coordinate_space: false,
        ..Default::default()
    };
    if !bytes.len().is_multiple_of(4) {
        let message = format!("{} bytes are no whole number of SPIR-V words", bytes.len());
        return Err(Diagnostic::new(Code::Parse, message).in_file(name));
    }
    let repaired = crate::spirv::repaired(bytes);
    naga::front::spv::parse_u8_slice(repaired.as_deref().unwrap_or(bytes), &options)
        .map_err(|error| Diagnostic::new(Code::Parse, chain(&error)).in_file(name))
}

fn parse_glsl(name: &str, text: &str, stage: Stage) -> Result<Module, Diagnostic> {
    let options = naga::front::glsl::Options::from(stage.to_naga());
    naga::front::glsl::Frontend::default()
        .parse(&options, text)
        .map_err(|errors| glsl_diagnostic(name, text, &errors))
}

/// The first error is the message, all others are labels.
fn glsl_diagnostic(name: &str, text: &str, errors: &naga::front::glsl::ParseErrors) -> Diagnostic {
    let messages: Vec<String> = errors.errors.iter().map(|e| e.kind.to_string()).collect();
    let places = errors
        .errors
        .iter()
        .zip(&messages)
        .filter_map(|(error, message)| Some((range_in(text, error.meta)?, message.clone())));
    let headline = messages.first().map_or("the text is not GLSL", String::as_str);
    let mut diagnostic = Diagnostic::new(Code::Parse, headline).at(name, text, places);
    if diagnostic.labels.is_empty() {
        diagnostic.notes = messages.iter().skip(1).cloned().collect();
    }
    diagnostic
}

/// Checks every rule. Whatever a target cannot express is accepted here and refused by that target.
pub(crate) fn validate(name: &str, text: &str, module: &Module) -> Result<ModuleInfo, Diagnostic> {
    Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(module)
        .map_err(|error| validation_diagnostic(name, text, &error))
}

/// Types and uses of a module that is a reduced form of one that has been validated: nothing is checked again.
pub(crate) fn analyze(name: &str, text: &str, module: &Module) -> Result<ModuleInfo, Diagnostic> {
    Validator::new(ValidationFlags::empty(), Capabilities::all())
        .validate(module)
        .map_err(|error| validation_diagnostic(name, text, &error))
}

/// The chain of causes as one message; every span as a label.
pub(crate) fn validation_diagnostic(name: &str, text: &str, error: &WithSpan<ValidationError>) -> Diagnostic {
    let places = error.spans().filter_map(|(span, description)| {
        Some((range_in(text, *span)?, plain_label(description).to_owned()))
    });
    Diagnostic::new(Code::Validate, chain(error.as_inner())).at(name, text, places)
}

/// naga describes a span by the Rust type of what is there; that is no news to someone who wrote a shader.
fn plain_label(description: &str) -> &str {
    if description.starts_with("naga::") {
        ""
    } else {
        description
    }
}

/// An error and its causes, without causes that only repeat what stands before.
pub(crate) fn chain(error: &dyn Error) -> String {
    let mut message = error.to_string();
    let mut cause = error.source();
    while let Some(next) = cause {
        let said = next.to_string();
        if !message.ends_with(&said) {
            message = format!("{message}: {said}");
        }
        cause = next.source();
    }
    message
}

/// The bytes of a span, if it lies in the text.
pub(crate) fn range_in(text: &str, span: Span) -> Option<Range<usize>> {
    span.to_range().filter(|range| text.get(range.clone()).is_some())
}
