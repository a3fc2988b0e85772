//! Watching a run: which operations went wrong, and with which operands.
//!
//! In a point domain these are the rules of [`crate::lint`] at the very numbers, and where a NaN first arises. In [`crate::Accept`] it is
//! where a sum or difference loses its digits: operands known well, a result known badly.

use super::machine::Machine;
use super::nudge::{Combination, Combines, largest};
use crate::compile::code::{Instr, Op, Row};
use crate::domain::ops::{FloatBinary, FloatUnary};
use crate::domain::{Domain, Truth};
use crate::lint::rule::{self, Rule};
use crate::texture::Bounds;
use std::collections::BTreeMap;

/// Something that went wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Event {
    /// The bits of up to two operands.
    operands: [u64; 2],
    /// How bad it is, as bits of a number that is not negative: of a cancellation, by how much the relative error grew.
    weight: u64,
}

impl Event {
    fn new(operands: [f64; 2], weight: f64) -> Self {
        Self {
            operands: operands.map(f64::to_bits),
            weight: weight.to_bits(),
        }
    }

    /// The operands.
    pub(crate) fn operands(&self) -> [f64; 2] {
        self.operands.map(f64::from_bits)
    }

    /// How bad it is.
    pub(crate) fn weight(&self) -> f64 {
        f64::from_bits(self.weight)
    }
}

/// Events by span number and rule; of several the worst, then the first.
pub(crate) type Events = BTreeMap<(u32, Rule), Event>;

/// What may be the cause of something that goes wrong later on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Suspicion {
    /// Terms that cancelled to nothing.
    Cancelled,
    /// A product too small for the format.
    Underflowed,
    /// A number near the opposite of a constant, of which only the last digits are left.
    NearConstant,
}

/// Suspects by span number; of several at one place the worst, then the first.
pub(crate) type Suspects = BTreeMap<(u32, Suspicion), Event>;

/// Adds events of another batch.
pub(crate) fn absorb<K: Copy + Ord>(to: &mut BTreeMap<K, Event>, from: &BTreeMap<K, Event>) {
    for (&site, &event) in from {
        let entry = to.entry(site).or_insert(event);
        // Bits of numbers that are not negative are in the order of the numbers.
        if event.weight > entry.weight {
            *entry = event;
        }
    }
}

/// Relative error of what an interval bounds; `None` where it bounds nothing.
fn relative((lo, hi): Bounds) -> Option<f64> {
    let most = lo.abs().max(hi.abs());
    match (most.is_finite(), most > 0.0) {
        (true, true) => Some((hi - lo) / most),
        (true, false) => Some(0.0),
        (false, _) => None,
    }
}

/// Operands must be known better than this, relatively, for a loss to be this operation's.
const KNOWN_WELL: f64 = 1.0 / 1024.0;

/// A result known worse than this has lost most of its digits.
const KNOWN_BADLY: f64 = 1.0 / 256.0;

/// And the loss must be at least this large.
const LOSS: f64 = 1024.0;

