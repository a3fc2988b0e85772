//! The bound of a whole surface fragment at given interpolants.
//!
//! The order of work is the surface's: frame from the interpolated vectors as they are → relief → alpha test → normal →
//! lights. Interpolants are exact here: they are what the fragment stage itself wrote out.

use bossage_assets::EdgeMode;
use bossage_reference::texture::Texture;

use super::formula::{
    bitangent, blinn_phong, blinn_phong_published, combine_frame, lambert, light_to_tangent, normalise,
    parallax_offset, parallax_offset_limited, parallax_offset_published,
};
use super::texture::{Storage, sample};
use crate::bounded::vector::{Vec3, add, multiply, normalize, scale, subtract};
use crate::bounded::{Bounded, Decision};

/// Which relief technique.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Relief {
    None,
    Offset,
    OffsetLimited,
}

/// One light: a direction where w = 0, a position where w = 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Light {
    pub(crate) vector: [f32; 4],
    pub(crate) radiance: [f32; 3],
}

/// A texture with what decides its filtering.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Map<'a> {
    pub(crate) texture: &'a Texture,
    pub(crate) storage: Storage,
}

/// All that a surface reads besides its interpolants.
#[derive(Clone, Debug)]
pub(crate) struct Surface<'a> {
    pub(crate) published: bool,
    pub(crate) relief: Relief,
    pub(crate) eye: [f32; 3],
    pub(crate) lights: Vec<Light>,
    pub(crate) albedo: [f32; 4],
    pub(crate) ambient: [f32; 3],
    pub(crate) specular: Option<[f32; 3]>,
    pub(crate) shininess: f32,
    pub(crate) elevation: [f32; 3],
    pub(crate) normal_decode: [f32; 2],
    pub(crate) alpha_cutoff: Option<f32>,
    pub(crate) edge: EdgeMode,
    pub(crate) albedo_map: Option<Map<'a>>,
    pub(crate) normal_map: Option<Map<'a>>,
    pub(crate) height_map: Option<Map<'a>>,
}

/// What the fragment stage was given, as it wrote it out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interpolants {
    pub(crate) position: [f32; 3],
    pub(crate) normal: [f32; 3],
    pub(crate) tangent: [f32; 4],
    pub(crate) uv: [f32; 2],
}

/// The bounded fragment: its colour, and whether the alpha test discards it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fragment {
    pub(crate) color: [Bounded; 4],
    pub(crate) discarded: Decision,
}

fn inputs<const N: usize>(values: [f32; N]) -> [Bounded; N] {
    values.map(Bounded::input)
}

impl Surface<'_> {
    /// The bound at one fragment.
    pub(crate) fn fragment(&self, at: &Interpolants) -> Fragment {
        let (position, normal, tangent) = (inputs(at.position), inputs(at.normal), inputs(at.tangent));
        let view = self.unit(&subtract(&inputs(self.eye), &position));
        let uv = self.uv(at, &normal, &tangent, &view);
        let albedo = multiply(
            &inputs(self.albedo),
            &self.read(self.albedo_map, &uv, [Bounded::exact(1.0); 4]),
        );
        let discarded = self
            .alpha_cutoff
            .map_or(Decision::Never, |cutoff| albedo[3].less(Bounded::input(cutoff)));
        let rgb = [albedo[0], albedo[1], albedo[2]];
        let shading_normal = self.normal(&uv, &normal, &tangent);
        let ambient = multiply(&inputs(self.ambient), &rgb);
        let [r, g, b] = self.lights.iter().fold(ambient, |sum, light| {
            add(&sum, &self.lit(light, &position, &shading_normal, &view, &rgb))
        });
        Fragment {
            color: [r, g, b, albedo[3]],
            discarded,
        }
    }

    fn unit(&self, v: &Vec3) -> Vec3 {
        if self.published {
            normalize(v)
        } else {
            normalise(v)
        }
    }

    fn read(&self, map: Option<Map<'_>>, uv: &[Bounded; 2], otherwise: [Bounded; 4]) -> [Bounded; 4] {
        map.map_or(otherwise, |map| sample(map.texture, map.storage, self.edge, uv))
    }

    fn uv(&self, at: &Interpolants, normal: &Vec3, tangent: &[Bounded; 4], view: &Vec3) -> [Bounded; 2] {
        let uv = inputs(at.uv);
        if self.relief == Relief::None {
            return uv;
        }
        let frame = ([tangent[0], tangent[1], tangent[2]], bitangent(normal, tangent));
        let view_ts = self.unit(&light_to_tangent(&frame.0, &frame.1, normal, view));
        let [height, ..] = self.read(self.height_map, &uv, [Bounded::exact(0.0); 4]);
        let [height_scale, height_bias, v_factor] = inputs(self.elevation);
        let z = height_scale * height + height_bias;
        let view_ts = [view_ts[0], view_ts[1] * v_factor, view_ts[2]];
        match (self.relief, self.published) {
            (Relief::Offset, false) => parallax_offset(&uv, z, &view_ts),
            (Relief::Offset, true) => parallax_offset_published(&uv, z, &view_ts),
            (Relief::OffsetLimited | Relief::None, _) => parallax_offset_limited(&uv, z, &view_ts),
        }
    }

    fn normal(&self, uv: &[Bounded; 2], normal: &Vec3, tangent: &[Bounded; 4]) -> Vec3 {
        let Some(map) = self.normal_map else {
            return self.unit(normal);
        };
        let [x, y, z, _] = sample(map.texture, map.storage, self.edge, uv);
        let [decode_scale, decode_bias] = inputs(self.normal_decode);
        let normal_ts = [x, y, z].map(|c| c * decode_scale + decode_bias);
        let tangent_dir = [tangent[0], tangent[1], tangent[2]];
        self.unit(&combine_frame(
            &tangent_dir,
            &bitangent(normal, tangent),
            normal,
            &normal_ts,
        ))
    }

    fn lit(&self, light: &Light, position: &Vec3, normal: &Vec3, view: &Vec3, albedo: &Vec3) -> Vec3 {
        let vector = inputs([light.vector[0], light.vector[1], light.vector[2]]);
        // A single directional light is used as it is; a loop over lights normalises each. The second is the wider bound.
        let toward = self.unit(&subtract(
            &vector,
            &scale(Bounded::input(light.vector[3]), position),
        ));
        let radiance = inputs(light.radiance);
        let Some(specular) = self.specular else {
            return multiply(&radiance, &scale(lambert(normal, &toward), albedo));
        };
        let (specular, shininess) = (inputs(specular), Bounded::input(self.shininess));
        let of = if self.published {
            blinn_phong_published
        } else {
            blinn_phong
        };
        multiply(
            &radiance,
            &of(normal, &toward, view, albedo, &specular, shininess),
        )
    }
}
