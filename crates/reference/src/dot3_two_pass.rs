//! `dot3_two_pass`: the same picture as `dot3_single_pass` in two passes: the first writes the dot product to the target, the
//! second draws the surface's colour and multiplies the target by it (blend: source × destination).
//!
//! Source: the third article, on hardware with two texture units only.
//!
//! What the detour costs in precision: the target rounds after each pass. With q the rounding to 1/255, one pass gives
//! q(I·M), two give q(q(I)·M). |q(I) − I| ≤ 1/510 and M ≤ 1, so before the last rounding they are at most 1/510 apart, and
//! after it at most **one code** of the target ([`LARGEST_DIFFERENCE_CODES`]). Where the blender rounds the source colour to
//! the target's format first ([`Blender::RoundsSource`], allowed by the interfaces), they are up to (I + M)/510 + 1/(4·255²)
//! apart before the last rounding. That stays below 1/255, since a number half a code from its rounding is at most 254.5/255: again
//! at most one code.

use glam::DVec3;

/// What the render target keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Floats: nothing is rounded here.
    Float,
    /// Unsigned normalised bytes, clamped to [0, 1] and rounded to nearest.
    Unorm8,
}

/// What the blending unit does to the source colour first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blender {
    /// Takes it as the shader wrote it.
    TakesSource,
    /// Rounds it to the target's format.
    RoundsSource,
}

/// How many codes of a [`Target::Unorm8`] the two ways may differ by, with either [`Blender`].
pub const LARGEST_DIFFERENCE_CODES: u32 = 1;

impl Target {
    /// A colour as the target keeps it.
    #[must_use]
    pub fn store(self, color: DVec3) -> DVec3 {
        match self {
            Target::Float => color,
            Target::Unorm8 => (color.clamp(DVec3::ZERO, DVec3::ONE) * 255.0).round() / 255.0,
        }
    }
}

/// The first pass: the dot product in all channels, as the target keeps it.
#[must_use]
pub fn first_pass(intensity: f64, target: Target) -> DVec3 {
    target.store(DVec3::splat(intensity))
}

/// The second pass: source × destination, as the target keeps it.
#[must_use]
pub fn second_pass(destination: DVec3, surface: DVec3, target: Target, blender: Blender) -> DVec3 {
    let source = match blender {
        Blender::TakesSource => surface,
        Blender::RoundsSource => target.store(surface),
    };
    target.store(source * destination)
}

/// Both passes.
#[must_use]
pub fn shade(intensity: f64, surface: DVec3, target: Target, blender: Blender) -> DVec3 {
    second_pass(first_pass(intensity, target), surface, target, blender)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{Blender, LARGEST_DIFFERENCE_CODES, Target, shade};

    /// Largest difference to one pass in codes of the target, over intensities and colours in steps of 1/1530 and 1/`m`.
    fn worst_codes(blender: Blender, m: u32) -> u32 {
        let pairs = (0..=1530)
            .flat_map(|i| (0..=m).map(move |c| (f64::from(i) / 1530.0, f64::from(c) / f64::from(m))));
        let codes = pairs.map(|(intensity, color)| {
            let surface = DVec3::splat(color);
            let two = shade(intensity, surface, Target::Unorm8, blender).x;
            let one = Target::Unorm8.store(intensity * surface).x;
            ((two - one) * 255.0).round().abs() as u32
        });
        codes.max().unwrap_or(0)
    }

    #[test]
    fn known_answers() {
        let two = |i, m| shade(i, DVec3::splat(m), Target::Unorm8, Blender::TakesSource).x * 255.0;
        assert_eq!(two(1.0, 1.0).round(), 255.0);
        assert_eq!(two(0.0, 1.0), 0.0);
        // I = 0.5 is kept as 128/255; times M = 1 it is code 128, as in one pass.
        assert_eq!(two(0.5, 1.0).round(), 128.0);
        // I = 2.5/255 − ε is kept as 2/255; times 0.7 that is 1.4 → 1, in one pass 1.75 → 2.
        assert_eq!(two(2.49 / 255.0, 0.7).round(), 1.0);
        assert_eq!(
            (Target::Unorm8.store(DVec3::splat(0.7 * 2.49 / 255.0)).x * 255.0).round(),
            2.0
        );
    }

    #[test]
    fn bytes_differ_by_no_more_than_the_bound_and_reach_it() {
        for blender in [Blender::TakesSource, Blender::RoundsSource] {
            for steps in [255, 1000] {
                assert_eq!(
                    worst_codes(blender, steps),
                    LARGEST_DIFFERENCE_CODES,
                    "{blender:?} {steps}"
                );
            }
        }
    }

    /// Blending units that work on bytes need not round a product to nearest: with ⌊(ab + ⌊ab/256⌋ + 128)/256⌋, which is up to
    /// 1/128 code more than half a code off, the two ways still are one code apart at most.
    #[test]
    fn a_product_of_bytes_in_integers_keeps_the_bound() {
        let code = |x: f64| (x * 255.0).round() as u32;
        let steps = 1530;
        let worst = (0..=steps)
            .flat_map(|i| (0..=steps).map(move |m| (i, m)))
            .map(|(i, m)| {
                let (intensity, color) = (f64::from(i) / f64::from(steps), f64::from(m) / f64::from(steps));
                let product = code(intensity) * code(color);
                let two = (product + product / 256 + 128) / 256;
                two.abs_diff(code(intensity * color))
            });
        assert_eq!(worst.max(), Some(LARGEST_DIFFERENCE_CODES));
    }

    #[test]
    fn a_rounded_source_shows() {
        // 200·100.4/255 = 78.7; 200·100/255 = 78.4.
        let code = |blender| {
            let surface = DVec3::splat(100.4 / 255.0);
            (shade(200.0 / 255.0, surface, Target::Unorm8, blender).x * 255.0).round()
        };
        assert_eq!(
            [Blender::TakesSource, Blender::RoundsSource].map(code),
            [79.0, 78.0]
        );
    }

    #[test]
    fn floats_do_not_differ() {
        let surface = DVec3::new(0.3, 0.6, 0.9);
        assert_eq!(
            shade(0.7, surface, Target::Float, Blender::RoundsSource),
            0.7 * surface
        );
    }
}
