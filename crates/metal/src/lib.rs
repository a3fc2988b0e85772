//! A machine for emitted MSL, without Metal: the adapter `clang`.
//!
//! The text of an entry point, exactly as it was emitted, is compiled by clang as C++ with a `metal_stdlib` of ours, and linked to a
//! program that reads jobs. Each job runs in a process of its own with [`Limits`](bossage_translate::external::Limits) on its time,
//! its memory and its output: a crash, a hang or an endless loop is the error of that job and nothing else. One program serves all
//! jobs of an entry point, and is kept between runs under a hash of all that it is made of.
//!
//! - [`Metal`]: the machine. It runs [`Code::Msl`](bossage_runner::Code::Msl) alone. Pictures are rasterised as the adapter `embedded`
//!   does ([`bossage_embedded::render`]); here run the vertices, and fragments in quads, whose four lanes take turns, so that
//!   derivatives are what the quad's are.
//!
//! Arguments are bound by the slots that the manifest states, and go to the parameters whose attributes (`[[buffer(1)]]`) name these
//! slots, so a wrong slot shows as a failure. Arithmetic is IEEE single precision without contraction; functions beyond it are
//! those of the C library; textures are filtered in double precision and rounded once.
//!
//! What it cannot see: address spaces, which C++ does not have; what Metal's own compiler makes of the text, its fast mathematics
//! above all; SIMD groups.
//!
//! ```
//! use bossage_metal::Metal;
//! use bossage_runner::{Code, run_probe};
//! use bossage_translate::{EmitOptions, Shader, Source, Target, emit, external, manifest};
//!
//! let text = "
//!     @group(0) @binding(0) var<storage, read> inputs: array<f32>;
//!     @group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
//!     @compute @workgroup_size(64) fn halve(@builtin(global_invocation_id) id: vec3u) {
//!         if id.x < arrayLength(&outputs) { outputs[id.x] = 0.5 * inputs[id.x]; }
//!     }";
//! let shader = Shader::parse("halve", &Source::Wgsl(text.to_owned()))?;
//! let emitted = emit(&shader, Target::Msl, &EmitOptions::default())?;
//! let manifest = manifest(&shader, &EmitOptions::default(), std::slice::from_ref(&emitted));
//! let entry = manifest.entry("halve").ok_or("no entry point")?;
//! let msl = emitted.file("halve").and_then(|file| file.contents.text()).ok_or("no text")?;
//! let Ok(machine) = Metal::new(&external::detect(), None) else {
//!     return Ok(()); // no clang
//! };
//! let halves = run_probe(&machine, Code::Msl(msl), entry, &[2.0, 3.0, 5.0], 1, 3)?;
//! assert_eq!(halves, [1.0, 1.5, 2.5]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod caller;
mod child;
mod compute;
mod job;
mod machine;
mod program;
mod signature;
mod stages;
mod tables;
mod texels;

pub use machine::{Metal, NAME, info};
