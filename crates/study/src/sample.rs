//! Made-up studies for tests.

use crate::record::{ErrorTexels, Point, Price, Rival, Settings, Study, Time, Versus};

/// A point with round figures.
pub(crate) fn point(technique: &str, map: &str, view_deg: f64) -> Point {
    Point {
        technique: technique.to_owned(),
        map: map.to_owned(),
        view_deg,
        error_texels: errors(1.0),
        time_ms: Some(around(2.0)),
        ops: 100.0,
        fetches: 10.0,
        rerun: format!("bossage study --technique {technique} --map {map} --view-deg {view_deg} -o out"),
        ..Point::default()
    }
}

/// Errors with this 99th percentile.
pub(crate) fn errors(p99: f64) -> ErrorTexels {
    ErrorTexels {
        mean: p99 / 4.0,
        p50: p99 / 8.0,
        p99,
        max: p99 * 3.0,
        over_1: if p99 > 1.0 { 0.05 } else { 0.0 },
    }
}

/// Times with this median.
pub(crate) fn around(median: f64) -> Time {
    Time {
        median,
        min: median * 0.9,
        max: median * 1.3,
        runs: 9,
    }
}

/// Two maps, two angles, techniques with and without settings, one of the user's; errors of 0 among them.
pub(crate) fn study() -> Study {
    let mut study = Study::default();
    study
        .environment
        .insert("adapter".into(), "an adapter <of ours>".into());
    for (map, roughness) in [("bricks", 1.0), ("dunes & hills", 0.3)] {
        for view_deg in [30.0, 75.0_f64] {
            let steep = roughness * view_deg.to_radians().tan();
            let mut add = |technique: &str, settings: Settings, time: f64, p99: f64| {
                study.points.push(Point {
                    settings,
                    time_ms: Some(around(time)),
                    error_texels: errors(p99),
                    ops: 40.0 * time,
                    ..point(technique, map, view_deg)
                });
            };
            add("parallax_offset", Settings::default(), 0.3, 9.0 * steep);
            for layers in [8.0, 16.0, 32.0, 64.0] {
                add(
                    "parallax_occlusion",
                    Settings::of([("layers", layers)]),
                    layers / 8.0,
                    30.0 * steep / layers,
                );
            }
            for layers in [8.0, 16.0] {
                let settings = Settings::of([("layers", layers), ("refinements", 4.0)]);
                add("relief", settings, layers / 7.0, 22.0 * steep / layers);
            }
            add("user:mine", Settings::default(), 6.0, 0.04);
            add("exact", Settings::default(), 3.0, 0.0);
        }
    }
    study.exact_against_marching = study
        .points
        .iter()
        .filter(|point| point.technique == "exact")
        .map(|exact| versus(&exact.map, exact.view_deg))
        .collect();
    study.prices = ["f16", "f32", "f64"]
        .into_iter()
        .zip([2e-3, 4e-7, 0.0])
        .map(|(variant, p99)| price(variant, p99))
        .collect();
    study
}

/// Marching that gets there at half of `exact`'s speed.
fn versus(map: &str, view_deg: f64) -> Versus {
    let rival = |technique: &str, ms: f64, p99: f64| Rival {
        technique: technique.to_owned(),
        settings: Settings::default(),
        p99,
        ms,
    };
    Versus {
        map: map.to_owned(),
        view_deg,
        exact: rival("exact", 3.0, 0.0),
        error_texels: 0.5,
        exact_gets_there: true,
        at_equal_error: rival("relief", 6.0, 0.4),
        gets_there: true,
        times_faster: 2.0,
        at_equal_time: rival("parallax_occlusion", 2.5, 1.5),
        is_as_fast: true,
        times_smaller: None,
    }
}

/// A variant of a chart of arithmetic; `f64` is not timed.
pub(crate) fn price(variant: &str, p99: f64) -> Price {
    Price {
        chart: "arithmetic".to_owned(),
        variant: variant.to_owned(),
        unit: "degrees".to_owned(),
        p50: p99 / 3.0,
        p99,
        max: p99 * 2.0,
        time_ms: (variant != "f64").then(|| around(1.0)),
        no_time: (variant == "f64").then(|| "the adapter has no f64".to_owned()),
        ops: 60.0,
        fetches: 0.0,
        bytes: 0.0,
        rerun: "bossage study --price arithmetic -o out".to_owned(),
    }
}
