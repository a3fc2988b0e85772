//! Logarithmic axes on which zero has a place.
//!
//! A logarithm has none, and to leave exact results out would hide the best of them. So a floor lies below the lowest decade, apart from
//! it by a break, and its label says what lies on it: `0`, or `< 10⁻⁷` where amounts are too small for the decades shown.

/// Decades shown at most; what is smaller lies on the floor.
const DECADES: i32 = 9;
/// How far the floor is below the lowest decade, in decades.
const FLOOR: f64 = 0.7;
/// Room at either end, in decades.
const MARGIN: f64 = 0.15;

/// A logarithmic axis for amounts from zero up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LogScale {
    /// Exponent of the lowest decade.
    low: i32,
    /// Exponent of the highest.
    high: i32,
    floor: Floor,
}

/// What lies on the floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Floor {
    Nothing,
    Zeros,
    SmallAmounts,
}

impl LogScale {
    /// An axis that has room for all of these amounts, which must be finite and not negative.
    pub(super) fn over(amounts: impl IntoIterator<Item = f64>) -> Self {
        let amounts: Vec<f64> = amounts.into_iter().collect();
        let positive = || amounts.iter().copied().filter(|amount| *amount > 0.0);
        let least = positive().fold(f64::INFINITY, f64::min);
        let greatest = positive().fold(0.0, f64::max);
        let (low, high) = match greatest > 0.0 {
            true => (least.log10().floor() as i32, greatest.log10().ceil() as i32),
            false => (-1, 0),
        };
        let high = high.max(low + 1);
        let lowest = low.max(high - DECADES);
        let floor = match (lowest > low, amounts.contains(&0.0)) {
            (true, _) => Floor::SmallAmounts,
            (false, true) => Floor::Zeros,
            (false, false) => Floor::Nothing,
        };
        Self {
            low: lowest,
            high,
            floor,
        }
    }

    /// Where an amount lies on the axis, in decades.
    pub(super) fn at(&self, amount: f64) -> f64 {
        let place = amount.log10();
        if place < f64::from(self.low) {
            self.floor()
        } else {
            place
        }
    }

    /// The ends of the axis, in decades.
    pub(super) fn ends(&self) -> (f64, f64) {
        let start = match self.floor {
            Floor::Nothing => f64::from(self.low),
            Floor::Zeros | Floor::SmallAmounts => self.floor(),
        };
        (start - MARGIN, f64::from(self.high) + MARGIN)
    }

    /// Where the floor is cut off from the decades, if there is one.
    pub(super) fn cut(&self) -> Option<f64> {
        (self.floor != Floor::Nothing).then(|| f64::from(self.low) - FLOOR / 2.0)
    }

    /// Places with a label, lowest first.
    pub(super) fn ticks(&self) -> Vec<f64> {
        let floor = (self.floor != Floor::Nothing).then(|| self.floor());
        floor
            .into_iter()
            .chain((self.low..=self.high).map(f64::from))
            .collect()
    }

    /// The label of a tick.
    pub(super) fn label(&self, tick: f64) -> String {
        if tick >= f64::from(self.low) {
            return power_of_ten(tick.round() as i32);
        }
        match self.floor {
            Floor::SmallAmounts => format!("< {}", power_of_ten(self.low)),
            Floor::Zeros | Floor::Nothing => "0".to_owned(),
        }
    }

    fn floor(&self) -> f64 {
        f64::from(self.low) - FLOOR
    }
}

/// `0.01`, `100`, and `10⁻⁶` where zeros would have to be counted.
fn power_of_ten(exponent: i32) -> String {
    match exponent {
        0..=4 => format!("1{}", "0".repeat(exponent as usize)),
        -3..=-1 => format!("0.{}1", "0".repeat((-exponent - 1) as usize)),
        _ => format!(
            "10{}",
            exponent.to_string().chars().map(raised).collect::<String>()
        ),
    }
}

const fn raised(digit: char) -> char {
    match digit {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        _ => '⁹',
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: LogScale) -> Vec<String> {
        scale.ticks().into_iter().map(|tick| scale.label(tick)).collect()
    }

    #[test]
    fn an_axis_without_zeros_has_no_floor() {
        let scale = LogScale::over([0.02, 35.0]);
        assert_eq!(labels(scale), ["0.01", "0.1", "1", "10", "100"]);
        assert_eq!(scale.cut(), None);
        assert_eq!(scale.at(0.1), -1.0);
    }

    #[test]
    fn zeros_lie_on_a_labelled_floor_apart_from_every_amount() {
        let scale = LogScale::over([0.0, 0.02, 5.0]);
        assert_eq!(labels(scale), ["0", "0.01", "0.1", "1", "10"]);
        let cut = scale.cut().unwrap();
        assert!(scale.at(0.0) < cut && cut < scale.at(0.02), "{scale:?}");
        assert!(scale.ends().0 < scale.at(0.0));
    }

    #[test]
    fn amounts_below_the_decades_shown_are_not_called_zero() {
        let scale = LogScale::over([0.0, 1e-12, 50.0]);
        assert_eq!(labels(scale)[..2], ["< 10⁻⁷", "10⁻⁷"]);
        assert_eq!(scale.at(1e-12), scale.at(0.0));
        assert!(scale.at(1.1e-7) > scale.cut().unwrap());
    }

    #[test]
    fn nothing_and_zeros_alone_still_make_an_axis() {
        assert_eq!(labels(LogScale::over([])), ["0.1", "1"]);
        assert_eq!(labels(LogScale::over([0.0])), ["0", "0.1", "1"]);
        assert_eq!(labels(LogScale::over([10.0])), ["10", "100"]);
    }
}
