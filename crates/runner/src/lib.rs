//! Runs emitted shaders on an adapter: compute and render, read-back, timing.
//!
//! Code goes to the driver by one of two routes: `wgsl` through wgpu's compiler, `spirv` as the emitted file, unseen
//! ([`Code`]). Either way it is bound by what the manifest says and nothing else ([`Shader`]), resources by the names of
//! the shader's variables ([`Resources`]), uniforms member by member.
//!
//! - [`run_probe`], [`ProbeJob`]: a function over an array of inputs;
//! - [`ComputeJob`]: any dispatch;
//! - [`RenderJob`]: meshes drawn to targets of floats or bytes, in one pass or several, replaced or blended;
//! - [`time`]: how long a job takes.
//!
//! A [`Machine`] runs them: a [`Device`], or another implementation that needs no driver.
//!
//! Outputs hold a [sentinel](SENTINEL) before a shader runs, so what it never wrote can be told. Every failure is an
//! [`Error`] of the job that met it; the device goes on. A [`Device`] may be shared between threads.
//!
//! What this crate doesn't do: check SPIR-V (a driver may crash on what isn't valid), multisample, bind multisampled textures, or read back what a
//! drawn stage stores.
//!
//! ```
//! use bossage_runner::{AdapterSelector, Code, Device, Error, run_probe};
//! use bossage_translate::{EmitOptions, Shader, Source, manifest};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let text = "
//!     @group(0) @binding(0) var<storage, read> inputs: array<f32>;
//!     @group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
//!     @compute @workgroup_size(64) fn halve(@builtin(global_invocation_id) id: vec3u) {
//!         if id.x < arrayLength(&outputs) { outputs[id.x] = 0.5 * inputs[id.x]; }
//!     }";
//! let shader = Shader::parse("halve", &Source::Wgsl(text.to_owned()))?;
//! let manifest = manifest(&shader, &EmitOptions::default(), &[]);
//! let entry = manifest.entry("halve").ok_or("no entry point")?;
//!
//! let device = match Device::open(&AdapterSelector::Any) {
//!     Err(Error::NoAdapter) => return Ok(()), // nothing to run on
//!     device => device?,
//! };
//! let halves = run_probe(&device, Code::Wgsl(text), entry, &[2.0, 3.0, 5.0], 1, 3)?;
//! assert_eq!(halves, [1.0, 1.5, 2.5]);
//! # Ok(())
//! # }
//! ```

mod adapter;
mod binding;
mod cache;
mod code;
mod compute;
mod device;
mod error;
mod layout;
mod limits;
mod machine;
mod mesh;
mod passes;
mod passthrough;
mod picture;
mod pipeline;
mod probe;
mod readback;
mod render;
mod resolve;
mod resources;
mod sentinel;
mod surfaces;
mod target;
mod texture;
mod timing;
mod uniforms;
mod upload;

pub use adapter::{AdapterInfo, AdapterSelector, DeviceKind, adapters, cpu_model};
pub use cache::CacheSizes;
pub use code::{Code, Shader};
pub use compute::{ComputeJob, ComputeOutput};
pub use device::Device;
pub use error::{Error, HOW_TO_GET_AN_ADAPTER};
pub use limits::within;
pub use machine::{DispatchLimits, Machine};
pub use mesh::{Attribute, Mesh};
pub use picture::Picture;
pub use probe::{INPUTS, OUTPUTS, ProbeJob, run_probe};
pub use render::{Cull, Depth, Draw, RenderJob, RenderOutput};
pub use resolve::{Resolved, Value, push_constants, resolve};
pub use resources::{BufferData, PUSH_CONSTANTS, Resources, slot};
pub use sentinel::{SENTINEL, SENTINEL_BITS, is_unwritten, unwritten};
pub use target::{Blend, Clear, RenderTarget, TargetFormat};
pub use texture::{AddressMode, Filter, SamplerSettings, TexelFormat, TextureData, TextureDimension};
pub use timing::{Clock, TimedJob, Timing, TimingOptions, time};
