//! What a witness must be to show one defect and not another at the same line.

use bossage_bounds::lint::Finding;

use crate::linted::{Linted, witness};

type Vector = [f64; 3];

fn vector(finding: &Finding, name: &str, at: usize) -> Vector {
    let values = witness(finding, name);
    std::array::from_fn(|k| values[at + k])
}

fn sum(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] + b[k])
}

fn cross([a, b, c]: Vector, [x, y, z]: Vector) -> Vector {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

fn length(v: Vector) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The sine of the angle between two vectors.
fn sine(a: Vector, b: Vector) -> f64 {
    length(cross(a, b)) / (length(a) * length(b))
}

/// A line with one defect of that rule.
pub(crate) fn any(_: &Linted, _: &Finding) {}

pub(crate) fn tiny(_: &Linted, finding: &Finding) {
    let v = vector(finding, "inputs", 0);
    assert!(
        length(v) > 0.0 && v.iter().any(|x| *x != 0.0 && x.abs() < 1e-22),
        "{v:?}"
    );
}

pub(crate) fn huge(_: &Linted, finding: &Finding) {
    let v = vector(finding, "inputs", 0);
    assert!(length(v) > 1e19, "{v:?}");
}

pub(crate) fn opposite(_: &Linted, finding: &Finding) {
    let (l, v) = (vector(finding, "inputs", 0), vector(finding, "inputs", 3));
    assert_eq!(sum(l, v), [0.0; 3]);
}

/// By how much a normal is off the axis of (−1, 1, 1).
fn off_the_axis(finding: &Finding) -> f64 {
    sine(vector(finding, "inputs", 0), [-1.0, 1.0, 1.0])
}

pub(crate) fn on_the_axis(_: &Linted, finding: &Finding) {
    assert!(off_the_axis(finding) < 1e-7, "{:?}", finding.witness);
}

pub(crate) fn beside_the_axis(_: &Linted, finding: &Finding) {
    let off = off_the_axis(finding);
    assert!(off > 1e-8 && off < 1e-4, "{off} {:?}", finding.witness);
}

pub(crate) fn near_minus_z(_: &Linted, finding: &Finding) {
    let n = vector(finding, "inputs", 0);
    assert!(n[2] < -0.999 && n[2] > -1.0, "{n:?}");
}

/// Texture edges that are parallel up to rounding, but not quite.
pub(crate) fn collinear(_: &Linted, finding: &Finding) {
    let values = witness(finding, "inputs");
    let [s1, t1, s2, t2] = [values[6], values[7], values[8], values[9]];
    let (area, products) = (s1 * t2 - s2 * t1, (s1 * t2).abs() + (s2 * t1).abs());
    assert!(
        area != 0.0 && area.abs() < 1e-6 * products,
        "{area} of {products}"
    );
}

pub(crate) fn parallel_edges(_: &Linted, finding: &Finding) {
    let (p, q) = (vector(finding, "inputs", 0), vector(finding, "inputs", 3));
    assert!(
        sine(p, q) < 1e-6 && length(p) > 0.0 && length(q) > 0.0,
        "{p:?} {q:?}"
    );
}

/// The sums over the two triangles of the vertex: normal, tangent.
fn sums(finding: &Finding) -> (Vector, Vector) {
    let of = |name: &str| vector(finding, name, 0);
    (
        sum(of("frames[0].xyz"), of("frames[3].xyz")),
        sum(of("frames[1].xyz"), of("frames[4].xyz")),
    )
}

/// Two tangents, neither of them zero, that are opposite in a component which the other two do not make up for.
pub(crate) fn mirrored(_: &Linted, finding: &Finding) {
    let (normal, tangent) = sums(finding);
    let (a, b) = (
        vector(finding, "frames[1].xyz", 0),
        vector(finding, "frames[4].xyz", 0),
    );
    assert!(length(normal) > 0.0, "{normal:?}");
    let cancel = (0..3).any(|k| a[k] != 0.0 && a[k] == -b[k]);
    assert!(cancel && length(tangent) < 1e-18, "{a:?} {b:?}");
}

pub(crate) fn along_the_normal(_: &Linted, finding: &Finding) {
    let (normal, tangent) = sums(finding);
    assert!(
        length(tangent) > 0.0 && sine(normal, tangent) < 1e-18,
        "{normal:?} {tangent:?}"
    );
}

pub(crate) fn nearly_along_the_normal(_: &Linted, finding: &Finding) {
    let (normal, tangent) = sums(finding);
    assert!(
        length(tangent) > 0.0 && sine(normal, tangent) < 1e-5,
        "{normal:?} {tangent:?}"
    );
}
