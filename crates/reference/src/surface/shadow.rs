//! What of a light is seen from the place on the relief that a search found.

use glam::DVec3;

use super::{Relief, Shadow, light::Surface, unit};
use crate::relief_ray::Status;
use crate::relief_truth::height_at;
use crate::{light_to_tangent, self_shadow, soft_shadow};

impl Surface<'_> {
    /// The share of a light in this direction, a unit vector, that is seen.
    pub(super) fn seen(&self, toward: DVec3) -> f64 {
        let (Some(hit), Relief::Search { layer, .. }, Some(maps)) =
            (self.hit, self.material.relief, &self.material.search_maps)
        else {
            return 1.0;
        };
        if self.material.shadow == Shadow::None || hit.status == Status::NonFinite {
            return 1.0;
        }
        let light_ts = light_to_tangent::world(self.at.normal, self.at.tangent, toward);
        let Some(ray) = self_shadow::light_ray(&hit, unit(light_ts, self.form), &layer) else {
            return 0.0;
        };
        let height = |uv| height_at(&maps.heights, self.material.edge, uv);
        let place = self_shadow::on_surface(&hit, height(hit.uv));
        match self.material.shadow {
            Shadow::None => 1.0,
            Shadow::Hard { samples } => {
                let shaded = self_shadow::march(&place, &ray, samples.max(1), height);
                f64::from(u8::from(!shaded))
            }
            Shadow::Soft { samples, half_width } => {
                let horizon = soft_shadow::sampled_horizon(&place, &ray, samples.max(1), height);
                soft_shadow::seen(horizon, half_width)
            }
        }
    }
}
