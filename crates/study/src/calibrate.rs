//! A cost profile from measured points: what a ray and a step of each technique cost on one adapter.
//!
//! The model is the planner's: a ray of a technique takes ray_ns + steps · step_ns, with the mean number of steps that the reference search
//! takes on the rays that were measured. Both are fitted by least squares of the **relative** error over all points of the technique, so that a
//! cheap point counts as much as an expensive one; neither may be negative. `residual` is the root mean square of what is left, as a share:
//! it says how far the model is off, and it is not small where neighbouring rays differ and a driver makes them wait for each other.

use std::collections::BTreeMap;
use std::path::Path;

use bossage_runner::AdapterInfo;
use bossage_scene::profile::{Cost, Profile};

use crate::error::Error;
use crate::record::Study;

/// A measurement: steps a ray, nanoseconds a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Mean number of steps.
    pub steps: f64,
    /// Median time, more than nothing.
    pub ns: f64,
}

/// The profile of a study's timed points, with the adapter and the driver that they were measured on.
///
/// # Errors
/// [`Error::NoDriver`] when nothing was timed.
pub fn profile(study: &Study, name: &str, machine: &AdapterInfo) -> Result<Profile, Error> {
    let mut samples: BTreeMap<&str, Vec<Sample>> = BTreeMap::new();
    for point in &study.points {
        let (Some(time), Some(steps)) = (point.time_ms, point.steps) else {
            continue;
        };
        let ns = time.median * 1e6 / point.rays.max(1) as f64;
        if ns > 0.0 {
            samples
                .entry(&point.technique)
                .or_default()
                .push(Sample { steps, ns });
        }
    }
    if samples.is_empty() {
        return Err(Error::NoDriver(
            "no technique was timed, so there is nothing to calibrate; a profile needs an adapter with a driver".to_owned(),
        ));
    }
    Ok(Profile {
        name: name.to_owned(),
        adapter: machine.name.clone(),
        driver: stated(&machine.driver_info),
        techniques: samples
            .into_iter()
            .map(|(technique, samples)| (technique.to_owned(), fit(&samples)))
            .collect(),
    })
}

/// Some drivers say nothing of themselves, and a profile wants a word.
fn stated(driver: &str) -> String {
    let word = driver.trim();
    if word.is_empty() { "not stated" } else { word }.to_owned()
}

/// The file's text, which [`Profile::parse`] reads back as the same profile.
///
/// # Errors
/// When it does not, which is a fault of ours.
pub fn text(profile: &Profile) -> Result<String, Error> {
    let text = format!(
        "# What techniques cost on one adapter, fitted by `bossage study --calibrate`: a ray takes ray_ns + steps * step_ns.\n\
         # residual: root mean square of the fit's relative error over so many points.\n{}",
        profile.to_toml()
    );
    let read =
        Profile::parse(Path::new("the profile"), &text).map_err(|why| Error::Profile(why.to_string()))?;
    if read == *profile {
        Ok(text)
    } else {
        Err(Error::Profile("it does not read back as it was".to_owned()))
    }
}

