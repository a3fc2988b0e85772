//! Levels of detail: from the derivatives of coordinates to a level, and from a level to the mip levels that are read.
//!
//! The ideal level is the base-2 logarithm of the longer of the two footprint axes in texels. Vulkan lets implementations take
//! anything between the largest component and the sum of the components; an interval domain contains all of that.

use super::{Bounds, Filter, LOD_SLACK, Sampler};

/// Bounds of the level from the coordinate's change along x and along y, both in texels.
pub(crate) fn from_gradients(dx: &[Bounds], dy: &[Bounds], uncertain: bool) -> Bounds {
    if dx.iter().chain(dy).any(|b| b.0.is_nan()) {
        return (f64::NAN, f64::NAN);
    }
    if !uncertain {
        let length = |d: &[Bounds]| d.iter().map(|b| b.0 * b.0).sum::<f64>().sqrt();
        let level = length(dx).max(length(dy)).log2();
        return (level, level);
    }
    let magnitude = |b: &Bounds| {
        (
            if b.0 <= 0.0 && b.1 >= 0.0 {
                0.0
            } else {
                b.0.abs().min(b.1.abs())
            },
            b.0.abs().max(b.1.abs()),
        )
    };
    let parts: Vec<Bounds> = dx
        .iter()
        .zip(dy)
        .map(|(x, y)| {
            let (x, y) = (magnitude(x), magnitude(y));
            (x.0.max(y.0), x.1.max(y.1))
        })
        .collect();
    let least = parts.iter().fold(0.0f64, |m, p| m.max(p.0));
    let most: f64 = parts.iter().map(|p| p.1).sum();
    (least.log2() - LOD_SLACK, most.log2() + LOD_SLACK)
}

/// A mip level, or a blend of two, to be read with one filter; `weight` belongs to the level above `level`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tap {
    pub(crate) level: usize,
    pub(crate) weight: f64,
    pub(crate) filter: Filter,
}

/// All taps whose hull covers a level of detail, which must not be NaN.
pub(crate) fn taps(sampler: &Sampler, levels: usize, (lo, hi): Bounds) -> Vec<Tap> {
    let clamp = |x: f64| {
        x.clamp(
            f64::from(sampler.lod.0),
            f64::from(sampler.lod.1.max(sampler.lod.0)),
        )
    };
    let (lo, hi) = (clamp(lo), clamp(hi));
    let mut out = Vec::new();
    if lo <= 0.0 {
        out.push(Tap {
            level: 0,
            weight: 0.0,
            filter: sampler.mag,
        });
    }
    if hi > 0.0 {
        minified(sampler, levels, (lo.max(0.0), hi), &mut out);
    }
    out
}

fn minified(sampler: &Sampler, levels: usize, (lo, hi): Bounds, out: &mut Vec<Tap>) {
    let last = (levels - 1) as f64;
    match sampler.mip {
        Filter::Nearest => {
            let (a, b) = ((lo + 0.5).floor().min(last), (hi + 0.5).floor().min(last));
            out.extend((a as usize..=b as usize).map(|level| Tap {
                level,
                weight: 0.0,
                filter: sampler.min,
            }));
        }
        Filter::Linear => {
            let (a, b) = (lo.min(last), hi.min(last));
            // Linear between neighbouring levels: the ends and the whole levels between give the hull.
            let whole = (a.ceil() as usize..=b.floor() as usize).map(|l| l as f64);
            for x in std::iter::once(a).chain(whole).chain(std::iter::once(b)) {
                out.push(Tap {
                    level: x.floor() as usize,
                    weight: x.fract(),
                    filter: sampler.min,
                });
            }
            out.dedup();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::AddressMode;

    #[test]
    fn levels_of_plain_gradients() {
        // Two texels a pixel in x, one in y: level 1.
        let (lo, hi) = from_gradients(&[(2.0, 2.0), (0.0, 0.0)], &[(0.0, 0.0), (1.0, 1.0)], false);
        assert_eq!((lo, hi), (1.0, 1.0));
        let (lo, hi) = from_gradients(&[(2.0, 2.0), (0.0, 0.0)], &[(0.0, 0.0), (1.0, 1.0)], true);
        assert!(lo < 1.0 && hi > 3f64.log2());
    }

    #[test]
    fn taps_cover_the_range() {
        let s = Sampler::linear(AddressMode::Repeat);
        let t = taps(&s, 4, (0.5, 2.25));
        let at: Vec<f64> = t.iter().map(|t| t.level as f64 + t.weight).collect();
        assert_eq!(at, [0.5, 1.0, 2.0, 2.25]);
        assert_eq!(
            taps(&s, 4, (-3.0, -1.0)),
            [Tap {
                level: 0,
                weight: 0.0,
                filter: Filter::Linear
            }]
        );
        assert_eq!(taps(&s, 4, (9.0, 9.0)).last().map(|t| t.level), Some(3));
    }
}
