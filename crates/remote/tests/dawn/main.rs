//! The machine whose compiler is Tint: what is asked of every machine, and what happens when its process misbehaves.
//!
//! Without Dawn, or without an adapter that it takes, the tests that need them are skipped, each saying so with a running number; where
//! `BOSSAGE_REQUIRE` lists `dawn`, they fail instead. Cubes are left out: across the edges of faces SwiftShader gives what happens to be in
//! its memory, through wgpu as well (`deviation.rs` of `conformance` has it).

#[path = "../../../runner/tests/adapter/blending.rs"]
mod blending;
#[path = "../shared/compiled.rs"]
mod compiled;
#[path = "../../../runner/tests/adapter/compute.rs"]
mod compute;
#[path = "../../../runner/tests/adapter/flat.rs"]
mod flat;
mod hanging;
mod machine;
#[cfg(unix)]
mod misbehaving;
#[path = "../shared/refused.rs"]
mod refused;
#[path = "../../../runner/tests/adapter/render.rs"]
mod render;
#[path = "../shared/support.rs"]
mod support;
#[path = "../shared/tested.rs"]
mod tested;
#[path = "../../../runner/tests/adapter/texels.rs"]
mod texels;
