//! The comparator: computed outputs against truth and acceptance intervals.
//!
//! An output passes when it lies in its interval; the truth must lie there too, otherwise two oracles disagree and that is
//! a failure of ours. An output on which the rules say nothing (`Bound::OPEN`) is counted as undecided and judged by
//! nothing but having been written, unless the case demands answers. Outputs still holding the sentinel were never written: a failure.

use std::fmt;

use bossage_runner::is_unwritten;
use serde::Serialize;

use crate::bound::Bound;
use crate::report::json::Number;
use crate::ulp::{MIN_NORMAL, error_ulps};

/// What one output should be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// The f64 reference.
    pub truth: f64,
    /// What an implementation may return.
    pub bound: Bound,
}

/// Why an output was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Refusal {
    /// The shader never wrote it.
    Unwritten,
    /// It lies outside of the interval.
    Outside,
    /// It is NaN or infinite where the interval is finite.
    NotFinite,
    /// The truth lies outside of the interval: the oracles disagree.
    OraclesDisagree,
    /// The rules leave it open where the function promises an answer.
    Open,
    /// Another route returned something else, and the interval does not admit both.
    Disagree,
}

impl Refusal {
    /// For people.
    #[must_use]
    pub fn reason(self) -> &'static str {
        match self {
            Self::Unwritten => "the shader did not write this output",
            Self::Outside => "outside of the acceptance interval",
            Self::NotFinite => "not finite where the interval is",
            Self::OraclesDisagree => "the oracles disagree: the f64 reference lies outside of the interval",
            Self::Open => {
                "the accuracy rules leave this output open, inside the function's documented domain"
            }
            Self::Disagree => "differs from another route's result by more than the acceptance interval",
        }
    }
}

/// The output with the largest error, or the first refused one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Worst {
    /// |got − truth| in ULPs of the truth.
    pub ulp: Option<f64>,
    /// |got − truth|.
    pub abs: Option<f64>,
    /// |got − truth| as a share of the allowed error.
    pub of_bound: Option<f64>,
    /// The item's inputs.
    #[serde(serialize_with = "numbers")]
    pub input: Vec<f32>,
    /// Which output of the item.
    pub output: usize,
    /// Whether it was written at all.
    pub written: bool,
    /// What came back.
    pub got: Number,
    /// The truth.
    pub truth: Number,
    /// The acceptance interval, low and high.
    pub interval: [Number; 2],
    /// What the output is called and at which input, of a user's shader.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place: Option<String>,
    /// The inputs by name, of a user's shader; those that belong to the output first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<NamedInput>,
    /// What another route returned, where two are compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub other: Option<OtherResult>,
}

/// An input of a user's shader.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedInput {
    /// How the shader calls it: `lights.items[3].vector`.
    pub name: String,
    /// Its components; exact in their type.
    pub values: Vec<f64>,
}

/// What another route returned.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OtherResult {
    /// Route and adapter.
    pub from: String,
    /// Its result.
    pub got: Number,
}

/// More named inputs than these are left to the JSON.
const SHOWN: usize = 8;

impl fmt::Display for NamedInput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // The shortest text of a number that is exact in f32 is that of the f32.
        let text = |x: f64| match x as f32 {
            single if f64::from(single) == x => format!("{single:?}"),
            _ => format!("{x:?}"),
        };
        let values: Vec<String> = self.values.iter().map(|x| text(*x)).collect();
        match values.as_slice() {
            [one] => write!(f, "{} = {one}", self.name),
            many => write!(f, "{} = ({})", self.name, many.join(", ")),
        }
    }
}

/// JSON has no NaN and no infinity, inputs do.
fn numbers<S: serde::Serializer>(values: &[f32], serializer: S) -> Result<S::Ok, S::Error> {
    // By way of the shortest decimal, so that 0.1 stays 0.1.
    let shortest = |x: f32| Number(x.to_string().parse().unwrap_or(f64::from(x)));
    serializer.collect_seq(values.iter().map(|&x| shortest(x)))
}

