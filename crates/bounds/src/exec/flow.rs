//! Structured control flow over lists of active lanes.

use super::machine::Machine;
use crate::compile::code::{Case, Loop, Node, Row};
use crate::domain::{Domain, Truth};
use crate::error::{Error, Result};
use crate::kind::IntType;
use std::collections::BTreeMap;

/// Lanes that have left the straight path of the current function or loop.
#[derive(Default)]
pub(crate) struct Exits {
    broke: Vec<u32>,
    continued: Vec<u32>,
    returned: Vec<u32>,
}

impl<'a, D: Domain> Machine<'a, D> {
    /// Calls a function; on return the lanes are those that came back.
    pub(crate) fn call(&mut self, function: usize, active: &mut Vec<u32>, span: u32) -> Result<()> {
        self.deeper(span)?;
        self.frames.push(function);
        let mut exits = Exits::default();
        let code = self.context.program;
        self.block(&code.code.functions[function].body, active, &mut exits)?;
        active.append(&mut exits.returned);
        active.sort_unstable();
        self.join(active);
        self.frames.pop();
        self.depth -= 1;
        Ok(())
    }

    fn deeper(&mut self, span: u32) -> Result<()> {
        self.depth += 1;
        let limit = self.context.limits.depth;
        if self.depth > limit {
            return Err(Error::Depth {
                limit,
                span: self.span(span),
            });
        }
        Ok(())
    }

    pub(crate) fn span(&self, span: u32) -> naga::Span {
        self.context
            .program
            .code
            .spans
            .get(span as usize)
            .copied()
            .unwrap_or_default()
    }

    fn block(&mut self, nodes: &'a [Node], active: &mut Vec<u32>, exits: &mut Exits) -> Result<()> {
        for node in nodes {
            if active.is_empty() {
                return Ok(());
            }
            self.node(node, active, exits)?;
        }
        Ok(())
    }

    fn node(&mut self, node: &'a Node, active: &mut Vec<u32>, exits: &mut Exits) -> Result<()> {
        match node {
            Node::Run(run) => run.iter().try_for_each(|instr| self.instruction(instr, active)),
            Node::If {
                cond,
                accept,
                reject,
                span,
            } => self.if_node(*cond, (accept, reject), *span, active, exits),
            Node::Switch {
                selector,
                int,
                cases,
                span,
            } => self.switch(*selector, *int, cases, *span, active, exits),
            Node::Loop(l) => self.loop_node(l, active, exits),
            Node::Break => {
                exits.broke.append(active);
                Ok(())
            }
            Node::Continue => {
                exits.continued.append(active);
                Ok(())
            }
            Node::Return => {
                exits.returned.append(active);
                self.join(&mut exits.returned);
                Ok(())
            }
            Node::Kill => {
                active
                    .iter()
                    .for_each(|&lane| self.lanes.killed[lane as usize] = Truth::True);
                Ok(())
            }
            Node::Barrier => {
                self.publish(active);
                Ok(())
            }
            Node::Call { function, span } => self.call(*function, active, *span),
        }
    }

    /// Splits lanes by a condition; an undecided lane goes both ways.
    fn split(&mut self, cond: Row, active: &mut Vec<u32>) -> (Vec<u32>, Vec<u32>) {
        let (mut yes, mut no) = (Vec::new(), Vec::new());
        for lane in active.drain(..) {
            match D::truth(self.get(cond, lane)) {
                Truth::True => yes.push(lane),
                Truth::False => no.push(lane),
                Truth::Maybe => {
                    let copy = self.fork(lane);
                    self.narrow(cond, true, lane);
                    self.narrow(cond, false, copy);
                    no.push(copy);
                    yes.push(lane);
                }
            }
        }
        (yes, no)
    }

    fn if_node(
        &mut self,
        cond: Row,
        (accept, reject): (&'a [Node], &'a [Node]),
        span: u32,
        active: &mut Vec<u32>,
        exits: &mut Exits,
    ) -> Result<()> {
        self.deeper(span)?;
        let (mut yes, mut no) = self.split(cond, active);
        self.block(accept, &mut yes, exits)?;
        self.block(reject, &mut no, exits)?;
        yes.append(&mut no);
        yes.sort_unstable();
        *active = yes;
        self.join(active);
        self.depth -= 1;
        Ok(())
    }

    fn switch(
        &mut self,
        selector: Row,
        int: IntType,
        cases: &'a [Case],
        span: u32,
        active: &mut Vec<u32>,
        exits: &mut Exits,
    ) -> Result<()> {
        self.deeper(span)?;
        let mut entering: Vec<Vec<u32>> = vec![Vec::new(); cases.len()];
        let mut done = Vec::new();
        for lane in std::mem::take(active) {
            let (lo, hi) = D::int_bounds(int, self.get(selector, lane));
            self.enter_cases(cases, (lo, hi), lane, &mut entering, &mut done);
        }
        let outer = std::mem::take(&mut exits.broke);
        let mut lanes = Vec::new();
        for (case, mut enter) in cases.iter().zip(entering) {
            lanes.append(&mut enter);
            lanes.sort_unstable();
            self.join(&mut lanes);
            self.block(&case.body, &mut lanes, exits)?;
            if !case.fall_through {
                done.append(&mut lanes);
            }
        }
        done.append(&mut lanes);
        done.append(&mut exits.broke);
        done.sort_unstable();
        exits.broke = outer;
        *active = done;
        self.join(active);
        self.depth -= 1;
        Ok(())
    }

