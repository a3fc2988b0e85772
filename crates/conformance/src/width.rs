//! How wide the acceptance intervals are: a bound that admits too much proves too little.
//!
//! A width is (high − low) over **one ULP of the truth**, output by output: the unit in which errors are stated everywhere else. An
//! open output counts as infinitely wide, a forked one as wide as the hull that is accepted. Quantiles are taken over the random inputs
//! of an ordinary run, drawn from the documented domain.
//!
//! Beside it stands a second measure with a name of its own, the width **at scale**: in ULPs of the largest component of the same
//! field's truth. A component of a vector that passes through zero has no relative accuracy that a formula of the whole vector could
//! keep; what matters for a direction is its error against the vector's length. The goal is judged by the first measure alone.

pub mod golden;

use bossage_shaders::Probe;

use crate::compare::Expected;
use crate::generate::random;
use crate::ulp::ulp;

/// What the median width of each output of a hardened function may be, in ULPs of the truth.
pub const GOAL: f64 = 64.0;

/// Hardened functions without `pow` that miss the goal, and why no narrower interval is to be had. One that meets it after all is
/// to be struck off: a test says so.
pub const MISSED: &[(&str, &str)] = &[];

/// Items that quantiles are taken over: the random inputs of an ordinary run, which a full run begins with.
pub const ITEMS: usize = crate::suite::probe::ORDINARY;

/// The measured widths of one output field, component by component where lists are.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldWidths {
    /// The field's name in the shader.
    pub name: &'static str,
    /// Median widths in ULPs of the truth.
    pub medians: Vec<f64>,
    /// The 90th percentiles.
    pub p90: Vec<f64>,
    /// The largest widths.
    pub largest: Vec<f64>,
    /// Median widths in ULPs of the field's largest component.
    pub at_scale: Vec<f64>,
    /// The share of outputs on which the rules say nothing.
    pub open: f64,
    /// The share of outputs that join several results.
    pub forked: f64,
}

/// The random items that widths are measured on.
#[must_use]
pub fn inputs(probe: &Probe) -> crate::generate::Inputs {
    random::generate(probe, ITEMS, 0, random::SEED)
}

/// The widths of a probe's outputs, field by field.
#[must_use]
pub fn measure(probe: &'static Probe, expected: &[Vec<Expected>]) -> Vec<FieldWidths> {
    let mut first = 0;
    let fields = probe.outputs.iter().map(|field| {
        let range = first..first + field.shape.floats();
        first = range.end;
        let items: Vec<&[Expected]> = expected.iter().map(|item| &item[range.clone()]).collect();
        field_widths(field.name, &items)
    });
    fields.collect()
}

fn field_widths(name: &'static str, items: &[&[Expected]]) -> FieldWidths {
    let components = items.first().map_or(0, |item| item.len());
    let widths = |unit: &dyn Fn(&[Expected], usize) -> f64| -> Vec<Vec<f64>> {
        (0..components)
            .map(|k| sorted(items.iter().map(|item| width(&item[k], unit(item, k)))))
            .collect()
    };
    let own = widths(&|item, k| ulp(item[k].truth));
    let scaled = widths(&|item, _| ulp(item.iter().map(|e| e.truth.abs()).fold(0.0, f64::max)));
    let quantiles = |of: &[Vec<f64>], q| of.iter().map(|list| quantile(list, q)).collect();
    let share = |is: fn(&Expected) -> bool| {
        let count = items
            .iter()
            .flat_map(|item| item.iter())
            .filter(|e| is(e))
            .count();
        count as f64 / (items.len() * components).max(1) as f64
    };
    FieldWidths {
        name,
        medians: quantiles(&own, 0.5),
        p90: quantiles(&own, 0.9),
        largest: quantiles(&own, 1.0),
        at_scale: quantiles(&scaled, 0.5),
        open: share(|e| !e.bound.is_decided()),
        forked: share(|e| e.bound.is_forked()),
    }
}

/// A width in a unit: 0 for one number, infinite for an open output.
fn width(expected: &Expected, unit: f64) -> f64 {
    let size = expected.bound.high() - expected.bound.low();
    match expected.bound.is_decided() {
        true if size == 0.0 => 0.0,
        // A truth that overflows has no unit.
        true if unit.is_finite() => size / unit,
        true | false => f64::INFINITY,
    }
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut list: Vec<f64> = values.collect();
    list.sort_by(f64::total_cmp);
    list
}

/// The value that a share `q` of a sorted list does not exceed.
fn quantile(list: &[f64], q: f64) -> f64 {
    let at = (q * list.len() as f64).ceil() as usize;
    list.get(at.saturating_sub(1)).copied().unwrap_or(0.0)
}

/// The widest median of a function's outputs.
#[must_use]
pub fn worst_median(fields: &[FieldWidths]) -> f64 {
    fields
        .iter()
        .flat_map(|field| &field.medians)
        .copied()
        .fold(0.0, f64::max)
}
