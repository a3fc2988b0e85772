//! Which module of the library a case asks for.
//!
//! A case says so by value, not by assembling for itself. So a bench prepares each module once, and it can be known without
//! running anything which cases a change of a source reaches: those whose assembled text it changes.

use std::fmt;

use bossage_shaders::{AssembledShader, FeatureSet, Kernel, Library, ProbeId, Stage};

/// One module of the library, by what it is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Module {
    /// One function over arrays.
    Probe(ProbeId),
    /// A compute kernel.
    Kernel(Kernel),
    /// One stage of the surface.
    Surface {
        /// What the surface does.
        features: FeatureSet,
        /// Which stage of it.
        stage: Stage,
    },
}

impl Module {
    /// The text of the module in a library.
    ///
    /// # Errors
    /// When the library's sources do not assemble.
    pub fn assemble(&self, library: &Library) -> bossage_shaders::Result<AssembledShader> {
        match self {
            Self::Probe(id) => library.assemble_probe(*id),
            Self::Kernel(kernel) => library.assemble_kernel(*kernel),
            Self::Surface { features, stage } => library.assemble_surface(features, *stage),
        }
    }
}

impl fmt::Display for Module {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Probe(id) => write!(f, "probe of {id}"),
            Self::Kernel(kernel) => f.write_str(&kernel.name()),
            Self::Surface { features, stage } => write!(f, "surface, {stage:?} of {features:?}"),
        }
    }
}