impl fmt::Display for Worst {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.place.is_none() {
            writeln!(f, "input     {:?}", self.input)?;
        }
        for input in self.inputs.iter().take(SHOWN) {
            writeln!(f, "input     {input}")?;
        }
        if self.inputs.len() > SHOWN {
            writeln!(f, "          and {} inputs more", self.inputs.len() - SHOWN)?;
        }
        let got = if self.written {
            self.got.to_string()
        } else {
            "never written".to_owned()
        };
        match &self.place {
            Some(place) => writeln!(f, "output    {place}: {got}")?,
            None => writeln!(f, "output    number {}: {got}", self.output)?,
        }
        match (&self.other, &self.place) {
            (Some(other), _) => writeln!(f, "against   {} from {}", other.got, other.from)?,
            // Of a user's shader: what the formula says in f64, where that is within the interval.
            (None, Some(_)) if self.truth.0.is_nan() => {}
            (None, Some(_)) => writeln!(f, "formula   {} in f64", self.truth)?,
            (None, None) => writeln!(f, "truth     {}", self.truth)?,
        }
        writeln!(f, "allowed   {} to {}", self.interval[0], self.interval[1])?;
        let or_none = |x: Option<f64>| x.map_or("not a number".to_owned(), |x| format!("{x:.4e}"));
        write!(
            f,
            "error     {} ULP, {} absolute",
            or_none(self.ulp),
            or_none(self.abs)
        )
    }
}

/// What an interval must say besides containing the value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Demand {
    /// Nothing.
    #[default]
    Nothing,
    /// That it is no open one.
    Answer,
    /// That it is not joined from several results either.
    OneAnswer,
}

/// The comparison of one case's outputs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Outputs compared.
    pub outputs: usize,
    /// Of those, outputs on which the rules say nothing.
    pub undecided: usize,
    /// Of those, outputs where an undecided comparison joined two results.
    pub forked: usize,
    /// Refused outputs.
    pub refused: usize,
    /// Why the worst was refused.
    pub refusal: Option<Refusal>,
    /// The worst output.
    pub worst: Option<Worst>,
    /// Which outputs are refused although the value lies in the interval.
    demands: Demand,
    /// The badness of `worst`, for merging.
    badness: f64,
}

impl Comparison {
    /// Outputs that a property judged as a whole, without intervals.
    #[must_use]
    pub fn of_property(outputs: usize) -> Self {
        Self {
            outputs,
            ..Self::default()
        }
    }

    /// For inputs inside the documented domain of a function that promises an answer there: open outputs are refused.
    #[must_use]
    pub fn demanding_answers() -> Self {
        Self {
            demands: Demand::Answer,
            ..Self::default()
        }
    }

    /// For inputs whose answer is known: outputs that are open, or may be one thing or another, are refused.
    #[must_use]
    pub fn demanding_one_answer() -> Self {
        Self {
            demands: Demand::OneAnswer,
            ..Self::default()
        }
    }

    /// Compares the outputs of one item.
    pub fn item(&mut self, input: &[f32], got: &[f32], expected: &[Expected]) {
        for (output, (&got, expected)) in got.iter().zip(expected).enumerate() {
            self.output(input, output, got, expected);
        }
        // A missing output is as bad as an unwritten one.
        for (output, expected) in expected.iter().enumerate().skip(got.len()) {
            self.output(input, output, bossage_runner::SENTINEL, expected);
        }
    }

    fn output(&mut self, input: &[f32], output: usize, got: f32, expected: &Expected) {
        let open = match self.demands {
            Demand::Nothing => false,
            Demand::Answer => !expected.bound.is_decided(),
            Demand::OneAnswer => !expected.bound.is_settled(),
        };
        let refusal = refusal(got, expected).or(open.then_some(Refusal::Open));
        self.count(&expected.bound, refusal);
        self.keep_worst(badness(got, expected, refusal), refusal, || {
            worst(input, output, got, expected)
        });
    }

    /// Counts an output.
    pub(crate) fn count(&mut self, bound: &Bound, refusal: Option<Refusal>) {
        self.outputs += 1;
        self.undecided += usize::from(!bound.is_decided());
        self.forked += usize::from(bound.is_forked());
        self.refused += usize::from(refusal.is_some());
    }

