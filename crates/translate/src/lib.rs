//! One shader in; SPIR-V, HLSL, MSL, GLSL and WGSL out, with a manifest, lints, and checks by external compilers.
//!
//! The work is naga's; this crate makes its output fit for engines and says where everything is.

pub mod cost;
pub mod diagnostic;
pub mod emit;
pub mod external;
mod features;
mod front;
mod guard;
mod ir;
pub mod lint;
pub mod manifest;
pub mod options;
mod overrides;
mod resources;
pub mod shader;
pub mod source;
pub mod target;
mod type_name;

pub use cost::Cost;
pub use diagnostic::{Code, Diagnostic, Label};
pub use emit::{Contents, Emitted, EmittedFile, emit};
pub use lint::{Lint, Severity, lint};
pub use manifest::{Manifest, manifest};
pub use options::{BoundsChecks, EmitOptions, GlslUnits};
pub use shader::{Overrides, Shader};
pub use source::{Language, Source};
pub use target::{GlslVersion, ShaderModel, Stage, Target};
