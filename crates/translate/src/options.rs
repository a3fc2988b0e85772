//! Every choice that changes emitted code, in one value that goes into the manifest.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::target::{GlslVersion, ShaderModel};

/// How to emit. Equal options and equal source give equal bytes.
///
/// Clip space is WebGPU's in every language: y points up and depth runs from 0 to 1. Vulkan wants a viewport of negative
/// height, OpenGL `glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE)`; where an engine can do neither,
/// [`adjust_clip_space`](Self::adjust_clip_space) bakes the change into the vertex shader.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EmitOptions {
    /// SPIR-V version, (major, minor). 1.0 loads everywhere.
    pub spirv: (u8, u8),
    /// HLSL shader model.
    pub hlsl: ShaderModel,
    /// Metal Shading Language version, (major, minor), 2.0 or later.
    pub msl: (u8, u8),
    /// GLSL version.
    pub glsl: GlslVersion,
    /// How GLSL resources are numbered.
    pub glsl_units: GlslUnits,
    /// SPIR-V: flip y in vertex shaders. GLSL: flip y and stretch depth to −1…1.
    pub adjust_clip_space: bool,
    /// Whether indices are clamped into their arrays, buffers and textures.
    pub bounds_checks: BoundsChecks,
    /// Whether loops get a counter that ends them after 2⁶⁴ rounds, which keeps a compiler from treating an endless loop
    /// as undefined.
    pub bound_loops: bool,
}

impl Default for EmitOptions {
    fn default() -> Self {
        Self {
            spirv: (1, 0),
            hlsl: ShaderModel::V5_1,
            msl: (2, 0),
            glsl: GlslVersion::Core450,
            glsl_units: GlslUnits::Auto,
            adjust_clip_space: false,
            bounds_checks: BoundsChecks::Off,
            bound_loops: false,
        }
    }
}

/// What happens to an index that is out of range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BoundsChecks {
    /// Nothing: as hand-written shaders do. The result is whatever the API says.
    #[default]
    Off,
    /// Indices are clamped, as WGSL demands of a browser. MSL then needs the sizes of runtime arrays in a buffer.
    Restrict,
}

/// How GLSL binding points and texture units are numbered.
///
/// OpenGL links stages into one program with one set of binding points, while vertex and fragment shaders may be
/// emitted from separate modules: a number must depend on (group, binding) alone, not on what else a stage uses.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GlslUnits {
    /// `Stride(8)` where all bindings of the module are below 8, else `Dense`.
    #[default]
    Auto,
    /// group × stride + binding.
    Stride(u32),
    /// The rank of (group, binding) among all bindings of the module: small numbers, the same for all entry points of one
    /// module, but not across modules.
    Dense,
    /// Exactly these numbers; a binding that is missing is an error.
    #[serde(with = "unit_map")]
    Map(BTreeMap<(u32, u32), u32>),
}

/// Pairs as keys do not exist in JSON: a map is written as `[[group, binding, unit], …]`.
mod unit_map {
    use std::collections::BTreeMap;

    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(
        map: &BTreeMap<(u32, u32), u32>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let rows: Vec<(u32, u32, u32)> = map.iter().map(|(&(g, b), &u)| (g, b, u)).collect();
        rows.serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<BTreeMap<(u32, u32), u32>, D::Error> {
        let rows = Vec::<(u32, u32, u32)>::deserialize(deserializer)?;
        Ok(rows.into_iter().map(|(g, b, u)| ((g, b), u)).collect())
    }
}
