//! Lanes: forking where a condition is undecided, merging where control flow joins.

use super::machine::Machine;
use crate::compile::code::{Effects, RegionId, Row};
use crate::domain::{Domain, Truth};
use crate::kind::Kind;
use std::collections::{BTreeMap, BTreeSet};

/// What a forked lane has written to shared memory.
#[derive(Clone, Debug)]
pub(crate) struct Overlay<D: Domain> {
    pub(crate) cells: BTreeMap<(RegionId, u32), (D::Cell, Kind)>,
    /// Regions of which nothing is known any more, but for `cells`.
    pub(crate) lost: BTreeSet<RegionId>,
}

impl<D: Domain> Default for Overlay<D> {
    fn default() -> Self {
        Self {
            cells: BTreeMap::new(),
            lost: BTreeSet::new(),
        }
    }
}

/// Bookkeeping of lanes. Lanes `0..count()` are the invocations; further ones are forks.
pub(crate) struct Lanes<D: Domain> {
    /// The invocation a lane belongs to.
    pub(crate) root: Vec<u32>,
    /// Whether the lane was discarded.
    pub(crate) killed: Vec<Truth>,
    pub(crate) overlay: Vec<Option<Box<Overlay<D>>>>,
    /// Rows that a condition has narrowed in some lane.
    pub(crate) narrowed: BTreeSet<Row>,
    /// How many lanes an invocation has now.
    pub(crate) live: Vec<u32>,
    free: Vec<u32>,
    /// Lanes in use beyond one for each invocation.
    pub(crate) forks: u32,
    /// By invocation: a lane seen in the list at hand.
    seen: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl<D: Domain> Lanes<D> {
    pub(crate) fn new(n: usize) -> Self {
        Self {
            root: (0..n as u32).collect(),
            killed: vec![Truth::False; n],
            overlay: (0..n).map(|_| None).collect(),
            narrowed: BTreeSet::new(),
            live: vec![1; n],
            free: Vec::new(),
            forks: 0,
            seen: vec![NONE; n],
        }
    }

    /// Number of invocations.
    pub(crate) fn count(&self) -> usize {
        self.live.len()
    }

    /// Number of lanes ever used.
    pub(crate) fn width(&self) -> usize {
        self.root.len()
    }

    /// Whether the lane is one of several ways its invocation may have gone.
    #[inline(always)]
    pub(crate) fn is_forked(&self, lane: u32) -> bool {
        D::UNCERTAIN && self.forks > 0 && self.live[self.root[lane as usize] as usize] > 1
    }
}

impl<'a, D: Domain> Machine<'a, D> {
    /// A second copy of a lane.
    pub(crate) fn fork(&mut self, lane: u32) -> u32 {
        let copy = self.lanes.free.pop().unwrap_or_else(|| self.new_lane());
        self.copy_columns(lane, copy);
        let lanes = &mut self.lanes;
        let root = lanes.root[lane as usize];
        lanes.root[copy as usize] = root;
        lanes.killed[copy as usize] = lanes.killed[lane as usize];
        lanes.overlay[copy as usize] = lanes.overlay[lane as usize].clone();
        lanes.live[root as usize] += 1;
        lanes.forks += 1;
        self.counters.forks += 1;
        copy
    }

    fn new_lane(&mut self) -> u32 {
        if self.lanes.width() == self.stride {
            self.grow();
        }
        let lanes = &mut self.lanes;
        lanes.root.push(0);
        lanes.killed.push(Truth::False);
        lanes.overlay.push(None);
        (lanes.root.len() - 1) as u32
    }

    /// Copies what the functions being executed own.
    fn copy_columns(&mut self, from: u32, to: u32) {
        let code = &self.context.program.code;
        let owned = self
            .frames
            .iter()
            .flat_map(|&f| &code.functions[f].owned)
            .chain(&code.privates);
        for &(base, len) in owned {
            self.work += u64::from(len);
            for row in base..base + len {
                let start = row as usize * self.stride;
                self.regs[start + to as usize] = self.regs[start + from as usize];
            }
        }
    }

    /// Merges lanes of one invocation that have come to the same point.
    pub(crate) fn join(&mut self, list: &mut Vec<u32>) {
        if !D::UNCERTAIN || self.lanes.forks == 0 || list.len() < 2 {
            return;
        }
        list.sort_unstable();
        let mut kept = 0;
        for k in 0..list.len() {
            let lane = list[k];
            let root = self.lanes.root[lane as usize] as usize;
            match self.lanes.seen[root] {
                NONE => {
                    self.lanes.seen[root] = lane;
                    list[kept] = lane;
                    kept += 1;
                }
                first => self.merge(first, lane),
            }
        }
        list.truncate(kept);
        for &lane in list.iter() {
            self.lanes.seen[self.lanes.root[lane as usize] as usize] = NONE;
        }
    }

    /// Takes the hull of two lanes into the first and frees the second.
    fn merge(&mut self, keep: u32, drop: u32) {
        self.widen(keep, drop);
        self.hull_variables(keep, drop);
        let other = self.lanes.overlay[drop as usize].take();
        if let Some(merged) = self.merged_overlay(keep, other) {
            self.work += merged.cells.len() as u64;
            self.lanes.overlay[keep as usize] = Some(merged);
        }
        let lanes = &mut self.lanes;
        lanes.killed[keep as usize] = lanes.killed[keep as usize].hull(lanes.killed[drop as usize]);
        let root = lanes.root[keep as usize] as usize;
        lanes.live[root] -= 1;
        lanes.forks -= 1;
        lanes.free.push(drop);
        if lanes.live[root] == 1 {
            self.commit(keep);
        }
    }

