//! What the runner does on a real adapter: lavapipe where it is there, else whatever is.
//!
//! Without an adapter these tests are skipped, each saying so with a running number; where `BOSSAGE_REQUIRE` lists
//! `lavapipe`, they fail instead.
//!
//! `blending`, `compute`, `cubes`, `render` and `texels` ask no more than what every `Machine` answers: the machine without a driver runs
//! the very same tests.

mod blending;
mod caches;
mod compiled;
mod compute;
mod cubes;
mod errors;
mod flat;
mod render;
mod routes;
mod support;
mod texels;
mod timing;
