//! One walk through a program with every input within a box: which operations may go wrong.
//!
//! Values are intervals that contain every machine's result ([`Range`]), with value numbers. Where a condition is open both sides are
//! walked, each under its condition, and joined. A path is what one invocation does; what other invocations write to shared memory
//! meanwhile is not seen, and what atomics and subgroups give is unknown.
//!
//! A loop that may both end and go on for more than [`UNDECIDED_ROUNDS`] rounds, or goes on for more than [`ROUNDS`], is given up:
//! its variables become unknown. Operations on unknown values raise no alarm; [`Walk::unfinished`] tells that there were such.

use super::rule::Rule;
use super::state::State;
use super::table::{Def, Table, Vn};
use crate::compile::code::{Case, Code, Effects, Loop, Node};
use crate::compile::program::Program;
use crate::domain::ops::BoolBinary;
use crate::domain::{Domain, Truth};
use crate::interval::Range;
use crate::kind::IntType;
use crate::ranges::Inputs;
use std::collections::{BTreeMap, BTreeSet};

const UNDECIDED_ROUNDS: u32 = 256;
const ROUNDS: u32 = 4096;

/// Times that a walk keeps two cases apart.
const SPLITS: u32 = 8;

/// Instructions of one walk.
const STEPS: u64 = 1 << 21;

/// An operation that may go wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Alarm {
    /// The operand that is to blame.
    pub(super) operand: Vn,
}

/// A walk.
pub(super) struct Walk<'p> {
    pub(super) program: &'p Program,
    pub(super) code: &'p Code,
    pub(super) inputs: &'p Inputs,
    pub(super) table: Table,
    pub(super) alarms: BTreeMap<(u32, Rule), Alarm>,
    /// Loops that were given up.
    pub(super) loops: BTreeSet<u32>,
    /// How the conditions of selections are assumed to be, by the row selected to.
    assumed: &'p Assumed,
    /// Selections whose condition was open: the value, and how often it was made.
    pub(super) selections: BTreeMap<u32, (Vn, u32)>,
    /// The path just walked cannot be, under what is assumed.
    pub(super) impossible: bool,
    splits: u32,
    steps: u64,
}

/// Assumptions about selections.
pub(super) type Assumed = BTreeMap<u32, bool>;

/// Paths that have left the straight way.
#[derive(Default)]
struct Exits {
    broke: Option<State>,
    continued: Option<State>,
    returned: Option<State>,
}

impl<'p> Walk<'p> {
    /// Walks the entry point with the dimensions of the input within a box; see [`super::space`].
    pub(super) fn new(program: &'p Program, inputs: &'p Inputs, assumed: &'p Assumed) -> Self {
        Self {
            program,
            code: &program.code,
            inputs,
            table: Table::default(),
            alarms: BTreeMap::new(),
            loops: BTreeSet::new(),
            assumed,
            selections: BTreeMap::new(),
            impossible: false,
            splits: 0,
            steps: 0,
        }
    }

    /// Decides an open selection, if an assumption says how; `None` where there is none.
    pub(super) fn decide(&mut self, dst: u32, condition: Vn, state: &mut State) -> Option<bool> {
        let holds = *self.assumed.get(&dst)?;
        self.impossible |= !state.assume(&self.table, condition, holds);
        Some(holds)
    }

    /// Whether the walk saw everything there is to see.
    pub(super) fn unfinished(&self) -> bool {
        self.steps > STEPS || !self.loops.is_empty()
    }

    pub(super) fn run(&mut self, state: State) {
        self.function(self.code.entry, state);
    }

    fn function(&mut self, index: usize, state: State) -> Option<State> {
        let mut exits = Exits::default();
        let code = self.code;
        let fell = self.block(&code.functions[index].body, Some(state), &mut exits);
        self.join(fell, exits.returned)
    }

    fn join(&mut self, a: Option<State>, b: Option<State>) -> Option<State> {
        self.join_sides(a, b, None)
    }

    /// Joins the sides of a condition.
    fn join_sides(&mut self, a: Option<State>, b: Option<State>, condition: Option<Vn>) -> Option<State> {
        match (a, b) {
            (Some(a), Some(b)) => Some(a.join(&b, condition, &mut self.table, &self.code.kinds)),
            (one, None) | (None, one) => one,
        }
    }

