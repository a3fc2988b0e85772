//! What an engine needs to bind the emitted files without reading them.
//!
//! The structs are the file format (`schema` 1): additions are allowed, renames are not. Every optional value is left out
//! of the JSON when there is none.
//!
//! What is stated about a language is read from what its writer reported, or from the emitted text itself, not guessed a
//! second time; `tests/manifest.rs` compares the rest with the files.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::cost::Cost;
use crate::options::EmitOptions;
use crate::target::Stage;

mod build;
mod interface;
mod layout;

pub(crate) use build::hex;
pub use build::manifest;

/// The version of the format that this code writes.
pub const SCHEMA: u32 = 1;

/// The manifest of one or more shaders.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Format version: [`SCHEMA`].
    pub schema: u32,
    /// Name and version of each tool that had a part in the files.
    pub tools: BTreeMap<String, String>,
    /// The options the files were emitted with.
    pub options: EmitOptions,
    /// One entry an entry point, in the order of the source.
    pub entries: Vec<Entry>,
}

impl Manifest {
    /// The entry point of this name.
    #[must_use]
    pub fn entry(&self, name: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.name == name)
    }

    /// Puts the entries of another manifest, made with the same options, behind these.
    pub fn append(&mut self, other: Self) {
        self.tools.extend(other.tools);
        self.entries.extend(other.entries);
    }
}

/// One entry point in all languages.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// The shader (module) it comes from.
    pub shader: String,
    /// The entry point's name in the source.
    pub name: String,
    /// Its stage.
    pub stage: Stage,
    /// File of each language, relative to the manifest.
    pub files: BTreeMap<String, String>,
    /// The entry point's name in each language; they differ where the name is a reserved word there.
    pub entry_points: BTreeMap<String, String>,
    /// SHA-256 of each file, in hexadecimal digits.
    pub sha256: BTreeMap<String, String>,
    /// The resources to bind, by (group, binding).
    pub bindings: Vec<Binding>,
    /// Layout of every uniform buffer.
    pub uniforms: Vec<Block>,
    /// Layout of every storage buffer.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub storage: Vec<Block>,
    /// Push constants and how each API passes them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub immediates: Option<Immediates>,
    /// What the stage reads from the stage or the assembler before it, and built-in values.
    pub inputs: Vec<Varying>,
    /// What the stage writes.
    pub outputs: Vec<Varying>,
    /// Invocations of a workgroup along x, y, z; of compute stages only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub workgroup_size: Option<[u32; 3]>,
    /// The pipeline-overridable constants with the values that were compiled in.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub overrides: Vec<OverrideValue>,
    /// HLSL: the constant buffer that the engine fills before each draw or dispatch, since Direct3D's vertex and instance
    /// numbers leave out the first ones and it has no count of workgroups.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hlsl_special_constants: Option<SpecialConstants>,
    /// MSL: the buffer with the byte sizes of buffers that end in a runtime array.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub msl_buffer_sizes: Option<BufferSizes>,
    /// GLSL: the plain `uint` uniform that holds the first instance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub glsl_first_instance: Option<String>,
    /// Static counts.
    pub cost: Cost,
}

/// One resource.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Binding {
    /// The variable's name in the source.
    pub name: String,
    /// What it is.
    pub kind: Kind,
    /// Group of the source.
    pub group: u32,
    /// Binding of the source.
    pub binding: u32,
    /// The type in WGSL's words.
    #[serde(rename = "type")]
    pub ty: String,
    /// Number of elements of a binding array; 0 if it is unsized.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
    /// Details of a texture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture: Option<Texture>,
    /// Where SPIR-V has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spirv: Option<SpirvSlot>,
    /// Where HLSL has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hlsl: Option<HlslSlot>,
    /// Where MSL has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub msl: Option<MslSlot>,
    /// Where GLSL has it. A sampler is in the textures it is used with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub glsl: Option<GlslSlot>,
}

/// Kinds of resources.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A uniform buffer.
    UniformBuffer,
    /// A storage buffer that is only read.
    ReadOnlyStorageBuffer,
    /// A storage buffer that is written.
    StorageBuffer,
    /// A texture that is sampled or loaded from.
    Texture,
    /// A depth texture.
    DepthTexture,
    /// A texture that is written or read without filtering.
    StorageTexture,
    /// A filtering or non-filtering sampler.
    Sampler,
    /// A sampler that compares with a reference depth.
    ComparisonSampler,
}

/// Details of a texture.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Texture {
    /// `1d`, `2d`, `3d` or `cube`.
    pub dimension: String,
    /// Whether it has layers.
    pub arrayed: bool,
    /// Whether it is multisampled.
    pub multisampled: bool,
    /// `f32`, `u32` or `i32`.
    pub sample_type: String,
    /// The texel format of a storage texture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub format: Option<String>,
    /// `read`, `write` or `read_write` of a storage texture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub access: Option<String>,
}

