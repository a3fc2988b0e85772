//! `codec_octahedral`: a direction as a point of the square [−1, 1]², through the octahedron |x| + |y| + |z| = 1 (Meyer et al.
//! 2010; Cigolle et al., JCGT 3(2), 2014).
//!
//! Published form: with the `sign` of the shading languages, which is 0 for 0. Fault: in the lower half, directions with
//! x = 0 or y = 0 fold onto the wrong point; −z comes back as +z. Hardened: the sign of zero is +1.

use glam::{Vec2, Vec3};

/// Encodes with sign(0) = 0. The zero vector gives NaN.
#[inline]
#[must_use]
pub fn encode_published(d: Vec3) -> Vec2 {
    let sign = |x: f32| if x == 0.0 { 0.0 } else { x.signum() };
    fold(d, sign)
}

/// Encodes with sign(0) = +1. The zero vector gives (0, 0), which is +z.
#[inline]
#[must_use]
pub fn encode(d: Vec3) -> Vec2 {
    if d == Vec3::ZERO {
        Vec2::ZERO
    } else {
        fold(d, sign_not_zero)
    }
}

/// The unit direction of a point of the square.
#[inline]
#[must_use]
pub fn decode(e: Vec2) -> Vec3 {
    let z = 1.0 - e.x.abs() - e.y.abs();
    let p = if z < 0.0 { corners(e, sign_not_zero) } else { e };
    p.extend(z).normalize()
}

fn fold(d: Vec3, sign: impl Fn(f32) -> f32) -> Vec2 {
    let p = d.truncate() / (d.x.abs() + d.y.abs() + d.z.abs());
    if d.z < 0.0 { corners(p, sign) } else { p }
}

/// Between the inner diamond and the corners: its own inverse.
fn corners(p: Vec2, sign: impl Fn(f32) -> f32) -> Vec2 {
    Vec2::new((1.0 - p.y.abs()) * sign(p.x), (1.0 - p.x.abs()) * sign(p.y))
}

fn sign_not_zero(x: f32) -> f32 {
    if x < 0.0 { -1.0 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn axes_are_exact() {
        for axis in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|a| [a, -a]) {
            assert_eq!(decode(encode(axis)), axis);
        }
        assert_eq!((encode(Vec3::ZERO), encode(-Vec3::Z)), (Vec2::ZERO, Vec2::ONE));
    }

    #[test]
    fn witness_the_sign_of_zero() {
        assert_eq!(decode(encode_published(-Vec3::Z)), Vec3::Z);
        assert_eq!(decode(encode_published(Vec3::new(0.0, 0.6, -0.8))), Vec3::Y);
    }

    proptest! {
        #[test]
        fn directions_come_back(x in -1.0f32..1.0, y in -1.0f32..1.0, z in -1.0f32..1.0) {
            let d = Vec3::new(x, y, z);
            prop_assume!(d.length() > 1e-3);
            let back = decode(encode(d));
            // Some twelve roundings of 2⁻²⁴ on numbers up to 1, stretched by up to √3 when made a unit vector.
            prop_assert!((back - d.normalize()).length() <= 24.0 * 2f32.powi(-24));
        }
    }
}
