//! The box of all inputs: its dimensions, the state a walk starts with, and how a box is cut in two.
//!
//! Dimensions are the scalars of [`Inputs`], then the workgroup and the place within it of a compute shader. What is known of a unit
//! vector as a whole shrinks its components' bounds; a choice of values shrinks to the values within the bounds.

use super::state::{State, Value};
use super::table::{Def, Table, Vn};
use crate::compile::program::{Port, Program, ResourceKind};
use crate::domain::Domain;
use crate::exec::machine::constant_cell;
use crate::interval::{Interval, Range, WideCell};
use crate::kind::{IntType, Kind};
use crate::ranges::{Inputs, Point, Seed, Target, Values};
use naga::{Binding, BuiltIn, ShaderStage};

/// Bounds of every dimension.
pub(super) type Box = Vec<(f64, f64)>;

/// The box that the inputs declare.
pub(super) fn whole(program: &Program, inputs: &Inputs) -> Box {
    let mut bounds = inputs.bounds();
    if program.stage == ShaderStage::Compute {
        bounds.extend(inputs.workgroups.map(|n| (0.0, f64::from(n) - 1.0)));
        bounds.extend(program.workgroup_size.map(|n| (0.0, f64::from(n.max(1)) - 1.0)));
    }
    bounds
}

fn kind_of(inputs: &Inputs, dimension: usize) -> Kind {
    inputs
        .scalars
        .get(dimension)
        .map_or(Kind::Int(IntType::U32), |scalar| scalar.kind)
}

/// Shrinks a box by what vectors and choices say as a whole; `false` when nothing is left.
pub(super) fn contract(inputs: &Inputs, bounds: &mut Box) -> bool {
    inputs.groups.iter().all(|group| match &group.values {
        Values::Between(_) => true,
        Values::Unit => contract_unit(&mut bounds[group.scalars.clone()]),
        Values::OneOf(list) => bounds[group.scalars.clone()].iter_mut().all(|b| {
            let inside = || list.iter().copied().filter(|x| b.0 <= *x && *x <= b.1);
            let (lo, hi) = (
                inside().fold(f64::INFINITY, f64::min),
                inside().fold(f64::NEG_INFINITY, f64::max),
            );
            *b = (lo, hi);
            lo <= hi
        }),
    })
}

/// Room for the rounding of the components.
const UNIT_SLACK: f64 = 1e-6;

fn contract_unit(part: &mut [(f64, f64)]) -> bool {
    let square = |b: &(f64, f64)| {
        let (p, q) = (b.0 * b.0, b.1 * b.1);
        let least = if b.0 <= 0.0 && b.1 >= 0.0 { 0.0 } else { p.min(q) };
        (least, p.max(q))
    };
    for k in 0..part.len() {
        let others = part
            .iter()
            .enumerate()
            .filter(|(j, _)| *j != k)
            .map(|(_, b)| square(b));
        let (lo, hi) = others.fold((0.0, 0.0), |sum, b| (sum.0 + b.0, sum.1 + b.1));
        let most = 1.0 + UNIT_SLACK - lo;
        if most < 0.0 {
            return false;
        }
        let least = (1.0 - UNIT_SLACK - hi).max(0.0).sqrt();
        let most = most.sqrt();
        let b = &mut part[k];
        b.0 = b.0.max(-most);
        b.1 = b.1.min(most);
        if b.0 > -least && least > 0.0 {
            b.0 = b.0.max(least);
        }
        if b.1 < least && least > 0.0 {
            b.1 = b.1.min(-least);
        }
        if b.0 > b.1 {
            return false;
        }
    }
    true
}

/// How much there is to cut in a dimension; zero for none.
fn extent(kind: Kind, (lo, hi): (f64, f64)) -> f64 {
    if lo >= hi {
        return 0.0;
    }
    match kind {
        Kind::Int(_) | Kind::Bool => (hi - lo + 1.0).log2() * 4.0,
        Kind::Float(_) if lo < 0.0 && hi > 0.0 => 200.0 + hi.max(-lo).log2().clamp(-50.0, 50.0),
        // Octaves between the ends; down to zero they are many, but the upper ones matter first.
        Kind::Float(_) => {
            let (small, large) = (lo.abs().min(hi.abs()), lo.abs().max(hi.abs()));
            let octaves = (large / small).log2();
            if octaves < 1e-5 {
                0.0
            } else {
                octaves
                    .min(8.0 + large.log2().clamp(-150.0, 150.0) / 32.0)
                    .max(0.01)
            }
        }
    }
}

/// Discrete dimensions of no more values than these are cut before others.
const FEW: f64 = 16.0;

/// A way to cut a box in two.
pub(super) struct Cut {
    /// How much there is to cut.
    pub(super) extent: f64,
    /// Whether the dimension has few values, so that a half may be one value.
    pub(super) discrete: bool,
    pub(super) halves: (Box, Box),
}

