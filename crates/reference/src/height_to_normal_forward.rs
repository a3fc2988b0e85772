//! `height_to_normal_forward`: a normal map from a height map by forward differences, as the fourth article,
//! *Normal Maps and Height Maps*, lists it.
//!
//! Published: with Δ₁ = h(row + 1) − h and Δ₂ = h(column + 1) − h, the normal is the cross product of (1, 0, s·Δ₁) and
//! (0, 1, s·Δ₂), that is (−s·Δ₁, −s·Δ₂, 1), normalised; all border texels are (0, 0, 1); the codec is `biased` with truncation; the
//! height goes to alpha. Heights are **bytes** (0 to 255), so s is elevation in texels per byte step.
//!
//! Known faults: the first axis is the row, so red holds the vertical slope (axes swapped); differences are first order; the
//! flat border is not a seamless tile. (The listing also reads past the row's end for the last column, but the flat border
//! hides it.)
//!
//! Hardened: red is the slope along u and green along v, borders follow an edge mode. The order of the differences stays:
//! that is what the technique is; [`crate::height_to_normal`] has the better ones.

use bossage_assets::{EdgeMode, HeightField};
use glam::DVec3;

use crate::vector::normalize;

/// The published normal at texel (x, y), unit, before the codec. `strength` is s times 255, since the field holds heights
/// in [0, 1].
#[must_use]
pub fn published(field: &HeightField, x: u32, y: u32, strength: f64) -> DVec3 {
    let border = x == 0 || y == 0 || x + 1 >= field.width || y + 1 >= field.height;
    if border {
        return DVec3::Z;
    }
    let h = |x, y| f64::from(field.texel(x, y));
    let (row_step, column_step) = (h(x, y + 1) - h(x, y), h(x + 1, y) - h(x, y));
    normalize(DVec3::new(-strength * row_step, -strength * column_step, 1.0))
}

/// The hardened normal at texel (x, y), unit, before the codec.
#[must_use]
pub fn hardened(field: &HeightField, edge: EdgeMode, x: u32, y: u32, strength: f64) -> DVec3 {
    let h = |dx: i64, dy: i64| {
        let (i, j) = (i64::from(x) + dx, i64::from(y) + dy);
        f64::from(field.texel(edge.resolve(i, field.width), edge.resolve(j, field.height)))
    };
    normalize(DVec3::new(-strength * (h(1, 0) - h(0, 0)), -strength * (h(0, 1) - h(0, 0)), 1.0))
}

#[cfg(test)]
mod tests {
    use bossage_assets::{EdgeMode, HeightField};
    use glam::DVec3;

    use super::{hardened, published};

    #[test]
    fn a_slope_along_u_lands_in_the_wrong_channel() {
        let ramp = HeightField::from_fn(4, 4, |x, _| x as f32 * 0.25);
        let diagonal = 0.5_f64.sqrt();
        // Slope 4 · 0.25 = 1: the normal is (−1, 0, 1)/√2. One division and one square root: 2 units of 2^-53.
        assert!((published(&ramp, 1, 1, 4.0) - DVec3::new(0.0, -diagonal, diagonal)).length() < 1e-15);
        assert!((hardened(&ramp, EdgeMode::Clamp, 1, 1, 4.0) - DVec3::new(-diagonal, 0.0, diagonal)).length() < 1e-15);
    }

    #[test]
    fn the_published_border_is_flat() {
        let ramp = HeightField::from_fn(4, 4, |x, _| x as f32 * 0.25);
        assert_eq!(published(&ramp, 0, 1, 4.0), DVec3::Z);
        assert_ne!(hardened(&ramp, EdgeMode::Clamp, 0, 1, 4.0), DVec3::Z);
    }
}
