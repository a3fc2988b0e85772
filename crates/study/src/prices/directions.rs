//! Seeded directions, and the errors of what becomes of them.

use bossage_conformance::generate::random::stream;
use bossage_reference::sphere::angle_deg;
use glam::DVec3;
use rand::RngExt;

/// The greatest angle that there is; what is no direction is this far off.
const FARTHEST_DEG: f64 = 180.0;

/// `count` unit vectors spread evenly over the sphere, drawn from the stream of a name and a seed.
pub(super) fn sphere(name: &str, seed: u64, count: u32) -> Vec<DVec3> {
    let mut rng = stream(name, seed);
    let mut direction = || {
        let z = 1.0 - 2.0 * rng.random::<f64>();
        let (sin, cos) = (std::f64::consts::TAU * rng.random::<f64>()).sin_cos();
        let r = ((1.0 - z) * (1.0 + z)).sqrt();
        DVec3::new(r * cos, r * sin, z)
    };
    (0..count).map(|_| direction()).collect()
}

/// The same over the half with z ≥ 0, where the normals of tangent space lie.
pub(super) fn hemisphere(name: &str, seed: u64, count: u32) -> Vec<DVec3> {
    let up = |d: DVec3| d.with_z(d.z.abs());
    sphere(name, seed, count).into_iter().map(up).collect()
}

/// Degrees between each direction and the vector that came of it, whose components are the first three of `stride` floats.
pub(super) fn errors_deg(truth: &[DVec3], found: &[f64], stride: usize) -> Vec<f64> {
    let error = |(truth, found): (&DVec3, &[f64])| {
        let found = DVec3::new(found[0], found[1], found[2]);
        let angle = angle_deg(found, *truth);
        if angle.is_nan() { FARTHEST_DEG } else { angle }
    };
    truth.iter().zip(found.chunks_exact(stride)).map(error).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_unit_seeded_and_where_they_should_be() {
        let all = sphere("test", 1, 4096);
        assert!(all.iter().all(|d| (d.length() - 1.0).abs() < 1e-15));
        assert_eq!(all, sphere("test", 1, 4096));
        assert_ne!(all, sphere("test", 2, 4096));
        assert!(hemisphere("test", 1, 4096).iter().all(|d| d.z >= 0.0));
        // The mean of n even directions has a deviation of 1/√(3n) = 0.009 along each axis; six of them are not met.
        assert!((all.iter().sum::<DVec3>() / 4096.0).abs().max_element() < 0.055);
    }

    #[test]
    fn what_is_no_direction_is_farthest() {
        let found = [0.0, 2.0, 0.0, 9.0, f64::NAN, 0.0, 1.0, 9.0, 0.0, 0.0, 0.0, 9.0];
        let errors = errors_deg(&[DVec3::Y, DVec3::Z, DVec3::X], &found, 4);
        assert_eq!(errors, [0.0, 180.0, 180.0]);
    }
}
