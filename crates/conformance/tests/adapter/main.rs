//! The suite on a real adapter, and shaders broken on purpose, which it must catch.
//!
//! Without an adapter these tests are skipped, each saying so with a running number; where `BOSSAGE_REQUIRE` lists
//! `lavapipe`, they fail instead.

mod library;
mod mutants;
mod support;