/// Vulkan's place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SpirvSlot {
    /// Descriptor set.
    pub set: u32,
    /// Binding in it.
    pub binding: u32,
}

/// Direct3D's place.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct HlslSlot {
    /// The variable's name in the text.
    pub name: String,
    /// Class and number, as in `t3`.
    pub register: String,
    /// Register space; 0 throughout in shader model 5.0.
    pub space: u32,
}

/// Metal's place.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MslSlot {
    /// `buffer`, `texture` or `sampler`.
    pub slot: String,
    /// Index in that argument table.
    pub index: u32,
}

/// OpenGL's place.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct GlslSlot {
    /// The name to look up: of the uniform block, the storage block, the combined sampler or the image. Of a sampler: of the
    /// first texture that it is used with.
    pub name: String,
    /// Block binding point, texture unit or image unit. In versions without binding layouts this is the number to set by
    /// name.
    pub unit: u32,
    /// Names of all combined samplers that use this sampler.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub textures: Vec<String>,
    /// The name (as in the source) of the sampler that this texture is combined with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sampler: Option<String>,
}

/// Layout of a buffer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Block {
    /// The variable's name in the source.
    pub name: String,
    /// Group of the source.
    pub group: u32,
    /// Binding of the source.
    pub binding: u32,
    /// Bytes to bind; of a buffer that ends in a runtime array: with one element.
    pub size: u32,
    /// The members; a buffer that is no struct has one member with an empty name.
    pub members: Vec<Member>,
}

/// A member of a buffer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Member {
    /// Its name in the source.
    pub name: String,
    /// Its type in WGSL's words.
    #[serde(rename = "type")]
    pub ty: String,
    /// Bytes from the start of the struct it is in.
    pub offset: u32,
    /// Bytes it takes; of a runtime array: one element.
    pub size: u32,
    /// Scalar, rows and columns, unless it is a struct (or an array of structs).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
    /// Of an array.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub array: Option<ArrayShape>,
    /// The members of a struct or of an array's element; offsets count from its start.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<Member>,
}

/// A scalar, a vector or a matrix of columns.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Value {
    /// `f32`, `u32`, `i32`, `f16`, …
    pub scalar: String,
    /// Components of a column: 1 for a scalar.
    pub rows: u32,
    /// Number of columns: 1 for scalars and vectors.
    pub columns: u32,
    /// Bytes from one column to the next.
    pub column_stride: u32,
}

/// How an array lies in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ArrayShape {
    /// Number of elements; 0 if the buffer's size decides.
    pub count: u32,
    /// Bytes from one element to the next.
    pub stride: u32,
}

/// Push constants.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Immediates {
    /// The variable's name in the source.
    pub name: String,
    /// Bytes.
    pub size: u32,
    /// The members.
    pub members: Vec<Member>,
    /// HLSL: the constant buffer that holds them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hlsl: Option<HlslSlot>,
    /// MSL: the buffer that holds them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub msl: Option<MslSlot>,
    /// GLSL: plain uniforms, by name.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub glsl: Vec<GlslImmediate>,
}

/// One plain uniform that stands for a push constant.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct GlslImmediate {
    /// The name to look up.
    pub name: String,
    /// Bytes from the start of the push constants.
    pub offset: u32,
    /// Bytes.
    pub size: u32,
}

/// A value that passes between stages, or a built-in.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Varying {
    /// The name in the source.
    pub name: String,
    /// The type in WGSL's words.
    #[serde(rename = "type")]
    pub ty: String,
    /// Location, of a user-defined value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub location: Option<u32>,
    /// WGSL's name of a built-in value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub builtin: Option<String>,
    /// `perspective`, `linear` or `flat`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<String>,
    /// `center`, `centroid`, `sample`, `first` or `either`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sampling: Option<String>,
    /// Second source of dual-source blending.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub blend_src: Option<u32>,
    /// HLSL: the semantic, as in `LOC0` or `SV_Position`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hlsl: Option<String>,
    /// MSL: the attribute, as in `attribute(0)`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub msl: Option<String>,
    /// GLSL: the variable.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub glsl: Option<String>,
}

/// An override and its value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OverrideValue {
    /// The name in the source.
    pub name: String,
    /// The number in `@id(N)`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub id: Option<u16>,
    /// The type in WGSL's words.
    #[serde(rename = "type")]
    pub ty: String,
    /// The value that was compiled in; none where the default is an expression.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
}

/// HLSL's constant buffer of draw parameters.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SpecialConstants {
    /// Its place.
    pub slot: HlslSlot,
    /// Three 32-bit values, in order: first vertex, first instance, one more; of a dispatch the workgroups along x, y, z.
    pub fields: Vec<String>,
}

/// MSL's buffer of buffer sizes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BufferSizes {
    /// Its place.
    pub slot: MslSlot,
    /// One `u32` for each of these variables, in this order.
    pub buffers: Vec<String>,
}
