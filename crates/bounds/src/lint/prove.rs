//! Which alarms are real possibilities: the box of inputs is walked whole, and cut in two where alarms remain, until none do or the
//! budget is used up.

use super::rule::Rule;
use super::space;
use super::table::Vn;
use super::walk::{Assumed, Walk};
use crate::compile::program::Program;
use crate::ranges::{Inputs, Point, Seed};
use rayon::prelude::*;
use std::collections::{BTreeSet, VecDeque};
use std::time::Instant;

/// An operation, by its span, and what may go wrong with it.
pub(super) type Site = (u32, Rule);

/// What walks have shown.
#[derive(Default)]
pub(super) struct Verdict {
    /// What could not be excluded.
    pub(super) open: BTreeSet<Site>,
    /// Loops of which no end could be shown.
    pub(super) loops: BTreeSet<u32>,
    /// Whether a walk stopped before its end.
    pub(super) stopped: bool,
}

/// Walks and cuts. Points within boxes that still alarm go to `witness`, which removes what it finds from the sites.
pub(super) fn prove(
    program: &Program,
    inputs: &Inputs,
    boxes: usize,
    until: Instant,
    seed: &mut Seed,
    mut witness: impl FnMut(&Point) -> BTreeSet<Site>,
) -> Verdict {
    let mut verdict = Verdict::default();
    let mut found: BTreeSet<Site> = BTreeSet::new();
    let mut queue = VecDeque::from([(
        space::whole(program, inputs),
        Assumed::new(),
        None::<BTreeSet<Site>>,
    )]);
    let mut walked = 0;
    while let Some((mut bounds, assumed, expected)) = queue.pop_front() {
        let pending = |found: &BTreeSet<Site>| {
            expected
                .as_ref()
                .is_none_or(|sites: &BTreeSet<Site>| sites.iter().any(|site| !found.contains(site)))
        };
        if !space::contract(inputs, &mut bounds) || !pending(&found) {
            continue;
        }
        if walked >= boxes || Instant::now() > until {
            verdict.open.extend(expected.into_iter().flatten());
            continue;
        }
        walked += 1;
        let mut walk = Walk::new(program, inputs, &assumed);
        let state = space::start(program, inputs, &bounds, &mut walk.table);
        walk.run(state);
        verdict.loops.extend(&walk.loops);
        verdict.stopped |= walk.unfinished();
        let sites: BTreeSet<Site> = walk
            .alarms
            .keys()
            .copied()
            .filter(|site| !found.contains(site))
            .collect();
        if sites.is_empty() {
            continue;
        }
        if walked > 1 {
            found.extend(witness(&space::point_in(inputs, &bounds, seed)));
        }
        let left: BTreeSet<Site> = sites.difference(&found).copied().collect();
        let operands: Vec<Vn> = left
            .iter()
            .filter_map(|site| walk.alarms.get(site))
            .map(|a| a.operand)
            .collect();
        if let Some(row) = selection(&walk, &operands) {
            for holds in [true, false] {
                let mut one = assumed.clone();
                one.insert(row, holds);
                queue.push_back((bounds.clone(), one, Some(left.clone())));
            }
            continue;
        }
        let dimensions: BTreeSet<u32> = operands.iter().flat_map(|vn| walk.table.inputs_of(*vn)).collect();
        let alarms = |bounds: &space::Box| alarms(program, inputs, bounds, &assumed, &left);
        match best_cut(
            inputs,
            &bounds,
            &dimensions,
            (walked % 2 == 1, left.len()),
            alarms,
        ) {
            Some((a, b)) => {
                queue.push_back((a, assumed.clone(), Some(left.clone())));
                queue.push_back((b, assumed, Some(left)));
            }
            None => verdict.open.extend(left),
        }
    }
    verdict.open.retain(|site| !found.contains(site));
    verdict
}

/// How many of the sites alarm in a box.
fn alarms(
    program: &Program,
    inputs: &Inputs,
    bounds: &space::Box,
    assumed: &Assumed,
    sites: &BTreeSet<Site>,
) -> usize {
    let mut bounds = bounds.clone();
    if !space::contract(inputs, &mut bounds) {
        return 0;
    }
    let mut walk = Walk::new(program, inputs, assumed);
    let state = space::start(program, inputs, &bounds, &mut walk.table);
    walk.run(state);
    walk.alarms.keys().filter(|site| sites.contains(site)).count()
}

/// More dimensions than this are not all tried.
const TRIED: usize = 12;

/// The cut of the longest dimension, or the one that leaves the fewest alarms in its two halves. Of numbers in a continuum that is done
/// every other time only, since looking ahead alone would peel off slivers.
fn best_cut(
    inputs: &Inputs,
    bounds: &space::Box,
    dimensions: &BTreeSet<u32>,
    (looks_ahead, now): (bool, usize),
    alarms: impl Fn(&space::Box) -> usize + Sync,
) -> Option<(space::Box, space::Box)> {
    let mut cuts: Vec<space::Cut> = dimensions
        .iter()
        .filter_map(|d| space::cut(inputs, bounds, *d))
        .collect();
    cuts.sort_by(|a, b| b.extent.total_cmp(&a.extent));
    cuts.truncate(TRIED);
    if cuts.len() > 1 {
        let left = |cut: &space::Cut| alarms(&cut.halves.0) + alarms(&cut.halves.1);
        let tried = |cut: &space::Cut| {
            if looks_ahead || cut.discrete {
                left(cut)
            } else {
                2 * now
            }
        };
        let counts: Vec<usize> = cuts.par_iter().map(tried).collect();
        let best = (0..cuts.len()).min_by_key(|k| (counts[*k], *k))?;
        return Some(cuts.swap_remove(best).halves);
    }
    cuts.pop().map(|cut| cut.halves)
}

/// An open selection that an operand depends on and that is made once, so that its two cases are all there are.
fn selection(walk: &Walk<'_>, operands: &[Vn]) -> Option<u32> {
    let sources: BTreeSet<Vn> = operands.iter().flat_map(|vn| walk.table.sources(*vn)).collect();
    let mut made_once = walk.selections.iter().filter(|(_, (_, times))| *times == 1);
    made_once
        .find(|(_, (vn, _))| sources.contains(vn))
        .map(|(row, _)| *row)
}
