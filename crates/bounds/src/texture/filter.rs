//! Filtering within one level: which texels a coordinate selects, and their weighted mean.
//!
//! Along each axis an uncertain coordinate selects a short list of *cells* (a texel and its neighbour), each with bounds of the
//! weight within it. A weighted mean is linear in each weight, so its extremes over a cell lie at the corners of the weights'
//! box: the result is the exact hull, cell by cell.
//!
//! Besides, a filter may work in the precision of the texels ([`TexelFormat::filter_step`](super::TexelFormat::filter_step)):
//! software drivers filter bytes in bytes. Texels that are all the same come out as they are, in whatever precision, since weights sum
//! to 1.

use super::{AddressMode, Bounds, Filter, SUBTEXEL};

/// The texels one coordinate may select along one axis.
pub(crate) struct Axis {
    first: i64,
    last: i64,
    /// Bounds of the coordinate in texels, and whether the texel above a cell has a weight.
    at: Bounds,
    linear: bool,
}

/// A coordinate that may be anything, or too many texels.
pub(crate) struct TooWide;

/// How far the coordinate that hardware uses may be from the real one, in texels: its sub-texel bits, and the rounding of
/// `u * size` in `f32` where coordinates are large.
fn slack(uncertain: bool, x: f64) -> f64 {
    if uncertain {
        SUBTEXEL + x.abs() * f64::from(f32::EPSILON)
    } else {
        0.0
    }
}

impl Axis {
    /// The cells of a normalised coordinate on an axis of `n` texels.
    pub(crate) fn new(
        u: Bounds,
        n: u32,
        offset: i64,
        filter: Filter,
        uncertain: bool,
        limit: u32,
    ) -> Result<Self, TooWide> {
        let shift = offset as f64 - if filter == Filter::Linear { 0.5 } else { 0.0 };
        let (lo, hi) = (u.0 * f64::from(n), u.1 * f64::from(n));
        let (lo, hi) = (
            lo + shift - slack(uncertain, lo),
            hi + shift + slack(uncertain, hi),
        );
        if !(lo.abs() < 1e15 && hi.abs() < 1e15) || hi - lo > f64::from(limit) {
            return Err(TooWide);
        }
        Ok(Self {
            first: lo.floor() as i64,
            last: hi.floor() as i64,
            at: (lo, hi),
            linear: filter == Filter::Linear,
        })
    }

    /// How many cells there are.
    pub(crate) fn len(&self) -> usize {
        (self.last - self.first + 1) as usize
    }

    /// Index of the lower texel and bounds of the upper one's weight, cell by cell.
    pub(crate) fn cells(&self) -> impl Iterator<Item = (i64, Bounds)> + use<> {
        let ((lo, hi), linear) = (self.at, self.linear);
        let weight = move |cell: i64| {
            if linear {
                (
                    (lo - cell as f64).clamp(0.0, 1.0),
                    (hi - cell as f64).clamp(0.0, 1.0),
                )
            } else {
                (0.0, 0.0)
            }
        };
        (self.first..=self.last).map(move |cell| (cell, weight(cell)))
    }

    /// The one cell of an axis that the texture does not have.
    pub(crate) fn flat() -> Self {
        Self {
            first: 0,
            last: 0,
            at: (0.0, 0.0),
            linear: false,
        }
    }
}

/// The texel that an index outside of `0..n` stands for; `None` is the border.
pub(crate) fn address(mode: AddressMode, i: i64, n: u32) -> Option<u32> {
    let n = i64::from(n);
    if (0..n).contains(&i) {
        return Some(i as u32);
    }
    let inside = match mode {
        AddressMode::ClampToEdge => i.clamp(0, n - 1),
        AddressMode::Repeat => i.rem_euclid(n),
        AddressMode::MirrorRepeat => {
            let k = i.rem_euclid(2 * n);
            if k < n { k } else { 2 * n - 1 - k }
        }
        AddressMode::ClampToBorder => return None,
    };
    Some(inside as u32)
}

/// The hull of two lists of bounds.
pub(crate) fn hull(a: [Bounds; 4], b: [Bounds; 4]) -> [Bounds; 4] {
    std::array::from_fn(|c| (a[c].0.min(b[c].0), a[c].1.max(b[c].1)))
}

