//! Truth for every probe: the f64 reference, called with the probe's arguments.
//!
//! Nothing is computed here that `bossage-reference` does not define, but for the few functions of the library that are
//! below the techniques: those are written out from their definition (`below`). One file a topic.

mod below;
mod codecs;
mod cubes;
mod frames;
mod relief;
mod search;
mod shading;

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};

use super::Args;

type A<'a, 'b> = &'a mut Args<'b, f64>;

/// The truth of one function: arguments in, outputs in order.
pub type Truth = fn(&mut Args<'_, f64>) -> Vec<f64>;

/// The rows of one topic.
type Rows = &'static [(&'static str, Truth)];

const TABLES: [Rows; 7] = [
    below::ROWS,
    codecs::ROWS,
    cubes::ROWS,
    frames::ROWS,
    relief::ROWS,
    search::ROWS,
    shading::ROWS,
];

/// The truth of the function of that name.
#[must_use]
pub fn find(function: &str) -> Option<Truth> {
    let rows = TABLES.iter().copied().flatten();
    rows.copied()
        .find(|(name, _)| *name == function)
        .map(|(_, truth)| truth)
}

/// The functions that have one.
pub fn names() -> impl Iterator<Item = &'static str> {
    TABLES.iter().copied().flatten().map(|(name, _)| *name)
}

fn each3(a: A<'_, '_>, f: impl Fn(f64) -> f64) -> Vec<f64> {
    a.array::<3>().map(f).to_vec()
}

fn v2(a: A<'_, '_>) -> DVec2 {
    DVec2::from_array(a.array())
}

fn v3(a: A<'_, '_>) -> DVec3 {
    DVec3::from_array(a.array())
}

fn v4(a: A<'_, '_>) -> DVec4 {
    DVec4::from_array(a.array())
}

fn m3(a: A<'_, '_>) -> DMat3 {
    DMat3::from_cols_array_2d(&a.matrix())
}

fn m4(a: A<'_, '_>) -> DMat4 {
    DMat4::from_cols_array_2d(&a.matrix())
}

fn out2(v: DVec2) -> Vec<f64> {
    v.to_array().to_vec()
}

fn out3(v: DVec3) -> Vec<f64> {
    v.to_array().to_vec()
}

fn out4(v: DVec4) -> Vec<f64> {
    v.to_array().to_vec()
}

fn out9(m: DMat3) -> Vec<f64> {
    m.to_cols_array().to_vec()
}
