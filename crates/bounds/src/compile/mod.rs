//! From a validated module and the name of an entry point to a program of scalar instructions.
//!
//! `layout` takes types apart, `builder` allocates rows, `expression` and the files it names compile expressions, `statement` and
//! `exchange` compile statements, `facts` notes what conditions say, `program` finds resources and stage inputs and outputs.

pub(crate) mod access;
pub(crate) mod binary;
pub(crate) mod builder;
pub(crate) mod chains;
pub(crate) mod code;
pub(crate) mod elementwise;
pub(crate) mod exchange;
pub(crate) mod expression;
pub(crate) mod facts;
pub(crate) mod geometry;
pub(crate) mod image;
pub(crate) mod indexing;
pub(crate) mod layout;
pub(crate) mod math;
pub(crate) mod products;
pub(crate) mod program;
pub(crate) mod statement;
pub(crate) mod units;
