//! Relief cases: where view rays meet a height field, technique by technique, on maps that are hard each in a way of its own;
//! views from 0° to 120°, along the axes and across.
//!
//! - `marching`: every technique but `exact`, against the same search in f64, within the intervals of the kernel's own IR.
//! - `cones`: cones over many steps, by what a safe map promises.
//! - `exact`: against the true first hit.
//! - `light`: shadows from the places that views meet, against the same march in f64.
//!
//! What is not finite is judged by what is promised, bit by bit: the rules of the language leave open what becomes of a NaN.

mod beside;
mod cones;
mod exact;
mod hits;
mod light;
mod maps;
mod marching;
mod setting;
#[cfg(test)]
mod tests;
mod truth;
mod views;

pub(crate) use self::exact::off_surface;
use crate::case::Case;

/// Every technique and way to read heights, on every map.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    marching::cases()
        .chain(cones::cases())
        .chain(exact::cases())
        .chain(light::cases())
}
