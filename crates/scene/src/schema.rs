//! The scene format, version 1: every key, its range and its default. This is the one place where defaults live.
//!
//! A scene is a TOML file with `schema = 1`. Keys not listed here are refused. Paths are relative to the scene file. Colours are
//! linear; image files hold sRGB colour where they are albedo maps and plain numbers otherwise. Right-handed world; the camera
//! looks along −z of its own space.
//!
//! | key | value | default |
//! |---|---|---|
//! | `schema` | `1` | required |
//! | `ambient` | 3 numbers ≥ 0 | `[0, 0, 0]` |
//! | `[camera]` | | required |
//! | `camera.position`, `camera.target` | 3 numbers, not the same point | required |
//! | `camera.up` | 3 numbers, not parallel to the viewing direction | `[0, 1, 0]` |
//! | `camera.fov_deg` | vertical field of view, in (0, 180) | required |
//! | `camera.near`, `camera.far` | 0 < near < far | required |
//! | `camera.size` | width and height of the image, 1 to 16384 | required |
//! | `[budget]` | what the planner may spend | |
//! | `budget.error_px` | 99th percentile of the error it may leave, pixels > 0 | `1` where there is no `time_ms` |
//! | `budget.time_ms` | time that the relief of all materials may take in a frame, milliseconds > 0 | none |
//! | `budget.profile` | on which machine: a cost profile that is bundled (`lavapipe`), or a file `NAME.toml` | `lavapipe`; required with `time_ms` |
//! | `[[lights]]` | at most 16 | none |
//! | `lights.name` | unique | required |
//! | `lights.kind` | `directional`, `point` | required |
//! | `lights.direction` | directional only: the way the light travels, not 0 | required |
//! | `lights.position` | point only | required |
//! | `lights.color` | 3 numbers ≥ 0 | `[1, 1, 1]` |
//! | `lights.intensity` | number ≥ 0 | `1` |
//! | `[environment]` | what surrounds the scene | none |
//! | `environment.faces` | 6 square images of one size: +X, −X, +Y, −Y, +Z, −Z | required |
//! | `[[materials]]` | | none |
//! | `materials.name` | unique | required |
//! | `materials.albedo.color` | 3 or 4 numbers in \[0, 1\], multiplies the map | `[1, 1, 1, 1]` |
//! | `materials.albedo.map` | image | none |
//! | `materials.normal.map` | image, with the channels that its codec needs | required, or the next |
//! | `materials.normal.bake` | `central`, `forward`: from `height`, with its elevation and `address` | required, or the last |
//! | `materials.normal.codec` | `unorm`, `biased`, `snorm`, `two_channel`, `octahedral`; with `bake` one of the first two | required in `normal` |
//! | `materials.normal.mips` | `normalised`, `averaged` | `normalised` |
//! | `materials.height.map` | image | required in `height` |
//! | `materials.height.channel` | `red`, `green`, `blue`, `alpha`, `luminance` | `red` |
//! | `materials.height.scale`, `.bias` | z(h) = scale·h + bias in UV units; scale > 0 | required, or the next two |
//! | `materials.height.depth`, `.tile` | depth > 0 below the polygon, and width and height > 0 of one tile, world units | required, or the last two |
//! | `materials.specular` | 3 numbers ≥ 0 | `[0, 0, 0]` |
//! | `materials.shininess` | > 0, at most 65536 | `32` |
//! | `materials.alpha.mode` | `opaque`, `mask` | `opaque`; with `wrap_lambert` `mask` at 0.01 |
//! | `materials.alpha.cutoff` | in (0, 1], `mask` only | required with `mask` |
//! | `materials.address` | `wrap`, `mirror`, `clamp` | `wrap` |
//! | `materials.technique` | `auto`, `none`, `parallax_offset`, `parallax_offset_limited`, `parallax_slope_ao`, `parallax_slope_ao_directed`, `displacement`, `parallax_iterative`, `steep_parallax`, `parallax_occlusion`, `relief`, `cone_step`, `relaxed_cone_step`, `exact` | `auto` |
//! | `materials.iterations` | 1 to 4096; `parallax_iterative` only | `4` |
//! | `materials.layers` | 1 to 4096; `steep_parallax`, `parallax_occlusion`, `relief` only | `32`; `16` of `relief` |
//! | `materials.steps` | 1 to 4096; `cone_step`, `relaxed_cone_step` only | `32`; `16` of `relaxed_cone_step` |
//! | `materials.refinements` | 0 to 24; `relief`, `relaxed_cone_step` only | `5` |
//! | `materials.shadow` | `none`, `hard`, `soft`: what of the relief stands before the lights | `none` |
//! | `materials.light_samples` | 1 to 4096: heights read on the way to each light; with `shadow` only | `16` |
//! | `materials.light_half_width` | 0.001 to 1000: half the extent of each light, in slopes of the ray to its middle; `soft` only | `0.25` |
//! | `materials.pixel_depth` | `true`, `false`: whether the depth written is that of the place on the relief, so that it meets other objects where it is | `false` |
//! | `materials.occlusion` | ≥ 0: ambient light taken away by a unit of `parallax_slope_ao`'s shift | `40` |
//! | `materials.shading` | `blinn_phong`, `wrap_lambert`, `emboss`, `dot3_single_pass`, `dot3_two_pass` | `blinn_phong` |
//! | `materials.normaliser.kind` | `arithmetic`, `cube`; `dot3` only | `arithmetic` |
//! | `materials.normaliser.size` | texels along an edge of the cube map, 1 to 4096 | required with `cube` |
//! | `materials.normaliser.bits` | `8`, `16` | `8` |
//! | `materials.emboss_texels` | > 0: how far toward the light `emboss` reads the second height | `1` |
//! | `materials.reflection` | `auto`, `none`, `environment_bump` | `auto` |
//! | `materials.form` | `hardened`, `published` | `hardened` |
//! | `materials.lighting_space` | `world`, `object` | `world` |
//! | `materials.tangents` | `mikktspace`, `from_uv`, `from_normal` | `mikktspace` |
//! | `[[objects]]` | at least one | required |
//! | `objects.name` | unique | required |
//! | `objects.material` | name of a material | required |
//! | `objects.shape` | `plane`, `cube`, `sphere`, `torus`, `obj` | required |
//! | `objects.size` | plane: width and height > 0; cube: edge > 0 | `[2, 2]`; `2` |
//! | `objects.radius` | sphere: > 0 | `1` |
//! | `objects.major`, `objects.minor` | torus: > 0, minor < major | `1`, `0.4` |
//! | `objects.segments` | sphere, torus: around and along, 3 to 1024; plane: along u and v, 1 to 1024 | `[48, 24]`; `[1, 1]` |
//! | `objects.file` | obj: the file | required |
//! | `objects.uv_repeat` | 2 numbers, not 0; negative mirrors | `[1, 1]` |
//! | `objects.translate` | 3 numbers | `[0, 0, 0]` |
//! | `objects.rotate` | `{ axis, angle_deg }`, or an array of them, first to last | none |
//! | `objects.scale` | a number, or 3; none 0; negative mirrors | `[1, 1, 1]` |
//!
//! Rules across keys:
//!
//! - A pinned relief technique needs `height`. The offsets and the searches along the view ray need something textured to displace too (`albedo.map` or
//!   `normal`), the slope techniques `normal`. The searches go with `blinn_phong` and have one form.
//! - `shadow` needs `height` and goes with `blinn_phong` and a search along the view ray, pinned or chosen: it begins at the place that
//!   the search found. Where another technique is chosen there is none. Light is then measured in world space.
//! - `pixel_depth` needs the same, and like a shadow there is none where another technique is chosen. Where tiles differ in length on a
//!   mesh, their mean counts.
//! - `emboss` needs `height`, `dot3_single_pass` and `dot3_two_pass` need `normal`; these and `wrap_lambert` have exactly one
//!   light that is not black. Of relief techniques `wrap_lambert` goes with the slope's two and `displacement`, `emboss` and
//!   `dot3` with none. `wrap_lambert` has one ambient value: `ambient` must be grey.
//! - `wrap_lambert` cuts out alpha below 0.01 and nothing else; `dot3_two_pass` cannot cut out.
//! - `environment_bump` needs `[environment]`, `specular`, `blinn_phong` and no slope technique; `auto` mirrors where that holds.
//!   It is done in world space.
//! - `lighting_space = "object"` needs objects of equal scale on all axes: anything else bends the angles it measures.
//! - A height map that is constant is the polygon itself, whatever `scale` and `bias`, unless a technique is pinned.
//! - World depth: z_u = depth/tile width, z_v = depth/tile height, bias = −scale on each axis.

