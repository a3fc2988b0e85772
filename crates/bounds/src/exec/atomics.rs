//! Atomic operations, executed lane by lane: one lawful order.
//!
//! In an interval domain a lane that may not have come here adds its effect as a possibility, in memory that all see.

use super::machine::Machine;
use super::places::Target;
use crate::compile::code::{Atomic, AtomicOp, AtomicTarget, Place, Root};
use crate::domain::ops::{Compare, FloatBinary};
use crate::domain::{Domain, Truth};
use crate::kind::Kind;
use crate::width::Width;

impl<'a, D: Domain> Machine<'a, D> {
    pub(crate) fn atomic(&mut self, atomic: &Atomic, active: &[u32]) {
        for &lane in active {
            match &atomic.target {
                AtomicTarget::Place(place) => self.atomic_at_place(atomic, place, lane),
                AtomicTarget::Texel {
                    image,
                    coordinate,
                    layer,
                } => {
                    let region = image.resource;
                    if let Some(at) = self.texel_cell(image, coordinate, *layer, lane) {
                        self.atomic_at(atomic, Root::Memory(region), at, lane);
                    }
                }
            }
        }
    }

    fn atomic_at_place(&mut self, atomic: &Atomic, place: &Place, lane: u32) {
        match self.target(place, lane) {
            Target::One(at) => self.atomic_at(atomic, place.root, at, lane),
            Target::Outside(_) => {
                self.counters.out_of_bounds += 1;
                self.unknown_result(atomic, lane, D::indeterminate(atomic.kind));
            }
            Target::Several { offsets, .. } => {
                let mut all: Option<D::Cell> = None;
                for at in offsets {
                    let old = self.peek(place.root, at, lane, atomic.kind);
                    let new = self.combined(atomic, old, lane);
                    all = Some(all.map_or(old, |a| D::hull(atomic.kind, a, old)));
                    self.update(place.root, at, lane, atomic.kind, new, true);
                }
                self.unknown_result(atomic, lane, all.unwrap_or_else(|| D::undecided(atomic.kind)));
            }
            Target::Unknown => self.unknown_result(atomic, lane, D::undecided(atomic.kind)),
        }
    }

    fn unknown_result(&mut self, atomic: &Atomic, lane: u32, old: D::Cell) {
        if let Some(row) = atomic.result {
            self.set(row, lane, old);
        }
        if let Some(row) = atomic.exchanged {
            self.set(row, lane, D::undecided(Kind::Bool));
        }
    }

    fn atomic_at(&mut self, atomic: &Atomic, root: Root, at: u32, lane: u32) {
        let old = self.peek(root, at, lane, atomic.kind);
        let new = self.combined(atomic, old, lane);
        if let Some(row) = atomic.result {
            self.set(row, lane, old);
        }
        if let (Some(row), Some(compare)) = (atomic.exchanged, atomic.compare) {
            let equal = equals::<D>(atomic.kind, old, self.get(compare, lane));
            self.set(row, lane, equal);
        }
        self.update(root, at, lane, atomic.kind, new, false);
    }

    /// Writes memory at once, as other invocations may see it.
    fn update(&mut self, root: Root, at: u32, lane: u32, kind: Kind, cell: D::Cell, weak: bool) {
        let Root::Memory(region) = root else { return };
        let weak = weak || self.lanes.is_forked(lane);
        match self.lanes.killed[lane as usize] {
            Truth::True => {}
            Truth::False if !weak => self.view.write(region, at, cell),
            Truth::False | Truth::Maybe => {
                let both = D::hull(kind, self.view.read(region, at), cell);
                self.view.write(region, at, both);
            }
        }
    }

    fn combined(&self, atomic: &Atomic, old: D::Cell, lane: u32) -> D::Cell {
        let value = self.get(atomic.value, lane);
        let w = if let Kind::Float(w) = atomic.kind {
            w
        } else {
            Width::F32
        };
        match (atomic.op, atomic.kind) {
            (AtomicOp::Integer(op), Kind::Int(t)) => D::int_binary(op, t, old, value),
            (AtomicOp::Integer(_), Kind::Float(_) | Kind::Bool) => old,
            (AtomicOp::FloatAdd, _) => D::binary(FloatBinary::Add, w, old, value),
            (AtomicOp::FloatSubtract, _) => D::binary(FloatBinary::Subtract, w, old, value),
            (AtomicOp::FloatMin, _) => D::binary(FloatBinary::Min, w, old, value),
            (AtomicOp::FloatMax, _) => D::binary(FloatBinary::Max, w, old, value),
            (AtomicOp::Exchange, _) => value,
            (AtomicOp::CompareExchange, kind) => match atomic.compare {
                Some(compare) => D::select(kind, equals::<D>(kind, old, self.get(compare, lane)), value, old),
                None => value,
            },
        }
    }
}

fn equals<D: Domain>(kind: Kind, a: D::Cell, b: D::Cell) -> D::Cell {
    match kind {
        Kind::Int(t) => D::int_compare(Compare::Equal, t, a, b),
        Kind::Float(w) => D::compare(Compare::Equal, w, a, b),
        Kind::Bool => D::bool_binary(crate::domain::ops::BoolBinary::Equal, a, b),
    }
}
