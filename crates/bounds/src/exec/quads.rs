//! Values of neighbouring lanes: derivatives on 2×2 quads, and subgroups.
//!
//! Lanes `4q .. 4q + 4` are the quad with pixels (0,0), (1,0), (0,1), (1,1). WGSL gives derivatives no accuracy at all; here they
//! are differences within the quad, and where an implementation may choose the row or column, an interval domain contains every
//! choice. A subgroup is up to 32 consecutive invocations; its operations are evaluated in point domains only, since the size of
//! a subgroup is the machine's.

use super::machine::Machine;
use crate::compile::code::{Combine, Row, Subgroup, SubgroupOp};
use crate::domain::Domain;
use crate::domain::ops::{FloatBinary, FloatUnary};
use crate::kind::{IntType, Kind};
use crate::width::Width;
use naga::{DerivativeAxis as Axis, DerivativeControl as Control};

/// Invocations of a subgroup.
pub(crate) const SUBGROUP: usize = 32;

impl<'a, D: Domain> Machine<'a, D> {
    pub(crate) fn derivative(
        &mut self,
        axis: Axis,
        control: Control,
        w: Width,
        (dst, a): (Row, Row),
        active: &[u32],
    ) {
        let quads = self.by_invocation(a, Kind::Float(w), active);
        for &lane in active {
            let root = self.lanes.root[lane as usize] as usize;
            let own = self.get(a, lane);
            let cell = quad_derivative::<D>(axis, control, w, &quads, root, own);
            self.set(dst, lane, cell);
        }
    }

    /// For every invocation, the hull of a row over its active lanes; nothing where neighbours are no neighbours.
    pub(crate) fn by_invocation(&self, row: Row, kind: Kind, active: &[u32]) -> Vec<Option<D::Cell>> {
        let mut out: Vec<Option<D::Cell>> = vec![None; self.lanes.count()];
        if self.lone {
            return out;
        }
        for &lane in active {
            let entry = &mut out[self.lanes.root[lane as usize] as usize];
            let cell = self.get(row, lane);
            *entry = Some(entry.map_or(cell, |e| D::hull(kind, e, cell)));
        }
        out
    }

    pub(crate) fn subgroup(&mut self, op: &Subgroup, active: &[u32]) {
        if D::UNCERTAIN {
            return self.any_subgroup(op, active);
        }
        let mut at = 0;
        while at < active.len() {
            let group = active[at] as usize / SUBGROUP;
            let end = active[at..]
                .iter()
                .position(|&l| l as usize / SUBGROUP != group)
                .map_or(active.len(), |n| at + n);
            self.one_subgroup(op, &active[at..end]);
            at = end;
        }
    }

    /// Subgroups of any size and membership that a machine may choose: a result holds for all of them.
    ///
    /// Votes are decided where all invocations agree, least and greatest values, broadcasts and shuffles lie in the hull of
    /// all invocations' values (or, with an identity or an absent source, are open); sums, products, scans and ballots depend on
    /// who takes part and are undecided.
    fn any_subgroup(&mut self, op: &Subgroup, active: &[u32]) {
        use crate::domain::ops::{FloatBinary, IntBinary};
        let values = |machine: &Self| {
            let row = op.argument?;
            let cells = active.iter().map(|&lane| machine.get(row, lane));
            cells.reduce(|a, b| D::hull(op.kind, a, b))
        };
        let open = D::undecided(op.kind);
        let result = match op.op {
            SubgroupOp::Ballot => return self.any_ballot(op.dst, active),
            SubgroupOp::All
            | SubgroupOp::Any
            | SubgroupOp::BroadcastFirst
            | SubgroupOp::Reduce(
                Combine::Float(FloatBinary::Min | FloatBinary::Max)
                | Combine::Int(IntBinary::Min | IntBinary::Max),
            ) => values(self).unwrap_or(open),
            SubgroupOp::Reduce(_) | SubgroupOp::Inclusive(_) | SubgroupOp::Exclusive(_) => open,
            // The source may be an invocation that is not there.
            SubgroupOp::Broadcast(..)
            | SubgroupOp::Shuffle(..)
            | SubgroupOp::ShuffleDown(..)
            | SubgroupOp::ShuffleUp(..)
            | SubgroupOp::ShuffleXor(..)
            | SubgroupOp::QuadBroadcast(..)
            | SubgroupOp::QuadSwap(_) => {
                let absent = D::indeterminate(op.kind);
                values(self).map_or(absent, |v| D::hull(op.kind, v, absent))
            }
        };
        for &lane in active {
            self.set(op.dst, lane, result);
        }
    }

    /// Bits of any invocations, in the words that the largest subgroup of 128 fills.
    fn any_ballot(&mut self, dst: Row, active: &[u32]) {
        for &lane in active {
            (0..4).for_each(|k| self.set(dst + k, lane, D::undecided(Kind::Int(IntType::U32))));
        }
    }

    fn one_subgroup(&mut self, op: &Subgroup, members: &[u32]) {
        let argument = |machine: &Self, lane: u32| {
            op.argument
                .map_or_else(D::Cell::default, |row| machine.get(row, lane))
        };
        let values: Vec<D::Cell> = members.iter().map(|&lane| argument(self, lane)).collect();
        if let SubgroupOp::Ballot = op.op {
            return self.ballot(op.dst, members, &values);
        }
        let results: Vec<D::Cell> = (0..members.len())
            .map(|k| self.member_result(op, members, &values, k))
            .collect();
        for (&lane, cell) in members.iter().zip(results) {
            self.set(op.dst, lane, cell);
        }
    }

