//! A surface that is known everywhere: a few waves over a square tile, wrapped, as steep whatever their length.

use std::f64::consts::TAU;

use bossage_conformance::generate::random::stream;
use glam::{DVec2, DVec3};
use rand::RngExt;

/// How many waves are added up.
const COUNT: usize = 3;

/// Texels of the longest waves; shorter ones are the same, 2, 4 or 8 times as many.
const LONGEST: u32 = 64;

/// The sum of the waves' steepest slopes.
pub(super) const STEEPEST: f64 = 1.5;

/// A wave sin(2π(k · uv + phase)) / (2·COUNT) of the height.
struct Wave {
    /// Whole numbers, so that it wraps.
    k: DVec2,
    phase: f64,
}

/// Heights in [0, 1] over a tile of `side` × `side` texels, and the elevation scale · h in widths of the tile.
pub(super) struct Waves {
    pub(super) side: u32,
    pub(super) scale: f64,
    waves: Vec<Wave>,
}

impl Waves {
    /// Waves about so many texels long, a divisor of 64, in seeded directions. Rounding the longest ones to whole numbers of waves
    /// makes them up to a third shorter or longer.
    pub(super) fn new(seed: u64, side: u32, texels: u32) -> Self {
        let mut rng = stream("waves", seed);
        let (longest, times) = (f64::from(side / LONGEST), f64::from(LONGEST / texels));
        // A sixth of a turn apart: no two waves run along one line, where they might cancel.
        let first = rng.random::<f64>();
        let mut wave = |at: usize| {
            let direction = DVec2::from_angle(TAU * (first + at as f64 / (2 * COUNT) as f64));
            Wave {
                k: times * (longest * direction).round(),
                phase: rng.random(),
            }
        };
        let waves: Vec<Wave> = (0..COUNT).map(&mut wave).collect();
        let steepest: f64 = waves.iter().map(|wave| TAU * wave.k.length() * amplitude()).sum();
        Self {
            side,
            scale: STEEPEST / steepest,
            waves,
        }
    }

    fn height(&self, uv: DVec2) -> f64 {
        let of = |wave: &Wave| amplitude() * (TAU * (wave.k.dot(uv) + wave.phase)).sin();
        0.5 + self.waves.iter().map(of).sum::<f64>()
    }

    /// The normal of the elevation, unit.
    pub(super) fn normal(&self, uv: DVec2) -> DVec3 {
        let of = |wave: &Wave| {
            let cos = (TAU * (wave.k.dot(uv) + wave.phase)).cos();
            amplitude() * TAU * cos * wave.k
        };
        let slope: DVec2 = self.scale * self.waves.iter().map(of).sum::<DVec2>();
        (-slope).extend(1.0).normalize()
    }

    /// The height at each texel's centre, row by row.
    pub(super) fn texels(&self) -> Vec<f64> {
        self.centres().map(|uv| self.height(uv)).collect()
    }

    /// The texels' centres, row by row.
    pub(super) fn centres(&self) -> impl Iterator<Item = DVec2> {
        let side = self.side;
        let centre = move |at: u32| [at % side, at / side].map(|n| (f64::from(n) + 0.5) / f64::from(side));
        (0..side * side).map(move |at| DVec2::from_array(centre(at)))
    }

    /// The greatest angle by which a wave's phase goes on from texel to texel, along either axis.
    #[cfg(test)]
    pub(super) fn greatest_step(&self) -> f64 {
        let steps = self.waves.iter().map(|wave| TAU * wave.k.abs().max_element());
        steps.fold(0.0, f64::max) / f64::from(self.side)
    }
}

/// The height of one wave over its middle.
fn amplitude() -> f64 {
    0.5 / COUNT as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_is_that_of_the_heights() {
        for texels in [8, 32] {
            let waves = Waves::new(1, 128, texels);
            let step = 1e-6;
            for uv in waves.centres().step_by(97) {
                let slope = DVec2::AXES.map(|axis| {
                    waves.scale * (waves.height(uv + step * axis) - waves.height(uv - step * axis))
                        / (2.0 * step)
                });
                let expected = DVec3::new(-slope[0], -slope[1], 1.0).normalize();
                // The square of the step times a third derivative, below 1e-12·(2π·16)²; and rounding, 1e-16 over the step.
                assert!((waves.normal(uv) - expected).length() < 1e-7);
            }
        }
    }

    #[test]
    fn heights_are_in_range_wrap_and_are_as_steep_as_said() {
        let waves = Waves::new(1, 128, 16);
        assert!(waves.texels().iter().all(|h| (0.0..=1.0).contains(h)));
        let uv = DVec2::new(0.3, 0.7);
        assert!((waves.height(uv) - waves.height(uv + 1.0)).abs() < 1e-12);
        let slope = |n: DVec3| n.truncate().length() / n.z;
        let steepest = waves
            .centres()
            .map(|uv| slope(waves.normal(uv)))
            .fold(0.0, f64::max);
        // Squares of waves that do not run along one line add up: the mean square is Σ s²/2 ≥ (Σ s)²/6, and the greatest not below it.
        assert!(
            steepest <= STEEPEST + 1e-12 && steepest > STEEPEST / 6f64.sqrt() - 1e-12,
            "{steepest}"
        );
    }
}
