//! Narrowing: an invocation that goes both ways of a condition knows on each way that the condition held, or did not.
//!
//! Narrowed rows are values, not variables: where the ways meet again, such a row is the least interval around both ways' again,
//! as if it had never been narrowed, and not marked as forked. A way that has left by then, with `return` or `break`, does not count:
//! so a guard that returns early holds for everything behind it.
//!
//! What a condition has tested is what is used behind it, with two exceptions that `interval::narrow` makes room for: a subnormal number
//! may be flushed for the comparison alone, and a product may be fused, unrounded, into what is added to it (`compile::products`).

use super::machine::Machine;
use crate::compile::code::Row;
use crate::compile::facts::Fact;
use crate::domain::Domain;

impl<D: Domain> Machine<'_, D> {
    /// Tells a forked lane what the condition says on its way.
    pub(crate) fn narrow(&mut self, cond: Row, holds: bool, lane: u32) {
        let Some(facts) = self.context.program.code.facts.get(&cond) else {
            return;
        };
        for fact in if holds { &facts.accept } else { &facts.reject } {
            self.narrow_by(fact, lane);
        }
    }

    fn narrow_by(&mut self, fact: &Fact, lane: u32) {
        let Fact { op, w, a, b } = *fact;
        let (old_a, old_b) = (self.get(a, lane), self.get(b, lane));
        let products = [a, b].map(|row| self.context.program.code.products[row as usize]);
        let (new_a, new_b) = D::narrow(op, w, old_a, old_b, products);
        for (row, old, new) in [(a, old_a, new_a), (b, old_b, new_b)] {
            if old != new {
                self.set(row, lane, new);
                self.lanes.narrowed.insert(row);
            }
        }
    }

    /// Gives two lanes that join the narrowed rows of both, before what differs between them is marked as forked. Only values and
    /// arguments of functions are compared, which nothing assigns to.
    pub(crate) fn widen(&mut self, keep: u32, drop: u32) {
        let narrowed = std::mem::take(&mut self.lanes.narrowed);
        for &row in &narrowed {
            let both = D::unite(self.get(row, keep), self.get(row, drop));
            self.set(row, keep, both);
            self.set(row, drop, both);
        }
        self.work += narrowed.len() as u64;
        self.lanes.narrowed = narrowed;
    }
}
