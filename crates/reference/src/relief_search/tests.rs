use bossage_assets::{EdgeMode, HeightField, cone_map, relaxed_cone_map};
use glam::{DVec2, DVec3};

use super::{Maps, Search};
use crate::relief_ray::{Layer, Status};
use crate::relief_truth;

const VIEW: DVec3 = DVec3::new(0.6, 0.0, 0.8);
const EDGE: EdgeMode = EdgeMode::Wrap;

fn hills() -> HeightField {
    HeightField::from_fn(32, 16, |x, y| {
        0.5 + 0.4 * (x as f32 * 0.39).sin() * (y as f32 * 0.78).cos()
    })
}

fn layer() -> Layer {
    Layer {
        scale: 0.1,
        bias: -0.1,
        v_factor: 2.0,
    }
}

/// Every technique, with so many steps that it comes near.
const LONG: [Search; 6] = [
    Search::SteepParallax { layers: 4096 },
    Search::ParallaxOcclusion { layers: 512 },
    Search::Relief {
        layers: 64,
        refinements: 12,
    },
    Search::ConeStep { steps: 512 },
    Search::RelaxedConeStep {
        steps: 64,
        refinements: 16,
    },
    Search::Exact,
];

#[test]
fn with_many_steps_every_search_comes_to_the_truth() {
    let field = hills();
    let (cones, relaxed) = (cone_map::bake(&field, EDGE), relaxed_cone_map::bake(&field, EDGE));
    let maps = Maps {
        cones: Some(&cones),
        relaxed_cones: Some(&relaxed),
        ..Maps::of_heights(&field, EDGE)
    };
    for index in 0..64 {
        let uv = DVec2::new(0.37, 0.61) * f64::from(index);
        let view_ts = DVec3::new((f64::from(index)).cos(), (f64::from(index)).sin(), 1.0).normalize();
        let truth = relief_truth::trace(&field, EDGE, uv, view_ts, &layer());
        for search in LONG {
            let found = search.find(&maps, uv, view_ts, &layer()).unwrap().record;
            // At 45° a ray falls by a height over 0.1 · 32 texels; slopes along it stay below the ray's own, so what is left of the gap
            // (a step of 1/4096, a cone's 1/1024, a few quadratic errors) is within 0.05 texel.
            let off = (found.uv - truth.uv) * DVec2::new(32.0, 16.0);
            assert!(off.length() < 0.05, "{search:?} {index}: {off}");
            assert_eq!(found.status, Status::Hit, "{search:?}");
        }
        // The control: two layers are not near, and neither is no search.
    }
    let uv = DVec2::new(0.3, 0.3);
    let far = Search::SteepParallax { layers: 2 }
        .find(&maps, uv, VIEW, &layer())
        .unwrap();
    let truth = relief_truth::trace(&field, EDGE, uv, VIEW, &layer());
    assert!(((far.record.uv - truth.uv) * 32.0).length() > 0.05);
}

#[test]
fn steps_are_heights_read_after_the_first() {
    // Level ground at 1/4: met at t = 3/4.
    let field = HeightField::from_fn(8, 8, |_, _| 0.25);
    let cones = cone_map::bake(&field, EDGE);
    let up = |_: DVec2| 1.0;
    let maps = Maps {
        cones: Some(&cones),
        relaxed_cones: Some(&cones),
        normal_z: Some(&up),
        ..Maps::of_heights(&field, EDGE)
    };
    let steps = |search: Search| {
        search
            .find(&maps, DVec2::splat(0.5), VIEW, &layer())
            .unwrap()
            .steps
    };
    assert_eq!(steps(Search::ParallaxOffset), 0);
    assert_eq!(steps(Search::ParallaxOffsetLimited), 0);
    assert_eq!(steps(Search::ParallaxIterative { iterations: 5 }), 4);
    // Samples 0, 1/8 … 6/8; the secant reads both ends again.
    assert_eq!(steps(Search::SteepParallax { layers: 8 }), 6);
    assert_eq!(steps(Search::ParallaxOcclusion { layers: 8 }), 8);
    let relief = Search::Relief {
        layers: 8,
        refinements: 5,
    };
    assert_eq!(steps(relief), 11);
    assert_eq!(steps(Search::ConeStep { steps: 7 }), 7);
    let relaxed = Search::RelaxedConeStep {
        steps: 7,
        refinements: 3,
    };
    assert_eq!(steps(relaxed), 10);
    // From texel 3.5 by 0.75 · 0.1 · 0.75 · 8 = 0.45 texels back: one side, that of texel 3.5 itself, is where the walk starts.
    assert_eq!(steps(Search::Exact), 0);
}

#[test]
fn the_cells_of_exact_are_those_of_the_truth() {
    let field = hills();
    let maps = Maps::of_heights(&field, EDGE);
    let view_ts = DVec3::new(0.9, 0.3, 0.3).normalize();
    let counted = Search::Exact
        .find(&maps, DVec2::splat(0.2), view_ts, &layer())
        .unwrap();
    let ray = crate::relief_ray::Entry::new(DVec2::splat(0.2), view_ts, &layer()).ray;
    let hit = relief_truth::first_hit(&field, EDGE, &ray);
    assert_eq!((counted.steps, counted.record.t), (hit.cells - 1, hit.t));
    assert!(counted.steps > 0);
}

#[test]
fn a_missing_map_and_a_lost_view_are_told() {
    let field = hills();
    let maps = Maps::of_heights(&field, EDGE);
    let at = |search: Search, view| search.find(&maps, DVec2::splat(0.5), view, &layer());
    for search in [
        Search::ConeStep { steps: 8 },
        Search::RelaxedConeStep {
            steps: 8,
            refinements: 4,
        },
        Search::ParallaxIterative { iterations: 4 },
    ] {
        assert_eq!(at(search, VIEW), None);
    }
    for search in [
        Search::ParallaxOffset,
        Search::Exact,
        Search::SteepParallax { layers: 8 },
    ] {
        let lost = at(search, DVec3::NAN).unwrap();
        assert_eq!(
            (lost.record.status, lost.steps),
            (Status::NonFinite, 0),
            "{search:?}"
        );
    }
}

#[test]
fn offsets_have_their_own_scale_along_each_axis() {
    let field = HeightField::from_fn(8, 8, |_, _| 0.5);
    let maps = Maps::of_heights(&field, EDGE);
    let view_ts = DVec3::new(0.3, 0.4, 0.5).normalize();
    let found = Search::ParallaxOffset
        .find(&maps, DVec2::ZERO, view_ts, &layer())
        .unwrap();
    // z = −0.05 tiles' widths, twice that in heights: uv = z · V.xy / V.z.
    assert!((found.record.uv - DVec2::new(-0.03, -0.08)).length() < 1e-15);
}
