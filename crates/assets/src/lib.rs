//! Images and meshes in; height fields, normal maps, mip chains and tangent frames out.
//!
//! The CPU side of the bake and frame techniques: each file of a technique carries the technique's name, states its formula,
//! the faults of its published form, and the operation order by which its compute kernel gives the same bytes.
//!
//! Conventions: T along +u, B along +v, N outward, B = w·cross(N, T); heights in [0, 1], 1 = highest; images row-major with
//! row 0 at v near 0; triangles counter-clockwise seen from outside.
//!
//! This crate does not write files, does not know scenes, and applies no defaults to damaged input: what it cannot use, it
//! refuses with an [`Error`] that names file and texel, vertex or line.
//!
//! ```
//! use bossage_assets::height_to_normal::{self, Bake};
//! use bossage_assets::{EdgeMode, HeightField, NormalCodec};
//!
//! // A ramp that rises along u: normals lean back against it, to -x.
//! let field = HeightField::from_fn(8, 8, |x, _| x as f32 / 8.0);
//! let bake = Bake::central(&field, [0.1, 0.1], EdgeMode::Clamp, NormalCodec::Unorm)?;
//! let map = height_to_normal::bake(&field, &bake);
//! assert!(map.decode(4, 4).x < 0.0);
//! # Ok::<(), bossage_assets::Error>(())
//! ```

pub mod codec_biased;
pub mod codec_octahedral;
pub mod codec_snorm;
pub mod codec_two_channel;
pub mod codec_unorm;
mod color_map;
pub mod cone_map;
mod cube_map;
mod edge_mode;
pub mod encode;
mod error;
pub mod frame_from_normal;
pub mod frame_from_uv;
pub mod frame_mikktspace;
mod height_field;
pub mod height_to_normal;
pub mod height_to_normal_forward;
mod images;
pub mod max_mip;
mod mesh;
pub mod mips;
mod normal_encoding;
mod normal_map;
pub mod normal_mips;
pub mod normalisation_cube_map;
pub mod obj;
pub mod primitives;
pub mod relaxed_cone_map;
mod scaled;
mod slope_search;
mod truncate;
pub mod window_maxima;

pub use color_map::{ColorMap, linear_from_srgb, linear_from_srgb_byte, srgb_from_linear};
pub use cone_map::ConeMap;
pub use cube_map::{CubeFace, CubeMap};
pub use edge_mode::EdgeMode;
pub use error::{Error, MeshDefect};
pub use height_field::{HeightField, height_byte};
pub use images::{Channel, Image, MAX_DECODED_BYTES, MAX_SIDE, Texels, decode, load_image};
pub use mesh::Mesh;
pub use normal_encoding::NormalEncoding;
pub use normal_map::{NormalCodec, NormalMap};
pub use normalisation_cube_map::NormalisationCubeMap;
pub use window_maxima::WindowMaxima;
