//! Vectors of bounded numbers: `dot`, `cross`, `length`, `normalize` by the formulas from which they inherit.
//!
//! `dot(a, b)` inherits Σ aᵢ·bᵢ in **any** order, with or without fma; `cross` its three differences of products;
//! `length(v)` inherits √dot(v, v); `normalize(v)` inherits v / length(v), and v · inverseSqrt(dot(v, v)), which compilers
//! use, lies inside that bound.

use super::Bounded;
use crate::ulp::MIN_NORMAL;

/// Three bounded components.
pub type Vec3 = [Bounded; 3];

/// Σ aᵢ·bᵢ. With n products that are not zero, any order of summing rounds each product once and passes it through at
/// most n − 1 sums: |error| ≤ n · u · (1 + u)ⁿ · Σ|aᵢ·bᵢ| with u = 2⁻²³ for rounding in either direction, besides what the
/// operands carry. One product alone is one multiplication.
#[must_use]
pub fn dot<const N: usize>(a: &[Bounded; N], b: &[Bounded; N]) -> Bounded {
    let products: Vec<Bounded> = a.iter().zip(b).map(|(&x, &y)| x * y).collect();
    let present: Vec<Bounded> = products
        .iter()
        .copied()
        .filter(|p| !p.is_decided() || p.magnitude() > 0.0)
        .collect();
    match present.as_slice() {
        [] => Bounded::exact(0.0).marked(&products),
        [single] => single.marked(&products),
        many => sum_in_any_order(many).marked(&products),
    }
}

fn sum_in_any_order(terms: &[Bounded]) -> Bounded {
    let unit = f64::from(f32::EPSILON);
    let value = terms.iter().map(|t| t.value).sum();
    let magnitude: f64 = terms.iter().map(Bounded::magnitude).sum();
    let carried: f64 = terms.iter().map(|t| t.error).sum();
    let sums = (terms.len() - 1) as f64;
    // A partial sum that turns out subnormal may be flushed.
    let smallest = terms
        .iter()
        .map(|t| t.value.abs() - t.error)
        .fold(f64::INFINITY, f64::min);
    let flushed = if smallest < MIN_NORMAL / unit {
        sums * MIN_NORMAL.min(magnitude)
    } else {
        0.0
    };
    let error = carried + sums * unit * (1.0 + unit).powi(terms.len() as i32) * magnitude + flushed;
    // Overflow of a partial sum in some order is overflow.
    let fits = magnitude <= crate::ulp::MAX;
    if fits {
        Bounded {
            value,
            error,
            forked: false,
        }
        .rounded(0.0)
    } else {
        Bounded::OPEN
    }
}

/// a × b.
#[must_use]
pub fn cross(a: &Vec3, b: &Vec3) -> Vec3 {
    let component = |i: usize, j: usize| dot(&[a[i], -a[j]], &[b[j], b[i]]);
    [component(1, 2), component(2, 0), component(0, 1)]
}

/// √dot(v, v).
#[must_use]
pub fn length(v: &Vec3) -> Bounded {
    dot(v, v).sqrt()
}

/// v / length(v).
#[must_use]
pub fn normalize(v: &Vec3) -> Vec3 {
    let length = length(v);
    v.map(|x| x / length)
}

/// Component by component.
#[must_use]
pub fn add<const N: usize>(a: &[Bounded; N], b: &[Bounded; N]) -> [Bounded; N] {
    std::array::from_fn(|i| a[i] + b[i])
}

/// Component by component.
#[must_use]
pub fn subtract<const N: usize>(a: &[Bounded; N], b: &[Bounded; N]) -> [Bounded; N] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// Component by component.
#[must_use]
pub fn multiply<const N: usize>(a: &[Bounded; N], b: &[Bounded; N]) -> [Bounded; N] {
    std::array::from_fn(|i| a[i] * b[i])
}

/// Every component by the same number.
#[must_use]
pub fn scale<const N: usize>(factor: Bounded, v: &[Bounded; N]) -> [Bounded; N] {
    v.map(|x| factor * x)
}

/// A matrix, given column by column, times a vector.
#[must_use]
pub fn transform(columns: &[Vec3; 3], v: &Vec3) -> Vec3 {
    std::array::from_fn(|row| dot(&[columns[0][row], columns[1][row], columns[2][row]], v))
}
