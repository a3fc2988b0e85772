//! Which rows may hold a product, itself or by way of copies, signs, choices and calls.
//!
//! A product is the one value whose uses may differ: where it is added a compiler may fuse it, where it is multiplied on it may
//! reassociate it, and elsewhere it is rounded. Whoever reasons about two uses of one value asks here first. Drivers inline calls, so
//! parameters and results are followed, over the whole program.

use super::code::{Block, Code, Node, Op, Place, Root, Row};
use crate::domain::ops::{FloatBinary, FloatTernary, FloatUnary};
use std::collections::HashMap;

/// By row, for a finished program.
pub(crate) fn products(code: &Code) -> Vec<bool> {
    let mut found = Found {
        is: vec![false; code.kinds.len()],
        copies: Vec::new(),
        arrays: HashMap::new(),
    };
    for function in &code.functions {
        found.block(&function.body);
    }
    found.close();
    found.is.truncate(code.kinds.len());
    found.is
}

struct Found {
    is: Vec<bool>,
    /// From a row to the row that holds the same value.
    copies: Vec<(Row, Row)>,
    /// A number beyond the rows for each variable that is reached at an index: it stands for all of its rows.
    arrays: HashMap<(Row, u32), Row>,
}

impl Found {
    fn block(&mut self, block: &Block) {
        for node in block {
            match node {
                Node::Run(run) => run.iter().for_each(|instr| self.op(&instr.op)),
                Node::If { accept, reject, .. } => {
                    self.block(accept);
                    self.block(reject);
                }
                Node::Switch { cases, .. } => cases.iter().for_each(|case| self.block(&case.body)),
                Node::Loop(l) => {
                    self.block(&l.body);
                    self.block(&l.continuing);
                }
                Node::Break
                | Node::Continue
                | Node::Return
                | Node::Kill
                | Node::Barrier
                | Node::Call { .. } => {}
            }
        }
    }

    fn mark(&mut self, row: Row) {
        self.is[row as usize] = true;
    }

    fn op(&mut self, op: &Op) {
        match op {
            Op::FloatBinary {
                op: FloatBinary::Multiply,
                dst,
                ..
            }
            | Op::FloatUnary {
                op: FloatUnary::Square | FloatUnary::Radians | FloatUnary::Degrees,
                dst,
                ..
            }
            | Op::FloatTernary {
                op: FloatTernary::SmoothStep,
                dst,
                ..
            } => self.mark(*dst),
            Op::Chain(chain) if chain.op == FloatBinary::Multiply => self.mark(chain.dst),
            Op::FloatUnary {
                op: FloatUnary::Negate | FloatUnary::Abs,
                dst,
                a,
                ..
            } => self.copies.push((*a, *dst)),
            Op::Copy { dst, src } => self.copies.push((*src, *dst)),
            Op::Select {
                dst, accept, reject, ..
            } => self.copies.extend([(*accept, *dst), (*reject, *dst)]),
            Op::Pick(pick) => {
                let rows = pick.groups.iter().flatten();
                let places = (0..pick.kinds.len()).cycle();
                self.copies
                    .extend(rows.zip(places).map(|(&from, k)| (from, pick.dst + k as Row)));
            }
            Op::Load(load) => {
                if let Some(all) = self.array(&load.place) {
                    let rows = load.dst..load.dst + load.kinds.len() as Row;
                    self.copies.extend(rows.map(|dst| (all, dst)));
                }
            }
            Op::Store(store) => {
                if let Some(all) = self.array(&store.place) {
                    self.copies.extend(store.values.iter().map(|&from| (from, all)));
                }
            }
            // Sums, quotients and all else are rounded where they are made.
            _ => {}
        }
    }

    /// What stands for a variable's rows; memory that invocations share holds values that were rounded.
    fn array(&mut self, place: &Place) -> Option<Row> {
        let Root::Rows { base, len } = place.root else {
            return None;
        };
        if let Some(&all) = self.arrays.get(&(base, len)) {
            return Some(all);
        }
        let all = self.is.len() as Row;
        self.is.push(false);
        self.arrays.insert((base, len), all);
        self.copies
            .extend((base..base + len).flat_map(|row| [(row, all), (all, row)]));
        Some(all)
    }

    /// Follows copies until nothing new is found.
    fn close(&mut self) {
        let mut to: Vec<Vec<Row>> = vec![Vec::new(); self.is.len()];
        for &(from, dst) in &self.copies {
            to[from as usize].push(dst);
        }
        let mut left: Vec<Row> = (0..self.is.len() as Row)
            .filter(|&row| self.is[row as usize])
            .collect();
        while let Some(row) = left.pop() {
            for &dst in &to[row as usize] {
                if !std::mem::replace(&mut self.is[dst as usize], true) {
                    left.push(dst);
                }
            }
        }
    }
}
