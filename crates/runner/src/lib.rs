//! Runs emitted shaders on an adapter: compute and render, read-back, timing.

mod adapter;
mod binding;
mod cache;
mod code;
mod compute;
mod device;
mod error;
mod layout;
mod mesh;
mod passes;
mod passthrough;
mod pipeline;
mod probe;
mod readback;
mod render;
mod resources;
mod sentinel;
mod texture;
mod timing;
mod uniforms;
mod upload;

pub use adapter::{AdapterInfo, AdapterSelector, DeviceKind, adapters};
pub use cache::CacheSizes;
pub use code::{Code, Shader};
pub use compute::{ComputeJob, ComputeOutput};
pub use device::Device;
pub use error::{Error, HOW_TO_GET_AN_ADAPTER};
pub use mesh::{Attribute, Mesh};
pub use probe::{INPUTS, OUTPUTS, ProbeJob, run_probe};
pub use render::{Blend, Clear, Cull, Depth, Draw, Picture, RenderJob, RenderOutput};
pub use resources::{BufferData, Resources, slot};
pub use sentinel::{SENTINEL, SENTINEL_BITS, is_unwritten, unwritten};
pub use texture::{AddressMode, Filter, SamplerSettings, TexelFormat, TextureData, TextureDimension};
pub use timing::{Clock, TimedJob, Timing, TimingOptions, time};
