//! What a shader's inputs may be: declared in a sidecar file, inferred from names and types where nothing is declared.
//!
//! A sidecar is a TOML file beside the shader, `NAME.ranges.toml` for `NAME.wgsl`:
//!
//! ```toml
//! schema = 1
//! workgroups = [2, 1, 1]                        # compute shaders: how many workgroups run (default 1, 1, 1)
//!
//! [overrides]
//! layers = 16                                   # a pipeline-overridable constant: a number or a truth value
//!
//! [ranges]
//! normal = { unit = true }                      # a stage input by its name: a vector of length one
//! "tangent.w" = { one_of = [-1, 1] }            # one component of it
//! "material.shininess" = { lo = 1, hi = 4096 }  # a member of a buffer
//! "lights.items[].vector.xyz" = { unit = true } # of every element of an array
//! "lights.items[3].radiance" = { lo = 0, hi = [4, 4, 2] } # of one element, a bound for each component
//! heights = { size = 16, lo = 0, hi = 1 }       # a run-time sized array: how many elements, and their range
//! slopes = { size = 16 }                        # one that the shader only writes has nothing but a size
//! "heights[0..3]" = { unit = true }             # three scalars that are one unit vector
//! normal_map = { size = [8, 8], lo = 0, hi = 1 }  # a texture: its size, and the range of its texels
//! ```
//!
//! The more specific key wins over the more general one. A key that names nothing, an unknown word, `lo > hi` and numbers
//! that are not finite are errors with file, line and caret. [`infer`] states what holds for inputs that are not declared.
//!
//! [`Declared`] is the parsed file, [`Inputs`] what it means for one entry point, [`Point`] one choice of all inputs.

mod bind;
pub mod infer;
mod layout;
mod parse;
mod pattern;
mod report;
mod resolve;
mod sample;

pub use bind::UNWRITTEN;
pub use layout::{Target, scalar_names};
pub use parse::Declared;
pub use report::{Problem, Report};
pub use sample::{Point, Seed, Style};

use crate::kind::Kind;
use crate::texture::Dimension;

/// The values a group of scalars may have.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Each scalar on its own, between its bounds (both inclusive).
    Between(Vec<(f64, f64)>),
    /// Together a vector of length one, up to the rounding of its components to `f32`.
    Unit,
    /// Each scalar is one of these.
    OneOf(Vec<f64>),
}

/// Scalars that belong together: a vector, a scalar, a column of a matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// How the shader calls it: `normal`, `lights.items[3].vector`.
    pub name: String,
    /// Its scalars, as a range of [`Inputs::scalars`].
    pub scalars: std::ops::Range<usize>,
    /// What they may be.
    pub values: Values,
    /// Whether the sidecar says so; otherwise it is inferred.
    pub declared: bool,
}

/// One scalar of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InputScalar {
    /// Where it goes.
    pub target: Target,
    /// Its type.
    pub kind: Kind,
}

/// A texture of the input.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureInput {
    /// The variable's name.
    pub name: String,
    /// Bind group and binding number.
    pub binding: (u32, u32),
    /// Shape.
    pub dimension: Dimension,
    /// Width, height, depth.
    pub size: [u32; 3],
    /// Array layers; six for a cube.
    pub layers: u32,
    /// Samples of a texel.
    pub samples: u32,
    /// Textures of a binding array; 1 otherwise.
    pub count: u32,
    /// How texels are held.
    pub format: crate::texture::TexelFormat,
    /// Least and greatest value of each channel.
    pub channels: [(f64, f64); 4],
    /// Whether the sidecar gives the channels.
    pub declared: bool,
    /// Whether the variable is a storage texture.
    pub storage: bool,
}

/// A sampler of the input.
#[derive(Clone, Debug, PartialEq)]
pub struct SamplerInput {
    /// Bind group and binding number.
    pub binding: (u32, u32),
    /// Whether it compares.
    pub comparison: bool,
    /// Samplers of a binding array; 1 otherwise.
    pub count: u32,
}

/// Everything an entry point reads, and what it may be.
#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// All scalars: of buffers in the order of their types, of stage inputs component by component.
    pub scalars: Vec<InputScalar>,
    /// The scalars in groups, in the same order, without gaps.
    pub groups: Vec<Group>,
    /// Textures, sampled and storage.
    pub textures: Vec<TextureInput>,
    /// Samplers.
    pub samplers: Vec<SamplerInput>,
    /// Workgroups of a compute shader.
    pub workgroups: [u32; 3],
    /// Buffers, read or written.
    pub(crate) buffers: Vec<layout::BufferInput>,
    /// Which ranges of the sidecar named something here, by number.
    pub(crate) used: std::collections::BTreeSet<usize>,
}
