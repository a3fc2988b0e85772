//! Float64 truth for every technique of the library, one file a technique, written from the published formulas.
//!
//! This crate is an **oracle**: it knows nothing of shaders and shares no code with them. What it computes is what the formula
//! says, carried out in float64; how far a shader may be from it is decided elsewhere (`bossage-conformance`).
//!
//! Conventions, fixed for the whole project: T along +u, B along +v, N out of the surface, B = w · (N × T); height h in
//! [0, 1] with 1 the highest; elevation over the polygon z(h) = scale · h + bias in UV units; V and L are unit vectors from the
//! surface to the eye and to the light; colours are linear.
//!
//! Two forms where a technique has a known fault: **published**, the formula exactly as printed, faults included, and
//! **hardened**, the same effect with the fault cured. A published form returns NaN or infinity where the formula does.
//!
//! ```
//! use bossage_assets::{EdgeMode, HeightField};
//! use bossage_reference::relief_ray::{Layer, Status};
//! use bossage_reference::relief_truth::trace;
//! use glam::{DVec2, DVec3};
//!
//! let field = HeightField::from_fn(8, 8, |_, _| 0.75);
//! let view_ts = DVec3::new(0.6, 0.0, 0.8);
//! let hit = trace(&field, EdgeMode::Wrap, DVec2::splat(0.5), view_ts, &Layer::below(0.04));
//! assert_eq!(hit.status, Status::Hit);
//! assert!((hit.t - 0.25).abs() < 1e-15);
//! ```

pub mod blinn_phong;
pub mod codec_biased;
pub mod codec_octahedral;
pub mod codec_snorm;
pub mod codec_two_channel;
pub mod codec_unorm;
pub mod cone_map;
pub mod cone_step;
pub mod cube;
pub mod displacement;
pub mod dot3;
pub mod dot3_single_pass;
pub mod dot3_two_pass;
pub mod emboss;
pub mod environment_bump;
pub mod frame_from_normal;
pub mod frame_from_uv;
pub mod frame_mikktspace;
pub mod height_to_normal;
pub mod height_to_normal_forward;
pub mod height_to_normal_fourth_order;
pub mod light_to_tangent;
pub mod max_mip;
pub mod normal_mips;
pub mod normal_transform;
pub mod normalisation_cube_map;
pub mod parallax_iterative;
pub mod parallax_occlusion;
pub mod parallax_offset;
pub mod parallax_offset_limited;
pub mod parallax_slope_ao;
pub mod parallax_slope_ao_directed;
pub mod pixel_depth;
pub mod relaxed_cone_step;
pub mod relief;
pub mod relief_grazing;
pub mod relief_ray;
pub mod relief_search;
pub mod relief_truth;
pub mod self_shadow;
pub mod soft_shadow;
pub mod sphere;
pub mod srgb;
pub mod steep_parallax;
pub mod surface;
pub mod texture;
pub mod vector;
pub mod wrap_lambert;

/// Which form of a technique.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Form {
    /// The formula as printed, faults included.
    Published,
    /// The same effect with the known faults cured.
    Hardened,
}
