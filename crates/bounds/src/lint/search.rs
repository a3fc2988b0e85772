//! Witnesses: inputs with which an operation does go wrong on a perfect machine.
//!
//! Points are chosen by [`Inputs::sample`] from a seed and run over [`F32`], watched. The first point that shows a defect is its
//! witness, made simpler input by input while it still shows it.

use super::cause::{self, Suspects};
use super::prove::Site;
use super::rule::Rule;
use crate::bindings::{Bindings, BufferData, Scalar};
use crate::compile::code::{Code, Node};
use crate::compile::program::{Program, ResourceKind};
use crate::domain::Domain;
use crate::domain::point::F32;
use crate::error::{Error, Result};
use crate::exec::watch::{self, Event, Events};
use crate::limits::{Limits, Nudge};
use crate::ranges::{Inputs, Point, Seed, Style, Values};
use crate::run::{run_compute, run_fragment, run_vertex};
use crate::stage::StageOutputs;
use naga::{ShaderStage, Span};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;

/// Operations an invocation may execute before a loop counts as endless.
pub(super) const OPERATIONS: u64 = 1 << 20;

/// Points whose results are kept together.
const CHUNK: usize = 128;

/// Points that are tried however little time there is. One that runs into an endless loop takes as long as thousands of others.
pub(super) const ALWAYS: u64 = 4;

/// Points among which signs of operands are compared.
const SAMPLED: u64 = 512;

/// Pairs of points between which a zero is looked for, and steps of one such search.
const PAIRS: usize = 8;
const BISECTIONS: usize = 200;

/// A point, and what it shows.
#[derive(Clone, Debug)]
pub(super) struct Shown {
    pub(super) point: Point,
    pub(super) event: Option<Event>,
}

/// A search.
pub(super) struct Search<'p> {
    pub(super) program: &'p Program,
    pub(super) inputs: &'p Inputs,
    pub(super) seed: u64,
    pub(super) found: BTreeMap<Site, Shown>,
    /// How often a suspect was tried.
    pub(super) trials: BTreeMap<Site, u32>,
}

/// What a point shows, and what may be the cause of it.
#[derive(Default)]
pub(super) struct Seen {
    sites: BTreeMap<Site, Option<Event>>,
    suspects: Option<Suspects>,
}

/// What one run gave.
pub(super) struct Run<D: Domain> {
    pub(super) events: Events,
    /// Sums and products that what goes wrong may come from.
    pub(super) suspects: watch::Suspects,
    pub(super) outputs: Vec<D::Float>,
    /// Whether a condition or a step could go either way.
    pub(super) undecided: bool,
    /// By span number, an operand that must not be zero, or not below it.
    pub(super) margins: BTreeMap<u32, f64>,
}

/// Runs the shader at a point; fragments that take derivatives come as a quad around it.
pub(super) fn run<D: Domain>(program: &Program, inputs: &Inputs, point: &Point, seed: u64) -> Result<Run<D>> {
    run_nudged(program, inputs, point, seed, None)
}

/// As [`run`], with results moved at one place.
pub(super) fn run_nudged<D: Domain>(
    program: &Program,
    inputs: &Inputs,
    point: &Point,
    seed: u64,
    nudge: Option<Nudge>,
) -> Result<Run<D>> {
    let limits = Limits {
        operations: OPERATIONS,
        watch: true,
        nudge,
        ..Limits::default()
    };
    let quad = (program.stage == ShaderStage::Fragment && program.uses_derivatives())
        .then(|| inputs.quad(point, &mut Seed::new(seed)));
    let points: Vec<&Point> = match &quad {
        Some(quad) => quad.iter().collect(),
        None => vec![point],
    };
    let (mut bindings, stage) = inputs.at::<D>(&points)?;
    let (outcome, mut outputs) = match program.stage {
        ShaderStage::Vertex => {
            let (out, outcome) = run_vertex(program, &mut bindings, &stage, &limits)?;
            (outcome, stage_floats(&out))
        }
        ShaderStage::Fragment => {
            let (out, outcome) = run_fragment(program, &mut bindings, &stage, &limits)?;
            (outcome, stage_floats(&out))
        }
        _ => (
            run_compute(program, &mut bindings, inputs.workgroups, &limits)?,
            Vec::new(),
        ),
    };
    outputs.extend(written(program, &bindings));
    Ok(Run {
        events: outcome.counters.events,
        suspects: outcome.counters.suspects,
        outputs,
        margins: outcome
            .counters
            .margins
            .into_iter()
            .map(|(span, bits)| (span, f64::from_bits(bits)))
            .collect(),
        undecided: outcome.counters.forks + outcome.counters.undecided > 0,
    })
}