    /// Keeps an output if it is worse than those before.
    pub(crate) fn keep_worst(
        &mut self,
        badness: f64,
        refusal: Option<Refusal>,
        worst: impl FnOnce() -> Worst,
    ) {
        if self.worst.is_none() || badness > self.badness {
            self.badness = badness;
            self.refusal = refusal;
            self.worst = Some(worst());
        }
    }

    /// Adds another part of the same case.
    pub fn merge(&mut self, other: Self) {
        self.outputs += other.outputs;
        self.undecided += other.undecided;
        self.forked += other.forked;
        self.refused += other.refused;
        if other.worst.is_some() && (self.worst.is_none() || other.badness > self.badness) {
            self.badness = other.badness;
            self.refusal = other.refusal;
            self.worst = other.worst;
        }
    }

    /// The share of outputs on which the rules say nothing or allow two results.
    #[must_use]
    pub fn undecided_share(&self) -> f64 {
        if self.outputs == 0 {
            0.0
        } else {
            (self.undecided + self.forked) as f64 / self.outputs as f64
        }
    }
}

/// Whether the truth lies in the interval, with room for the rounding of the float64 reference.
fn oracles_agree(expected: &Expected) -> bool {
    let (low, high) = (expected.bound.low(), expected.bound.high());
    // Some tens of operations at 2^-53 each, relative to the largest magnitude there is.
    let rounding = 64.0 * f64::EPSILON * low.abs().max(high.abs()) + f64::MIN_POSITIVE;
    !expected.bound.is_decided() || (low - rounding <= expected.truth && expected.truth <= high + rounding)
}

fn refusal(got: f32, expected: &Expected) -> Option<Refusal> {
    if is_unwritten(got) {
        return Some(Refusal::Unwritten);
    }
    if !oracles_agree(expected) {
        return Some(Refusal::OraclesDisagree);
    }
    if !expected.bound.is_decided() || expected.bound.contains(f64::from(got)) {
        return None;
    }
    Some(if got.is_finite() {
        Refusal::Outside
    } else {
        Refusal::NotFinite
    })
}

/// The order of "worse": refusals first, then the share of the allowed error that was used. Accepted outputs that are
/// forked or flushed use all of it by nature (a sign either way, a subnormal taken for zero) and would hide the rest.
fn badness(got: f32, expected: &Expected, refusal: Option<Refusal>) -> f64 {
    let share = share_of_bound(f64::from(got), expected).unwrap_or(0.0).min(1e30);
    match refusal {
        Some(Refusal::Unwritten) => 4e30,
        Some(Refusal::OraclesDisagree) => 3e30,
        Some(Refusal::Open) => 2.5e30,
        Some(Refusal::NotFinite) => 2e30,
        Some(Refusal::Outside | Refusal::Disagree) => 1e30 + share,
        None if expected.bound.is_forked() || expected.truth.abs() < MIN_NORMAL => 0.0,
        None => share,
    }
}

/// The error as a share of the room that the interval leaves on that side of the truth.
fn share_of_bound(got: f64, expected: &Expected) -> Option<f64> {
    let distance = (got - expected.truth).abs();
    let room = if got < expected.truth {
        expected.truth - expected.bound.low()
    } else {
        expected.bound.high() - expected.truth
    };
    match expected.bound.is_decided() {
        false => None,
        true if distance == 0.0 => Some(0.0),
        true => Some(distance / room).filter(|share| !share.is_nan()),
    }
}

fn worst(input: &[f32], output: usize, got: f32, expected: &Expected) -> Worst {
    let finite = |x: f64| x.is_finite().then_some(x);
    let got64 = f64::from(got);
    Worst {
        ulp: finite(error_ulps(got64, expected.truth)),
        abs: finite((got64 - expected.truth).abs()),
        of_bound: share_of_bound(got64, expected).and_then(finite),
        input: input.to_vec(),
        output,
        written: !is_unwritten(got),
        got: Number(got64),
        truth: Number(expected.truth),
        interval: [Number(expected.bound.low()), Number(expected.bound.high())],
        place: None,
        inputs: Vec::new(),
        other: None,
    }
}