/// The fit. A line that would need a negative price is fitted again without that price.
#[must_use]
pub fn fit(samples: &[Sample]) -> Cost {
    // Each measurement divided by its time: 1 = ray/ns + step · steps/ns.
    let rows: Vec<[f64; 2]> = samples
        .iter()
        .map(|sample| [1.0 / sample.ns, sample.steps / sample.ns])
        .collect();
    let sum = |of: fn(&[f64; 2]) -> f64| rows.iter().map(of).sum::<f64>();
    let (aa, ab, bb) = (sum(|r| r[0] * r[0]), sum(|r| r[0] * r[1]), sum(|r| r[1] * r[1]));
    let (a, b) = (sum(|r| r[0]), sum(|r| r[1]));
    let of = |ray_ns: f64, step_ns: f64| {
        let squares = rows
            .iter()
            .map(|row| (row[0] * ray_ns + row[1] * step_ns - 1.0).powi(2));
        let residual = (squares.sum::<f64>() / rows.len().max(1) as f64).sqrt();
        Cost {
            ray_ns,
            step_ns,
            residual: Some(residual),
            points: u32::try_from(rows.len()).ok(),
        }
    };
    let only_ray = of(a / aa, 0.0);
    let determinant = aa * bb - ab * ab;
    // All points with the same number of steps: the step has no price that could be told from the ray's.
    if bb == 0.0 || determinant <= 1e-12 * aa * bb {
        return only_ray;
    }
    let both = of((a * bb - b * ab) / determinant, (b * aa - a * ab) / determinant);
    if both.step_ns < 0.0 {
        only_ray
    } else if both.ray_ns < 0.0 {
        of(0.0, b / bb)
    } else {
        both
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use bossage_runner::AdapterInfo;
    use bossage_scene::profile::Profile;

    use super::{Sample, fit, profile, text};
    use crate::error::Error;
    use crate::record::{Point, Study, Time};

    fn samples(pairs: &[(f64, f64)]) -> Vec<Sample> {
        pairs.iter().map(|&(steps, ns)| Sample { steps, ns }).collect()
    }

    #[test]
    fn points_on_a_line_give_the_line() {
        let price = fit(&samples(&[(0.0, 3.0), (4.0, 5.0), (100.0, 53.0)]));
        assert!((price.ray_ns - 3.0).abs() < 1e-9 && (price.step_ns - 0.5).abs() < 1e-9);
        assert!(price.residual.unwrap() < 1e-9);
        assert_eq!(price.points, Some(3));
    }

    #[test]
    fn what_is_off_the_line_is_in_the_residual() {
        let price = fit(&samples(&[(10.0, 10.0), (10.0, 30.0)]));
        // One price for 10 and 30: the least relative error is at a/aa = (1/10 + 1/30)/(1/100 + 1/900) = 12.
        assert!((price.ray_ns - 12.0).abs() < 1e-9 && price.step_ns == 0.0);
        let expected = ((0.2_f64.powi(2) + 0.6_f64.powi(2)) / 2.0).sqrt();
        assert!((price.residual.unwrap() - expected).abs() < 1e-9, "{price:?}");
    }

    #[test]
    fn no_price_is_negative() {
        let falling = fit(&samples(&[(1.0, 10.0), (9.0, 2.0)]));
        assert_eq!(falling.step_ns, 0.0);
        assert!(falling.ray_ns > 0.0);
        let steep = fit(&samples(&[(10.0, 1.0), (20.0, 100.0)]));
        assert_eq!(steep.ray_ns, 0.0);
        assert!(steep.step_ns > 0.0);
    }

    fn machine(name: &str, driver: &str) -> AdapterInfo {
        AdapterInfo {
            name: name.to_owned(),
            driver_info: driver.to_owned(),
            ..bossage_embedded::info()
        }
    }

    fn point(technique: &str, steps: f64, median: Option<f64>) -> Point {
        Point {
            technique: technique.to_owned(),
            rays: 1000,
            steps: Some(steps),
            time_ms: median.map(|median| Time {
                median,
                min: median,
                max: median,
                runs: 9,
            }),
            ..Point::default()
        }
    }

    #[test]
    fn a_profile_has_what_was_timed() {
        let study = Study {
            points: vec![
                point("exact", 4.0, Some(0.005)),
                point("exact", 8.0, Some(0.007)),
                point("relief", 21.0, None),
            ],
            ..Study::default()
        };
        let found = profile(&study, "lavapipe", &machine("llvmpipe", "Mesa")).unwrap();
        assert_eq!(found.techniques.keys().collect::<Vec<_>>(), ["exact"]);
        let exact = found.techniques["exact"];
        assert!(
            (exact.ray_ns - 3.0).abs() < 1e-9 && (exact.step_ns - 0.5).abs() < 1e-9,
            "{exact:?}"
        );
        let read = Profile::parse(Path::new("p.toml"), &text(&found).unwrap()).unwrap();
        assert_eq!(read, found);
        assert_eq!(
            (read.adapter.as_str(), read.driver.as_str()),
            ("llvmpipe", "Mesa")
        );
        assert_eq!(read.techniques["exact"].points, Some(2));
    }

    #[test]
    fn a_driver_that_says_nothing_still_has_a_profile_that_reads() {
        let study = Study {
            points: vec![point("exact", 4.0, Some(0.005))],
            ..Study::default()
        };
        let found = profile(&study, "quiet", &machine("SwiftShader \"fast\"", " ")).unwrap();
        let read = Profile::parse(Path::new("p.toml"), &text(&found).unwrap()).unwrap();
        assert_eq!(
            (read.adapter.as_str(), read.driver.as_str()),
            ("SwiftShader \"fast\"", "not stated")
        );
    }

    #[test]
    fn what_no_profile_may_hold_is_not_written() {
        let study = Study {
            points: vec![point("no_such_technique", 4.0, Some(0.005))],
            ..Study::default()
        };
        let found = profile(&study, "mine", &machine("a", "b")).unwrap();
        assert!(matches!(text(&found), Err(Error::Profile(_))));
    }

    #[test]
    fn nothing_timed_is_no_profile() {
        let study = Study::default();
        assert!(matches!(
            profile(&study, "a", &machine("b", "c")),
            Err(Error::NoDriver(_))
        ));
    }
}
