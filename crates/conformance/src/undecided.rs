//! How much of a case may stay undecided, where that is more than isolated ties.
//!
//! A hardened function leaves nothing open inside its domain, and forks where an interval holds a step: so the limit is
//! [`UNDECIDED_LIMIT`]. The exceptions below are derived, each from what is known before anything is run.

use crate::tolerance::UNDECIDED_LIMIT;

/// How inputs were made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inputs {
    /// By lot, from the documented domain.
    Random,
    /// Spaced evenly over what the fields mean, which may be more than the function's domain.
    Spaced,
}

/// The width at scale of a component of `normalisation_cube_map`, in ULPs: at most this in the reviewed table, which a test holds.
pub const UNIT_WIDTH_ULPS: f64 = 20.0;

/// The share of codes that fork, of unit vectors written with the largest code `largest`.
///
/// A code is round((½·n + ½) · c). ½·n halves the width of n; the sum and the product are rounded outward, by half a ULP of 2⁻²⁴ at
/// each end on the average. Boundaries between codes lie one code apart and components lie anywhere between them, so an
/// interval that is w codes wide holds one with probability w.
#[must_use]
pub fn code_share(largest: f64) -> f64 {
    (0.5 * UNIT_WIDTH_ULPS + 2.0) / f64::from(1u32 << 24) * largest
}

/// The share of spaced pairs of vectors whose product leaves the range of f32.
///
/// Lengths are powers of two, the exponents a and b spaced evenly over ±126, and `handedness_of` multiplies both vectors: below 2⁻¹²⁶
/// the product may be flushed, above 2¹²⁸ it overflows, and the sign is anybody's. |a + b| exceeds 126 in two corners of the square,
/// each an eighth of it.
const PRODUCT_OUT_OF_RANGE: f64 = 0.25;

/// The largest share of undecided outputs of a hardened function.
#[must_use]
pub fn limit(function: &str, inputs: Inputs) -> f64 {
    match (function, inputs) {
        ("normalisation_cube_map_code", Inputs::Random | Inputs::Spaced) => {
            // Half of the inputs each.
            0.5 * (code_share(65_535.0) + code_share(255.0))
        }
        ("handedness_of", Inputs::Spaced) => PRODUCT_OUT_OF_RANGE,
        (_, Inputs::Random | Inputs::Spaced) => UNDECIDED_LIMIT,
    }
}

#[cfg(test)]
mod tests {
    use bossage_shaders::Probe;

    use super::{Inputs, PRODUCT_OUT_OF_RANGE, UNIT_WIDTH_ULPS, code_share, limit};
    use crate::tolerance::UNDECIDED_LIMIT;
    use crate::width::golden;

    #[test]
    fn components_are_known_as_well_as_the_limit_of_codes_assumes() {
        let probe = Probe::find("normalisation_cube_map").unwrap();
        let row = golden::reviewed(probe, "direction").unwrap();
        assert!(
            row.at_scale.iter().all(|&width| width <= UNIT_WIDTH_ULPS),
            "{row:?}"
        );
        // Not loose either: a tenth wider would not do.
        assert!(row.at_scale.iter().any(|&width| 1.2 * width > UNIT_WIDTH_ULPS));
    }

    #[test]
    fn the_share_of_codes_is_that_of_a_grid() {
        // Intervals of the assumed width, at places spaced by the golden ratio, against whole codes.
        let width = 0.5 * UNIT_WIDTH_ULPS + 2.0;
        let (items, step) = (200_000, 0.618_033_988_749_894_9);
        let held = |codes: f64| {
            let wide = width / f64::from(1u32 << 24) * codes;
            let holds = |k: &u32| {
                let at = (f64::from(*k) * step).fract() * codes;
                (at + 0.5).floor() != (at + wide + 0.5).floor()
            };
            (0..items).filter(holds).count() as f64 / f64::from(items)
        };
        for codes in [65_535.0, 255.0] {
            let share = held(codes) / code_share(codes);
            assert!((share - 1.0).abs() < 0.05, "{codes}: {share}");
        }
    }

    #[test]
    fn the_corners_of_the_square_are_a_quarter() {
        let n = 504i32;
        let places = (0..=n).flat_map(|a| (0..=n).map(move |b| (a, b)));
        let outside = places.filter(|&(a, b)| (a + b - n).abs() > n / 2);
        let share = outside.count() as f64 / f64::from((n + 1) * (n + 1));
        assert!((share - PRODUCT_OUT_OF_RANGE).abs() < 0.01, "{share}");
    }

    #[test]
    fn every_other_function_has_the_usual_limit() {
        assert_eq!(limit("normalise", Inputs::Spaced), UNDECIDED_LIMIT);
        assert_eq!(limit("handedness_of", Inputs::Random), UNDECIDED_LIMIT);
    }
}
