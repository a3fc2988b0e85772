//! The state of one batch.

use super::lanes::Lanes;
use super::memory::{Memory, Pages, View};
use crate::compile::code::{Constant, Row};
use crate::compile::program::Program;
use crate::domain::{Domain, Truth};
use crate::error::Result;
use crate::kind::Kind;
use crate::limits::Limits;
use crate::texture::{Sampler, Texture};

/// What the lanes of a batch have in common.
pub(crate) struct Context<'a, D: Domain> {
    pub(crate) program: &'a Program,
    pub(crate) limits: &'a Limits,
    pub(crate) memory: &'a Memory<D>,
    /// Textures by resource; a binding array has several.
    pub(crate) textures: &'a [Vec<Texture>],
    pub(crate) samplers: &'a [Vec<Sampler>],
}

/// Numbers that a run adds up.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Scalar operations executed.
    pub operations: u64,
    /// Texels or filtered samples fetched.
    pub fetches: u64,
    /// Times an invocation forked because a condition was undecided.
    pub forks: u64,
    /// Times a loop was given up because it could not be decided when it ends.
    pub abandoned_loops: u64,
    /// Memory accesses whose index was out of bounds.
    pub out_of_bounds: u64,
    /// Operations and fetches by span number of the program, if counting was asked for.
    pub(crate) by_span: Vec<[u64; 2]>,
    /// What went wrong, if the run was watched.
    pub(crate) events: super::watch::Events,
    /// By span number, the bits of an operand that must not be zero, or not below it, if the run was watched.
    pub(crate) margins: std::collections::BTreeMap<u32, u64>,
    /// Sums and products that something worse may come from, if the run was watched.
    pub(crate) suspects: super::watch::Suspects,
    /// Comparisons and steps whose result was open, if the run was watched.
    pub(crate) undecided: u64,
}

impl Counters {
    pub(crate) fn absorb(&mut self, other: &Self) {
        self.operations += other.operations;
        self.fetches += other.fetches;
        self.forks += other.forks;
        self.abandoned_loops += other.abandoned_loops;
        self.out_of_bounds += other.out_of_bounds;
        self.undecided += other.undecided;
        self.margins.extend(&other.margins);
        super::watch::absorb(&mut self.events, &other.events);
        super::watch::absorb(&mut self.suspects, &other.suspects);
        self.by_span
            .resize(self.by_span.len().max(other.by_span.len()), [0; 2]);
        for (to, from) in self.by_span.iter_mut().zip(&other.by_span) {
            to[0] += from[0];
            to[1] += from[1];
        }
    }
}

/// One batch in execution.
pub(crate) struct Machine<'a, D: Domain> {
    pub(crate) context: &'a Context<'a, D>,
    /// Rows by lanes.
    pub(crate) regs: Vec<D::Cell>,
    /// Lanes a row has room for.
    pub(crate) stride: usize,
    pub(crate) lanes: Lanes<D>,
    /// Whether nothing is known of the other fragments of an invocation's quad.
    pub(crate) lone: bool,
    pub(crate) view: View<'a, D>,
    pub(crate) counters: Counters,
    /// Operations this batch may execute.
    pub(crate) budget: u64,
    /// Cells copied and joined for forks, which the budget pays for although no shader asked for them.
    pub(crate) work: u64,
    /// Functions being executed, outermost first.
    pub(crate) frames: Vec<usize>,
    pub(crate) depth: u32,
    /// By span number: whether operations there are taken for exact. Empty where none are.
    pub(crate) exact: Vec<bool>,
    /// By row: whether it holds a constant. Empty where the run is not watched.
    pub(crate) constant: Vec<bool>,
}

impl<'a, D: Domain> Machine<'a, D> {
    /// A batch of `n` invocations.
    pub(crate) fn new(context: &'a Context<'a, D>, n: usize) -> Self {
        let code = &context.program.code;
        let stride = if D::UNCERTAIN { n + n / 2 + 4 } else { n };
        let mut machine = Self {
            context,
            regs: vec![D::Cell::default(); code.kinds.len() * stride],
            stride,
            lanes: Lanes::new(n),
            lone: false,
            view: View::new(context.memory),
            counters: Counters::default(),
            budget: context.limits.operations.saturating_mul(n as u64),
            work: 0,
            frames: Vec::new(),
            depth: 0,
            exact: exact_spans(context),
            constant: Vec::new(),
        };
        if context.limits.watch {
            machine.constant = vec![false; code.kinds.len()];
            for (row, _) in &code.constants {
                machine.constant[*row as usize] = true;
            }
        }
        if context.limits.count {
            machine.counters.by_span = vec![[0; 2]; code.spans.len()];
        }
        machine.fill_constants();
        machine
    }

    fn fill_constants(&mut self) {
        let program = self.context.program;
        for &(row, constant) in &program.code.constants {
            let cell = constant_cell::<D>(constant);
            self.row_mut(row).fill(cell);
        }
    }

    fn row_mut(&mut self, row: Row) -> &mut [D::Cell] {
        let start = row as usize * self.stride;
        &mut self.regs[start..start + self.stride]
    }

    #[inline(always)]
    pub(crate) fn get(&self, row: Row, lane: u32) -> D::Cell {
        self.regs[row as usize * self.stride + lane as usize]
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, row: Row, lane: u32, cell: D::Cell) {
        self.regs[row as usize * self.stride + lane as usize] = cell;
    }

    pub(crate) fn kind(&self, row: Row) -> Kind {
        self.context.program.code.kinds[row as usize]
    }

    /// Runs the entry point over all lanes.
    pub(crate) fn run(&mut self) -> Result<()> {
        let mut active: Vec<u32> = (0..self.lanes.count() as u32).collect();
        self.call(self.context.program.code.entry, &mut active, 0)
    }

    /// The state of memory and the counters after the run.
    pub(crate) fn finish(self) -> (Pages<D>, Counters) {
        (self.view.into_pages(), self.counters)
    }

    /// Whether the invocation was discarded.
    pub(crate) fn discarded(&self, lane: u32) -> Truth {
        self.lanes.killed[lane as usize]
    }

    /// Makes room for more lanes.
    pub(crate) fn grow(&mut self) {
        let stride = self.stride * 2;
        let rows = self.context.program.code.kinds.len();
        let mut regs = vec![D::Cell::default(); rows * stride];
        for row in 0..rows {
            regs[row * stride..][..self.stride]
                .copy_from_slice(&self.regs[row * self.stride..][..self.stride]);
        }
        self.regs = regs;
        self.stride = stride;
        self.fill_constants();
    }
}

fn exact_spans<D: Domain>(context: &Context<'_, D>) -> Vec<bool> {
    let Some(place) = &context.limits.exact else {
        return Vec::new();
    };
    let begins_there = |span: &naga::Span| span.to_range().is_some_and(|range| place.contains(&range.start));
    context.program.code.spans.iter().map(begins_there).collect()
}

pub(crate) fn constant_cell<D: Domain>(constant: Constant) -> D::Cell {
    match constant.kind {
        Kind::Float(w) => D::float(w, f64::from_bits(constant.bits)),
        Kind::Int(t) => D::int(t, t.wrap(i128::from(constant.bits))),
        Kind::Bool => D::bool(constant.bits != 0),
    }
}
