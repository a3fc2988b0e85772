//! The evaluator: batches of lanes in lockstep over one compiled program.
//!
//! A *lane* is one invocation, or one of the ways an invocation may have gone. Values live in a register file of rows by lanes;
//! every instruction runs over the active lanes of its control-flow region, so the cost of decoding it is shared by the batch.
//! Lockstep makes barriers free and gives derivatives their neighbours.
//!
//! In the interval domains a condition may be undecided. The lane then *forks*: one copy takes each side, and where the control
//! flow joins again the copies merge into the hull of their variables. Writes of a forked lane to shared memory are kept in an
//! overlay of its own and merged with it. A loop that an invocation may both leave and stay in for more than
//! [`Limits::undecided_exits`](crate::Limits::undecided_exits) rounds is given up: what it writes becomes *undecided*.
//!
//! `machine` holds the state, `lanes` forks and merges, `narrow` tells either way what its condition says, `flow` runs control flow, `ops` runs instructions, `memory` is shared
//! memory, `places` resolves pointers, `packing`, `atomics`, `quads`, `images` hold the instructions of those names. `watch`, `nudge` and `exact` are there for the
//! lint and for attribution.

pub(crate) mod atomics;
pub(crate) mod exact;
pub(crate) mod flow;
pub(crate) mod images;
pub(crate) mod lanes;
pub(crate) mod machine;
pub(crate) mod memory;
pub(crate) mod narrow;
pub(crate) mod nudge;
pub(crate) mod ops;
pub(crate) mod packing;
pub(crate) mod places;
pub(crate) mod quads;
pub(crate) mod watch;
