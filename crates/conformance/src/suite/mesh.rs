//! Bake cases.
use crate::case::Case;
/// cases
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> { std::iter::empty() }
