//! One file a command: flags in, calls of the other crates, results out.

pub(crate) mod bake;
mod bake_gpu;
mod bake_relief;
pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod conform;
pub(crate) mod conform_shader;
pub(crate) mod demo;
pub(crate) mod doctor;
pub(crate) mod emit;
pub(crate) mod hunt;
pub(crate) mod plan;
pub(crate) mod render;
pub(crate) mod study;
