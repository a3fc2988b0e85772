//! The 99th percentile of a distribution, from a sample of it: the estimate, and bounds that hold whatever the distribution is.
//!
//! How many of n independent values exceed the true percentile is binomial with n and 1/100. So the value that k others exceed lies
//! above it unless at most k exceed it, and below it unless more than k do. Both happen with a probability that can be summed up, and
//! the ranks at which it is small are bounds (order statistics). A sample that fills its space more evenly than independent draws is
//! nearer to the truth than that.

/// Share of a distribution above its 99th percentile.
const ABOVE: f64 = 0.01;
/// The probability with which a bound does not hold.
pub(crate) const DOUBT: f64 = 0.005;

/// What a sample says about the 99th percentile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Percentile {
    /// The smallest value that at least 99 % of the sample do not exceed.
    pub(crate) estimate: f64,
    /// Below the true percentile, but for [`DOUBT`].
    pub(crate) at_least: f64,
    /// Above the true percentile, but for [`DOUBT`]; infinite where the sample is too small to say.
    pub(crate) at_most: f64,
}

impl Percentile {
    /// Of a sample in any order; none without values.
    pub(crate) fn of(values: &[f64]) -> Option<Self> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let n = sorted.len();
        let exceeded_by = |k: usize| sorted.get((n - 1).checked_sub(k)?).copied();
        let Tails { few, many } = tails(n);
        let rank = (n as f64 * (1.0 - ABOVE)).ceil() as usize;
        Some(Self {
            estimate: *sorted.get(rank.checked_sub(1)?)?,
            at_least: exceeded_by(many).unwrap_or(f64::NEG_INFINITY),
            at_most: few.and_then(exceeded_by).unwrap_or(f64::INFINITY),
        })
    }
}

/// How many of n values may exceed the true percentile.
#[derive(Debug, PartialEq)]
struct Tails {
    /// The largest number that is not reached with a probability of more than 1 − [`DOUBT`]: at most so many do with at most DOUBT.
    few: Option<usize>,
    /// The smallest number that is not exceeded with a probability of at least 1 − [`DOUBT`].
    many: usize,
}

fn tails(n: usize) -> Tails {
    let (n_f, odds) = (n as f64, ABOVE / (1.0 - ABOVE));
    // P(K = 0) is above the smallest f64 up to 70,000 values; its logarithm is kept instead.
    let mut log_p = n_f * (1.0 - ABOVE).ln();
    let (mut sum, mut few) = (0.0, None);
    for k in 0..=n {
        sum += log_p.exp();
        if sum <= DOUBT {
            few = Some(k);
        }
        if sum >= 1.0 - DOUBT {
            return Tails { few, many: k };
        }
        log_p += (odds * (n_f - k as f64) / (k as f64 + 1.0)).ln();
    }
    Tails { few, many: n }
}

#[cfg(test)]
mod tests {
    use super::{DOUBT, Percentile, Tails, tails};
    use crate::sequence::Sequence;

    #[test]
    fn the_estimate_is_a_value_of_the_sample() {
        let of = |values: &[f64]| Percentile::of(values).map(|p| p.estimate);
        assert_eq!(of(&(1..=200).map(f64::from).collect::<Vec<_>>()), Some(198.0));
        assert_eq!(of(&[3.0]), Some(3.0));
        assert_eq!(of(&[]), None);
    }

    #[test]
    fn tails_are_those_of_the_binomial() {
        // 0.99⁵²⁷ = 0.005009, 0.99⁵²⁸ = 0.004959: from 528 values on the greatest one says something.
        assert_eq!(tails(527).few, None);
        assert_eq!(tails(528).few, Some(0));
        // One value exceeds with 1/100, which is more than the doubt; of two, both with 1e-4.
        assert_eq!(tails(1), Tails { few: None, many: 1 });
        assert_eq!(tails(2).many, 1);
        // About the mean by 2.576 deviations: 40.96 ± 16.4, and the binomial's skew moves both up by less than 2.
        let Tails { few, many } = tails(4096);
        assert!(
            (24..=26).contains(&few.unwrap()) && (57..=59).contains(&many),
            "{few:?} {many}"
        );
        // e^−2634 is no f64.
        assert!(tails(1 << 18).few.is_some_and(|few| (2480..2500).contains(&few)));
    }

    #[test]
    fn bounds_fail_as_often_as_they_may() {
        // x² of uniform x: the percentile is 0.99². Each bound fails in DOUBT of 2000 samples or a little less, for ranks are whole:
        // 10 expected, and more than 22 with a probability below 3e-4.
        let mut sequence = Sequence::random(3, 0);
        let mut draw = || sequence.draw().map(|x| x * x);
        let (mut below, mut above) = (0, 0);
        for _ in 0..2000 {
            let values: Vec<f64> = (0..300).flat_map(|_| draw()).collect();
            let Percentile {
                at_least, at_most, ..
            } = Percentile::of(&values).unwrap();
            below += u32::from(at_most < 0.9801);
            above += u32::from(at_least > 0.9801);
        }
        assert!(below <= 22 && above <= 22, "{below} {above}");
        // The control: bounds that never failed would be no bounds of this confidence.
        assert!(below + above > 0 && DOUBT == 0.005);
    }
}