/// The floats of the first invocation; nothing of a discarded fragment.
fn stage_floats<D: Domain>(out: &StageOutputs<D>) -> Vec<D::Float> {
    if out.discarded.first() == Some(&crate::Truth::True) {
        return Vec::new();
    }
    let columns = out.columns.values();
    columns
        .flat_map(|c| c.of(0).iter().filter_map(Scalar::float))
        .collect()
}

/// The floats of all buffers that the shader may write.
fn written<D: Domain>(program: &Program, bindings: &Bindings<D>) -> Vec<D::Float> {
    let buffers = program
        .resources
        .iter()
        .filter_map(|resource| match resource.kind {
            ResourceKind::Buffer { writable: true, .. } => bindings.buffers.get(&resource.binding?),
            _ => None,
        });
    let scalars = buffers.flat_map(|data| match data {
        BufferData::Scalars(list) => &list[..],
        BufferData::Bytes(_) => &[],
    });
    scalars.filter_map(Scalar::float).collect()
}

impl<'p> Search<'p> {
    pub(super) fn new(program: &'p Program, inputs: &'p Inputs, seed: u64) -> Self {
        Self {
            program,
            inputs,
            seed,
            found: BTreeMap::new(),
            trials: BTreeMap::new(),
        }
    }

    /// What a point shows.
    pub(super) fn shows(&self, point: &Point) -> Seen {
        match run::<F32>(self.program, self.inputs, point, self.seed) {
            Ok(run) => {
                let suspects = cause::suspects(&run);
                let is_nan = run.outputs.iter().any(|x| x.is_nan());
                let events = run.events.into_iter();
                let sites = events
                    .filter(|((_, rule), _)| *rule != Rule::NanOutput || is_nan)
                    .map(|(site, event)| (site, Some(event)))
                    .collect();
                Seen {
                    sites,
                    suspects: Some(suspects),
                }
            }
            Err(Error::Budget { span, .. }) => {
                let site = (self.loop_around(span), Rule::UnboundedLoop);
                Seen {
                    sites: BTreeMap::from([(site, None)]),
                    suspects: None,
                }
            }
            Err(_) => Seen::default(),
        }
    }

    /// Whether a point shows one site, and with what.
    fn still_shows(&self, point: &Point, site: Site) -> Option<Option<Event>> {
        match site.1 {
            Rule::VanishingSum | Rule::Underflow => self.shows_cause(point, site).map(Some),
            _ => self.shows(point).sites.remove(&site),
        }
    }

    /// The innermost loop around a place; the place itself, where the loop is in a function that calls this one.
    fn loop_around(&self, span: Span) -> u32 {
        let range = |number: u32| {
            self.program
                .code
                .spans
                .get(number as usize)
                .and_then(|s| s.to_range())
        };
        let here = span.to_range().unwrap_or(0..0);
        let around = loops(&self.program.code)
            .into_iter()
            .filter(|number| range(*number).is_some_and(|r| r.start <= here.start && here.end <= r.end));
        let innermost = around.min_by_key(|number| range(*number).map_or(0, |r| r.len()));
        let mut spans = self.program.code.spans.iter();
        let itself = || spans.position(|s| s.to_range() == span.to_range()).unwrap_or(0) as u32;
        innermost.unwrap_or_else(itself)
    }

    /// Tries that many points, or until the time is up.
    pub(super) fn explore(&mut self, points: usize, until: Instant) {
        let mut at = 0;
        while at < points && Instant::now() < until {
            let numbers: Vec<u64> = (at..(at + CHUNK).min(points)).map(|n| n as u64).collect();
            let shown: Vec<(Point, Seen)> = numbers
                .into_par_iter()
                .filter(|n| *n < ALWAYS || Instant::now() < until)
                .map(|n| {
                    let point = self.point(n);
                    let shown = self.shows(&point);
                    (point, shown)
                })
                .collect();
            for (point, seen) in shown {
                self.keep(&point, seen, until);
            }
            at += CHUNK;
        }
    }

    /// The point with a number: three at the edges for one at random.
    pub(super) fn point(&self, number: u64) -> Point {
        let mut seed = Seed::new(self.seed ^ number.wrapping_mul(0x2545_f491_4f6c_dd1d));
        let style = if number % 4 == 3 {
            Style::Random
        } else {
            Style::Edge
        };
        self.inputs.sample(&mut seed, style)
    }