    fn block(&mut self, nodes: &'p [Node], mut state: Option<State>, exits: &mut Exits) -> Option<State> {
        for (at, node) in nodes.iter().enumerate() {
            let now = state?;
            if self.steps > STEPS {
                return None;
            }
            if let Node::If {
                cond, accept, reject, ..
            } = node
            {
                let sides = self.sides(*cond, (accept, reject), now, exits);
                if sides.len() > 1 {
                    return self.apart(sides, &nodes[at + 1..], exits);
                }
                state = sides.into_iter().next();
            } else {
                state = self.node(node, now, exits);
            }
        }
        state
    }

    /// Walks the rest of a block for each of several paths, and joins them at its end.
    fn apart(&mut self, paths: Vec<State>, rest: &'p [Node], exits: &mut Exits) -> Option<State> {
        let mut joined = None;
        for path in paths {
            let end = self.block(rest, Some(path), exits);
            joined = self.join(joined, end);
        }
        joined
    }

    /// The paths after both sides of a condition: one, or two where the negation of a conjunction leaves two cases and the walk can
    /// afford to keep them apart.
    fn sides(
        &mut self,
        cond: u32,
        (accept, reject): (&'p [Node], &'p [Node]),
        state: State,
        exits: &mut Exits,
    ) -> Vec<State> {
        let value = state.get(cond, self.code.kinds[cond as usize]);
        let before = state.clone();
        let (yes, no) = self.split(cond, state);
        let both_open = yes.is_some() && no.is_some();
        let yes = self.block(accept, yes, exits);
        let parts = match *self.table.def(value.vn) {
            Def::Bool(BoolBinary::And, a, b) if both_open && yes.is_none() && self.splits < SPLITS => {
                Some((a, b))
            }
            _ => None,
        };
        let Some((a, b)) = parts else {
            let no = self.block(reject, no, exits);
            return self.join_sides(yes, no, Some(value.vn)).into_iter().collect();
        };
        self.splits += 1;
        let case = |assumptions: &[(Vn, bool)]| {
            let mut path = before.clone();
            path.guard(value.vn);
            let possible = assumptions
                .iter()
                .all(|(vn, holds)| path.assume(&self.table, *vn, *holds));
            possible.then_some(path)
        };
        let cases = [case(&[(a, false)]), case(&[(a, true), (b, false)])];
        cases
            .into_iter()
            .filter_map(|path| self.block(reject, path, exits))
            .collect()
    }

    fn node(&mut self, node: &'p Node, mut state: State, exits: &mut Exits) -> Option<State> {
        match node {
            Node::Run(run) => {
                self.steps += run.len() as u64;
                for instr in run {
                    self.instruction(instr, &mut state);
                    if self.impossible {
                        self.impossible = false;
                        return None;
                    }
                }
                Some(state)
            }
            // Handled by the block, which may go on with several paths.
            Node::If { .. } => Some(state),
            Node::Switch {
                selector, int, cases, ..
            } => self.switch(*selector, *int, cases, state, exits),
            Node::Loop(l) => self.repeat(l, state, exits),
            Node::Break => {
                exits.broke = self.join(exits.broke.take(), Some(state));
                None
            }
            Node::Continue => {
                exits.continued = self.join(exits.continued.take(), Some(state));
                None
            }
            Node::Return => {
                exits.returned = self.join(exits.returned.take(), Some(state));
                None
            }
            // A discarded fragment goes on as a helper, whose results nobody sees.
            Node::Kill => None,
            Node::Barrier => Some(state),
            Node::Call { function, .. } => self.function(*function, state),
        }
    }

    /// The paths on which a condition holds and does not.
    fn split(&mut self, cond: u32, state: State) -> (Option<State>, Option<State>) {
        let value = state.get(cond, self.code.kinds[cond as usize]);
        let side = |holds: bool, mut state: State| {
            let possible = state.assume(&self.table, value.vn, holds);
            possible.then_some(state)
        };
        match Range::truth(value.cell) {
            Truth::True => (side(true, state), None),
            Truth::False => (None, side(false, state)),
            Truth::Maybe => {
                let mut state = state;
                state.guard(value.vn);
                (side(true, state.clone()), side(false, state))
            }
        }
    }

