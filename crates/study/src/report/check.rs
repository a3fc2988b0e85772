//! What a study must hold before it is drawn: numbers that are finite and not negative.

use super::Error;
use crate::record::{Point, Price, SceneError, Study, Time};

/// Refuses the first figure that has no place on a chart.
pub(super) fn figures(study: &Study) -> Result<(), Error> {
    study.points.iter().try_for_each(point)?;
    study.prices.iter().try_for_each(price)
}

fn point(point: &Point) -> Result<(), Error> {
    let errors = &point.error_texels;
    let figures = [
        ("view_deg", point.view_deg),
        ("error_texels.mean", errors.mean),
        ("error_texels.p50", errors.p50),
        ("error_texels.p99", errors.p99),
        ("error_texels.max", errors.max),
        ("error_texels.over_1", errors.over_1),
        ("ops", point.ops),
        ("fetches", point.fetches),
    ];
    let settings = point.settings.0.values().map(|value| ("settings", *value));
    let subject = || {
        format!(
            "{} {} on {} at {}°",
            point.technique, point.settings, point.map, point.view_deg
        )
    };
    let times = times(point.time_ms.as_ref());
    let on_screen = on_screen(point.scene.as_ref());
    refuse_bad(
        figures.into_iter().chain(settings).chain(times).chain(on_screen),
        subject,
        &point.rerun,
    )
}

fn on_screen(scene: Option<&SceneError>) -> impl Iterator<Item = (&'static str, f64)> {
    scene.into_iter().flat_map(|scene| {
        let pixels = scene.error_px;
        let colour = scene.colour.unwrap_or_default();
        [
            ("scene.error_px.p99", pixels.p99),
            ("scene.error_px.max", pixels.max),
            ("scene.colour.mean", colour.mean),
            ("scene.colour.max", colour.max),
            ("scene.flip", scene.flip.unwrap_or_default()),
        ]
    })
}

fn price(price: &Price) -> Result<(), Error> {
    let figures = [
        ("p50", price.p50),
        ("p99", price.p99),
        ("max", price.max),
        ("ops", price.ops),
        ("fetches", price.fetches),
        ("bytes", price.bytes),
    ];
    let subject = || format!("price {} {}", price.chart, price.variant);
    let times = times(price.time_ms.as_ref());
    refuse_bad(figures.into_iter().chain(times), subject, &price.rerun)
}

fn times(time: Option<&Time>) -> impl Iterator<Item = (&'static str, f64)> {
    time.into_iter().flat_map(|time| {
        [
            ("time_ms.median", time.median),
            ("time_ms.min", time.min),
            ("time_ms.max", time.max),
        ]
    })
}

fn refuse_bad(
    figures: impl IntoIterator<Item = (&'static str, f64)>,
    subject: impl Fn() -> String,
    rerun: &str,
) -> Result<(), Error> {
    let bad = figures
        .into_iter()
        .find(|(_, value)| !value.is_finite() || *value < 0.0);
    bad.map_or(Ok(()), |(field, value)| {
        Err(Error::Figure {
            subject: subject(),
            field,
            value,
            rerun: rerun.to_owned(),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// What is said of the sample study after a change.
    fn said(change: impl Fn(&mut Study)) -> Option<String> {
        let mut study = sample::study();
        change(&mut study);
        figures(&study).err().map(|error| error.to_string())
    }

    #[test]
    fn figures_without_a_place_are_named_with_point_and_command() {
        assert_eq!(said(|_| ()), None);
        let error = said(|study| study.points[3].error_texels.p99 = f64::NAN).unwrap();
        for part in [
            "parallax_occlusion layers=32 on bricks at 30°",
            "error_texels.p99 is NaN",
            "bossage study",
        ] {
            assert!(error.contains(part), "{error}");
        }
        assert!(
            said(|study| study.points[0].ops = f64::INFINITY).is_some_and(|said| said.contains("ops is inf"))
        );
        assert!(
            said(|study| study.points[0].view_deg = -5.0).is_some_and(|said| said.contains("view_deg is -5"))
        );
        let no_time = |study: &mut Study| study.points[0].time_ms = Some(sample::around(f64::NAN));
        assert!(said(no_time).is_some_and(|said| said.contains("time_ms.median")));
        assert!(
            said(|study| study.prices[1].max = -1.0)
                .is_some_and(|said| said.contains("price arithmetic f32"))
        );
    }
}
