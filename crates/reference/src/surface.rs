//! The whole surface shader in float64, evaluated at given interpolants.
//!
//! Order of the work, from the eye inward: frame from the interpolated vectors as they are (MikkTSpace style) → relief shift
//! of the texture coordinates, with its occlusion of ambient light → alpha test → perturbed normal → light, by kind of shading →
//! reflection. Linear; the sRGB encoding is a separate step. What each [`Shading`] adds up:
//!
//! - `BlinnPhong`: ambient · ao · albedo + Σ seen · radiance · (saturate(N·L) · albedo + pow(saturate(N·H), p) · specular), where
//!   `seen` is 1 without [`Shadow`];
//! - `Emboss`: ambient · albedo + radiance · saturate(saturate(N·L) + h − h′) · albedo, the light's part only where the light is
//!   above the polygon;
//! - `WrapLambert`: the second article's factor · radiance · albedo;
//! - `Dot3`: saturate(ambient + radiance · I) · albedo. The texture combiners of the third article saturate what they add, and
//!   so does the target between two passes; with ambient light 0 and a white light of 1 it is the article's I · albedo.
//!
//! Spaces: position, normal, tangent, eye and light positions in one lighting space (world or object); the environment is
//! looked up in world space.
//!
//! Limits: textures have one mip level; the rasteriser is not modelled, which is why the interpolants are inputs. Displaced
//! vertices show in the interpolants alone.

mod depth;
mod light;
mod shadow;
#[cfg(test)]
mod tests;

pub use depth::{DepthRows, depth};

use bossage_assets::cone_map::ConeMap;
use bossage_assets::{EdgeMode, HeightField};
use glam::{DVec2, DVec3, DVec4};

use crate::dot3_single_pass::Normaliser;
use crate::environment_bump::{self, Environment};
use crate::relief_ray::{HitRecord, Layer};
use crate::relief_search::{Maps, Search};
use crate::texture::Texture;
use crate::vector::{normalize, normalize_or_zero};
use crate::{
    Form, frame_mikktspace, light_to_tangent, parallax_offset, parallax_offset_limited, parallax_slope_ao,
    parallax_slope_ao_directed,
};

/// What the rasteriser hands to a fragment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interpolants {
    /// Position in lighting space.
    pub position: DVec3,
    /// Interpolated normal, not normalised.
    pub normal: DVec3,
    /// Interpolated tangent, not normalised, with the handedness in w.
    pub tangent: DVec4,
    /// Texture coordinates.
    pub uv: DVec2,
}

/// One light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// From far away: the unit vector toward the light.
    Directional {
        /// Unit, toward the light.
        toward: DVec3,
        /// Linear radiance.
        radiance: DVec3,
    },
    /// From a point, without attenuation.
    Point {
        /// Position in lighting space.
        position: DVec3,
        /// Linear radiance.
        radiance: DVec3,
    },
}

/// From where the surface is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewer {
    /// Position in lighting space.
    pub eye: DVec3,
    /// Unit vector against the viewing direction, one for all pixels: the published slope relief takes it for V.
    pub backward: DVec3,
}

/// How texture coordinates are shifted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Relief {
    /// Not at all.
    None,
    /// [`crate::parallax_offset`].
    Offset {
        /// Published or hardened.
        form: Form,
        /// Elevation of h = 1 over h = 0, in UV units.
        scale: f64,
        /// Elevation of h = 0, in UV units.
        bias: f64,
        /// Scale and bias are along u; along v they are this much larger (1 where the tile is square).
        v_factor: f64,
    },
    /// [`crate::parallax_offset_limited`].
    OffsetLimited {
        /// Elevation of h = 1 over h = 0, in UV units.
        scale: f64,
        /// Elevation of h = 0, in UV units.
        bias: f64,
        /// Scale and bias are along u; along v they are this much larger (1 where the tile is square).
        v_factor: f64,
    },
    /// [`crate::parallax_slope_ao`], or its directed form.
    Slope {
        /// Along the view, or along the texture's diagonal.
        directed: bool,
        /// Published or hardened.
        form: Form,
        /// Shift of a full slope, in UV units.
        scale: f64,
        /// The directed shift along v is this much larger (1 where the tile is square).
        v_factor: f64,
        /// Ambient light taken away by a unit of shift.
        occlusion: f64,
    },
    /// To where the view ray meets the heights: one of [`crate::relief_search`], which reads [`Material::search_maps`].
    Search {
        /// The technique with its settings.
        search: Search,
        /// Where the relief lies.
        layer: Layer,
    },
}

