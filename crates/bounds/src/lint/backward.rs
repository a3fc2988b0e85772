//! Backward error: are there inputs close by of which a machine's result is the exact one?
//!
//! Where there are, an error is no worse than the inputs' own last digits, whatever its size. Where there are none, the formula has made
//! something that it never gives: a tangent that is not at right angles to its normal. Inputs are moved by up to [`FORMULA`] halves of a unit in their
//! last place each, and outputs are taken to follow linearly, which is what can be solved: least squares within a box, coordinate by coordinate.
//!
//! Only asked where the outputs depend on one vector alone. Of several it is known that no nearby ones need exist: a computed cross product of
//! nearly parallel vectors is not at right angles to them, and there the vectors are to blame.

use super::cancel::FORMULA;

/// Rounds of the search, each over all inputs.
const ROUNDS: usize = 64;

/// How far one input, moved by half a unit in its last place, moves each output.
pub(super) struct Moved {
    /// The vector that the input belongs to.
    pub(super) group: usize,
    pub(super) of: Vec<f64>,
}

/// The largest share of an output's size that is left of its error when inputs close by are taken; `None` where outputs depend on several
/// vectors, or on nothing.
pub(super) fn unreachable(errors: &[f64], sizes: &[f64], moves: &[Moved]) -> Option<f64> {
    let judged: Vec<usize> = (0..errors.len())
        .filter(|k| errors[*k].is_finite() && sizes[*k] > 0.0)
        .filter(|k| moves.iter().all(|m| m.of[*k].is_finite()))
        .collect();
    let column = |m: &Moved| judged.iter().map(|k| m.of[*k] / sizes[*k]).collect::<Vec<f64>>();
    let acting: Vec<(usize, Vec<f64>)> = moves.iter().map(|m| (m.group, column(m))).collect();
    let acting: Vec<(usize, Vec<f64>)> = acting
        .into_iter()
        .filter(|(_, column)| column.iter().any(|x| *x != 0.0))
        .collect();
    let (group, _) = acting.first()?;
    if acting.iter().any(|(other, _)| other != group) {
        return None;
    }
    let left: Vec<f64> = judged.iter().map(|k| errors[*k] / sizes[*k]).collect();
    let columns: Vec<Vec<f64>> = acting.into_iter().map(|(_, column)| column).collect();
    let left = fitted(left, &columns);
    Some(left.iter().fold(0.0, |most, x| x.abs().max(most)))
}

/// What is left of a vector when multiples of columns are taken from it, each at most [`FORMULA`].
fn fitted(mut left: Vec<f64>, columns: &[Vec<f64>]) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut shares = vec![0.0; columns.len()];
    for _ in 0..ROUNDS {
        for (share, column) in shares.iter_mut().zip(columns) {
            let wanted: f64 = *share + dot(&left, column) / dot(column, column);
            let new = wanted.clamp(-FORMULA, FORMULA);
            for (x, c) in left.iter_mut().zip(column) {
                *x -= (new - *share) * c;
            }
            *share = new;
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::{Moved, unreachable};

    fn moved(group: usize, of: &[f64]) -> Moved {
        Moved {
            group,
            of: of.to_vec(),
        }
    }

    #[test]
    fn an_error_that_inputs_explain_is_reached() {
        let moves = [moved(0, &[1.0, 0.0, 1.0]), moved(0, &[0.0, 1.0, 1.0])];
        let left = unreachable(&[3.0, -2.0, 1.0], &[1.0; 3], &moves).unwrap();
        assert!(left < 1e-9, "{left}");
    }

    #[test]
    fn an_error_across_what_inputs_do_is_not() {
        let moves = [moved(0, &[1.0, 0.0, 0.0]), moved(0, &[0.0, 1.0, 0.0])];
        let left = unreachable(&[3.0, -2.0, 0.5], &[1.0; 3], &moves).unwrap();
        assert!((left - 0.5).abs() < 1e-9, "{left}");
        let far = unreachable(&[30.0, 0.0, 0.0], &[1.0; 3], &moves).unwrap();
        assert!((far - 14.0).abs() < 1e-9, "inputs move by so much only: {far}");
    }

    #[test]
    fn several_vectors_are_not_asked() {
        let moves = [moved(0, &[1.0, 0.0]), moved(1, &[0.0, 1.0])];
        assert_eq!(unreachable(&[1.0, 1.0], &[1.0; 2], &moves), None);
        assert_eq!(unreachable(&[1.0, 1.0], &[1.0; 2], &[]), None);
    }
}