impl<D: Domain> Machine<'_, D> {
    /// Looks at what an instruction has just done.
    #[inline(never)]
    pub(crate) fn observe(&mut self, instr: &Instr, active: &[u32]) {
        if D::UNCERTAIN {
            self.steps(instr, active);
        } else {
            self.margins(instr, active);
            self.suspects(instr, active);
        }
        match &instr.op {
            Op::FloatUnary { op, w, dst, a } => self.each(instr.span, *dst, &[*a], active, false, |x, r| {
                rule::unary(*op, *w, x[0], r)
            }),
            Op::FloatBinary { op, w, dst, a, b } => {
                let divides = *op == FloatBinary::Divide;
                self.each(instr.span, *dst, &[*a, *b], active, divides, |x, r| {
                    rule::binary(*op, *w, x[0], x[1], r)
                });
                if matches!(op, FloatBinary::Add | FloatBinary::Subtract) {
                    self.cancels(instr.span, *dst, &[*a, *b], active);
                }
            }
            Op::Chain(chain) => {
                let (rows, w) = ([chain.a, chain.b], chain.w);
                self.each(instr.span, chain.dst, &rows, active, false, |x, r| {
                    rule::binary(chain.op, w, x[0], x[1], r)
                });
                if matches!(chain.op, FloatBinary::Add | FloatBinary::Subtract) {
                    self.cancels(instr.span, chain.dst, &rows, active);
                }
            }
            Op::FloatTernary { op, w, dst, a, b, c } => {
                self.each(instr.span, *dst, &[*a, *b, *c], active, false, |x, r| {
                    rule::ternary(*op, *w, [x[0], x[1], x[2]], r)
                });
            }
            Op::Sum { w, dst, terms, n } => {
                let terms = &terms[..usize::from(*n)];
                self.each(instr.span, *dst, terms, active, false, |x, r| {
                    rule::sum(*w, x.iter().copied(), r)
                });
                self.cancels(instr.span, *dst, terms, active);
            }
            _ => {}
        }
    }

    fn each(
        &mut self,
        span: u32,
        dst: Row,
        operands: &[Row],
        active: &[u32],
        divides: bool,
        check: impl Fn(&[Bounds], Bounds) -> Option<Rule>,
    ) {
        if D::UNCERTAIN {
            return;
        }
        let normalises = self.context.program.code.normalises.contains(&span);
        for &lane in active {
            let mut x = [(0.0, 0.0); 4];
            for (to, &row) in x.iter_mut().zip(operands) {
                *to = D::float_bounds(self.get(row, lane));
            }
            let x = &x[..operands.len()];
            let result = D::float_bounds(self.get(dst, lane));
            if let Some(found) = check(x, result) {
                self.note(span, crate::lint::rule_at(found, normalises, divides), x, 0.0);
            }
            if result.0.is_nan() && x.iter().all(|x| !x.0.is_nan()) {
                self.note(span, Rule::NanOutput, x, 0.0);
            }
        }
    }

    /// Notes how far an operand is from where its operation goes wrong, which is at zero.
    fn margins(&mut self, instr: &Instr, active: &[u32]) {
        let operand = match &instr.op {
            Op::FloatUnary {
                op: FloatUnary::Sqrt | FloatUnary::InverseSqrt | FloatUnary::Log | FloatUnary::Log2,
                a,
                ..
            }
            | Op::FloatBinary {
                op: FloatBinary::Pow,
                a,
                ..
            } => *a,
            Op::FloatBinary {
                op: FloatBinary::Divide | FloatBinary::Remainder,
                b,
                ..
            } => *b,
            _ => return,
        };
        if let Some(&lane) = active.first() {
            let x = D::float_bounds(self.get(operand, lane)).0;
            self.counters.margins.insert(instr.span, x.to_bits());
        }
    }

    /// Notes sums and products that something worse may come from.
    fn suspects(&mut self, instr: &Instr, active: &[u32]) {
        let Some(combination) = Combination::of(&instr.op) else {
            return;
        };
        let of_constant = combination.terms().iter().any(|row| self.constant[*row as usize]);
        for &lane in active {
            let (numbers, n) = self.numbers(combination.terms(), lane);
            let terms = &numbers[..n];
            let result = D::float_bounds(self.get(combination.dst, lane)).0;
            let suspicion = if combination.vanishes(terms, result) {
                match combination.combines {
                    Combines::Sum => Suspicion::Cancelled,
                    Combines::Product => Suspicion::Underflowed,
                }
            } else if of_constant && combination.leaves_little(terms, result) {
                Suspicion::NearConstant
            } else {
                continue;
            };
            let weight = if suspicion == Suspicion::NearConstant {
                largest(terms) / result.abs()
            } else {
                0.0
            };
            let event = Event::new([numbers[0], numbers[1]], weight);
            absorb(
                &mut self.counters.suspects,
                &BTreeMap::from([((instr.span, suspicion), event)]),
            );
        }
    }

    /// Counts results that jump: a comparison either way, two whole numbers.
    fn steps(&mut self, instr: &Instr, active: &[u32]) {
        let open = |machine: &Self, lane: u32| match &instr.op {
            Op::FloatCompare { dst, .. } => D::truth(machine.get(*dst, lane)) == Truth::Maybe,
            Op::FloatUnary {
                op:
                    FloatUnary::Sign
                    | FloatUnary::Floor
                    | FloatUnary::Ceil
                    | FloatUnary::Round
                    | FloatUnary::Trunc
                    | FloatUnary::Fract,
                dst,
                ..
            }
            | Op::FloatBinary {
                op: FloatBinary::Step,
                dst,
                ..
            } => {
                let (lo, hi) = D::float_bounds(machine.get(*dst, lane));
                hi - lo >= 0.5
            }
            _ => false,
        };
        let count = active.iter().filter(|lane| open(self, **lane)).count();
        self.counters.undecided += count as u64;
    }

    fn cancels(&mut self, span: u32, dst: Row, operands: &[Row], active: &[u32]) {
        if !D::UNCERTAIN {
            return;
        }
        for &lane in active {
            let errors = operands
                .iter()
                .map(|&row| relative(D::float_bounds(self.get(row, lane))));
            let Some(worst) = errors
                .collect::<Option<Vec<f64>>>()
                .map(|e| e.into_iter().fold(0.0, f64::max))
            else {
                continue;
            };
            let result = D::float_bounds(self.get(dst, lane));
            let Some(error) = relative(result) else {
                continue;
            };
            if worst > 0.0 && worst < KNOWN_WELL && error > KNOWN_BADLY && error > LOSS * worst {
                let ends = [(result.0, result.0), (result.1, result.1)];
                self.note(span, Rule::Cancellation, &ends, error / worst);
            }
        }
    }

    fn note(&mut self, span: u32, rule: Rule, operands: &[Bounds], weight: f64) {
        let operand = |k: usize| operands.get(k).map_or(0.0, |x| x.0);
        let event = Event::new([operand(0), operand(1)], weight);
        absorb(
            &mut self.counters.events,
            &BTreeMap::from([((span, rule), event)]),
        );
    }
}
