//! Tests of the scene crate through its public face: bad input, what examples call for, single decisions, and draws.

mod bad_input;
mod decisions;
mod draws;
mod examples;
mod fixture;
mod refused;
mod shading;