    fn switch(
        &mut self,
        selector: u32,
        int: IntType,
        cases: &'p [Case],
        state: State,
        exits: &mut Exits,
    ) -> Option<State> {
        let value = state.get(selector, self.code.kinds[selector as usize]);
        let (lo, hi) = Range::int_bounds(int, value.cell);
        let inside = |v: i128| lo <= v && v <= hi;
        let mut state = state;
        if lo < hi {
            state.guard(value.vn);
        }
        let named = cases.iter().filter(|c| c.value.is_some_and(inside)).count();
        let covered = named as i128 == hi - lo + 1;
        let mut inner = Exits::default();
        let mut running: Option<State> = None;
        let mut done: Option<State> = None;
        for case in cases {
            let enters = match case.value {
                Some(v) => inside(v),
                None => !covered,
            };
            let mut entering = None;
            if enters {
                let mut here = state.clone();
                let possible = match case.value {
                    Some(v) => here.narrow(&self.table, value.vn, Range::int_range(int, v, v), 4),
                    None => true,
                };
                entering = possible.then_some(here);
            }
            running = self.join(running, entering);
            running = self.block(&case.body, running, &mut inner);
            if !case.fall_through {
                done = self.join(done, running.take());
            }
        }
        if !covered && cases.iter().all(|c| c.value.is_some()) {
            done = self.join(done, Some(state));
        }
        done = self.join(done, running);
        exits.continued = self.join(exits.continued.take(), inner.continued);
        exits.returned = self.join(exits.returned.take(), inner.returned);
        self.join(done, inner.broke)
    }

    fn repeat(&mut self, l: &'p Loop, state: State, exits: &mut Exits) -> Option<State> {
        let (mut left, mut current) = (None, Some(state));
        let (mut rounds, mut undecided) = (0, 0);
        while let Some(state) = current {
            let (leaving, staying) = self.round(l, state, exits);
            undecided += u32::from(leaving.is_some() && staying.is_some());
            rounds += 1;
            left = self.join(left, leaving);
            if undecided > UNDECIDED_ROUNDS || rounds > ROUNDS || self.steps > STEPS {
                return self.give_up(l, staying, left, exits);
            }
            current = staying;
        }
        left
    }

    /// One round: the path that leaves and the path that stays.
    fn round(&mut self, l: &'p Loop, state: State, exits: &mut Exits) -> (Option<State>, Option<State>) {
        let mut inner = Exits::default();
        let fell = self.block(&l.body, Some(state), &mut inner);
        let again = self.join(fell, inner.continued.take());
        let mut staying = self.block(&l.continuing, again, &mut inner);
        let mut leaving = inner.broke.take();
        if let Some(cond) = l.break_if
            && let Some(state) = staying.take()
        {
            let (out, stay) = self.split(cond, state);
            leaving = self.join(leaving, out);
            staying = stay;
        }
        exits.returned = self.join(exits.returned.take(), inner.returned);
        (leaving, staying)
    }

    /// Whatever the loop writes is unknown from here on.
    fn give_up(
        &mut self,
        l: &'p Loop,
        staying: Option<State>,
        left: Option<State>,
        exits: &mut Exits,
    ) -> Option<State> {
        self.loops.insert(l.span);
        let mut state = match (staying, left) {
            (Some(staying), left) => self.join(Some(staying), left)?,
            (None, left) => return left,
        };
        self.forget(&l.effects, &mut state);
        if l.effects.returns {
            exits.returned = self.join(exits.returned.take(), Some(state.clone()));
        }
        Some(state)
    }

    fn forget(&mut self, effects: &Effects, state: &mut State) {
        for &(base, len) in &effects.rows {
            for row in base..base + len {
                let kind = self.code.kinds[row as usize];
                state.rows[row as usize] = self.unknown(kind, state);
            }
        }
        for &region in &effects.regions {
            self.forget_region(region, state);
        }
    }
}
