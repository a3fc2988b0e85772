//! The tool on a real adapter: a sample of mutants, and controls that a tool which catches nothing, or everything, would fail.
//!
//! Without an adapter these tests are skipped, each saying so with a running number; where `BOSSAGE_REQUIRE` lists `lavapipe`,
//! they fail instead.

mod command;
mod controls;
mod sample;
mod support;