    /// Looks for zeros of operands between points where they are above and below it, by bisection.
    pub(super) fn close_in(&mut self, sites: &BTreeSet<Site>, until: Instant) {
        let samples: Vec<(Point, BTreeMap<u32, f64>)> = (0..SAMPLED)
            .into_par_iter()
            .filter(|_| Instant::now() < until)
            .filter_map(|n| {
                let point = self.point(n);
                let run = run::<F32>(self.program, self.inputs, &point, self.seed).ok()?;
                Some((point, run.margins))
            })
            .collect();
        for site in sites {
            let value = |sample: &(Point, BTreeMap<u32, f64>)| sample.1.get(&site.0).copied();
            let above = samples.iter().filter(|s| value(s).is_some_and(|x| x > 0.0));
            let below = samples.iter().filter(|s| value(s).is_some_and(|x| x < 0.0));
            for (a, b) in above.zip(below).take(PAIRS) {
                if self.found.contains_key(site) || Instant::now() > until {
                    break;
                }
                self.bisect(*site, &a.0, &b.0, until);
            }
        }
    }

    fn bisect(&mut self, site: Site, above: &Point, below: &Point, until: Instant) {
        let (mut above, mut below) = (above.clone(), below.clone());
        for _ in 0..BISECTIONS {
            if Instant::now() > until {
                return;
            }
            let Some(middle) = self.inputs.between_points(&above, &below) else {
                return;
            };
            if middle == above || middle == below || self.attempt(&middle, until).contains(&site) {
                return;
            }
            let run = run::<F32>(self.program, self.inputs, &middle, self.seed);
            match run.ok().and_then(|run| run.margins.get(&site.0).copied()) {
                Some(x) if x > 0.0 => above = middle,
                Some(x) if x < 0.0 => below = middle,
                Some(_) | None => return,
            }
        }
    }

    /// Tries one point, if the inputs admit it; what it newly shows.
    pub(super) fn attempt(&mut self, point: &Point, until: Instant) -> BTreeSet<Site> {
        if !self.inputs.admits(point) {
            return BTreeSet::new();
        }
        let seen = self.shows(point);
        self.keep(point, seen, until);
        self.found.keys().copied().collect()
    }

    fn keep(&mut self, point: &Point, seen: Seen, until: Instant) {
        let causes = match &seen.suspects {
            Some(suspects) => self.causes(point, suspects, until),
            None => Vec::new(),
        };
        let causes = causes.into_iter().map(|(site, event)| (site, Some(event)));
        for (site, event) in seen.sites.into_iter().chain(causes) {
            self.found.entry(site).or_insert_with(|| Shown {
                point: point.clone(),
                event,
            });
        }
    }

    /// Makes witnesses simpler, while they still show what they show.
    pub(super) fn simplify(&mut self, until: Instant) {
        let sites: Vec<Site> = self.found.keys().copied().collect();
        for site in sites {
            for at in 0..self.inputs.groups.len() {
                if Instant::now() > until {
                    return;
                }
                self.simplify_group(site, at);
            }
        }
    }

    fn simplify_group(&mut self, site: Site, at: usize) {
        let group = &self.inputs.groups[at];
        let Some(shown) = self.found.get(&site) else {
            return;
        };
        let n = group.scalars.len();
        let mut plain: Vec<Vec<f64>> = [0.0, 1.0, 0.5].map(|x| vec![x; n]).to_vec();
        if group.values == Values::Unit {
            plain = (0..n)
                .rev()
                .map(|axis| (0..n).map(|k| f64::from(u8::from(k == axis))).collect())
                .collect();
        }
        let current = shown.point.clone();
        for values in plain {
            if current.values[group.scalars.clone()] == values[..] {
                return;
            }
            if !group.admits(&values) {
                continue;
            }
            let mut simpler = current.clone();
            simpler.values[group.scalars.clone()].copy_from_slice(&values);
            if let Some(event) = self.still_shows(&simpler, site) {
                self.found.insert(
                    site,
                    Shown {
                        point: simpler,
                        event,
                    },
                );
                return;
            }
        }
    }
}

/// Span numbers of all loops.
fn loops(code: &Code) -> Vec<u32> {
    fn within(nodes: &[Node], out: &mut Vec<u32>) {
        for node in nodes {
            match node {
                Node::If { accept, reject, .. } => [accept, reject].into_iter().for_each(|b| within(b, out)),
                Node::Switch { cases, .. } => cases.iter().for_each(|case| within(&case.body, out)),
                Node::Loop(l) => {
                    out.push(l.span);
                    within(&l.body, out);
                    within(&l.continuing, out);
                }
                Node::Run(_)
                | Node::Break
                | Node::Continue
                | Node::Return
                | Node::Kill
                | Node::Barrier
                | Node::Call { .. } => {}
            }
        }
    }
    let mut out = Vec::new();
    code.functions
        .iter()
        .for_each(|function| within(&function.body, &mut out));
    out
}
