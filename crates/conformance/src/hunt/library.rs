//! Probes of the library: the truth is the reference's, the interval that of the shader's own IR, what came back a machine's.

use std::time::Duration;

use bossage_bounds::Program;
use bossage_bounds::ranges::{Point, Seed};
use bossage_runner::run_probe;
use bossage_shaders::{Library, Probe};
use rand::RngExt;

use super::corpus::{Corpus, Found};
use super::{Goal, Hunted, Measured, Options, Score, Subject, Told, finding, hunt as hunt_subject, role};
use crate::bench::Bench;
use crate::case::with_causes;
use crate::compare::NamedInput;
use crate::error::Error;
use crate::generate::{Inputs, random};
use crate::machines::Pairs;
use crate::module::Module;
use crate::oracle;
use crate::route::{Prepared, Route};
use crate::run::Selection;
use crate::ulp::error_ulps;

/// Hunts the probes whose names hold the filter, on the first machine of the selection: `embedded` unless routes or adapters are named.
///
/// # Errors
/// [`Error::NoSuchCase`] when the filter finds no probe, and as [`Selection::pairs`].
pub fn hunt(
    options: &Options,
    selection: &Selection,
    library: &Library,
    told: Told<'_>,
) -> Result<Hunted, Error> {
    let probes = super::probes(options.filter.as_deref());
    if probes.is_empty() {
        return Err(Error::NoSuchCase {
            filter: options.filter.clone().unwrap_or_default(),
            known: bossage_shaders::PROBES.len(),
        });
    }
    let mut selection = selection.clone();
    if selection.routes.is_empty() && selection.adapters.is_empty() {
        selection.routes = vec![Route::Embedded];
    }
    let pairs: Pairs = selection.pairs()?;
    let machines = pairs.open()?;
    let benches = machines.benches(library);
    let bench = benches
        .first()
        .ok_or(Error::Adapter(bossage_runner::Error::NoAdapter))?;
    let mut hunted = Hunted::default();
    let share = options.time.map(|time| time.div_f64(probes.len() as f64));
    for probe in probes {
        told(probe.function());
        match of_probe(probe, bench, options, share) {
            Ok(one) => hunted.add(one),
            Err(reason) => hunted.skipped.push((probe.function().to_owned(), reason)),
        }
    }
    Ok(hunted)
}

impl Hunted {
    pub(super) fn add(&mut self, other: Self) {
        self.findings.extend(other.findings);
        self.evaluated.extend(other.evaluated);
        self.corpora.extend(other.corpora);
        self.kept.extend(other.kept);
        self.skipped.extend(other.skipped);
    }
}

fn of_probe(
    probe: &'static Probe,
    bench: &Bench<'_>,
    options: &Options,
    time: Option<Duration>,
) -> Result<Hunted, String> {
    let module = bench.module(&Module::Probe(probe.id))?;
    let program = module.program(probe.entry)?;
    let subject = ProbeSubject {
        probe,
        bench,
        module: &module,
        program: &program,
        fields: fields(probe),
    };
    let (prey, evaluated) = hunt_subject(&subject, options, time)?;
    let mut corpus = Corpus::new(probe.function());
    for one in &prey {
        corpus.found.push(Found {
            goal: one.goal,
            output: one.score.output,
            ulps: one.score.ulps,
            seed: options.seed,
            input: one.point.values.iter().map(|x| *x as f32).collect(),
        });
    }
    Ok(Hunted {
        findings: prey
            .iter()
            .map(|one| finding(&subject, one, options.seed))
            .collect(),
        evaluated: vec![(subject.name(), evaluated)],
        corpora: if corpus.found.is_empty() {
            Vec::new()
        } else {
            vec![corpus]
        },
        ..Hunted::default()
    })
}

/// Where each field's floats are.
fn fields(probe: &Probe) -> Vec<std::ops::Range<usize>> {
    let mut at = 0;
    let mut next = |n: usize| {
        at += n;
        at - n..at
    };
    probe
        .inputs
        .iter()
        .map(|field| next(field.shape.floats()))
        .collect()
}

struct ProbeSubject<'a> {
    probe: &'static Probe,
    bench: &'a Bench<'a>,
    module: &'a Prepared,
    program: &'a Program,
    fields: Vec<std::ops::Range<usize>>,
}

impl Subject for ProbeSubject<'_> {
    fn name(&self) -> String {
        self.probe.function().to_owned()
    }

    fn keys(&self) -> usize {
        self.probe.output_floats
    }

    fn groups(&self) -> Vec<std::ops::Range<usize>> {
        self.fields.clone()
    }

    fn sample(&self, seed: &mut Seed) -> Point {
        let mut rng = random::stream(self.probe.function(), seed.bits());
        let drawn = random::generate(self.probe, 1, 0, rng.random());
        Point {
            values: drawn.values.iter().map(|x| f64::from(*x)).collect(),
            texels: Vec::new(),
        }
    }

    fn is_free(&self, group: &std::ops::Range<usize>) -> bool {
        let at = self.fields.iter().position(|field| field == group);
        at.is_some_and(|at| role::is_free(&self.probe.inputs[at]))
    }

    fn mend(&self, point: &mut Point) {
        for (field, range) in self.probe.inputs.iter().zip(&self.fields) {
            role::mend(field, &mut point.values[range.clone()]);
        }
    }

    fn measure(&self, points: &[Point]) -> Result<Vec<Measured>, String> {
        let mut inputs = Inputs::of(self.probe);
        for point in points {
            inputs.values.extend(point.values.iter().map(|x| *x as f32));
        }
        let expected = oracle::expected(self.probe, self.program, &inputs)?;
        let shader = self.module.shader(self.probe.entry)?;
        let outputs = self.probe.output_floats;
        let got = run_probe(
            self.bench.device,
            shader.code,
            shader.entry,
            &inputs.values,
            outputs,
            inputs.len(),
        )
        .map_err(|error| with_causes(&error))?;
        let one = |(got, expected): (&[f32], &Vec<crate::compare::Expected>)| {
            let mut measured = Measured::of(outputs);
            for (output, (got, expected)) in got.iter().zip(expected).enumerate() {
                let got = f64::from(*got);
                if !expected.bound.contains(got) {
                    measured.refused.get_or_insert((output, got));
                }
                if expected.bound.is_settled() {
                    let error = error_ulps(got, expected.truth);
                    measured.keep(output, Goal::Error, Score { ulps: error, output });
                    if let Some(ulps) = expected.bound.width_ulps() {
                        measured.keep(output, Goal::Width, Score { ulps, output });
                    }
                }
            }
            measured
        };
        Ok(got.chunks(outputs).zip(&expected).map(one).collect())
    }

    fn output(&self, output: usize) -> String {
        output.to_string()
    }

    fn inputs(&self, point: &Point, _output: usize) -> Vec<NamedInput> {
        let fields = self.probe.inputs.iter().zip(&self.fields);
        fields
            .map(|(field, range)| NamedInput {
                name: field.name.to_owned(),
                values: point.values[range.clone()].to_vec(),
            })
            .collect()
    }
}