use bossage_reference::relief_search::Search;
use glam::{DVec2, DVec3, DVec4};

use crate::model::TechniquePin;

/// The version this crate reads.
pub const SCHEMA: u32 = 1;
/// Most lights a scene may have: the size of the shader's array.
pub const MAX_LIGHTS: usize = 16;
/// Largest image side of the camera, pixels: what every target's render targets can hold.
pub const MAX_CAMERA_SIDE: u32 = 16_384;
/// Largest scene file read.
pub const MAX_SCENE_BYTES: u64 = 4 << 20;
/// Largest shininess: pow(x, p) is a spike of one f32 step beyond it.
pub const MAX_SHININESS: f64 = 65_536.0;
/// Fewest and most segments of round shapes.
pub const SEGMENTS: std::ops::RangeInclusive<u32> = 3..=1024;

/// Default `camera.up`.
pub const UP: DVec3 = DVec3::Y;
/// Default `ambient`.
pub const AMBIENT: DVec3 = DVec3::ZERO;
/// Default `budget.error_px`.
pub const ERROR_PX: f64 = 1.0;
/// Default `budget.profile`.
pub const PROFILE: &str = "lavapipe";
/// Default `lights.color`.
pub const LIGHT_COLOR: DVec3 = DVec3::ONE;
/// Default `lights.intensity`.
pub const INTENSITY: f64 = 1.0;
/// Default `materials.albedo.color`.
pub const ALBEDO_COLOR: DVec4 = DVec4::ONE;
/// Default `materials.specular`.
pub const SPECULAR: DVec3 = DVec3::ZERO;
/// Default `materials.shininess`.
pub const SHININESS: f64 = 32.0;
/// Default `materials.occlusion`, as published.
pub const OCCLUSION: f64 = 40.0;
/// Most layers, steps or iterations of a search: what its shader counts to.
pub const MAX_STEPS: u32 = 4096;
/// Most refinements: after that a bracket is no longer wider than the rounding of its ends.
pub const MAX_REFINEMENTS: u32 = 24;

