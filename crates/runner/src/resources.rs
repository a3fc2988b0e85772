//! What a job binds, by the names that the shader's variables have in the manifest.

use std::borrow::Cow;
use std::collections::BTreeMap;

use crate::sentinel;
use crate::texture::{SamplerSettings, TextureData};

/// A storage buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BufferData<'a> {
    /// These bytes. Where the shader may write the buffer, it is read back.
    Bytes(&'a [u8]),
    /// So many bytes of [sentinel](crate::SENTINEL), read back afterwards.
    Output(usize),
}

impl BufferData<'_> {
    /// How many bytes.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Bytes(bytes) => bytes.len(),
            Self::Output(bytes) => *bytes,
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// What the buffer holds before the shader runs.
    #[must_use]
    pub fn bytes(&self) -> Cow<'_, [u8]> {
        match self {
            Self::Bytes(bytes) => Cow::Borrowed(bytes),
            Self::Output(bytes) => Cow::Owned(sentinel::fill(*bytes)),
        }
    }
}

/// Everything that a job binds. Keys are names of variables; where a shader has no names (stripped SPIR-V), [`slot`]
/// makes a key of group and binding.
#[derive(Clone, Debug, Default)]
pub struct Resources<'a> {
    /// Values of uniforms: `object.clip_from_local`, or just the variable's name where it is no struct. Matrices column
    /// by column. Values that no shader asks for are left out; a member that no value is given for is an error.
    pub uniforms: BTreeMap<String, Vec<f32>>,
    /// Storage buffers. A uniform buffer may stand here as well, as its bytes: then no values of its members are looked for. So do push
    /// constants, by their name or by [`PUSH_CONSTANTS`].
    pub buffers: BTreeMap<String, BufferData<'a>>,
    /// Textures.
    pub textures: BTreeMap<String, &'a TextureData>,
    /// Samplers.
    pub samplers: BTreeMap<String, SamplerSettings>,
}

/// The key of push constants that have no name.
pub const PUSH_CONSTANTS: &str = "push constants";

/// The key of a resource that has no name.
#[must_use]
pub fn slot(group: u32, binding: u32) -> String {
    format!("@group({group}) @binding({binding})")
}
