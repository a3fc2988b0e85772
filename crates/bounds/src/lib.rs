//! Evaluates shaders, as naga's IR, over number domains.
//!
//! One evaluator answers four questions about the same shader, ours or a user's:
//!
//! | domain | a float is | answers |
//! |---|---|---|
//! | [`F32`] | one number, rounded to nearest after each operation | what does a perfect machine return? |
//! | [`F64`] | one `f64` | what does the formula say? |
//! | [`Accept`] | an interval by the WGSL accuracy table | what may a correct implementation return? |
//! | [`Range`] | an interval over declared input ranges | what can happen at all? |
//!
//! A fifth, what it costs, comes with each of them: [`Limits::count`] counts operations and fetches by source span.
//!
//! On top of them: [`ranges`], what inputs may be; [`lint`], what can go wrong with them; [`attribution`](fn@attribution), which lines a bound comes
//! from.
//!
//! ```
//! use bossage_bounds::{Accept, F32, Limits, Program, run_probe};
//!
//! let source = "
//!     @group(0) @binding(0) var<storage, read> inputs: array<f32>;
//!     @group(0) @binding(1) var<storage, read_write> outputs: array<f32>;
//!     @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
//!         if (id.x >= arrayLength(&outputs)) { return; }
//!         outputs[id.x] = normalize(vec2f(inputs[id.x], 1.0)).x;
//!     }";
//! let module = naga::front::wgsl::parse_str(source)?;
//! let info = naga::valid::Validator::new(Default::default(), Default::default()).validate(&module)?;
//! let program = Program::new(&module, &info, "main")?;
//!
//! let inputs = [0.5, 2.0, -7.0];
//! let (machine, _) = run_probe::<F32>(&program, &inputs, 3, 3, &Limits::default())?;
//! let (accepted, _) = run_probe::<Accept>(&program, &inputs, 3, 3, &Limits::default())?;
//! assert!(machine.iter().zip(&accepted).all(|(x, interval)| interval.contains(*x)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # How it works
//!
//! [`Program::new`] compiles an entry point once: pipeline constants are applied, vectors and structs are taken apart into
//! scalars, calls with pointer or texture arguments are specialised, and built-in functions that inherit their accuracy become
//! the formula they inherit it from. A run executes the program over batches of invocations in lockstep, on all cores, with
//! results that do not depend on the number of threads. The modules `compile` and `exec` tell the rest.
//!
//! # Undecided conditions
//!
//! In an interval domain a condition may be open. The invocation then goes both ways and comes out with the hull of both. A loop
//! that it may have left and may still be in for more than [`Limits::undecided_exits`] rounds is given up: what the loop writes
//! becomes *undecided*, is counted in [`Counters::abandoned_loops`], and is never guessed. A shader that never ends is stopped by
//! [`Limits::operations`], with an error that names the budget.
//!
//! # What is sound, and under which assumptions
//!
//! `Accept` contains every result that the accuracy table of WGSL allows, fused multiply-adds and all orders of additions and of
//! multiplications included (those inside `dot` and matrix products, and those of sums and products as written, which WGSL lets a
//! compiler reassociate), with subnormal numbers flushed or not. Assumptions:
//!
//! - Sums and products are reassociated within one function and one straight line of code, up to sixteen terms and four factors.
//!   Quotients stay as written, and nothing is multiplied out or factored.
//! - An error in units of the last place does not change the sign of a result.
//! - An exactly zero quotient or root is zero; `atan2(0, x)` for `x > 0` is as accurate as beside it.
//! - `determinant` and derivatives, for which WGSL states no accuracy, have the accuracy of their formulas.
//! - `f64`, which WGSL does not have, has the `f32` entries of the table in its own units.
//! - Textures: 8 sub-texel bits ([`SUBTEXEL`]), 4 bits of the level of detail ([`LOD_SLACK`]), no anisotropy. A filter of 8 or 16-bit
//!   normalised texels may work in their precision: a step of 1/255 along each axis, or two of 1/65535.
//! - Subgroups have 4 to 128 invocations and any members: in an interval domain votes, least and greatest values, broadcasts and
//!   shuffles hold for all of them, and sums, scans and ballots are undecided.
//! - A store to a texture may round to either neighbour in its format, as Vulkan has it; a perfect machine takes the nearest.
//! - A write out of bounds is dropped; it is counted in [`Counters::out_of_bounds`].
//! - Invocations of one workgroup run in lockstep and atomics in the order of invocations: races are resolved one lawful way.
//!
//! # What is left out
//!
//! These are [`Error::Unsupported`], with the place: ray queries and ray tracing pipelines, mesh and task stages, cooperative
//! matrices, binding arrays of buffers, and programs whose inlined size exceeds four million scalar instructions. External textures are treated as plain ones.
#![forbid(unsafe_code)]

mod attribution;
mod bindings;
mod compile;
mod domain;
mod error;
mod exec;
mod interval;
mod kind;
mod limits;
pub mod lint;
pub mod ranges;
mod readback;
mod run;
mod stage;
mod texture;
mod width;

pub use attribution::{Attribution, Contribution, attribution};
pub use bindings::{Bindings, BufferData, IMMEDIATE, Scalar, range_scalar};
pub use compile::program::Program;
pub use domain::point::{F32, F64};
pub use domain::{Domain, Truth, ops};
pub use error::{Error, Result};
pub use exec::machine::Counters;
pub use interval::{Accept, Flags, Interval, Range, WideCell};
pub use kind::{IntType, Kind};
pub use limits::{Limits, Nudge};
pub use readback::BufferUse;
pub use run::{
    Outcome, SpanCost, run_compute, run_entry, run_fragment, run_probe, run_probe_with, run_vertex,
};
pub use stage::{Column, Slot, StageInputs, StageOutputs};
pub use texture::{
    AddressMode, CompareFunction, Dimension, Filter, LOD_SLACK, MAX_SIDE, SUBTEXEL, Sampler, TexelFormat,
    Texture,
};
pub use width::Width;
