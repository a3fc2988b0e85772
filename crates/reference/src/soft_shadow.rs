//! `soft_shadow`: how much of a light with an extent is seen from a place on the relief.
//!
//! Published (Tatarchuk 2006, as in the vendor's sample): seven heights along L.xy·scale, which is not divided by L.z, at the shares
//! 0.22, 0.33, … 0.88; shadow = max of (hᵢ − h₀ − shareᵢ) · weightᵢ · softening with weights 12, 10, 8, 6, 4, 2, 1, and the light
//! is 1 − 0.6 of it, not clamped. Faults: seven samples whatever the distance; a place that faces away may come out brighter than
//! 1 (negative shadows are not cut) or darker than black.
//!
//! Hardened: along the true ray of `self_shadow`. Seen from the place, the relief's horizon stands at the slope H = sup (h − h₀)/s,
//! in units of the slope of the ray to the light's middle, which is 1. A light that reaches from slope 1 − w to 1 + w is seen by
//! the share (1 + w − H)/2w, clamped to [0, 1]. With samples, H is the greatest of theirs; [`horizon`] is exact.
//!
//! Limits: w > 0; the light is taken for a band of even brightness across the horizon.

use bossage_assets::{EdgeMode, HeightField};
use glam::{DVec2, DVec3};

use crate::relief_ray::{HitRecord, Ray};
use crate::relief_truth::MAX_CELLS;
use crate::relief_truth::cells::{Quadratic, Walk};
use crate::self_shadow::BIAS_HEIGHT;

/// Shares of the layer's thickness and weights of the published samples.
pub const PUBLISHED_SAMPLES: [(f64, f64); 7] = [
    (0.22, 12.0),
    (0.33, 10.0),
    (0.44, 8.0),
    (0.55, 6.0),
    (0.66, 4.0),
    (0.77, 2.0),
    (0.88, 1.0),
];

/// The light of the greatest of the samples' shadows, as published. The listing is HLSL, so its numbers are those of f32.
#[must_use]
pub fn published_light(shadow: f64) -> f64 {
    (1.0 - shadow) * f64::from(0.6_f32) + f64::from(0.4_f32)
}

/// What one sample adds to the shadow, as published: its height over the ground and over its share of the layer, weighted.
#[must_use]
pub fn published_sample(height: f64, ground: f64, (share, weight): (f64, f64), softening: f64) -> f64 {
    (height - ground - share) * weight * softening
}

/// The published light factor.
#[must_use]
pub fn published(
    uv: DVec2,
    light_ts: DVec3,
    scale: f64,
    softening: f64,
    height: impl Fn(DVec2) -> f64,
) -> f64 {
    let (h0, travel) = (height(uv), scale * light_ts.truncate());
    let shadow = PUBLISHED_SAMPLES
        .iter()
        .map(|&sample| published_sample(height(uv + sample.0 * travel), h0, sample, softening))
        .fold(f64::NEG_INFINITY, f64::max);
    published_light(shadow)
}

/// The share of the light that is seen over a horizon, for a light of half-width `half_width` in slopes.
#[must_use]
pub fn seen(horizon: f64, half_width: f64) -> f64 {
    ((1.0 + half_width - horizon) / (2.0 * half_width)).clamp(0.0, 1.0)
}

/// The highest slope of the samples s = t/n, 2t/n, … t over the ground at the place; below any horizon for no samples, and for a
/// place within [`BIAS_HEIGHT`] of the layer's top, over which nothing stands by more.
#[must_use]
pub fn sampled_horizon(hit: &HitRecord, ray: &Ray, samples: u32, height: impl Fn(DVec2) -> f64) -> f64 {
    if hit.t <= BIAS_HEIGHT {
        return f64::NEG_INFINITY;
    }
    let slope = |sample: u32| {
        let s = hit.t * f64::from(sample) / f64::from(samples);
        (height(ray.at(s)) - (1.0 - hit.t)) / s
    };
    (1..=samples).map(slope).fold(f64::NEG_INFINITY, f64::max)
}

/// The slope of the relief's horizon along the light's ray, exactly: sup of (h(uv(s)) − h₀)/s over the way through the layer. A place at
/// the layer's top has no horizon.
#[must_use]
pub fn horizon(field: &HeightField, edge: EdgeMode, hit: &HitRecord, ray: &Ray) -> f64 {
    let mut walk = Walk::new(field, ray, hit.t);
    let mut highest = f64::NEG_INFINITY;
    loop {
        // Over level ground at h₀: what is left is h − h₀.
        let above = walk.quadratic(field, edge, 1.0 - hit.t, 0.0);
        highest = highest.max(steepest(&above, walk.t, walk.exit() - walk.t));
        if walk.is_last() || walk.cells >= MAX_CELLS {
            return highest;
        }
        walk.advance();
    }
}