/// Cuts a box in two along a dimension; `None` for nothing left to cut.
pub(super) fn cut(inputs: &Inputs, bounds: &Box, dimension: u32) -> Option<Cut> {
    let d = dimension as usize;
    let kind = kind_of(inputs, d);
    let extent = extent(kind, bounds[d]);
    if extent <= 0.0 {
        return None;
    }
    let (left, right) = halves(kind, bounds[d])?;
    let (mut a, mut b) = (bounds.clone(), bounds.clone());
    a[d] = left;
    b[d] = right;
    let group = inputs.groups.iter().find(|group| group.scalars.contains(&d));
    let chosen = group.is_some_and(|group| matches!(group.values, Values::OneOf(_)));
    let discrete = chosen || !matches!(kind, Kind::Float(_));
    let few = discrete && bounds[d].1 - bounds[d].0 <= FEW;
    Some(Cut {
        // A choice among a few often decides which code runs: it goes first.
        extent: if few { extent + 100.0 } else { extent },
        discrete,
        halves: (a, b),
    })
}

type Halves = ((f64, f64), (f64, f64));

fn halves(kind: Kind, (lo, hi): (f64, f64)) -> Option<Halves> {
    match kind {
        Kind::Int(_) | Kind::Bool => {
            let mid = ((lo + hi) / 2.0).floor();
            Some(((lo, mid), (mid + 1.0, hi)))
        }
        Kind::Float(w) => {
            let mid = w.round(middle(lo, hi, w.min_normal()));
            if mid <= lo || mid >= hi {
                return None;
            }
            // Zero itself goes with the side above, so that the other side is free of it.
            let below = if mid == 0.0 { w.next_down(0.0) } else { mid };
            Some(((lo, below), (mid, hi)))
        }
    }
}

/// Zero, if it lies within; four octaves below the larger end, or the geometric mean over several octaves; the arithmetic one otherwise.
fn middle(lo: f64, hi: f64, least: f64) -> f64 {
    if lo < 0.0 && hi > 0.0 {
        return 0.0;
    }
    let (small, large) = (lo.abs().min(hi.abs()), lo.abs().max(hi.abs()));
    let sign = if lo < 0.0 { -1.0 } else { 1.0 };
    if large <= least {
        return lo + (hi - lo) / 2.0;
    }
    if large / small.max(least) > 256.0 {
        return (large / 16.0) * sign;
    }
    if large / small > 4.0 {
        return (small.sqrt() * large.sqrt()) * sign;
    }
    lo + (hi - lo) / 2.0
}

/// A point within a box, in the middle or at random, that keeps to its groups' values as well as a box allows.
pub(super) fn point_in(inputs: &Inputs, bounds: &Box, seed: &mut Seed) -> Point {
    let mut point = inputs.sample(seed, crate::ranges::Style::Random);
    for group in &inputs.groups {
        let share = [0.0, 1.0, 0.5, seed.fraction()][seed.below(4)];
        for k in group.scalars.clone() {
            let (lo, hi) = bounds[k];
            let x = lo + (hi - lo) * share;
            point.values[k] = match inputs.scalars[k].kind {
                Kind::Float(w) => w.round(x).clamp(lo, hi),
                Kind::Int(_) | Kind::Bool => x.round(),
            };
        }
        let values = &mut point.values[group.scalars.clone()];
        match &group.values {
            Values::Between(_) => {}
            Values::Unit => {
                let length = values.iter().map(|x| x * x).sum::<f64>().sqrt();
                values
                    .iter_mut()
                    .for_each(|x| *x = f64::from((*x / length) as f32));
            }
            Values::OneOf(list) => {
                for x in values {
                    let near = list
                        .iter()
                        .min_by(|a, b| (*a - *x).abs().total_cmp(&(*b - *x).abs()));
                    *x = near.copied().unwrap_or(*x);
                }
            }
        }
    }
    point
}

fn cell(kind: Kind, (lo, hi): (f64, f64)) -> WideCell {
    match kind {
        Kind::Float(w) => Range::from_float(w, Interval::new(lo, hi)),
        Kind::Int(t) => {
            let lo = (lo.ceil() as i128).clamp(t.min(), t.max());
            Range::int_range(t, lo, (hi.floor() as i128).clamp(lo, t.max()))
        }
        Kind::Bool if lo >= 0.5 => Range::bool(true),
        Kind::Bool if hi < 0.5 => Range::bool(false),
        Kind::Bool => Range::undecided(Kind::Bool),
    }
}

