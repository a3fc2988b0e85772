//! Mutation of the shader library: the test of the tests.
//!
//! Each **mutant** is the library with one small fault put into one place of one file: an operator swapped, a constant off by
//! one per cent, a guard dropped ([`operator`]). Conformance runs the cases whose assembled text the fault changes, and should
//! refuse at least one output. A mutant that nothing refuses **survives**: an input, a case or an oracle is missing, or the
//! fault changes no result. Survivors of the second kind are listed with the reason ([`equivalent`]); any other survivor fails
//! the run, and so does a list that is out of date.
//!
//! What counts: mutants that still assemble and validate in every module that a case uses. Two places with the same mutated
//! text count once. Generation, order and names depend on nothing but the sources.
//!
//! Mutants run in child processes (`worker`, `pool`): a shader that never ends or takes the driver down is a fault that was
//! caught, and ends neither the run nor the tool.

mod args;
pub mod equivalent;
mod error;
pub mod fate;
pub mod folder;
pub mod generate;
pub mod ground;
mod ledger;
pub mod mutant;
pub mod operator;
mod pool;
mod report;
mod run;
mod sample;
pub mod syntax;
mod worker;

pub use error::Error;
pub use run::run;
