//! Tests of the evaluator through its public interface.

mod accept;
mod arithmetic;
mod attribution;
mod common;
mod corpus;
mod coverage;
mod flow;
mod further;
mod gallery;
mod generated;
mod intervals;
mod kinds;
mod limits;
mod lint;
mod math;
mod mutated;
mod narrow;
mod precision;
mod ranges;
mod rules;
mod textures;