/// The greatest (c + bτ + aτ²)/(start + τ) on [0, length].
fn steepest(above: &Quadratic, start: f64, length: f64) -> f64 {
    let slope = |step: f64| {
        if start + step > 0.0 {
            above.at(step) / (start + step)
        } else {
            // At the place itself the surface begins at h₀, so that the slope is the surface's own.
            above.b
        }
    };
    let ends = slope(0.0).max(slope(length));
    // Turned to s = start + τ: a·s + (b − 2a·start) + (c − b·start + a·start²)/s, whose derivative vanishes at s² = rest/a.
    let rest = above.c - start * (above.b - start * above.a);
    let summit = (rest / above.a).sqrt() - start;
    if summit > 0.0 && summit < length {
        ends.max(slope(summit))
    } else {
        ends
    }
}

#[cfg(test)]
mod tests {
    use bossage_assets::{EdgeMode, HeightField};
    use glam::{DVec2, DVec3};

    use super::{horizon, published, sampled_horizon, seen};
    use crate::relief_ray::{HitRecord, Layer, Status};
    use crate::relief_truth::height_at;
    use crate::self_shadow::light_ray;

    /// What 0.6 and 0.4 are off by in f32 comes into the light at most nine times: half a last digit of each, 2⁻²⁵ and 2⁻²⁶.
    const OF_F32: f64 = 10.0 / (1 << 25) as f64;

    #[test]
    fn the_horizon_is_the_highest_of_a_dense_march() {
        let field = HeightField::from_fn(16, 16, |x, y| ((x * 7 + y * 5) % 11) as f32 / 10.0);
        for i in 0..40 {
            let uv = DVec2::new(0.03 + 0.023 * f64::from(i), 0.91 - 0.019 * f64::from(i));
            let t = 1.0 - height_at(&field, EdgeMode::Clamp, uv);
            let hit = HitRecord {
                uv,
                t,
                status: Status::Hit,
            };
            let light = DVec3::new((f64::from(i)).cos(), (f64::from(i)).sin(), 0.3);
            let ray = light_ray(&hit, light, &Layer::below(0.1)).expect("above the horizon");
            let dense = sampled_horizon(&hit, &ray, 20_000, |uv| height_at(&field, EdgeMode::Clamp, uv));
            let exact = horizon(&field, EdgeMode::Clamp, &hit, &ray);
            // Between samples the slope changes by less than the step times its derivative, (|h'| + H)/s; the first texel's is the surface's.
            assert!(
                exact >= dense - 1e-9 && exact - dense < 0.05,
                "{i}: {exact} against {dense}"
            );
        }
    }

    #[test]
    fn a_ramp_is_its_own_horizon() {
        // Texel i holds i/8 and a ray along u with rise 1: h − h₀ = s, but for the last half texel, where the edge is level.
        let field = HeightField::from_fn(8, 2, |x, _| x as f32 / 8.0);
        let hit = HitRecord {
            uv: DVec2::new(0.25, 0.5),
            t: 0.5,
            status: Status::Hit,
        };
        let ray = light_ray(&hit, DVec3::new(1.0, 0.0, 1.0), &Layer::below(1.0)).expect("above the horizon");
        let h0 = height_at(&field, EdgeMode::Clamp, hit.uv);
        let on_it = HitRecord { t: 1.0 - h0, ..hit };
        assert!((horizon(&field, EdgeMode::Clamp, &on_it, &ray) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn the_light_fades_between_its_ends() {
        for (horizon, share) in [
            (-1.0, 1.0),
            (0.75, 1.0),
            (1.0, 0.5),
            (1.125, 0.25),
            (1.25, 0.0),
            (9.0, 0.0),
        ] {
            assert_eq!(seen(horizon, 0.25), share, "{horizon}");
        }
        assert_eq!(seen(f64::NEG_INFINITY, 0.25), 1.0);
    }

    #[test]
    fn witness_the_published_form_brightens_level_ground() {
        // Level ground: the greatest of −share·weight is −0.88, so the light is 1.528 where it should be 1.
        let light = published(DVec2::ZERO, DVec3::new(0.6, 0.0, 0.8), 0.05, 1.0, |_| 0.5);
        assert!((light - 1.528).abs() < OF_F32);
    }

    #[test]
    fn witness_the_published_form_goes_below_black() {
        // A wall of height 1 at 0.22 of the way over ground at 0: (1 − 0.22)·12 = 9.36.
        let wall = |uv: DVec2| if uv.x > 0.0 { 1.0 } else { 0.0 };
        let light = published(DVec2::ZERO, DVec3::X, 0.05, 1.0, wall);
        assert!((light - (1.0 - 9.36) * 0.6 - 0.4).abs() < OF_F32 && light < 0.0);
    }
}
