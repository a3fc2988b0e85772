//! Fields whose answer is known in closed form, and a brute-force march as a second oracle.

use bossage_assets::{EdgeMode, HeightField};
use glam::{DVec2, DVec3};

use super::{Ray, Status, first_hit, height_at};

const EDGES: [EdgeMode; 3] = [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp];

fn view(degrees: f64, azimuth_degrees: f64) -> DVec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (s, c) = azimuth_degrees.to_radians().sin_cos();
    DVec3::new(sin * c, sin * s, cos)
}

fn waves(size: u32) -> HeightField {
    HeightField::from_fn(size, size, |x, y| {
        let phase = |i: u32| std::f32::consts::TAU * (i as f32 + 0.5) / size as f32;
        0.5 + 0.3 * (3.0 * phase(x)).sin() * (2.0 * phase(y)).cos() + 0.15 * (7.0 * phase(x) + phase(y)).sin()
    })
}

#[test]
fn a_constant_field_is_met_at_its_own_depth() {
    for edge in EDGES {
        for height in [0.0_f32, 0.25, 0.5, 1.0] {
            let field = HeightField::from_fn(5, 3, |_, _| height);
            let ray = Ray::through(DVec2::new(0.1, 0.9), view(75.0, 30.0), 0.05, -0.05).unwrap();
            let hit = first_hit(&field, edge, &ray);
            assert_eq!(hit.status, Status::Hit);
            // A linear equation with coefficients of order 1 solved in f64: a few units of 2^-53.
            assert!((hit.t - f64::from(1.0 - height)).abs() < 1e-15);
        }
    }
}

#[test]
fn straight_down_reads_the_height() {
    let field = waves(16);
    for i in 0..50 {
        let uv = DVec2::new(f64::from(i) * 0.037, f64::from(i) * 0.061);
        let hit = first_hit(
            &field,
            EdgeMode::Wrap,
            &Ray::through(uv, DVec3::Z, 0.05, -0.02).unwrap(),
        );
        assert_eq!(hit.uv, uv);
        assert!((hit.t - (1.0 - height_at(&field, EdgeMode::Wrap, uv))).abs() < 1e-14);
    }
}

/// March in steps far smaller than a texel, then bisect: the slow, obvious way.
fn brute_force(field: &HeightField, edge: EdgeMode, ray: &Ray) -> f64 {
    const STEPS: u32 = 200_000;
    let below = |t: f64| height_at(field, edge, ray.at(t)) >= 1.0 - t;
    let hit = (0..=STEPS)
        .map(|i| f64::from(i) / f64::from(STEPS))
        .find(|&t| below(t))
        .expect("heights are ≥ 0");
    let (mut low, mut high) = ((hit - 1.0 / f64::from(STEPS)).max(0.0), hit);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if below(middle) {
            high = middle
        } else {
            low = middle
        }
    }
    high
}

#[test]
fn agrees_with_brute_force() {
    let field = waves(24);
    for edge in EDGES {
        for (i, degrees) in [20.0, 45.0, 60.0, 75.0, 85.0].into_iter().enumerate() {
            let uv = DVec2::new(0.137 * i as f64 - 0.2, 0.71 - 0.3 * i as f64);
            let ray = Ray::through(uv, view(degrees, 37.0 + 80.0 * i as f64), 0.08, -0.03).unwrap();
            let hit = first_hit(&field, edge, &ray);
            let slow = brute_force(&field, edge, &ray);
            // The march may miss a crest that the ray cleared by less than one step's worth of height; none here does.
            assert!(
                (hit.t - slow).abs() < 1e-12,
                "{edge:?} {degrees}: {} against {slow}",
                hit.t
            );
            assert!((height_at(&field, edge, hit.uv) - (1.0 - hit.t)).abs() < 1e-12);
        }
    }
}

#[test]
fn rays_along_texel_lines_and_corners_terminate() {
    let field = waves(8);
    for azimuth in [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0] {
        let ray = Ray::through(DVec2::splat(0.5 / 8.0), view(80.0, azimuth), 0.2, -0.2).unwrap();
        let hit = first_hit(&field, EdgeMode::Wrap, &ray);
        assert_eq!(hit.status, Status::Hit);
        assert!((height_at(&field, EdgeMode::Wrap, hit.uv) - (1.0 - hit.t)).abs() < 1e-12);
    }
}

#[test]
fn a_view_from_the_side_or_below_has_no_ray() {
    for view_ts in [
        DVec3::X,
        -DVec3::Z,
        DVec3::new(1.0, 0.0, -1e-9),
        DVec3::NAN,
        DVec3::new(1.0, 0.0, 5e-324),
    ] {
        assert!(Ray::through(DVec2::ZERO, view_ts, 0.05, -0.05).is_none());
    }
}

#[test]
fn a_spike_between_samples_is_never_stepped_over() {
    // One texel high, all others at the bottom: a grazing ray must meet the pyramid, wherever a fixed march would look.
    let field = HeightField::from_fn(64, 64, |x, y| if (x, y) == (32, 32) { 1.0 } else { 0.0 });
    let spike_uv = DVec2::splat(32.5 / 64.0);
    let ray = Ray {
        uv_top: spike_uv - DVec2::new(0.3, 0.0),
        delta: DVec2::new(1.0, 0.0),
    };
    let hit = first_hit(&field, EdgeMode::Clamp, &ray);
    // On the rising flank 64 (u − u₁) = 1 − t with u = u_s − 0.3 + t and u₁ = u_s − 1/64: 65 t = 64·0.3, t = 19.2/65.
    assert!((hit.t - 19.2 / 65.0).abs() < 1e-13);
}