    /// Puts a lane into every case its selector may select.
    fn enter_cases(
        &mut self,
        cases: &[Case],
        (lo, hi): (i128, i128),
        lane: u32,
        entering: &mut [Vec<u32>],
        done: &mut Vec<u32>,
    ) {
        let inside = |v: i128| lo <= v && v <= hi;
        let mut targets: Vec<usize> = cases
            .iter()
            .enumerate()
            .filter(|(_, c)| c.value.is_some_and(inside))
            .map(|(i, _)| i)
            .collect();
        let covered = targets.len() as i128 == hi - lo + 1;
        let default = cases.iter().position(|c| c.value.is_none());
        if !covered {
            targets.extend(default);
            if default.is_none() {
                if targets.is_empty() {
                    done.push(lane);
                    return;
                }
                done.push(self.fork(lane));
            }
        }
        let Some((&first, others)) = targets.split_first() else {
            done.push(lane);
            return;
        };
        for &other in others {
            let copy = self.fork(lane);
            entering[other].push(copy);
        }
        entering[first].push(lane);
    }

    fn loop_node(&mut self, l: &'a Loop, active: &mut Vec<u32>, exits: &mut Exits) -> Result<()> {
        self.deeper(l.span)?;
        let outer = (
            std::mem::take(&mut exits.broke),
            std::mem::take(&mut exits.continued),
        );
        let mut left = Vec::new();
        let mut rounds: BTreeMap<u32, u32> = BTreeMap::new();
        while !active.is_empty() {
            let returned = exits.returned.len();
            self.round(l, active, exits)?;
            if D::UNCERTAIN && self.lanes.forks > 0 {
                self.limit_rounds(l, active, exits, returned, &mut rounds);
            }
            left.append(&mut exits.broke);
            self.join(&mut left);
            self.spend(active.len() as u64, l.span)?;
        }
        left.sort_unstable();
        *active = left;
        (exits.broke, exits.continued) = outer;
        self.join(active);
        self.depth -= 1;
        Ok(())
    }

    /// One pass through the body and the continuing block.
    fn round(&mut self, l: &'a Loop, active: &mut Vec<u32>, exits: &mut Exits) -> Result<()> {
        self.block(&l.body, active, exits)?;
        if !exits.continued.is_empty() {
            active.append(&mut exits.continued);
            active.sort_unstable();
            self.join(active);
        }
        self.block(&l.continuing, active, exits)?;
        if let Some(cond) = l.break_if {
            let (mut leaving, staying) = self.split(cond, active);
            exits.broke.append(&mut leaving);
            *active = staying;
        }
        Ok(())
    }

    /// Gives up a loop for invocations that both left and stayed too often.
    fn limit_rounds(
        &mut self,
        l: &'a Loop,
        active: &mut Vec<u32>,
        exits: &mut Exits,
        returned: usize,
        rounds: &mut BTreeMap<u32, u32>,
    ) {
        let returned = returned.min(exits.returned.len());
        let leaving: Vec<u32> = exits
            .broke
            .iter()
            .chain(&exits.returned[returned..])
            .map(|&lane| self.lanes.root[lane as usize])
            .collect();
        if leaving.is_empty() {
            return;
        }
        let limit = self.context.limits.undecided_exits;
        let mut staying = Vec::with_capacity(active.len());
        for lane in active.drain(..) {
            let root = self.lanes.root[lane as usize];
            if !leaving.contains(&root) {
                staying.push(lane);
                continue;
            }
            let count = rounds.entry(root).or_default();
            *count += 1;
            if *count <= limit {
                staying.push(lane);
            } else {
                self.give_up(l, lane, exits);
            }
        }
        *active = staying;
    }

    fn give_up(&mut self, l: &'a Loop, lane: u32, exits: &mut Exits) {
        self.abandon(lane, &l.effects);
        if l.effects.returns {
            let copy = self.fork(lane);
            let code = self.context.program;
            if let Some(&function) = self.frames.last() {
                for &row in &code.code.functions[function].result {
                    self.set_unknown(row, copy);
                }
            }
            exits.returned.push(copy);
        }
        exits.broke.push(lane);
    }

    /// Charges operations to the batch's budget.
    pub(crate) fn spend(&mut self, operations: u64, span: u32) -> Result<()> {
        self.counters.operations += operations;
        if self.counters.operations + self.work > self.budget {
            return Err(Error::Budget {
                budget: self.context.limits.operations,
                span: self.span(span),
            });
        }
        Ok(())
    }
}
