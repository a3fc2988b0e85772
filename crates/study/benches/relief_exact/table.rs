//! One line a measurement.

use bossage_runner::Timing;

use crate::check::Errors;
use crate::maps::Map;

/// The price that is to be reached at an angle, as a ratio to the measure.
fn goal(angle_deg: f64) -> f64 {
    match angle_deg {
        a if a <= 60.0 => 0.5,
        a if a <= 75.0 => 1.0,
        _ => 1.5,
    }
}

/// Ratios are taken run by run, since the jobs take turns: what slows the machine slows both.
pub(crate) fn print(
    map: &Map,
    angle_deg: f64,
    design: &str,
    time: &Timing,
    measure: &Timing,
    errors: &Errors,
) {
    let pairs = time.runs_ms.iter().zip(&measure.runs_ms);
    let mut ratios: Vec<f64> = pairs.map(|(time, measure)| time / measure.max(1e-9)).collect();
    ratios.sort_by(f64::total_cmp);
    let at = |share: f64| ratios[((ratios.len() - 1) as f64 * share).round() as usize];
    let is_exact = errors.wrong == 0 && errors.capped == 0;
    let verdict = match (design, is_exact) {
        ("parallax_occlusion", _) => "the measure".to_owned(),
        (_, false) => format!("WRONG: {} rays, {} capped", errors.wrong, errors.capped),
        (_, true) if at(0.5) <= goal(angle_deg) => format!("goal {} met", goal(angle_deg)),
        (_, true) => format!("goal {} MISSED", goal(angle_deg)),
    };
    println!(
        "{:20} {angle_deg:3}° {design:18} {:8.3} ms  ratio {:.3} ({:.3}–{:.3} half of the runs)  error ≤ {:.5} texel, {} grazing  {verdict}",
        map.name,
        time.median_ms,
        at(0.5),
        at(0.25),
        at(0.75),
        errors.worst_texels,
        errors.grazing,
    );
}