/// What of the relief stands between the place that a search found and the lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shadow {
    /// Nothing.
    None,
    /// [`crate::self_shadow`].
    Hard {
        /// Samples on the way to each light, at least one.
        samples: u32,
    },
    /// [`crate::soft_shadow`], hardened.
    Soft {
        /// Samples on the way to each light, at least one.
        samples: u32,
        /// Half the extent of each light, in slopes of the ray to its middle.
        half_width: f64,
    },
}

/// What a search along the view ray reads.
#[derive(Clone, Debug)]
pub struct SearchMaps {
    /// Heights in [0, 1].
    pub heights: HeightField,
    /// Free or relaxed cones.
    pub cones: Option<ConeMap>,
    /// Third components of unit normals, in green.
    pub normal_z: Option<Texture>,
}

/// What light does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shading {
    /// [`crate::blinn_phong`], or Lambert's cosine where there is no highlight.
    BlinnPhong,
    /// [`crate::wrap_lambert`]; the ambient value is the ambient light's red.
    WrapLambert,
    /// [`crate::emboss`].
    Emboss {
        /// How far toward the light the second height is read, UV units.
        step: f64,
    },
    /// [`crate::dot3_single_pass`], or one of the passes of [`crate::dot3_two_pass`].
    Dot3 {
        /// What makes a unit vector of the light vector.
        normaliser: Normaliser,
        /// Which draw.
        pass: Pass,
    },
}

/// Which draw of `dot3`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pass {
    /// One for all.
    Single,
    /// Light, with alpha 1.
    First,
    /// The colour that is multiplied in.
    Second,
}

/// A material with its textures.
#[derive(Clone, Debug)]
pub struct Material {
    /// Linear colour and alpha, multiplies the map.
    pub albedo: DVec4,
    /// Linear albedo map.
    pub albedo_map: Option<Texture>,
    /// Normal map, before decoding.
    pub normal_map: Option<Texture>,
    /// n = texel · x + y.
    pub normal_decode: DVec2,
    /// Height map, height in red.
    pub height_map: Option<Texture>,
    /// What [`Relief::Search`] reads.
    pub search_maps: Option<SearchMaps>,
    /// Shift of the texture coordinates.
    pub relief: Relief,
    /// What stands before the lights; nothing without [`Relief::Search`].
    pub shadow: Shadow,
    /// What makes a depth of the place that a search found; `None` where the polygon's is written.
    pub depth: Option<DepthRows>,
    /// Ambient light, linear.
    pub ambient: DVec3,
    /// Specular colour, linear; `None` where the shader has no highlight.
    pub specular: Option<DVec3>,
    /// Exponent of the highlight.
    pub shininess: f64,
    /// What light does.
    pub shading: Shading,
    /// What is mirrored and by which colour; `None` where nothing is.
    pub reflection: Option<(Environment, DVec3)>,
    /// Alpha below this is discarded; `None` for opaque.
    pub alpha_cutoff: Option<f64>,
    /// Sampler's edge mode.
    pub edge: EdgeMode,
}

/// The shaded fragment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fragment {
    /// Linear colour and alpha.
    Color(DVec4),
    /// Cut out by the alpha test.
    Discarded,
}

/// Evaluates the surface at one fragment.
#[must_use]
pub fn shade(
    material: &Material,
    lights: &[Light],
    viewer: &Viewer,
    at: &Interpolants,
    form: Form,
) -> Fragment {
    let view = unit(viewer.eye - at.position, form);
    let Shifted {
        uv,
        ambient_occlusion,
        hit,
    } = shifted_uv(material, at, viewer, form);
    let albedo = material.albedo * sample(material.albedo_map.as_ref(), material.edge, uv, DVec4::ONE);
    if material.alpha_cutoff.is_some_and(|cutoff| albedo.w < cutoff) {
        return Fragment::Discarded;
    }
    let surface = light::Surface {
        material,
        at,
        form,
        uv,
        hit,
        ambient_occlusion,
        albedo,
        view,
        bent: bent_normal(material, at, uv),
    };
    Fragment::Color(surface.lit(lights) + surface.mirrored().extend(0.0))
}

/// Where the maps are read, and how much ambient light arrives there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shifted {
    /// The texture coordinates after the relief shift.
    pub uv: DVec2,
    /// The share of ambient light.
    pub ambient_occlusion: f64,
    /// How a search ended, where there was one.
    pub hit: Option<HitRecord>,
}

