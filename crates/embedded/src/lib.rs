//! A machine without a driver: the `embedded` adapter.
//!
//! It runs the same jobs as a device, compute and render, by evaluating the shaders' IR in the `F32` domain of
//! [`bossage_bounds`] (IEEE single precision, round to nearest after each operation), and rasterises by itself. It is there on
//! every machine, and it is perfect by construction: what it returns is what a correctly rounded implementation returns.
//!
//! - [`adapters`]: every driver's, and `embedded` as the last;
//! - [`open`]: the one that is wanted; without any driver that is this one;
//! - [`Embedded`]: the machine itself;
//! - [`bindings`]: what a job binds, as the evaluator takes it in any of its domains;
//! - [`render`]: the rasteriser, for another machine that runs [`Stages`] in a way of its own.
//!
//! What is taken from whom. Shading, texture reads and derivatives are the evaluator's. Coverage is a rasteriser's business,
//! which no accuracy rule covers; ours follows what drivers do (see [`Embedded`]), so that pictures can be compared.
//!
//! Limits: no multisampling; no anisotropic filtering; no storage buffers written by a fragment stage (helper invocations
//! would write, too); triangles only. Not for measuring time: nothing here says how fast a GPU is.
//!
//! ```
//! use bossage_embedded::Embedded;
//! use bossage_runner::{Code, run_probe};
//! use bossage_translate::{EmitOptions, Shader, Source, manifest};
//!
//! let text = "
//!     @group(0) @binding(0) var<storage, read> inputs: array<f32>;
//!     @group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
//!     @compute @workgroup_size(64) fn halve(@builtin(global_invocation_id) id: vec3u) {
//!         if id.x < arrayLength(&outputs) { outputs[id.x] = 0.5 * inputs[id.x]; }
//!     }";
//! let shader = Shader::parse("halve", &Source::Wgsl(text.to_owned()))?;
//! let manifest = manifest(&shader, &EmitOptions::default(), &[]);
//! let entry = manifest.entry("halve").ok_or("no entry point")?;
//! let halves = run_probe(&Embedded::new(), Code::Wgsl(text), entry, &[2.0, 3.0, 5.0], 1, 3)?;
//! assert_eq!(halves, [1.0, 1.5, 2.5]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bind;
mod clip;
mod compute;
mod coverage;
mod draw;
mod failure;
mod frame;
mod machine;
mod program;
mod render;
mod select;
mod shade;
mod stages;
mod surface;
mod texture;
mod triangle;
mod vertex;

pub use bind::bindings;
pub use machine::Embedded;
pub use render::render;
pub use select::{NAME, adapters, info, open};
pub use stages::{Open, Stages};
