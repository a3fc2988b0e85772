//! Tests of the evaluator through its public interface.

mod accept;
mod arithmetic;
mod common;
mod corpus;
mod coverage;
mod flow;
mod further;
mod generated;
mod kinds;
mod limits;
mod lint;
mod math;
mod narrow;
mod precision;
mod ranges;
mod textures;