/// The weighted mean over all cells of three axes; `texel` gives the bounds of a texel's channels. The allowance is the step of a
/// filter's arithmetic along one axis (0 for floats), and `None` for the ideal mean.
pub(crate) fn filtered(
    axes: &[Axis; 3],
    allowance: Option<f64>,
    texel: &mut impl FnMut([i64; 3]) -> [Bounds; 4],
) -> [Bounds; 4] {
    let mut total: Option<[Bounds; 4]> = None;
    for (z, wz) in axes[2].cells() {
        for (y, wy) in axes[1].cells() {
            for (x, wx) in axes[0].cells() {
                let cell = cell_mean([x, y, z], [wx, wy, wz], allowance, texel);
                total = Some(total.map_or(cell, |t| hull(t, cell)));
            }
        }
    }
    total.unwrap_or([(0.0, 0.0); 4])
}

fn cell_mean(
    base: [i64; 3],
    weights: [Bounds; 3],
    allowance: Option<f64>,
    texel: &mut impl FnMut([i64; 3]) -> [Bounds; 4],
) -> [Bounds; 4] {
    let mut mean = along(2, base, &weights, texel);
    let blended = weights.iter().filter(|w| w.1 > 0.0).count() as f64;
    if let Some(step) = allowance.filter(|_| blended > 0.0) {
        for bounds in &mut mean {
            let steps = if bounds.0 == bounds.1 { 0.0 } else { blended * step };
            // Three interpolations in f32, each with two roundings of at most one unit of the greatest magnitude.
            let pad = bounds.0.abs().max(bounds.1.abs()) * f64::from(f32::EPSILON) * 3.0 + steps;
            *bounds = (bounds.0 - pad, bounds.1 + pad);
        }
    }
    mean
}

/// The mean along an axis and those below it.
fn along(
    axis: usize,
    base: [i64; 3],
    weights: &[Bounds; 3],
    texel: &mut impl FnMut([i64; 3]) -> [Bounds; 4],
) -> [Bounds; 4] {
    let lower = if axis == 0 {
        texel(base)
    } else {
        along(axis - 1, base, weights, texel)
    };
    let (least, most) = weights[axis];
    if most == 0.0 {
        return lower;
    }
    let mut next = base;
    next[axis] += 1;
    let upper = if axis == 0 {
        texel(next)
    } else {
        along(axis - 1, next, weights, texel)
    };
    std::array::from_fn(|c| lerp(lower[c], upper[c], (least, most)))
}

/// Bounds of `a + (b - a) * t`.
pub(crate) fn lerp(a: Bounds, b: Bounds, t: Bounds) -> Bounds {
    let at = |x: f64, y: f64, t: f64| {
        if t == 0.0 {
            x
        } else if t == 1.0 {
            y
        } else {
            x + (y - x) * t
        }
    };
    let lo = at(a.0, b.0, t.0).min(at(a.0, b.0, t.1));
    let hi = at(a.1, b.1, t.0).max(at(a.1, b.1, t.1));
    (lo, hi)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn address_modes_agree_with_their_definitions() {
        let list = |mode| (-5..9).map(|i| address(mode, i, 4)).collect::<Vec<_>>();
        let some = |v: &[u32]| v.iter().map(|&x| Some(x)).collect::<Vec<_>>();
        assert_eq!(
            list(AddressMode::ClampToEdge),
            some(&[0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3])
        );
        assert_eq!(
            list(AddressMode::Repeat),
            some(&[3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0])
        );
        assert_eq!(
            list(AddressMode::MirrorRepeat),
            some(&[3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 2, 1, 0, 0])
        );
        assert_eq!(address(AddressMode::ClampToBorder, -1, 4), None);
    }

    #[test]
    fn an_uncertain_coordinate_covers_every_cell() {
        let u = (0.30, 0.60);
        let axis = Axis::new(u, 4, 0, Filter::Linear, true, 64).unwrap_or(Axis::flat());
        let value = |i: i64| [0.0, 1.0, 5.0, 2.0][i.clamp(0, 3) as usize];
        let axes = [axis, Axis::flat(), Axis::flat()];
        let bounds = filtered(&axes, Some(0.0), &mut |at| [(value(at[0]), value(at[0])); 4])[0];
        for k in 0..=100 {
            let x = (u.0 + (u.1 - u.0) * f64::from(k) / 100.0) * 4.0 - 0.5;
            let i = x.floor();
            let exact = value(i as i64) + (value(i as i64 + 1) - value(i as i64)) * (x - i);
            assert!(bounds.0 <= exact && exact <= bounds.1);
        }
        // Negative control: the end points alone miss the peak between them.
        assert!(bounds.1 > 4.0);
    }
}
