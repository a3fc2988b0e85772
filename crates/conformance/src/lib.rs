//! Numeric conformance.

pub mod bounded;
pub mod case_id;
pub mod ulp;
pub mod verdict;
