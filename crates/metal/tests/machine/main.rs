//! The machine for MSL: what is asked of every machine, the language beside the evaluator, and programs that misbehave.

mod agreement;
#[path = "../../../runner/tests/adapter/blending.rs"]
mod blending;
#[path = "../../../runner/tests/adapter/compute.rs"]
mod compute;
#[path = "../../../runner/tests/adapter/cubes.rs"]
mod cubes;
#[path = "../../../runner/tests/adapter/flat.rs"]
mod flat;
mod misbehaviour;
#[path = "../../../runner/tests/adapter/render.rs"]
mod render;
mod support;
#[path = "../../../runner/tests/adapter/texels.rs"]
mod texels;
