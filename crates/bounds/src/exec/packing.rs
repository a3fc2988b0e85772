//! Packing numbers into words and back.

use super::machine::Machine;
use crate::compile::code::{Pack, Packing};
use crate::domain::Domain;
use crate::domain::point::{float_from_bits, float_to_bits};
use crate::interval::rules::UNPACK_ULPS;
use crate::kind::{IntType, Kind};
use crate::width::Width;

impl<'a, D: Domain> Machine<'a, D> {
    pub(crate) fn pack(&mut self, pack: &Pack, active: &[u32]) {
        let bits = pack.packing.bits();
        for &lane in active {
            if D::UNCERTAIN && self.leaves_half(pack, lane) {
                self.set(pack.word, lane, D::indeterminate(Kind::Int(IntType::U32)));
                continue;
            }
            let (mut lo, mut hi) = (0i128, 0i128);
            for (k, &row) in (0u32..).zip(&pack.parts) {
                let (a, b) = code_bounds::<D>(pack.packing, self.get(row, lane));
                lo |= a << (k * bits);
                hi |= b << (k * bits);
            }
            self.set(pack.word, lane, D::int_range(IntType::U32, lo, hi));
        }
    }

    /// Whether a part may lie beyond the finite numbers of `f16`: the language then leaves the whole word open, not that half of it.
    fn leaves_half(&self, pack: &Pack, lane: u32) -> bool {
        matches!(pack.packing, Packing::Half)
            && pack.parts.iter().any(|&row| {
                let (lo, hi) = D::float_bounds(self.get(row, lane));
                // A NaN is no number of the format either.
                let within = |x: f64| Width::F16.round(x).is_finite();
                !(within(Width::F16.round_down(lo, 0.0)) && within(Width::F16.round_up(hi, 0.0)))
            })
    }

    pub(crate) fn unpack(&mut self, pack: &Pack, active: &[u32]) {
        let bits = pack.packing.bits();
        for &lane in active {
            let (lo, hi) = D::int_bounds(IntType::U32, self.get(pack.word, lane));
            for (k, &row) in (0u32..).zip(&pack.parts) {
                let cell = unpacked::<D>(pack.packing, field(lo, hi, k * bits, bits));
                self.set(row, lane, cell);
            }
        }
    }
}

/// Bounds of the bits `at .. at + bits` of the words from `lo` to `hi`.
fn field(lo: i128, hi: i128, at: u32, bits: u32) -> (i128, i128) {
    let mask = (1i128 << bits) - 1;
    if lo >> (at + bits) != hi >> (at + bits) {
        return (0, mask);
    }
    ((lo >> at) & mask, (hi >> at) & mask)
}

/// Bounds of the code that a part is packed into, as an unsigned number.
fn code_bounds<D: Domain>(packing: Packing, cell: D::Cell) -> (i128, i128) {
    let all = (0, (1i128 << packing.bits()) - 1);
    match packing {
        Packing::Int { signed, clamp } => int_code::<D>(signed, clamp, cell),
        Packing::Half => half_code::<D>(cell, all),
        Packing::Unorm { bits } => {
            float_code::<D>(cell, all, |x| scaled(x.clamp(0.0, 1.0), (1u64 << bits) - 1))
        }
        Packing::Snorm { bits } => float_code::<D>(cell, all, |x| {
            scaled(x.clamp(-1.0, 1.0), (1u64 << (bits - 1)) - 1)
        }),
    }
}

/// `floor(0.5 + scale * x)`, as the built-ins define it.
fn scaled(x: f64, scale: u64) -> f64 {
    (0.5 + scale as f64 * x).floor()
}

fn float_code<D: Domain>(cell: D::Cell, all: (i128, i128), code: impl Fn(f64) -> f64) -> (i128, i128) {
    let (lo, hi) = D::float_bounds(cell);
    if lo.is_nan() {
        return if D::UNCERTAIN { all } else { (0, 0) };
    }
    // The intermediate product may be rounded in either direction before the floor.
    let slack = if D::UNCERTAIN {
        f64::from(f32::EPSILON)
    } else {
        0.0
    };
    wrap_bounds(
        code(lo - slack * lo.abs()) as i128,
        code(hi + slack * hi.abs()) as i128,
        all,
    )
}