/// The state a walk starts with.
pub(super) fn start(program: &Program, inputs: &Inputs, bounds: &Box, table: &mut Table) -> State {
    // Value number 0 stands for what is not there.
    table.opaque(Kind::Bool, Vec::new());
    let mut state = State::new(program.code.kinds.len(), Vec::new());
    let dimensions: Vec<Value> = bounds
        .iter()
        .enumerate()
        .map(|(d, b)| {
            let kind = kind_of(inputs, d);
            let vn = table.number(kind, Def::Input(d as u32));
            state.define(table, vn, cell(kind, *b))
        })
        .collect();
    for group in inputs.groups.iter().filter(|group| group.values == Values::Unit) {
        let members: Vec<Vn> = group.scalars.clone().map(|k| dimensions[k].vn).collect();
        table.units.push(members);
    }
    for &(row, constant) in &program.code.constants {
        let vn = table.number(constant.kind, Def::Constant(constant.kind, constant.bits));
        state.rows[row as usize] = state.define(table, vn, constant_cell::<Range>(constant));
    }
    memory(program, inputs, &dimensions, table, &mut state);
    for port in &program.inputs {
        port_values(program, inputs, port, &dimensions, table, &mut state);
    }
    state
}

fn memory(program: &Program, inputs: &Inputs, dimensions: &[Value], table: &mut Table, state: &mut State) {
    for resource in &program.resources {
        let zero = |kind: Kind, table: &mut Table, state: &mut State| {
            let vn = table.number(kind, Def::Constant(kind, 0));
            state.define(table, vn, crate::exec::places::zero::<Range>(kind))
        };
        let cells: Vec<Value> = match &resource.kind {
            ResourceKind::Buffer { .. } => {
                let buffer = inputs
                    .buffers
                    .iter()
                    .find(|b| Some(b.binding) == resource.binding);
                let kinds = buffer.map_or(&[][..], |b| &b.kinds);
                let first = buffer.and_then(|b| b.first);
                let value = |(n, kind): (usize, &Kind)| match first {
                    Some(first) => dimensions[first + n],
                    None => zero(*kind, table, state),
                };
                kinds.iter().enumerate().map(value).collect()
            }
            ResourceKind::Workgroup { kinds } => kinds.iter().map(|&kind| zero(kind, table, state)).collect(),
            ResourceKind::Texture { .. }
            | ResourceKind::StorageTexture { .. }
            | ResourceKind::Sampler { .. } => Vec::new(),
        };
        state.memory.push(cells);
    }
}

fn port_values(
    program: &Program,
    inputs: &Inputs,
    port: &Port,
    dimensions: &[Value],
    table: &mut Table,
    state: &mut State,
) {
    if let Some(wanted) = crate::run::slot_of(&port.binding) {
        for (k, scalar) in inputs.scalars.iter().enumerate() {
            if let Target::Stage { slot, component } = scalar.target
                && slot == wanted
                && let Some(&row) = port.rows.get(component)
            {
                state.rows[row as usize] = dimensions[k];
            }
        }
        return;
    }
    let n = inputs.scalars.len();
    let (Binding::BuiltIn(builtin), Some(ids)) = (&port.binding, dimensions.get(n..n + 6)) else {
        return;
    };
    let whole = |value: &Value| Range::int_bounds(IntType::U32, value.cell);
    for (k, &row) in port.rows.iter().enumerate() {
        let size = i128::from(program.workgroup_size[k % 3].max(1));
        let ((g, h), (l, m)) = (whole(&ids[k % 3]), whole(&ids[3 + k % 3]));
        let total = program
            .workgroup_size
            .iter()
            .map(|&n| i128::from(n.max(1)))
            .product::<i128>();
        let (lo, hi) = match builtin {
            BuiltIn::WorkGroupId => {
                state.rows[row as usize] = ids[k % 3];
                continue;
            }
            BuiltIn::LocalInvocationId => {
                state.rows[row as usize] = ids[3 + k % 3];
                continue;
            }
            BuiltIn::GlobalInvocationId => (g * size + l, h * size + m),
            BuiltIn::LocalInvocationIndex => {
                let at = |end: fn((i128, i128)) -> i128| {
                    let [x, y, z] = [3, 4, 5].map(|d| end(whole(&ids[d])));
                    let [sx, sy, _] = program.workgroup_size.map(|n| i128::from(n.max(1)));
                    x + y * sx + z * sx * sy
                };
                (at(|b| b.0), at(|b| b.1))
            }
            BuiltIn::WorkGroupSize => (size, size),
            BuiltIn::NumWorkGroups => {
                let n = i128::from(inputs.workgroups[k % 3]);
                (n, n)
            }
            _ => (0, total.max(1)),
        };
        let parents = ids.iter().map(|id| id.vn).collect();
        let vn = table.opaque(Kind::Int(IntType::U32), parents);
        state.rows[row as usize] = state.define(table, vn, Range::int_range(IntType::U32, lo, hi));
    }
}