    fn hull_variables(&mut self, keep: u32, drop: u32) {
        let code = &self.context.program.code;
        let variables = self
            .frames
            .iter()
            .flat_map(|&f| &code.functions[f].variables)
            .chain(&code.privates);
        for &(base, len) in variables {
            self.work += u64::from(len);
            for row in base..base + len {
                let start = row as usize * self.stride;
                let (a, b) = (self.regs[start + keep as usize], self.regs[start + drop as usize]);
                if a != b {
                    self.regs[start + keep as usize] = D::hull(code.kinds[row as usize], a, b);
                }
            }
        }
    }

    /// The overlay that contains both lanes' writes.
    fn merged_overlay(&self, keep: u32, other: Option<Box<Overlay<D>>>) -> Option<Box<Overlay<D>>> {
        let mine = self.lanes.overlay[keep as usize].clone();
        if mine.is_none() && other.is_none() {
            return None;
        }
        let (mine, other) = (mine.unwrap_or_default(), other.unwrap_or_default());
        let lost = mine.lost.union(&other.lost).copied().collect();
        let mut merged = Overlay::<D> {
            cells: BTreeMap::new(),
            lost,
        };
        for (&at, &(cell, kind)) in mine.cells.iter().chain(&other.cells) {
            let (a, b) = (self.through(&mine, at, kind), self.through(&other, at, kind));
            merged
                .cells
                .entry(at)
                .or_insert((if a == b { cell } else { D::hull(kind, a, b) }, kind));
        }
        Some(Box::new(merged))
    }

    /// A cell as seen through an overlay.
    fn through(&self, overlay: &Overlay<D>, (region, at): (RegionId, u32), kind: Kind) -> D::Cell {
        match overlay.cells.get(&(region, at)) {
            Some(&(cell, _)) => cell,
            None if overlay.lost.contains(&region) => D::undecided(kind),
            None => self.view.read(region, at),
        }
    }

    /// Reads shared memory as a lane sees it.
    #[inline(always)]
    pub(crate) fn read(&self, region: RegionId, at: u32, lane: u32, kind: Kind) -> D::Cell {
        if D::UNCERTAIN
            && self.lanes.forks > 0
            && let Some(overlay) = &self.lanes.overlay[lane as usize]
        {
            return self.through(overlay, (region, at), kind);
        }
        self.view.read(region, at)
    }

    /// Writes shared memory on behalf of a lane; `weak` keeps the old value as a possibility.
    pub(crate) fn write(
        &mut self,
        region: RegionId,
        at: u32,
        lane: u32,
        kind: Kind,
        cell: D::Cell,
        weak: bool,
    ) {
        let weak = match self.lanes.killed[lane as usize] {
            Truth::True => return,
            Truth::Maybe => true,
            Truth::False => weak,
        };
        let cell = if weak {
            D::hull(kind, self.read(region, at, lane, kind), cell)
        } else {
            cell
        };
        if self.lanes.is_forked(lane) {
            let overlay = self.lanes.overlay[lane as usize].get_or_insert_default();
            overlay.cells.insert((region, at), (cell, kind));
        } else {
            self.view.write(region, at, cell);
        }
    }

    /// The only lane left of an invocation makes its writes visible.
    fn commit(&mut self, lane: u32) {
        let Some(overlay) = self.lanes.overlay[lane as usize].take() else {
            return;
        };
        for &region in &overlay.lost {
            self.lose(region);
        }
        for ((region, at), (cell, _)) in overlay.cells {
            self.view.write(region, at, cell);
        }
    }

    fn lose(&mut self, region: RegionId) {
        let kinds = self.region_kinds(region);
        self.work += self.view.len(region) as u64;
        for at in 0..self.view.len(region) as u32 {
            self.view.write(region, at, D::undecided(kinds.kind(at)));
        }
    }

    /// At a barrier other invocations see what a forked lane may have written.
    pub(crate) fn publish(&mut self, active: &[u32]) {
        if !D::UNCERTAIN || self.lanes.forks == 0 {
            return;
        }
        for &lane in active {
            let Some(overlay) = self.lanes.overlay[lane as usize].clone() else {
                continue;
            };
            for &region in &overlay.lost {
                self.lose(region);
            }
            self.work += overlay.cells.len() as u64;
            for (&(region, at), &(cell, kind)) in &overlay.cells {
                let both = D::hull(kind, self.view.read(region, at), cell);
                self.view.write(region, at, both);
            }
        }
    }

    /// Gives up a loop for a lane: whatever the loop may write is unknown.
    pub(crate) fn abandon(&mut self, lane: u32, effects: &Effects) {
        self.counters.abandoned_loops += 1;
        for &(base, len) in &effects.rows {
            for row in base..base + len {
                self.set_unknown(row, lane);
            }
        }
        for &region in &effects.regions {
            if self.lanes.is_forked(lane) {
                let overlay = self.lanes.overlay[lane as usize].get_or_insert_default();
                overlay.cells.retain(|&(r, _), _| r != region);
                overlay.lost.insert(region);
            } else {
                self.lose(region);
            }
        }
        if effects.kills {
            let killed = &mut self.lanes.killed[lane as usize];
            *killed = killed.hull(if *killed == Truth::True {
                Truth::True
            } else {
                Truth::Maybe
            });
        }
    }

    pub(crate) fn set_unknown(&mut self, row: Row, lane: u32) {
        let kind = self.kind(row);
        self.set(row, lane, D::undecided(kind));
    }
}