    fn ballot(&mut self, dst: Row, members: &[u32], values: &[D::Cell]) {
        let set = members
            .iter()
            .zip(values)
            .filter(|(_, v)| D::truth(**v) == crate::Truth::True);
        let mask = set.fold(0i128, |m, (&lane, _)| m | 1 << (lane as usize % SUBGROUP));
        for &lane in members {
            self.set(dst, lane, D::int(IntType::U32, mask));
            (1..4).for_each(|k| self.set(dst + k, lane, D::int(IntType::U32, 0)));
        }
    }

    fn member_result(&self, op: &Subgroup, members: &[u32], values: &[D::Cell], k: usize) -> D::Cell {
        let own = members[k] as usize;
        let from = |id: i128| {
            let lane = (own / SUBGROUP * SUBGROUP) as i128 + id;
            let found = members.iter().position(|&l| i128::from(l) == lane);
            found.map_or_else(|| D::indeterminate(op.kind), |p| values[p])
        };
        let index = |(row, t): (Row, IntType)| D::int_bounds(t, self.get(row, members[k])).0;
        let id = (own % SUBGROUP) as i128;
        let all = |want: crate::Truth| values.iter().all(|v| D::truth(*v) == want);
        match op.op {
            SubgroupOp::Ballot => values[k],
            SubgroupOp::All => D::bool(all(crate::Truth::True)),
            SubgroupOp::Any => D::bool(!all(crate::Truth::False)),
            SubgroupOp::Reduce(c) => combine::<D>(c, op.kind, values),
            SubgroupOp::Inclusive(c) => combine::<D>(c, op.kind, &values[..=k]),
            SubgroupOp::Exclusive(c) => combine::<D>(c, op.kind, &values[..k]),
            SubgroupOp::BroadcastFirst => values[0],
            SubgroupOp::Broadcast(row, t) | SubgroupOp::Shuffle(row, t) => from(index((row, t))),
            SubgroupOp::ShuffleDown(row, t) => from(id + index((row, t))),
            SubgroupOp::ShuffleUp(row, t) => from(id - index((row, t))),
            SubgroupOp::ShuffleXor(row, t) => from(id ^ index((row, t))),
            SubgroupOp::QuadBroadcast(row, t) => from((id & !3) + index((row, t))),
            SubgroupOp::QuadSwap(mask) => from(id ^ i128::from(mask)),
        }
    }
}

fn combine<D: Domain>(c: Combine, kind: Kind, values: &[D::Cell]) -> D::Cell {
    let identity = || match (c, kind) {
        (Combine::Float(FloatBinary::Multiply), Kind::Float(w)) => D::float(w, 1.0),
        (Combine::Int(crate::domain::ops::IntBinary::Multiply), Kind::Int(t)) => D::int(t, 1),
        _ => super::places::zero::<D>(kind),
    };
    let step = |a, b| match (c, kind) {
        (Combine::Float(op), Kind::Float(w)) => D::binary(op, w, a, b),
        (Combine::Int(op), Kind::Int(t)) => D::int_binary(op, t, a, b),
        (Combine::Float(_) | Combine::Int(_), _) => a,
    };
    values.iter().copied().reduce(step).unwrap_or_else(identity)
}

/// A derivative at one pixel of a quad.
pub(crate) fn quad_derivative<D: Domain>(
    axis: Axis,
    control: Control,
    w: Width,
    values: &[Option<D::Cell>],
    root: usize,
    own: D::Cell,
) -> D::Cell {
    match axis {
        Axis::X => difference::<D>(control, w, values, root, own, 1),
        Axis::Y => difference::<D>(control, w, values, root, own, 2),
        Axis::Width => {
            let (x, y) = (
                difference::<D>(control, w, values, root, own, 1),
                difference::<D>(control, w, values, root, own, 2),
            );
            let abs = |c| D::unary(FloatUnary::Abs, w, c);
            D::binary(FloatBinary::Add, w, abs(x), abs(y))
        }
    }
}

/// The difference along one axis (`bit` 1 for x, 2 for y): in the pixel's own row or column for fine derivatives, in the first
/// one for coarse ones, in either where that is left open.
fn difference<D: Domain>(
    control: Control,
    w: Width,
    values: &[Option<D::Cell>],
    root: usize,
    own: D::Cell,
    bit: usize,
) -> D::Cell {
    let own_line = line::<D>(w, values, root, own, root & !bit, root | bit);
    let (first_low, first_high) = (root & !3, (root & !3) | bit);
    match control {
        Control::Fine => own_line,
        Control::None if !D::UNCERTAIN => own_line,
        Control::Coarse if !D::UNCERTAIN => line::<D>(w, values, root, own, first_low, first_high),
        Control::Coarse | Control::None => {
            let other = root ^ 3 ^ bit;
            let other_line = line::<D>(w, values, root, own, other & !bit, other | bit);
            D::hull(Kind::Float(w), own_line, other_line)
        }
    }
}

fn line<D: Domain>(
    w: Width,
    values: &[Option<D::Cell>],
    root: usize,
    own: D::Cell,
    low: usize,
    high: usize,
) -> D::Cell {
    let at = |k: usize| {
        if k == root {
            Some(own)
        } else {
            values.get(k).copied().flatten()
        }
    };
    match (at(low), at(high)) {
        (Some(a), Some(b)) => D::binary(FloatBinary::Subtract, w, b, a),
        // A neighbour that is not here has no value: indeterminate, and zero for a perfect machine.
        (None, _) | (_, None) if D::UNCERTAIN => D::indeterminate(Kind::Float(w)),
        (None, _) | (_, None) => D::float(w, 0.0),
    }
}
