//! OpenGL without a display: what is asked of every machine, and what it refuses.
//!
//! Where there is no OpenGL 4.5 the tests are skipped, each saying so with a running number; where `BOSSAGE_REQUIRE` lists `opengl`, they
//! fail instead.

#[path = "../../../runner/tests/adapter/blending.rs"]
mod blending;
#[path = "../shared/compiled.rs"]
mod compiled;
#[path = "../../../runner/tests/adapter/compute.rs"]
mod compute;
#[path = "../../../runner/tests/adapter/cubes.rs"]
mod cubes;
#[path = "../../../runner/tests/adapter/flat.rs"]
mod flat;
mod machine;
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
#[cfg(unix)]
mod without_egl;
