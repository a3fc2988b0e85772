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
use glam::{DVec2, DVec3};

use crate::vector::normalize;

/// The published normal from three height **bytes**, unit: this texel, the next row's and the next column's.
/// `height_scale` is elevation in texels per byte step.
#[must_use]
pub fn normal_published(here: f64, next_row: f64, next_column: f64, height_scale: f64) -> DVec3 {
    normalize(DVec3::new(
        height_scale * (here - next_row),
        height_scale * (here - next_column),
        1.0,
    ))
}

/// The published normal at texel (x, y), unit, before the codec.
#[must_use]
pub fn published(field: &HeightField, x: u32, y: u32, height_scale: f64) -> DVec3 {
    let border = x == 0 || y == 0 || x + 1 >= field.width || y + 1 >= field.height;
    if border {
        return DVec3::Z;
    }
    let byte = |x, y| (f64::from(field.texel(x, y)) * 255.0).round();
    normal_published(byte(x, y), byte(x, y + 1), byte(x + 1, y), height_scale)
}

/// The hardened normal from three heights, unit: this texel, the next along u and the next along v. `slope` is the slope
/// that a difference of 1 stands for: scale · side.
#[must_use]
pub fn normal_hardened(here: f64, right: f64, after: f64, slope: DVec2) -> DVec3 {
    normalize(DVec3::new(
        -slope.x * (right - here),
        -slope.y * (after - here),
        1.0,
    ))
}

/// The hardened normal at texel (x, y), unit, before the codec.
#[must_use]
pub fn hardened(field: &HeightField, edge: EdgeMode, x: u32, y: u32, slope: DVec2) -> DVec3 {
    let h = |dx: i64, dy: i64| {
        let (i, j) = (i64::from(x) + dx, i64::from(y) + dy);
        f64::from(field.texel(edge.resolve(i, field.width), edge.resolve(j, field.height)))
    };
    normal_hardened(h(0, 0), h(1, 0), h(0, 1), slope)
}

#[cfg(test)]
mod tests {
    use bossage_assets::{EdgeMode, HeightField};
    use glam::{DVec2, DVec3};

    use super::{hardened, published};

    fn ramp() -> HeightField {
        // Byte steps of 51 along u.
        HeightField::from_fn(4, 4, |x, _| x as f32 * 0.2)
    }

    #[test]
    fn a_slope_along_u_lands_in_the_wrong_channel() {
        let diagonal = 0.5_f64.sqrt();
        // Slope 51/51 = 1: the normal is (−1, 0, 1)/√2 in some order. The heights are f32 numbers next to multiples of 0.2.
        assert!(
            (published(&ramp(), 1, 1, 1.0 / 51.0) - DVec3::new(0.0, -diagonal, diagonal)).length() < 1e-15
        );
        let good = hardened(&ramp(), EdgeMode::Clamp, 1, 1, DVec2::splat(5.0));
        assert!((good - DVec3::new(-diagonal, 0.0, diagonal)).length() < 1e-6);
    }

    #[test]
    fn the_published_border_is_flat() {
        assert_eq!(published(&ramp(), 0, 1, 4.0), DVec3::Z);
        assert_ne!(hardened(&ramp(), EdgeMode::Clamp, 0, 1, DVec2::ONE), DVec3::Z);
    }
}
