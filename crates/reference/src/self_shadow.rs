//! `self_shadow`: whether the relief stands between a place on it and the light.
//!
//! From the hit record of the view: the place is at depth t, height 1 − t; where a search stopped over the surface or under it,
//! [`on_surface`] is the record to start from. The light's ray leaves it upward,
//! uv(s) = uv + s · rise with rise = scale · L.xy / L.z per axis, at the height 1 − t + s, and leaves the layer at s = t. Published as
//! the relief's own march turned round (Policarpo 2005, Tatarchuk 2006): so many samples, any of them under the surface is shadow.
//! [`obstruction`] is the truth that this samples: how far the surface stands over the ray at most, exactly.
//!
//! L is the unit vector to the light in tangent space. A light at or below the horizon, L.z ≤ 0, lights nothing; one lower than
//! [`MIN_VIEW_Z`] counts as one at that L.z.
//!
//! Limits: at the place itself surface and ray meet, so rounding decides there: a shadow needs more than [`BIAS_HEIGHT`].

use bossage_assets::{EdgeMode, HeightField};
use glam::{DVec2, DVec3};

use crate::relief_ray::{HitRecord, Layer, MIN_VIEW_Z, Ray};
use crate::relief_truth::cells::Walk;

/// Heights by which a surface must stand over the light's ray to shade: half a step of an 8-bit map.
pub const BIAS_HEIGHT: f64 = 0.5 / 255.0;

/// The record of the surface itself at a record's uv, where it has this height.
#[must_use]
pub fn on_surface(hit: &HitRecord, height: f64) -> HitRecord {
    HitRecord {
        t: 1.0 - height,
        ..*hit
    }
}

/// The ray from a place toward the light: from s = 0 at the place, one thickness of the layer a unit of s. `None` where the light is
/// not above the horizon.
#[must_use]
pub fn light_ray(hit: &HitRecord, light_ts: DVec3, layer: &Layer) -> Option<Ray> {
    (light_ts.z > 0.0).then(|| Ray {
        uv_top: hit.uv,
        delta: layer.scale * layer.per_axis() * light_ts.truncate() / light_ts.z.max(MIN_VIEW_Z),
    })
}

/// Whether any of the samples s = t/n, 2t/n, … t lies more than [`BIAS_HEIGHT`] under the surface.
#[must_use]
pub fn march(hit: &HitRecord, ray: &Ray, samples: u32, height: impl Fn(DVec2) -> f64) -> bool {
    (1..=samples).any(|sample| {
        let s = hit.t * f64::from(sample) / f64::from(samples);
        height(ray.at(s)) - (1.0 - hit.t + s) > BIAS_HEIGHT
    })
}

/// The greatest height by which the bilinear surface stands over the light's ray until that leaves the layer. Near 0 or above, since
/// the ray begins on the surface.
#[must_use]
pub fn obstruction(field: &HeightField, edge: EdgeMode, hit: &HitRecord, ray: &Ray) -> f64 {
    let mut walk = Walk::new(field, ray, hit.t);
    let mut greatest = f64::NEG_INFINITY;
    loop {
        let length = walk.exit() - walk.t;
        let above = walk.quadratic(field, edge, 1.0 - hit.t, 1.0);
        greatest = greatest.max(above.maximum(length));
        if walk.is_last() || walk.cells >= crate::relief_truth::MAX_CELLS {
            return greatest;
        }
        walk.advance();
    }
}

/// Whether the place is in shadow, exactly.
#[must_use]
pub fn is_shaded(
    field: &HeightField,
    edge: EdgeMode,
    hit: &HitRecord,
    light_ts: DVec3,
    layer: &Layer,
) -> bool {
    light_ray(hit, light_ts, layer).is_none_or(|ray| obstruction(field, edge, hit, &ray) > BIAS_HEIGHT)
}

#[cfg(test)]
mod tests {
    use bossage_assets::{EdgeMode, HeightField};
    use glam::{DVec2, DVec3};

