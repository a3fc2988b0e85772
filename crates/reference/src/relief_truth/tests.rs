//! Fields whose answer is known in closed form. `tests/relief.rs` holds the comparison with a march.

use bossage_assets::{EdgeMode, HeightField};
use glam::{DVec2, DVec3};

use super::{first_hit, first_hit_lifted, height_at, trace};
use crate::relief_ray::{Layer, Ray, Status};

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
        for (width, height) in [(1, 1), (1, 7), (5, 3)] {
            for level in [0.0_f32, 0.25, 0.5, 1.0] {
                let field = HeightField::from_fn(width, height, |_, _| level);
                for degrees in [0.0, 40.0, 75.0, 89.0] {
                    let view = view(degrees, 30.0);
                    let layer = Layer::below(0.05);
                    let hit = trace(&field, edge, DVec2::new(0.1, 0.9), view, &layer);
                    let expected = if degrees == 89.0 {
                        Status::Clamped
                    } else {
                        Status::Hit
                    };
                    assert_eq!(hit.status, expected);
                    // A linear equation with coefficients of order 1 solved in f64: a few units of 2^-53.
                    assert!((hit.t - f64::from(1.0 - level)).abs() < 1e-15);
                }
            }
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

#[test]
fn a_saddle_is_met_on_its_crest_inside_the_cell() {
    // Corners 0 1 / 1 0: h = x + y − 2xy, 0 at both ends of the diagonal and ½ in its middle: a ray along the diagonal may be over the
    // surface at both ends of the cell and meet it in between.
    let field = HeightField::from_fn(2, 2, |x, y| (x ^ y) as f32);
    let across = |start: f64| Ray {
        // From corner (0, 0) to corner (1, 1) of the cell, in half tiles, while the ray falls by 1.
        uv_top: DVec2::splat(0.25) - start * DVec2::splat(0.5),
        delta: DVec2::splat(0.5),
    };
    // h along the ray at cell coordinate w = t − start: 2w − 2w². Met where 2w − 2w² = 1 − t = 1 − start − w.
    for start in [-0.124f64, -0.06, 0.0, 0.1] {
        let hit = first_hit(&field, EdgeMode::Clamp, &across(start));
        let w = (3.0 - (9.0 - 8.0 * (1.0 - start)).sqrt()) / 4.0;
        assert!(
            (hit.t - (start + w)).abs() < 1e-14,
            "{start}: {} against {}",
            hit.t,
            start + w
        );
    }
    // The control: an eighth before, the ray touches the crest; earlier it passes over the cell.
    assert!(first_hit(&field, EdgeMode::Clamp, &across(-0.126)).t > 0.874);
}

#[test]
fn tiles_repeat_and_mirror() {
    let field = waves(12);
    for i in 0..200 {
        let uv = DVec2::new(0.017 * f64::from(i), 0.9 - 0.013 * f64::from(i));
        let (view, layer) = (view(80.0, 33.0 * f64::from(i)), Layer::below(0.1));
        let of = |edge, uv, view| trace(&field, edge, uv, view, &layer);
        let here = of(EdgeMode::Wrap, uv, view);
        let there = of(EdgeMode::Wrap, uv + DVec2::new(3.0, -2.0), view);
        // uv of a few units is rounded by 2⁻⁵¹, and a ray of 0.6 tiles a height carries that on; grazing rays would be worse.
        assert!((here.t - there.t).abs() < 1e-11, "{i}");
        let here = of(EdgeMode::Mirror, uv, view);
        let turned = of(
            EdgeMode::Mirror,
            DVec2::new(-uv.x, 2.0 - uv.y),
            DVec3::new(-view.x, -view.y, view.z),
        );
        assert!((here.t - turned.t).abs() < 1e-11, "{i}");
    }
}

#[test]
fn beyond_a_clamped_edge_the_border_goes_on() {
    let field = waves(9);
    let far = trace(
        &field,
        EdgeMode::Clamp,
        DVec2::new(-7.0, 11.0),
        view(60.0, 10.0),
        &Layer::below(0.05),
    );
    assert!((far.t - (1.0 - f64::from(field.texel(0, 8)))).abs() < 1e-12);
}

#[test]
fn a_stretched_tile_is_the_square_one_seen_in_other_units() {
    // A tile twice as wide as high is the square tile of half the elevation along u and the whole along v.
    let field = waves(16);
    let layer = Layer {
        scale: 0.05,
        bias: -0.02,
        v_factor: 2.0,
    };
    let view_ts = view(70.0, 25.0);
    let stretched = trace(&field, EdgeMode::Wrap, DVec2::splat(0.3), view_ts, &layer);
    let turned = DVec3::new(view_ts.x, 2.0 * view_ts.y, view_ts.z);
    let square = trace(
        &field,
        EdgeMode::Wrap,
        DVec2::splat(0.3),
        turned,
        &Layer {
            v_factor: 1.0,
            ..layer
        },
    );
    assert_eq!(stretched, square);
}

#[test]
fn the_floor_closes_the_layer() {
    let mut field = waves(4);
    field.texels.fill(f32::NAN);
    let hit = trace(
        &field,
        EdgeMode::Wrap,
        DVec2::ZERO,
        view(75.0, 20.0),
        &Layer::below(0.05),
    );
    assert_eq!((hit.t, hit.status), (1.0, Status::Hit));
    field.texels.fill(0.0);
    for i in 0..200 {
        let hit = trace(
            &field,
            EdgeMode::Wrap,
            DVec2::ZERO,
            view(75.0, f64::from(i)),
            &Layer::below(0.05),
        );
        assert!(hit.status == Status::Hit && 1.0 - hit.t < 1e-15);
    }
}

#[test]
fn a_lifted_surface_is_met_earlier_and_a_lowered_one_later() {
    let field = waves(16);
    for i in 0..100 {
        let ray = Ray::through(
            DVec2::splat(0.01 * f64::from(i)),
            view(80.0, 7.0 * f64::from(i)),
            0.1,
            0.0,
        )
        .unwrap();
        let t = |lift| first_hit_lifted(&field, EdgeMode::Wrap, &ray, lift).t;
        assert!(t(1e-3) < t(0.0) && t(0.0) < t(-1e-3));
    }
}
