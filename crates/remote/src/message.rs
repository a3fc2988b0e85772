//! What goes to a process: JSON that points into data.

use serde::Serialize;

/// A job.
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub(crate) enum Request {
    Compute {
        shader: Stage,
        groups: Vec<Vec<Entry>>,
        workgroups: [u32; 3],
    },
    Render {
        width: u32,
        height: u32,
        targets: Vec<Target>,
        read_depth: bool,
        passes: Vec<Vec<Draw>>,
    },
}

/// Offset and length of bytes in the data.
pub(crate) type Part = [u64; 2];

/// The bytes that a request points into.
#[derive(Debug, Default)]
pub(crate) struct Data(pub(crate) Vec<u8>);

impl Data {
    /// Takes bytes up.
    pub(crate) fn add(&mut self, bytes: &[u8]) -> Part {
        let offset = self.0.len() as u64;
        self.0.extend_from_slice(bytes);
        [offset, bytes.len() as u64]
    }
}

/// An entry point.
#[derive(Debug, Serialize)]
pub(crate) struct Stage {
    pub(crate) text: String,
    pub(crate) entry: String,
}

/// A resource at its place in a group.
#[derive(Debug, Serialize)]
pub(crate) struct Entry {
    pub(crate) binding: u32,
    /// WebGPU's flags of the stages that see it.
    pub(crate) visibility: u32,
    pub(crate) resource: Resource,
    /// Where GLSL has it, for OpenGL.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) glsl: Option<GlslSlot>,
}

/// A block, or a texture with its sampler, as GLSL has it.
#[derive(Debug, Serialize)]
pub(crate) struct GlslSlot {
    /// In each stage that has it.
    pub(crate) names: Vec<String>,
    pub(crate) unit: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sampler: Option<Sampler>,
}

#[derive(Debug, Serialize)]
#[serde(tag = "type", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub(crate) enum Resource {
    Uniform {
        data: Part,
    },
    Storage {
        data: Part,
        writable: bool,
    },
    Texture {
        width: u32,
        height: u32,
        layers: u32,
        dimension: &'static str,
        format: &'static str,
        texel_bytes: usize,
        filterable: bool,
        levels: Vec<Part>,
    },
    Sampler {
        filtering: bool,
        settings: Sampler,
    },
}

/// WebGPU's description of a sampler.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Sampler {
    pub(crate) address_mode_u: &'static str,
    pub(crate) address_mode_v: &'static str,
    pub(crate) address_mode_w: &'static str,
    pub(crate) mag_filter: &'static str,
    pub(crate) min_filter: &'static str,
    pub(crate) mipmap_filter: &'static str,
    pub(crate) max_anisotropy: u16,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Target {
    pub(crate) format: &'static str,
    pub(crate) pixel_bytes: u32,
    /// What it is cleared to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) colour: Option<[f32; 4]>,
    /// What is written to it instead.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) pixels: Option<Part>,
}

#[derive(Debug, Serialize)]
pub(crate) struct Draw {
    pub(crate) vertex: Stage,
    pub(crate) fragment: Stage,
    pub(crate) groups: Vec<Vec<Entry>>,
    pub(crate) attributes: Vec<Attribute>,
    pub(crate) indices: Part,
    pub(crate) states: States,
}

#[derive(Debug, Serialize)]
pub(crate) struct Attribute {
    pub(crate) location: u32,
    pub(crate) components: u32,
    pub(crate) values: Part,
}

/// How fragments meet what is there.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct States {
    pub(crate) cull: &'static str,
    pub(crate) depth_writes: bool,
    pub(crate) depth_compare: &'static str,
    pub(crate) targets: Vec<TargetState>,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct TargetState {
    pub(crate) format: &'static str,
    pub(crate) write_mask: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) blend: Option<Blend>,
}

#[derive(Debug, Serialize)]
pub(crate) struct Blend {
    pub(crate) color: BlendComponent,
    pub(crate) alpha: BlendComponent,
}

#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct BlendComponent {
    pub(crate) operation: &'static str,
    pub(crate) src_factor: &'static str,
    pub(crate) dst_factor: &'static str,
}