/// The relief shift.
#[must_use]
pub fn shifted_uv(material: &Material, at: &Interpolants, viewer: &Viewer, form: Form) -> Shifted {
    let view = unit(viewer.eye - at.position, form);
    let view_ts = unit(light_to_tangent::world(at.normal, at.tangent, view), form);
    let height = sample(material.height_map.as_ref(), material.edge, at.uv, DVec4::ZERO).x;
    let in_uv = |v_factor: f64| view_ts * DVec3::new(1.0, v_factor, 1.0);
    let moved = |uv: DVec2| Shifted {
        uv,
        ambient_occlusion: 1.0,
        hit: None,
    };
    match material.relief {
        Relief::None => moved(at.uv),
        Relief::Search { search, layer } => {
            let hit = found(material, search, at.uv, view_ts, &layer);
            Shifted {
                hit,
                ..moved(hit.map_or(at.uv, |hit| hit.uv))
            }
        }
        Relief::Offset {
            form: Form::Published,
            scale,
            bias,
            v_factor,
        } => moved(parallax_offset::published(
            at.uv,
            in_uv(v_factor),
            height,
            scale,
            bias,
        )),
        Relief::Offset {
            form: Form::Hardened,
            scale,
            bias,
            v_factor,
        } => moved(parallax_offset::hardened(
            at.uv,
            in_uv(v_factor),
            height,
            scale,
            bias,
        )),
        Relief::OffsetLimited {
            scale,
            bias,
            v_factor,
        } => moved(parallax_offset_limited::offset(
            at.uv,
            in_uv(v_factor),
            height,
            scale,
            bias,
        )),
        Relief::Slope {
            directed,
            form,
            scale,
            v_factor,
            occlusion,
        } => {
            let n = bent_normal(material, at, at.uv);
            let shift = match (directed, form) {
                (true, _) => {
                    let delta = parallax_slope_ao::delta_hardened(n, at.normal, view, height, scale);
                    parallax_slope_ao_directed::shift(at.uv, in_uv(v_factor), delta, occlusion)
                }
                (false, Form::Published) => {
                    let delta =
                        parallax_slope_ao::delta_published(n, at.normal, viewer.backward, height, scale);
                    parallax_slope_ao::published(at.uv, delta, occlusion)
                }
                (false, Form::Hardened) => {
                    let delta = parallax_slope_ao::delta_hardened(n, at.normal, view, height, scale);
                    parallax_slope_ao::hardened(at.uv, delta, occlusion)
                }
            };
            Shifted {
                uv: shift.uv,
                ambient_occlusion: shift.ambient_occlusion,
                hit: None,
            }
        }
    }
}

/// The hit of a search; none where the maps are missing that it reads.
fn found(material: &Material, search: Search, uv: DVec2, view_ts: DVec3, layer: &Layer) -> Option<HitRecord> {
    let given = material.search_maps.as_ref()?;
    let normal_z = |uv: DVec2| sample(given.normal_z.as_ref(), material.edge, uv, DVec4::ONE).y;
    let maps = Maps {
        normal_z: Some(&normal_z),
        cones: given.cones.as_ref(),
        relaxed_cones: given.cones.as_ref(),
        ..Maps::of_heights(&given.heights, material.edge)
    };
    search.find(&maps, uv, view_ts, layer).map(|found| found.record)
}

/// The perturbed normal as it comes out of the frame, of any length.
#[must_use]
pub fn bent_normal(material: &Material, at: &Interpolants, uv: DVec2) -> DVec3 {
    material.normal_map.as_ref().map_or(at.normal, |map| {
        frame_mikktspace::combine(at.normal, at.tangent, normal_ts(material, map, uv))
    })
}

/// The map's normal, decoded, in tangent space.
fn normal_ts(material: &Material, map: &Texture, uv: DVec2) -> DVec3 {
    map.sample(material.edge, uv).truncate() * material.normal_decode.x + material.normal_decode.y
}

fn unit(v: DVec3, form: Form) -> DVec3 {
    match form {
        Form::Published => normalize(v),
        Form::Hardened => normalize_or_zero(v),
    }
}

fn sample(texture: Option<&Texture>, edge: EdgeMode, uv: DVec2, otherwise: DVec4) -> DVec4 {
    texture.map_or(otherwise, |texture| texture.sample(edge, uv))
}

/// What the surface mirrors from the view by a normal of any length.
fn reflected(view: DVec3, normal: DVec3, form: Form) -> DVec3 {
    match form {
        Form::Published => environment_bump::reflected_published(view, normal),
        Form::Hardened => environment_bump::reflected_hardened(view, normal),
    }
}