    use super::{is_shaded, light_ray, march, obstruction};
    use crate::relief_ray::{HitRecord, Layer, Status};
    use crate::relief_truth::height_at;

    /// Ground at ¼ with a wall of height 1 at column 32 of 64.
    fn wall() -> HeightField {
        HeightField::from_fn(64, 4, |x, _| if x == 32 { 1.0 } else { 0.25 })
    }

    fn on_the_ground(u: f64) -> HitRecord {
        HitRecord {
            uv: DVec2::new(u, 0.5),
            t: 0.75,
            status: Status::Hit,
        }
    }

    #[test]
    fn the_walls_shadow_is_as_long_as_the_light_is_low() {
        // At 45° over a layer of 0.2 the shadow of ¾ of it ends 0.15 before the crest; the flank's foot is one texel before it.
        let (field, light, layer) = (wall(), DVec3::new(1.0, 0.0, 1.0), Layer::below(0.2));
        let crest = 32.5 / 64.0;
        let shaded = |u: f64| is_shaded(&field, EdgeMode::Clamp, &on_the_ground(u), light, &layer);
        assert!(shaded(crest - 0.149) && !shaded(crest - 0.151));
        assert!(
            !shaded(crest + 0.05),
            "behind the wall, seen from the light, is before it"
        );
        assert!(shaded(crest - 0.05));
    }

    #[test]
    fn obstruction_is_the_greatest_of_a_dense_march() {
        let field = HeightField::from_fn(16, 16, |x, y| ((x * 7 + y * 5) % 11) as f32 / 10.0);
        for i in 0..40 {
            let uv = DVec2::new(0.03 + 0.023 * f64::from(i), 0.91 - 0.019 * f64::from(i));
            let t = 1.0 - height_at(&field, EdgeMode::Mirror, uv);
            let hit = HitRecord {
                uv,
                t,
                status: Status::Hit,
            };
            let light = DVec3::new((f64::from(i)).cos(), (f64::from(i)).sin(), 0.3);
            let ray = light_ray(&hit, light, &Layer::below(0.1)).expect("above the horizon");
            let dense = (0..=20_000)
                .map(|k| f64::from(k) / 20_000.0 * t)
                .map(|s| height_at(&field, EdgeMode::Mirror, ray.at(s)) - (1.0 - t + s))
                .fold(f64::NEG_INFINITY, f64::max);
            let exact = obstruction(&field, EdgeMode::Mirror, &hit, &ray);
            // The march misses a summit by half a step at most, where the slope is at most 2·16·0.33 + 1 heights a unit of s.
            assert!(
                exact >= dense - 1e-12 && exact - dense < 12.0 * 0.5 / 20_000.0,
                "{i}"
            );
        }
    }

    #[test]
    fn samples_find_what_is_wider_than_their_spacing() {
        let (field, light, layer) = (wall(), DVec3::new(1.0, 0.0, 1.0), Layer::below(0.2));
        let hit = on_the_ground(32.5 / 64.0 - 0.05);
        let ray = light_ray(&hit, light, &layer).expect("above the horizon");
        let found = |samples| march(&hit, &ray, samples, |uv| height_at(&field, EdgeMode::Clamp, uv));
        assert!(found(64));
        assert!(
            !found(1),
            "witness: one sample, at the top of the layer, is over the wall"
        );
    }

    #[test]
    fn a_light_at_or_below_the_horizon_lights_nothing() {
        let field = HeightField::from_fn(4, 4, |_, _| 0.25);
        for z in [0.0, -1.0, f64::NAN] {
            let light = DVec3::new(1.0, 0.0, z);
            assert!(is_shaded(
                &field,
                EdgeMode::Wrap,
                &on_the_ground(0.3),
                light,
                &Layer::below(0.1)
            ));
        }
        // The control: the same plane under any light above it is lit.
        for z in [1e-9, 0.01, 1.0] {
            let light = DVec3::new(1.0, 0.0, z);
            assert!(!is_shaded(
                &field,
                EdgeMode::Wrap,
                &on_the_ground(0.3),
                light,
                &Layer::below(0.1)
            ));
        }
    }
}
