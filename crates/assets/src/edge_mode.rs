//! What lies beyond the border of an image: the one place that says so.
//!
//! The three rules are those of the graphics APIs' samplers (repeat, mirrored repeat, clamp to edge), for integer texel
//! coordinates. The bake kernels' shader twins follow the same formulas.

/// How a texel coordinate outside `0..n` is brought inside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum EdgeMode {
    /// The image repeats: texel −1 is texel n−1. Right for tiling images.
    #[default]
    Wrap,
    /// The image repeats mirrored, the edge texel occurring twice: texel −1 is texel 0, texel n is texel n−1.
    Mirror,
    /// The edge texel goes on for ever. Right for images that do not tile, such as elevation maps.
    Clamp,
}

impl EdgeMode {
    /// The texel in `0..n` that stands for coordinate `i`. `n` = 0 answers 0.
    ///
    /// ```
    /// use bossage_assets::EdgeMode;
    /// assert_eq!(EdgeMode::Wrap.resolve(-1, 4), 3);
    /// assert_eq!(EdgeMode::Mirror.resolve(-1, 4), 0);
    /// assert_eq!(EdgeMode::Clamp.resolve(9, 4), 3);
    /// ```
    #[must_use]
    pub fn resolve(self, i: i64, n: u32) -> u32 {
        if n == 0 {
            return 0;
        }
        let n = i64::from(n);
        let inside = match self {
            EdgeMode::Wrap => i.rem_euclid(n),
            EdgeMode::Mirror => {
                let k = i.rem_euclid(2 * n);
                k.min(2 * n - 1 - k)
            }
            EdgeMode::Clamp => i.clamp(0, n - 1),
        };
        u32::try_from(inside).unwrap_or(0)
    }

    /// The word used in scene files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            EdgeMode::Wrap => "wrap",
            EdgeMode::Mirror => "mirror",
            EdgeMode::Clamp => "clamp",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::EdgeMode::{Clamp, Mirror, Wrap};
    use proptest::prelude::*;

    #[test]
    fn the_first_texels_outside() {
        let outside = [-5i64, -4, -1, 0, 3, 4, 5, 8];
        let of = |mode: super::EdgeMode| outside.map(|i| mode.resolve(i, 4));
        assert_eq!(of(Wrap), [3, 0, 3, 0, 3, 0, 1, 0]);
        assert_eq!(of(Mirror), [3, 3, 0, 0, 3, 3, 2, 0]);
        assert_eq!(of(Clamp), [0, 0, 0, 0, 3, 3, 3, 3]);
    }

    proptest! {
        #[test]
        fn always_inside(i in any::<i64>(), n in 1u32..=u32::MAX) {
            for mode in [Wrap, Mirror, Clamp] {
                prop_assert!(mode.resolve(i, n) < n);
            }
        }

        #[test]
        fn inside_is_left_alone(n in 1u32..20_000, f in 0.0f64..1.0) {
            let i = (f * f64::from(n)) as u32;
            for mode in [Wrap, Mirror, Clamp] {
                prop_assert_eq!(mode.resolve(i64::from(i), n), i);
            }
        }

        #[test]
        fn wrap_and_mirror_have_their_periods(i in -1_000_000i64..1_000_000, n in 1u32..5000) {
            prop_assert_eq!(Wrap.resolve(i, n), Wrap.resolve(i + i64::from(n), n));
            prop_assert_eq!(Mirror.resolve(i, n), Mirror.resolve(i + 2 * i64::from(n), n));
            prop_assert_eq!(Mirror.resolve(i, n), Mirror.resolve(-1 - i, n));
        }
    }
}
