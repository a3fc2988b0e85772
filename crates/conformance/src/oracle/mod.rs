//! The two oracles of a probe: truth in f64 and the acceptance interval at each input.
//!
//! They meet only here: [`expected`] evaluates both at an item's inputs. The comparator refuses a case where they disagree.

pub mod truth;

use bossage_shaders::Probe;

use crate::bounded::Bounded;
use crate::compare::Expected;
use crate::tolerance;

/// What the reports say about the oracles of a probe.
pub const BASIS: [&str; 2] = ["reference f64", "accuracy rules at the input"];

/// An item's arguments, read one after the other.
#[derive(Clone, Debug)]
pub struct Args<'a, T> {
    rest: &'a [T],
}

impl<'a, T: Copy> Args<'a, T> {
    /// The arguments of one item, tightly packed.
    #[must_use]
    pub fn new(values: &'a [T]) -> Self {
        Self { rest: values }
    }

    /// The next N numbers.
    ///
    /// # Panics
    /// When there are fewer: the oracle and the table of probes disagree, which a test over the table finds.
    pub fn array<const N: usize>(&mut self) -> [T; N] {
        let (head, tail) = self
            .rest
            .split_first_chunk()
            .expect("an oracle reads more inputs than the probe has");
        self.rest = tail;
        *head
    }

    /// The next number.
    pub fn scalar(&mut self) -> T {
        let [x] = self.array();
        x
    }

    /// The next matrix, N columns of N.
    pub fn matrix<const N: usize>(&mut self) -> [[T; N]; N] {
        std::array::from_fn(|_| self.array())
    }

    /// All that is left.
    pub fn rest(&mut self) -> &'a [T] {
        std::mem::take(&mut self.rest)
    }

    /// Whether everything was read.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }
}

/// What a probe's outputs should be at an item's inputs. `None` where an oracle is missing.
#[must_use]
pub fn expected(probe: &Probe, input: &[f32]) -> Option<Vec<Expected>> {
    let exact: Vec<f64> = input.iter().copied().map(f64::from).collect();
    let bounded: Vec<Bounded> = input.iter().copied().map(Bounded::input).collect();
    let truth = truth::find(probe.function())?(&mut Args::new(&exact));
    // Nothing is judged where the table has no row: the outputs count as undecided.
    let bounds = match tolerance::find(probe.function()) {
        Some(row) => (row.bound)(&mut Args::new(&bounded)),
        None => vec![Bounded::OPEN; truth.len()],
    };
    Some(
        truth
            .into_iter()
            .zip(bounds)
            .map(|(truth, bound)| Expected { truth, bound })
            .collect(),
    )
}

#[cfg(test)]
mod tests {
    use bossage_shaders::PROBES;

    use super::{Args, expected, truth};
    use crate::bounded::Bounded;
    use crate::generate::random;
    use crate::tolerance;

    #[test]
    fn every_probe_has_both_oracles_and_every_oracle_a_probe() {
        let known = |name: &str| PROBES.iter().any(|probe| probe.function() == name);
        let missing: Vec<&str> = PROBES
            .iter()
            .map(|probe| probe.function())
            .filter(|f| truth::find(f).is_none())
            .collect();
        assert!(missing.is_empty(), "no truth for {missing:?}");
        let orphans: Vec<&str> = truth::names()
            .chain(tolerance::names())
            .filter(|name| !known(name))
            .collect();
        assert!(orphans.is_empty(), "oracles without a probe: {orphans:?}");
    }

    #[test]
    fn oracles_read_all_inputs_and_give_all_outputs() {
        for probe in PROBES {
            let inputs = random::generate(probe, 1, 0, 1);
            let input = inputs.items().next().unwrap();
            let exact: Vec<f64> = input.iter().copied().map(f64::from).collect();
            let mut args = Args::new(&exact);
            let truth = truth::find(probe.function()).unwrap()(&mut args);
            assert!(args.is_empty(), "{}: the truth leaves inputs unread", probe.id);
            assert_eq!(
                truth.len(),
                probe.output_floats,
                "{}: the truth's outputs",
                probe.id
            );
            let Some(tolerance) = tolerance::find(probe.function()) else {
                continue;
            };
            let bounded: Vec<Bounded> = input.iter().copied().map(Bounded::input).collect();
            let mut args = Args::new(&bounded);
            let bounds = (tolerance.bound)(&mut args);
            assert!(
                args.is_empty(),
                "{}: the tolerance leaves inputs unread",
                probe.id
            );
            assert_eq!(
                bounds.len(),
                probe.output_floats,
                "{}: the tolerance's outputs",
                probe.id
            );
        }
    }

    #[test]
    fn the_oracles_agree_on_random_inputs() {
        for probe in PROBES {
            let inputs = random::generate(probe, 500, 0, 2);
            for input in inputs.items() {
                for (output, e) in expected(probe, input).unwrap().iter().enumerate() {
                    let slack = 64.0 * f64::EPSILON * e.bound.value.abs() + f64::MIN_POSITIVE;
                    let agree =
                        !e.bound.is_decided() || (e.truth - e.bound.value).abs() <= e.bound.error + slack;
                    assert!(agree, "{} output {output} at {input:?}: {e:?}", probe.id);
                }
            }
        }
    }

    #[test]
    fn hardened_functions_are_decided_on_random_inputs() {
        for probe in PROBES
            .iter()
            .filter(|probe| probe.form == bossage_shaders::Form::Hardened)
            .filter(|probe| tolerance::find(probe.function()).is_some())
        {
            let inputs = random::generate(probe, 2000, 0, 3);
            let (mut outputs, mut open) = (0, 0);
            for input in inputs.items() {
                for e in expected(probe, input).unwrap() {
                    outputs += 1;
                    open += usize::from(!e.bound.is_decided() || e.bound.forked);
                }
            }
            assert!(
                open * 100 <= outputs,
                "{}: {open} of {outputs} undecided",
                probe.id
            );
        }
    }
}