#[cfg(test)]
mod tests {
    use bossage_runner::SENTINEL;

    use super::{Comparison, Expected, Refusal};
    use crate::bound::Bound;

    fn expect(truth: f64, error: f64) -> Expected {
        Expected {
            truth,
            bound: Bound::between(truth - error, truth + error),
        }
    }

    fn compare(got: f32, expected: Expected) -> Comparison {
        let mut comparison = Comparison::default();
        comparison.item(&[7.0], &[got], &[expected]);
        comparison
    }

    #[test]
    fn inside_passes_and_one_ulp_beyond_fails() {
        let error = f64::from(f32::EPSILON);
        assert_eq!(compare(1.0f32.next_up(), expect(1.0, error)).refused, 0);
        let outside = compare(1.0f32.next_up().next_up(), expect(1.0, error));
        assert_eq!((outside.refused, outside.refusal), (1, Some(Refusal::Outside)));
        let worst = outside.worst.unwrap();
        assert_eq!(
            (worst.ulp, worst.of_bound, worst.input),
            (Some(2.0), Some(2.0), vec![7.0])
        );
    }

    #[test]
    fn unwritten_is_refused_even_where_the_rules_say_nothing() {
        let open = Expected {
            truth: f64::NAN,
            bound: Bound::OPEN,
        };
        assert_eq!(compare(SENTINEL, open).refusal, Some(Refusal::Unwritten));
        let other = compare(f32::NAN, open);
        assert_eq!((other.refused, other.undecided), (0, 1));
    }

    #[test]
    fn an_open_output_is_refused_where_an_answer_is_promised() {
        let open = Expected {
            truth: 1.0,
            bound: Bound::OPEN,
        };
        let mut promised = Comparison::demanding_answers();
        promised.item(&[], &[1.0], &[open]);
        assert_eq!((promised.refused, promised.refusal), (1, Some(Refusal::Open)));
        assert_eq!(compare(1.0, open).refused, 0);
    }

    #[test]
    fn nan_is_refused_where_the_interval_is_finite() {
        assert_eq!(
            compare(f32::NAN, expect(0.0, 1.0)).refusal,
            Some(Refusal::NotFinite)
        );
        assert_eq!(
            compare(f32::INFINITY, expect(0.0, 1.0)).refusal,
            Some(Refusal::NotFinite)
        );
    }

    #[test]
    fn disagreeing_oracles_are_refused_although_the_output_is_in_the_interval() {
        let expected = Expected {
            truth: 2.0,
            bound: Bound::between(0.9, 1.1),
        };
        assert_eq!(compare(1.0, expected).refusal, Some(Refusal::OraclesDisagree));
    }

    #[test]
    fn too_few_outputs_are_refused() {
        let mut comparison = Comparison::default();
        comparison.item(&[], &[1.0], &[expect(1.0, 0.0), expect(1.0, 0.0)]);
        assert_eq!(
            (comparison.refused, comparison.refusal),
            (1, Some(Refusal::Unwritten))
        );
    }

    #[test]
    fn a_fork_does_not_hide_a_rounding_error() {
        let sign = Expected {
            truth: 1.0,
            bound: Bound::between(-1.0, 3.0).forked(),
        };
        let mut comparison = compare(1.05, expect(1.0, 0.1));
        comparison.item(&[], &[-1.0], &[sign]);
        assert_eq!((comparison.refused, comparison.forked), (0, 1));
        assert_eq!(comparison.worst.unwrap().got.0, f64::from(1.05f32));
    }

    #[test]
    fn merging_keeps_the_worst() {
        let mut all = compare(1.0, expect(1.0, 0.1));
        all.merge(compare(1.5, expect(1.0, 0.1)));
        all.merge(compare(1.05, expect(1.0, 0.1)));
        assert_eq!((all.outputs, all.refused), (3, 1));
        assert_eq!(all.worst.unwrap().got.0, 1.5);
    }
}
