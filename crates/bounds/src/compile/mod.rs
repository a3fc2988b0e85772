//! From a validated module and the name of an entry point to a program of scalar instructions.
//!
//! `layout` takes types apart, `builder` allocates rows, `expression`/`binary`/`math`/`geometry`/`access`/`image` compile
//! expressions, `statement` compiles control flow, `program` finds resources and stage inputs and outputs.

pub(crate) mod access;
pub(crate) mod binary;
pub(crate) mod builder;
pub(crate) mod code;
pub(crate) mod expression;
pub(crate) mod geometry;
pub(crate) mod image;
pub(crate) mod layout;
pub(crate) mod math;
pub(crate) mod program;
pub(crate) mod statement;
