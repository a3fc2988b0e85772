//! Directions spread evenly over the sphere, the same ones every time: the sample sets of error statistics.

use glam::DVec3;

/// `count` unit vectors on a Fibonacci lattice: equal slices of height, each turned by the golden angle against the last.
/// None lies on a coordinate plane by construction, so add the special directions where they matter.
pub fn fibonacci(count: u32) -> impl Iterator<Item = DVec3> {
    let golden_angle = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    (0..count).map(move |i| {
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(count);
        let (sin, cos) = (golden_angle * f64::from(i) + 0.5).sin_cos();
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * cos, r * sin, z)
    })
}

/// The angle between two vectors in degrees, accurate for small angles too: 2·atan2(|a/|a| − b/|b||, |a/|a| + b/|b||).
#[must_use]
pub fn angle_deg(a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (crate::vector::normalize(a), crate::vector::normalize(b));
    2.0 * (a - b).length().atan2((a + b).length()).to_degrees()
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{angle_deg, fibonacci};

    #[test]
    fn even_and_unit() {
        let n = 10_000;
        let (sum, longest) = fibonacci(n).fold((DVec3::ZERO, 0.0_f64), |(s, l), d| {
            (s + d, l.max((d.length() - 1.0).abs()))
        });
        assert!(longest < 1e-15);
        // The mean of an even set is near 0; a random set of 10⁴ would have 0.01.
        assert!(sum.length() / f64::from(n) < 1e-3);
    }

    #[test]
    fn angles() {
        assert_eq!(angle_deg(DVec3::X, 3.0 * DVec3::X), 0.0);
        assert_eq!(angle_deg(DVec3::X, DVec3::NEG_X), 180.0);
        // A rotation by 1e-9: a cosine could not tell it from none. Relative rounding of a few 2^-53 on 1e-9, plus 2^-53.
        let turned = DVec3::new(1.0, 1e-9, 0.0);
        assert!((angle_deg(DVec3::X, turned).to_radians() - 1e-9).abs() < 1e-15);
    }
}
