//! Evaluates the naga IR over number domains.
#![forbid(unsafe_code)]

mod domain;
mod error;
mod interval;
mod kind;
mod limits;
mod width;

pub use domain::point::{F32, F64};
pub use domain::{Domain, Truth, ops};
pub use error::{Error, Result};
pub use interval::{Accept, Flags, Interval, Range, WideCell};
pub use kind::{IntType, Kind};
pub use limits::Limits;
pub use width::Width;