/// Two's complement of a range, everything when it crosses zero.
fn wrap_bounds(lo: i128, hi: i128, all: (i128, i128)) -> (i128, i128) {
    if lo < 0 && hi >= 0 {
        all
    } else {
        (lo & all.1, hi & all.1)
    }
}

fn half_code<D: Domain>(cell: D::Cell, all: (i128, i128)) -> (i128, i128) {
    let (lo, hi) = D::float_bounds(cell);
    if !D::UNCERTAIN {
        let code = i128::from(float_to_bits(Width::F16, Width::F16.round(lo)));
        return (code, code);
    }
    let (down, up) = (Width::F16.round_down(lo, 0.0), Width::F16.round_up(hi, 0.0));
    let open = !(down.is_finite() && up.is_finite()) || (down <= 0.0 && up >= 0.0 && down != up);
    if open {
        return all;
    }
    let (a, b) = (float_to_bits(Width::F16, down), float_to_bits(Width::F16, up));
    (i128::from(a.min(b)), i128::from(a.max(b)))
}

fn int_code<D: Domain>(signed: bool, clamp: bool, cell: D::Cell) -> (i128, i128) {
    let (mut lo, mut hi) = D::int_bounds(IntType { signed, bits: 32 }, cell);
    if clamp {
        let (least, most) = if signed { (-128, 127) } else { (0, 255) };
        (lo, hi) = (lo.clamp(least, most), hi.clamp(least, most));
    }
    if hi - lo > 255 || (lo & 255) > (hi & 255) {
        (0, 255)
    } else {
        (lo & 255, hi & 255)
    }
}

fn unpacked<D: Domain>(packing: Packing, (lo, hi): (i128, i128)) -> D::Cell {
    match packing {
        Packing::Int { signed, .. } => {
            let t = IntType { signed, bits: 32 };
            let (a, b) = signed_bounds(signed, 8, lo, hi);
            D::int_range(t, a, b)
        }
        Packing::Half => half_value::<D>(lo, hi),
        Packing::Unorm { bits } => normalised::<D>(lo as f64, hi as f64, ((1u64 << bits) - 1) as f64),
        Packing::Snorm { bits } => {
            let (a, b) = signed_bounds(true, bits, lo, hi);
            let most = ((1u64 << (bits - 1)) - 1) as f64;
            normalised::<D>((a as f64).max(-most), (b as f64).max(-most), most)
        }
    }
}

fn signed_bounds(signed: bool, bits: u32, lo: i128, hi: i128) -> (i128, i128) {
    if !signed {
        return (lo, hi);
    }
    let t = IntType { signed: true, bits };
    let (a, b) = (t.wrap(lo), t.wrap(hi));
    if a <= b { (a, b) } else { (t.min(), t.max()) }
}

/// A code over its greatest value, with the units in the last place that the table allows for unpacking.
fn normalised<D: Domain>(lo: f64, hi: f64, most: f64) -> D::Cell {
    let w = Width::F32;
    let (a, b) = (lo / most, hi / most);
    if !D::UNCERTAIN {
        return D::real(w, a, b);
    }
    // Zero and the two ends are exact: a quotient of equal or zero numbers has nothing to round.
    let exact = |x: f64| x == 0.0 || x.abs() == 1.0;
    let below = if exact(a) { a } else { a - UNPACK_ULPS * w.ulp(a) };
    let above = if exact(b) { b } else { b + UNPACK_ULPS * w.ulp(b) };
    D::real(w, below, above)
}

fn half_value<D: Domain>(lo: i128, hi: i128) -> D::Cell {
    let (a, b) = (
        float_from_bits(Width::F16, lo as u64),
        float_from_bits(Width::F16, hi as u64),
    );
    if !D::UNCERTAIN {
        return D::float(Width::F32, a);
    }
    let open = (lo < 0x8000) != (hi < 0x8000) || !a.is_finite() || !b.is_finite();
    if open {
        return D::indeterminate(Kind::Float(Width::F32));
    }
    // A subnormal half is a normal f32, but may be flushed on the way.
    let cell = D::real(Width::F32, a.min(b), a.max(b));
    let subnormal = Width::F16.is_subnormal(a) || Width::F16.is_subnormal(b);
    if subnormal {
        D::hull(Kind::Float(Width::F32), cell, D::float(Width::F32, 0.0))
    } else {
        cell
    }
}
