//! `codec_octahedral`: a direction as a point of the square [−1, 1]², through the octahedron |x| + |y| + |z| = 1.
//!
//! Source: Meyer et al., *On Floating-Point Normal Vectors*, 2010; Cigolle et al., *A Survey of Efficient Representations
//! for Independent Unit Vectors*, JCGT 3(2), 2014. The upper half is projected onto the square's inner diamond; the lower half
//! is folded out over its edges into the four corners.
//!
//! Known fault of the form that uses the shading languages' `sign` (called published here): sign(0) = 0, so directions of
//! the lower half with x = 0 or y = 0 are folded onto the wrong point: −z comes back as +z. Hardened: the sign of zero is +1
//! (a `select`), as Cigolle et al. write it. Decoding never meets the fault: inside of the square, z < 0 needs x ≠ 0 and y ≠ 0.

use glam::{DVec2, DVec3};

use crate::vector::{SMALLEST_NORMAL_F32, normalize, sign_not_zero};

/// The `sign` of the shading languages: 0 for 0.
#[must_use]
pub fn sign_of_shaders(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

/// With the `sign` of the shading languages: wrong where x or y is 0 and z < 0. The zero vector gives NaN.
#[must_use]
pub fn encode_published(direction: DVec3) -> DVec2 {
    encode_by(sign_of_shaders, direction)
}

/// With the sign of zero taken as +1. A vector without direction (below the smallest normal f32) gives (0, 0), which is +z.
#[must_use]
pub fn encode_hardened(direction: DVec3) -> DVec2 {
    if direction.abs().max_element() < SMALLEST_NORMAL_F32 {
        return DVec2::ZERO;
    }
    encode_by(sign_not_zero, direction)
}

/// Between the inner diamond and the corners of the square; its own inverse.
#[must_use]
pub fn fold(p: DVec2) -> DVec2 {
    fold_by(sign_not_zero, p)
}

fn fold_by(sign: fn(f64) -> f64, p: DVec2) -> DVec2 {
    DVec2::new((1.0 - p.y.abs()) * sign(p.x), (1.0 - p.x.abs()) * sign(p.y))
}

fn encode_by(sign: fn(f64) -> f64, d: DVec3) -> DVec2 {
    let p = d.truncate() / (d.x.abs() + d.y.abs() + d.z.abs());
    if d.z >= 0.0 {
        return p;
    }
    fold_by(sign, p)
}

/// The unit direction of a point of the square.
#[must_use]
pub fn decode(e: DVec2) -> DVec3 {
    let z = 1.0 - e.x.abs() - e.y.abs();
    let p = if z >= 0.0 { e } else { fold(e) };
    normalize(p.extend(z))
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::{decode, encode_hardened, encode_published};
    use crate::codec_snorm::{self, Bits};
    use crate::sphere::{angle_deg, fibonacci};

    #[test]
    fn known_answers() {
        assert_eq!(encode_hardened(DVec3::Z), DVec2::ZERO);
        assert_eq!(encode_hardened(DVec3::X), DVec2::X);
        assert_eq!(encode_hardened(-DVec3::Y), -DVec2::Y);
        assert_eq!(encode_hardened(-DVec3::Z), DVec2::ONE);
        assert_eq!(encode_hardened(DVec3::ZERO), DVec2::ZERO);
        for corner in [DVec2::ONE, -DVec2::ONE, DVec2::new(1.0, -1.0)] {
            assert_eq!(decode(corner), -DVec3::Z);
        }
    }

    #[test]
    fn directions_come_back() {
        let axes = [
            DVec3::X,
            DVec3::Y,
            DVec3::Z,
            DVec3::new(0.0, 0.6, -0.8),
            DVec3::new(0.6, 0.0, -0.8),
        ];
        for d in axes.into_iter().flat_map(|a| [a, -a]).chain(fibonacci(10_000)) {
            // Some ten roundings of 2^-53 on numbers up to 1, stretched by at most √3 by the projection.
            assert!((decode(encode_hardened(d)) - d).length() < 3e-15, "{d}");
        }
    }

    #[test]
    fn witness_the_sign_of_zero() {
        assert_eq!(decode(encode_published(-DVec3::Z)), DVec3::Z);
        // (0, 0.6, −0.8) is folded onto (0, 1): y itself, atan2(0.8, 0.6) = 53.13° away.
        let d = DVec3::new(0.0, 0.6, -0.8);
        assert_eq!(decode(encode_published(d)), DVec3::Y);
        assert!((angle_deg(DVec3::Y, d) - 53.130_102_354).abs() < 1e-8);
        // The control: off the two planes both forms agree.
        assert!(fibonacci(1000).all(|d| encode_published(d) == encode_hardened(d)));
    }

    #[test]
    fn two_bytes_hold_a_direction_to_less_than_a_degree() {
        let quantise = |e: DVec2| {
            DVec2::from_array(
                e.to_array()
                    .map(|c| codec_snorm::decode(codec_snorm::encode(c, Bits::Eight), Bits::Eight)),
            )
        };
        let worst = fibonacci(100_000)
            .map(|d| angle_deg(decode(quantise(encode_hardened(d))), d))
            .fold(0.0, f64::max);
        // Half a step of 1/127 in x and in y moves the point of the octahedron by at most (½, ½, 1)/127, and the sphere is
        // at most √3 nearer than 1: √1.5·√3/127 rad = 0.957°.
        assert!(worst < 0.957 && worst > 0.5, "{worst}");
    }
}
