//! The machine without a driver: what is asked of every machine, known answers of the rasteriser, and a driver's pictures beside
//! its own.

#[path = "../../../runner/tests/adapter/blending.rs"]
mod blending;
#[path = "../../../runner/tests/adapter/compiled.rs"]
mod compiled;
#[path = "../../../runner/tests/adapter/compute.rs"]
mod compute;
#[path = "../../../runner/tests/adapter/cubes.rs"]
mod cubes;
#[path = "../../../runner/tests/adapter/flat.rs"]
mod flat;
#[path = "../../../runner/tests/adapter/render.rs"]
mod render;
mod support;
#[path = "../../../runner/tests/adapter/texels.rs"]
mod texels;
