//! The techniques' algorithms over bounded numbers, one a row of the table.
//!
//! Each follows the algorithm that the technique's documentation states, with its branches: a branch that can go either way
//! joins both results.

use super::{ONE, SMALLEST_NORMAL, ZERO};
use crate::bounded::vector::{Vec3, cross, dot, length, multiply, normalize, scale, subtract};
use crate::bounded::{Bounded, Decision};

/// Both results of a branch, joined where it can go either way; the side that is never taken is not evaluated.
pub(super) fn branch<const N: usize>(
    condition: Decision,
    yes: impl FnOnce() -> [Bounded; N],
    no: impl FnOnce() -> [Bounded; N],
) -> [Bounded; N] {
    match condition {
        Decision::Always => yes(),
        Decision::Never => no(),
        Decision::Either { .. } => {
            let (yes, no) = (yes(), no());
            std::array::from_fn(|i| Bounded::select(condition, yes[i], no[i]))
        }
    }
}

pub(super) fn largest_component(v: &Vec3) -> Bounded {
    v[0].abs().max(v[1].abs()).max(v[2].abs())
}

pub(super) fn normalise(v: &Vec3) -> Vec3 {
    let largest = largest_component(v);
    branch(
        largest.less(SMALLEST_NORMAL),
        || [ZERO; 3],
        || {
            let scaled = scaled_by(v, largest);
            let length = dot(&scaled, &scaled).max(ONE_LESS_ROUNDING).sqrt();
            scaled.map(|x| x / length)
        },
    )
}

/// The largest component of a scaled vector is 1 to within the quotient's 2.5 ULP, so the squared length is at least this.
/// The general propagation cannot see it, since it takes the divisor's and the component's errors for independent.
const ONE_LESS_ROUNDING: Bounded = Bounded::exact(0.999_999);

/// v / s where |v| ≤ s: every quotient is at most 1, plus the quotient's own error.
fn scaled_by(v: &Vec3, largest: Bounded) -> Vec3 {
    v.map(|x| x / largest)
}

pub(super) fn length_of(v: &Vec3) -> Bounded {
    let largest = largest_component(v);
    let [length] = branch(
        largest.less(SMALLEST_NORMAL),
        || [ZERO],
        || [largest * length(&scaled_by(v, largest))],
    );
    length
}

pub(super) fn tangent_from_normal([x, y, z]: &Vec3) -> Vec3 {
    let side = Bounded::select(z.less(ZERO), -ONE, ONE);
    let a = -ONE / (side + *z);
    [ONE + side * *x * *x * a, side * (*x * *y * a), -side * *x]
}

/// P·t₂ − Q·t₁ and Q·s₁ − P·s₂, and the texture area's two products.
fn triangle(p: &Vec3, q: &Vec3, st1: &[Bounded; 2], st2: &[Bounded; 2]) -> (Vec3, Vec3, [Bounded; 2]) {
    let tangent = subtract(&scale(st2[1], p), &scale(st1[1], q));
    let bitangent = subtract(&scale(st1[0], q), &scale(st2[0], p));
    (tangent, bitangent, multiply(&[st1[0], st2[0]], &[st2[1], st1[1]]))
}

pub(super) fn frame_from_uv_triangle(
    p: &Vec3,
    q: &Vec3,
    st1: &[Bounded; 2],
    st2: &[Bounded; 2],
) -> Vec<Bounded> {
    let normal = cross(p, q);
    let area = length_of(&normal);
    let (tangent, bitangent, [first, second]) = triangle(p, q, st1, st2);
    let uv_area = first - second;
    let noise = Bounded::exact(2.384_185_8e-7) * (first.abs() + second.abs());
    let shortest = largest_component(&tangent).min(largest_component(&bitangent));
    let skipped = uv_area
        .abs()
        .less_or_equal(noise)
        .or(area.less_or_equal(ZERO))
        .or(shortest.less(SMALLEST_NORMAL));
    let share: [Bounded; 7] = branch(
        skipped,
        || [ZERO; 7],
        || {
            let side = Bounded::select(uv_area.greater(ZERO), ONE, -ONE);
            let unit = |v: &Vec3| scale(area, &normalise(&scale(side, v)));
            let ([tx, ty, tz], [bx, by, bz]) = (unit(&tangent), unit(&bitangent));
            [tx, ty, tz, bx, by, bz, area]
        },
    );
    [normal.as_slice(), share.as_slice()].concat()
}

pub(super) fn frame_from_uv_triangle_published(
    p: &Vec3,
    q: &Vec3,
    st1: &[Bounded; 2],
    st2: &[Bounded; 2],
) -> Vec<Bounded> {
    let (tangent, bitangent, [first, second]) = triangle(p, q, st1, st2);
    let inverse = ONE / (first - second);
    let normal = normalize(&cross(p, q));
    [
        normal.as_slice(),
        &scale(inverse, &tangent),
        &scale(inverse, &bitangent),
        &[ONE],
    ]
    .concat()
}

pub(super) fn gram_schmidt(normal: &Vec3, tangent: &Vec3) -> Vec3 {
    subtract(tangent, &scale(dot(normal, tangent), normal))
}

pub(super) fn handedness(normal: &Vec3, tangent: &Vec3, bitangent: &Vec3) -> Bounded {
    Bounded::select(dot(&cross(normal, tangent), bitangent).less(ZERO), -ONE, ONE)
}

pub(super) fn frame_from_uv_vertex(
    normal: &Vec3,
    tangent: &Vec3,
    bitangent: &Vec3,
    weight: Bounded,
) -> [Bounded; 4] {
    let projected = gram_schmidt(normal, tangent);
    let left = length_of(&projected);
    let cancelled = left
        .less_or_equal(Bounded::exact(1.0 / 4096.0) * weight)
        .or(left.less(SMALLEST_NORMAL));
    branch(
        cancelled,
        || with_sign(tangent_from_normal(normal), ONE),
        || {
            let unit = normalise(&projected);
            with_sign(unit, handedness(normal, &unit, bitangent))
        },
    )
}

fn with_sign([x, y, z]: Vec3, sign: Bounded) -> [Bounded; 4] {
    [x, y, z, sign]
}

pub(super) fn normal_of_slopes(gx: Bounded, gy: Bounded) -> Vec<Bounded> {
    let r = ONE / dot(&[gx, gy, ONE], &[gx, gy, ONE]).max(ONE).sqrt();
    vec![-gx * r, -gy * r, r]
}
