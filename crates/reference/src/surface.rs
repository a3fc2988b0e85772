//! The whole surface shader in float64, evaluated at given interpolants.
//!
//! Order of the work, from the eye inward: frame from the interpolated vectors as they are (MikkTSpace style) → relief shift
//! of the texture coordinates → alpha test → perturbed normal → lights. Colour = ambient · albedo + Σ radiance · (saturate(N·L) ·
//! albedo + pow(saturate(N·H), p) · specular), linear; the sRGB encoding is a separate step.
//!
//! Spaces: position, normal, tangent, eye and light positions in one lighting space (world or object).
//!
//! Limits: textures have one mip level; the rasteriser is not modelled, which is why the interpolants are inputs.

use bossage_assets::EdgeMode;
use glam::{DVec2, DVec3, DVec4};

use crate::texture::Texture;
use crate::vector::{normalize, normalize_or_zero, saturate};
use crate::{
    Form, blinn_phong, frame_mikktspace, light_to_tangent, parallax_offset, parallax_offset_limited,
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
    /// Shift of the texture coordinates.
    pub relief: Relief,
    /// Ambient light, linear.
    pub ambient: DVec3,
    /// Specular colour, linear; `None` where the shader has no highlight.
    pub specular: Option<DVec3>,
    /// Exponent of the highlight.
    pub shininess: f64,
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
pub fn shade(material: &Material, lights: &[Light], eye: DVec3, at: &Interpolants, form: Form) -> Fragment {
    let view = unit(eye - at.position, form);
    let uv = shifted_uv(material, at, view, form);
    let albedo = material.albedo * sample(material.albedo_map.as_ref(), material.edge, uv, DVec4::ONE);
    if material.alpha_cutoff.is_some_and(|cutoff| albedo.w < cutoff) {
        return Fragment::Discarded;
    }
    let normal = shading_normal(material, at, uv, form);
    let base = material.ambient * albedo.truncate();
    let color = lights.iter().fold(base, |sum, light| {
        sum + lit(material, light, albedo.truncate(), normal, view, at, form)
    });
    Fragment::Color(color.extend(albedo.w))
}

/// The texture coordinates after the relief shift.
#[must_use]
pub fn shifted_uv(material: &Material, at: &Interpolants, view: DVec3, form: Form) -> DVec2 {
    let view_ts = unit(light_to_tangent::world(at.normal, at.tangent, view), form);
    let height = sample(material.height_map.as_ref(), material.edge, at.uv, DVec4::ZERO).x;
    let in_uv = |v_factor: f64| view_ts * DVec3::new(1.0, v_factor, 1.0);
    match material.relief {
        Relief::None => at.uv,
        Relief::Offset {
            form: Form::Published,
            scale,
            bias,
            v_factor,
        } => parallax_offset::published(at.uv, in_uv(v_factor), height, scale, bias),
        Relief::Offset {
            form: Form::Hardened,
            scale,
            bias,
            v_factor,
        } => parallax_offset::hardened(at.uv, in_uv(v_factor), height, scale, bias),
        Relief::OffsetLimited {
            scale,
            bias,
            v_factor,
        } => parallax_offset_limited::offset(at.uv, in_uv(v_factor), height, scale, bias),
    }
}

/// The unit normal that the lights see.
#[must_use]
pub fn shading_normal(material: &Material, at: &Interpolants, uv: DVec2, form: Form) -> DVec3 {
    let Some(map) = &material.normal_map else {
        return unit(at.normal, form);
    };
    let texel = map.sample(material.edge, uv).truncate();
    let normal_ts = texel * material.normal_decode.x + material.normal_decode.y;
    unit(frame_mikktspace::combine(at.normal, at.tangent, normal_ts), form)
}

fn lit(
    material: &Material,
    light: &Light,
    albedo: DVec3,
    normal: DVec3,
    view: DVec3,
    at: &Interpolants,
    form: Form,
) -> DVec3 {
    let (toward, radiance) = match *light {
        Light::Directional { toward, radiance } => (toward, radiance),
        Light::Point { position, radiance } => (unit(position - at.position, form), radiance),
    };
    let Some(specular) = material.specular else {
        return radiance * saturate(normal.dot(toward)) * albedo;
    };
    let reflectance = blinn_phong::Reflectance {
        diffuse: albedo,
        specular,
        shininess: material.shininess,
    };
    radiance
        * match form {
            Form::Published => blinn_phong::published(normal, toward, view, &reflectance),
            Form::Hardened => blinn_phong::hardened(normal, toward, view, &reflectance),
        }
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

#[cfg(test)]
mod tests {
    use bossage_assets::EdgeMode;
    use glam::{DVec2, DVec3, DVec4};

    use super::{Fragment, Interpolants, Light, Material, Relief, shade};
    use crate::Form;
    use crate::texture::Texture;

    fn plain() -> Material {
        Material {
            albedo: DVec4::new(0.5, 0.25, 1.0, 1.0),
            albedo_map: None,
            normal_map: None,
            normal_decode: DVec2::new(2.0, -1.0),
            height_map: None,
            relief: Relief::None,
            ambient: DVec3::splat(0.5),
            specular: None,
            shininess: 1.0,
            alpha_cutoff: None,
            edge: EdgeMode::Wrap,
        }
    }

    const FACING: Interpolants = Interpolants {
        position: DVec3::ZERO,
        normal: DVec3::Z,
        tangent: DVec4::new(1.0, 0.0, 0.0, 1.0),
        uv: DVec2::new(0.25, 0.25),
    };
    const SUN: Light = Light::Directional {
        toward: DVec3::Z,
        radiance: DVec3::ONE,
    };

    #[test]
    fn ambient_and_a_light_from_the_front() {
        let color = shade(&plain(), &[SUN], DVec3::Z, &FACING, Form::Hardened);
        assert_eq!(color, Fragment::Color(DVec4::new(0.75, 0.375, 1.5, 1.0)));
    }

    #[test]
    fn a_normal_map_turns_the_light_away() {
        // Texel (255, 128+, 128+) decodes to n = (1, ~0, ~0): nearly along T, so the light from N barely reaches it.
        let map = Texture {
            width: 1,
            height: 1,
            texels: vec![DVec4::new(1.0, 0.5, 0.5, 1.0)],
        };
        let material = Material {
            normal_map: Some(map),
            ..plain()
        };
        let color = shade(&material, &[SUN], DVec3::Z, &FACING, Form::Hardened);
        assert_eq!(color, Fragment::Color(DVec4::new(0.25, 0.125, 0.5, 1.0)));
    }

    #[test]
    fn alpha_cuts() {
        let material = Material {
            alpha_cutoff: Some(0.5),
            albedo: DVec4::new(1.0, 1.0, 1.0, 0.25),
            ..plain()
        };
        assert_eq!(
            shade(&material, &[], DVec3::Z, &FACING, Form::Hardened),
            Fragment::Discarded
        );
    }

    #[test]
    fn relief_moves_the_lookup() {
        let height_map = Texture::from_r32float(1, 1, &[1.0]);
        let albedo_map = Texture::from_rgba8(2, 1, &[0, 0, 0, 255, 255, 255, 255, 255]);
        let relief = Relief::OffsetLimited {
            scale: 0.5 * 2f64.sqrt(),
            bias: 0.0,
            v_factor: 1.0,
        };
        let material = Material {
            height_map: Some(height_map),
            albedo_map: Some(albedo_map),
            relief,
            ..plain()
        };
        // The eye at 45° along +u shifts by scale · V.x = 0.5: from the black texel's centre to the white one's.
        let Fragment::Color(color) =
            shade(&material, &[], DVec3::new(1.0, 0.0, 1.0), &FACING, Form::Hardened)
        else {
            panic!("opaque material was cut");
        };
        // Weights next to 1 lose at most a few units of 2^-53.
        assert!((color.x - 0.25).abs() < 1e-15);
    }
}
