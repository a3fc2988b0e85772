//! Evaluates the naga IR over number domains.
#![forbid(unsafe_code)]

mod bindings;
mod compile;
mod domain;
mod error;
mod exec;
mod interval;
mod kind;
mod limits;
mod run;
mod stage;
mod texture;
mod width;

pub use bindings::{Bindings, BufferData, Scalar, range_scalar};
pub use compile::program::Program;
pub use domain::point::{F32, F64};
pub use domain::{Domain, Truth, ops};
pub use error::{Error, Result};
pub use exec::machine::Counters;
pub use interval::{Accept, Flags, Interval, Range, WideCell};
pub use kind::{IntType, Kind};
pub use limits::Limits;
pub use run::{Outcome, SpanCost, run_compute, run_fragment, run_probe, run_probe_with, run_vertex};
pub use stage::{Column, Slot, StageInputs, StageOutputs};
pub use texture::{AddressMode, CompareFunction, Dimension, Filter, LOD_SLACK, MAX_SIDE, SUBTEXEL, Sampler, TexelFormat, Texture};
pub use width::Width;
