//! Points of the unit cube, one after the other: where rays are drawn.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A sequence that can be drawn from for as long as one likes.
#[derive(Clone, Debug)]
pub(crate) enum Sequence {
    /// Fills the cube evenly from the start.
    LowDiscrepancy {
        /// Points drawn.
        drawn: u32,
    },
    /// Independent, uniform points.
    Random(Pcg64Mcg),
}

impl Sequence {
    /// The planner's own.
    pub(crate) fn even() -> Self {
        Self::LowDiscrepancy { drawn: 0 }
    }

    /// Independent points: the same seed and stream give the same ones.
    pub(crate) fn random(seed: u64, stream: u64) -> Self {
        Self::Random(Pcg64Mcg::seed_from_u64(seed ^ stream.rotate_left(32)))
    }

    /// The next point.
    pub(crate) fn draw(&mut self) -> [f64; 3] {
        match self {
            Self::LowDiscrepancy { drawn } => {
                *drawn += 1;
                roberts(*drawn)
            }
            Self::Random(generator) => generator.random(),
        }
    }
}

/// Roberts' additive recurrence in three dimensions: multiples of the powers of 1/g, g the real root of g⁴ = g + 1.
fn roberts(index: u32) -> [f64; 3] {
    const G: f64 = 1.220_744_084_605_759_5;
    [1.0, 2.0, 3.0].map(|power: f64| (0.5 + f64::from(index) * G.powf(-power)).fract())
}

#[cfg(test)]
mod tests {
    use super::Sequence;

    #[test]
    fn sequences_fill_the_cube() {
        // 512 cells of an 8x8x8 grid and 16 points a cell on average. The even one leaves no cell empty; of independent points a
        // given cell stays empty with probability e⁻¹⁶, one of them with less than 6e-5.
        for mut sequence in [Sequence::even(), Sequence::random(7, 1)] {
            let mut seen = [false; 512];
            for _ in 0..8192 {
                let [x, y, z] = sequence.draw().map(|v| (v * 8.0) as usize);
                seen[x * 64 + y * 8 + z] = true;
            }
            assert!(seen.iter().all(|cell| *cell), "{sequence:?}");
        }
    }

    #[test]
    fn streams_and_seeds_differ() {
        let first = |seed, stream| Sequence::random(seed, stream).draw();
        assert_eq!(first(1, 0), first(1, 0));
        assert_ne!(first(1, 0), first(1, 1));
        assert_ne!(first(1, 0), first(2, 0));
    }
}
