//! What light does at a fragment, by kind of shading.

use glam::{DVec2, DVec3, DVec4};

use super::{Interpolants, Light, Material, Pass, Shading, normal_ts, reflected, sample, unit};
use crate::dot3_single_pass::{self, Normaliser};
use crate::relief_ray::HitRecord;
use crate::vector::saturate;
use crate::{Form, blinn_phong, emboss, light_to_tangent, wrap_lambert};

/// A fragment that the alpha test kept.
pub(super) struct Surface<'a> {
    pub(super) material: &'a Material,
    pub(super) at: &'a Interpolants,
    pub(super) form: Form,
    /// Where the maps are read.
    pub(super) uv: DVec2,
    /// How a search for that place ended.
    pub(super) hit: Option<HitRecord>,
    pub(super) ambient_occlusion: f64,
    pub(super) albedo: DVec4,
    /// Unit, toward the eye.
    pub(super) view: DVec3,
    /// The perturbed normal, of any length.
    pub(super) bent: DVec3,
}

impl Surface<'_> {
    /// Colour and alpha by ambient light and lights.
    pub(super) fn lit(&self, lights: &[Light]) -> DVec4 {
        match self.material.shading {
            Shading::BlinnPhong => self.blinn_phong(lights),
            Shading::WrapLambert => self.wrapped(lights),
            Shading::Emboss { step } => self.embossed(lights, step),
            Shading::Dot3 { normaliser, pass } => self.dot3(lights, normaliser, pass),
        }
    }

    /// What of the environment it mirrors.
    pub(super) fn mirrored(&self) -> DVec3 {
        self.material
            .reflection
            .as_ref()
            .map_or(DVec3::ZERO, |(environment, specular)| {
                specular
                    * environment
                        .sample(reflected(self.view, self.bent, self.form))
                        .truncate()
            })
    }

    fn rgb(&self) -> DVec3 {
        self.albedo.truncate()
    }

    /// The vector toward a light, of any length for point lights, and the light's radiance.
    fn toward(&self, light: &Light) -> (DVec3, DVec3) {
        match *light {
            Light::Directional { toward, radiance } => (toward, radiance),
            Light::Point { position, radiance } => (position - self.at.position, radiance),
        }
    }

    /// The unit vector toward a light; a directional one's is given as such.
    fn unit_toward(&self, light: &Light) -> (DVec3, DVec3) {
        let (toward, radiance) = self.toward(light);
        match light {
            Light::Directional { .. } => (toward, radiance),
            Light::Point { .. } => (unit(toward, self.form), radiance),
        }
    }

    fn blinn_phong(&self, lights: &[Light]) -> DVec4 {
        let ambient = self.material.ambient * self.ambient_occlusion * self.rgb();
        let normal = unit(self.bent, self.form);
        let one = |light: &Light| {
            let (toward, radiance) = self.unit_toward(light);
            self.seen(toward) * radiance * self.reflected_light(normal, toward)
        };
        (ambient + lights.iter().map(one).sum::<DVec3>()).extend(self.albedo.w)
    }

    fn reflected_light(&self, normal: DVec3, toward: DVec3) -> DVec3 {
        let Some(specular) = self.material.specular else {
            return saturate(normal.dot(toward)) * self.rgb();
        };
        let reflectance = blinn_phong::Reflectance {
            diffuse: self.rgb(),
            specular,
            shininess: self.material.shininess,
        };
        match self.form {
            Form::Published => blinn_phong::published(normal, toward, self.view, &reflectance),
            Form::Hardened => blinn_phong::hardened(normal, toward, self.view, &reflectance),
        }
    }

    fn wrapped(&self, lights: &[Light]) -> DVec4 {
        let ambient = self.material.ambient.x;
        let one = |light: &Light| {
            let (toward, radiance) = self.unit_toward(light);
            match self.form {
                Form::Published => {
                    let factor =
                        wrap_lambert::factor_published(self.ambient_occlusion, ambient, self.bent, toward);
                    factor * radiance.extend(1.0) * self.albedo
                }
                Form::Hardened => {
                    let factor =
                        wrap_lambert::factor_hardened(self.ambient_occlusion, ambient, self.bent, toward);
                    (factor * radiance * self.rgb()).extend(self.albedo.w)
                }
            }
        };
        lights.first().map_or(DVec4::W * self.albedo.w, one)
    }

    fn embossed(&self, lights: &[Light], step: f64) -> DVec4 {
        let ambient = self.material.ambient * self.rgb();
        let normal = unit(self.bent, self.form);
        let height = |uv| {
            sample(
                self.material.height_map.as_ref(),
                self.material.edge,
                uv,
                DVec4::ZERO,
            )
            .x
        };
        let one = |light: &Light| {
            let (toward, radiance) = self.unit_toward(light);
            let light_ts = unit(
                light_to_tangent::world(self.at.normal, self.at.tangent, toward),
                self.form,
            );
            let diffuse = saturate(normal.dot(toward));
            let shifted = emboss::shifted_uv(self.uv, light_ts, step);
            let lit = if light_ts.z > 0.0 {
                emboss::lit(diffuse, height(self.uv), height(shifted))
            } else {
                0.0
            };
            radiance * lit * self.rgb()
        };
        (ambient + lights.iter().map(one).sum::<DVec3>()).extend(self.albedo.w)
    }

    fn dot3(&self, lights: &[Light], normaliser: Normaliser, pass: Pass) -> DVec4 {
        if pass == Pass::Second {
            return self.albedo;
        }
        let normal = self
            .material
            .normal_map
            .as_ref()
            .map_or(DVec3::Z, |map| normal_ts(self.material, map, self.uv));
        let one = |light: &Light| {
            let (toward, radiance) = self.toward(light);
            let light_ts = light_to_tangent::world(self.at.normal, self.at.tangent, toward);
            let intensity = dot3_single_pass::intensity(0.5 * normal + 0.5, normaliser.color(light_ts));
            intensity * radiance
        };
        let sum = self.material.ambient + lights.iter().map(one).sum::<DVec3>();
        let light = DVec3::from_array(sum.to_array().map(saturate));
        match pass {
            Pass::First => light.extend(1.0),
            Pass::Single | Pass::Second => (light * self.rgb()).extend(self.albedo.w),
        }
    }
}
