//! One shader in; SPIR-V, HLSL, MSL, GLSL and WGSL out, with a manifest, lints, and checks by external compilers.
//!
//! The translation is [naga]'s. What this crate adds is what an engine needs and naga leaves to wgpu:
//!
//! - every resource has a stated place in every language: real Metal slots, plain HLSL samplers and registers, GLSL names
//!   and units ([`emit()`]), written down in a [`Manifest`] so that nobody has to read the code to bind it;
//! - what a target cannot express is a [`Diagnostic`] with its place in the source, for that target alone; the other
//!   targets are still emitted, and nothing panics;
//! - compilers of others have the last word ([`external`]), and [`lint()`] warns of what no compiler refuses.
//!
//! A [`Shader`] is split into its entry points, each with only what it reaches, and compacted; the order of everything is
//! that of the source. Equal source and [`EmitOptions`] give equal bytes.
//!
//! Not here: mesh, task and ray stages; linking of stages; optimisation. Mistakes are [`Diagnostic`]s, which is this
//! crate's one error type: each has a [`Code`] and, where the source is text, a line with a caret.
//!
//! ```
//! use bossage_translate::{emit, manifest, EmitOptions, Shader, Source, Target};
//!
//! # fn main() -> Result<(), bossage_translate::Diagnostic> {
//! let text = "
//!     @group(0) @binding(0) var height_map: texture_2d<f32>;
//!     @group(0) @binding(1) var height_sampler: sampler;
//!     @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
//!         return textureSample(height_map, height_sampler, uv);
//!     }";
//! let shader = Shader::parse("height.wgsl", &Source::Wgsl(text.to_owned()))?;
//! let options = EmitOptions::default();
//! let hlsl = emit(&shader, Target::Hlsl, &options)?;
//!
//! let code = hlsl.files[0].contents.text().unwrap();
//! assert!(code.contains("SamplerState height_sampler : register(s1);"));
//!
//! let manifest = manifest(&shader, &options, &[hlsl]);
//! let height_map = &manifest.entries[0].bindings[0];
//! assert_eq!(height_map.hlsl.as_ref().unwrap().register, "t0");
//! # Ok(())
//! # }
//! ```

mod callable;
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
mod repairs;
mod resources;
pub mod shader;
pub mod source;
mod spirv;
pub mod target;
mod type_name;

pub use callable::Callable;
pub use cost::Cost;
pub use diagnostic::{Code, Details, Diagnostic, Label};
pub use emit::{Contents, Emitted, EmittedFile, emit};
pub use lint::{Lint, Severity, lint};
pub use manifest::{Manifest, manifest};
pub use options::{BoundsChecks, EmitOptions, GlslUnits};
pub use shader::{Overrides, Shader};
pub use source::{Language, Source};
pub use target::{GlslVersion, ShaderModel, Stage, Target};
