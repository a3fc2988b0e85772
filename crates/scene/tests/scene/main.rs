//! Tests of the scene crate through its public face: bad input, what examples call for, single decisions, and draws.

mod bad_input;
mod budgets;
mod decisions;
mod draws;
mod examples;
mod fixture;
mod planner;
mod random_scene;
mod refused;
mod shading;