/// Default `materials.light_samples`.
pub const LIGHT_SAMPLES: u32 = 16;
/// Default `materials.light_half_width`.
pub const LIGHT_HALF_WIDTH: f64 = 0.25;
/// Least and greatest `materials.light_half_width`: a light is neither a point nor all of the sky.
pub const LIGHT_HALF_WIDTH_ENDS: [f64; 2] = [0.001, 1000.0];

/// A search with its default settings; none for pins that are no search.
#[must_use]
pub fn search(pin: TechniquePin) -> Option<Search> {
    match pin {
        TechniquePin::ParallaxOffset => Some(Search::ParallaxOffset),
        TechniquePin::ParallaxOffsetLimited => Some(Search::ParallaxOffsetLimited),
        TechniquePin::ParallaxIterative => Some(Search::ParallaxIterative { iterations: 4 }),
        TechniquePin::SteepParallax => Some(Search::SteepParallax { layers: 32 }),
        TechniquePin::ParallaxOcclusion => Some(Search::ParallaxOcclusion { layers: 32 }),
        TechniquePin::Relief => Some(Search::Relief {
            layers: 16,
            refinements: 5,
        }),
        TechniquePin::ConeStep => Some(Search::ConeStep { steps: 32 }),
        TechniquePin::RelaxedConeStep => Some(Search::RelaxedConeStep {
            steps: 16,
            refinements: 5,
        }),
        TechniquePin::Exact => Some(Search::Exact),
        TechniquePin::Auto
        | TechniquePin::None
        | TechniquePin::ParallaxSlopeAo
        | TechniquePin::ParallaxSlopeAoDirected
        | TechniquePin::Displacement => None,
    }
}

/// Default `materials.emboss_texels`.
pub const EMBOSS_TEXELS: f64 = 1.0;
/// The alpha below which `wrap_lambert` cuts out, as published.
pub const WRAP_ALPHA_CUTOFF: f64 = 0.01;
/// Sizes of a normalisation cube map.
pub const NORMALISER_SIZE: std::ops::RangeInclusive<u32> = 1..=4096;
/// Default `objects.size` of a plane.
pub const PLANE_SIZE: DVec2 = DVec2::new(2.0, 2.0);
/// Default `objects.size` of a cube.
pub const CUBE_SIZE: f64 = 2.0;
/// Default `objects.radius`.
pub const RADIUS: f64 = 1.0;
/// Default `objects.major`.
pub const TORUS_MAJOR: f64 = 1.0;
/// Default `objects.minor`.
pub const TORUS_MINOR: f64 = 0.4;
/// Default `objects.segments`.
pub const SEGMENTS_DEFAULT: [u32; 2] = [48, 24];
/// Fewest and most segments of a plane.
pub const PLANE_SEGMENTS: std::ops::RangeInclusive<u32> = 1..=1024;
/// Default `objects.segments` of a plane.
pub const PLANE_SEGMENTS_DEFAULT: [u32; 2] = [1, 1];
/// Default `objects.uv_repeat`.
pub const UV_REPEAT: DVec2 = DVec2::ONE;
