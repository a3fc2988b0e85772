//! Probe cases: one function of the library over hand-picked, hard and random inputs.

use std::sync::OnceLock;

use bossage_runner::run_probe;
use bossage_shaders::{Form, PROBES, Probe, Technique};
use rayon::prelude::*;

use crate::bench::Bench;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::generate::{Inputs, control, edge, random, spaced};
use crate::module::Module;
use crate::oracle;
use crate::tolerance::UNDECIDED_LIMIT;

/// Random items of one probe in an ordinary run.
pub const ORDINARY: usize = 10_000;
/// Random items of one probe in a full run.
pub const FULL: usize = 1_000_000;

/// Items that are generated, run and judged at a time. Expectations of a case with one part are kept between routes; longer
/// ones compute them again, to save memory.
const PART: usize = ORDINARY;

/// Where the inputs come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Generator {
    Control,
    Edge,
    Spaced { count: usize },
    Random { count: usize, seed: u64 },
}

/// One function with one generator.
struct ProbeCase {
    id: CaseId,
    probe: &'static Probe,
    generator: Generator,
    prepared: OnceLock<(Inputs, Vec<Vec<Expected>>)>,
}

/// The cases of all probes.
pub fn cases(full: bool, seed: u64) -> impl Iterator<Item = Box<dyn Case>> {
    let (count, spaced) = if full {
        (FULL, spaced::FULL)
    } else {
        (ORDINARY, spaced::ORDINARY)
    };
    let generators = [
        Generator::Control,
        Generator::Edge,
        Generator::Spaced { count: spaced },
        Generator::Random { count, seed },
    ];
    PROBES
        .iter()
        .flat_map(move |probe| generators.map(|generator| (probe, generator)))
        .filter(|(probe, generator)| *generator != Generator::Control || !control::rows(probe).is_empty())
        .map(|(probe, generator)| Box::new(ProbeCase::new(probe, generator)) as Box<dyn Case>)
}

/// `technique[/form]/generator:params` of a probe: the form only where the technique has two.
#[must_use]
pub fn id(probe: &Probe, generator: &str) -> CaseId {
    let both = Technique::find(probe.technique).is_some_and(|technique| technique.forms.len() > 1);
    let id = CaseId::new(probe.technique, both.then(|| probe.form.as_str()), generator);
    if probe.function() == probe.technique {
        id
    } else {
        id.with("fn", probe.function())
    }
}

impl ProbeCase {
    fn new(probe: &'static Probe, generator: Generator) -> Self {
        let id = match generator {
            Generator::Control => id(probe, "control"),
            Generator::Edge => id(probe, "edge"),
            Generator::Spaced { count } => id(probe, "spaced").with("n", count),
            Generator::Random { count, seed } => id(probe, "random").with("n", count).with("seed", seed),
        };
        Self {
            id,
            probe,
            generator,
            prepared: OnceLock::new(),
        }
    }

    fn parts(&self) -> usize {
        match self.generator {
            Generator::Control | Generator::Edge => 1,
            Generator::Spaced { count } | Generator::Random { count, .. } => count.div_ceil(PART),
        }
    }

    fn inputs(&self, part: usize) -> Inputs {
        match self.generator {
            Generator::Control => control::generate(self.probe),
            Generator::Edge => edge::generate(self.probe),
            Generator::Spaced { count } => {
                spaced::generate(self.probe, part * PART, PART.min(count - part * PART))
            }
            Generator::Random { count, seed } => {
                random::generate(self.probe, PART.min(count - part * PART), part, seed)
            }
        }
    }

    /// The outputs expected of each item; for control cases the known answers replace the truth, so that both oracles are
    /// checked against a third.
    fn expectations(&self, inputs: &Inputs) -> Vec<Vec<Expected>> {
        let items: Vec<&[f32]> = inputs.items().collect();
        let of = |item: &&[f32]| oracle::expected(self.probe, item).unwrap_or_default();
        let mut expected: Vec<Vec<Expected>> = items.par_iter().map(of).collect();
        if self.generator == Generator::Control {
            for (item, row) in expected.iter_mut().zip(control::rows(self.probe)) {
                item.iter_mut()
                    .zip(row.outputs)
                    .for_each(|(e, known)| e.truth = *known);
            }
        }
        expected
    }

    /// A part's inputs with what is expected of them.
    fn make(&self, part: usize) -> (Inputs, Vec<Vec<Expected>>) {
        let inputs = self.inputs(part);
        let expected = self.expectations(&inputs);
        (inputs, expected)
    }

    fn compare(
        &self,
        bench: &Bench<'_>,
        inputs: &Inputs,
        expected: &[Vec<Expected>],
    ) -> Result<Comparison, String> {
        let probe = self.probe;
        let module = bench.module(&Module::Probe(probe.id))?;
        let shader = module.shader(probe.entry)?;
        let got = run_probe(
            bench.device,
            shader.code,
            shader.entry,
            &inputs.values,
            probe.output_floats,
            inputs.len(),
        )
        .map_err(|error| with_causes(&error))?;
        let compared = inputs.items().zip(got.chunks(probe.output_floats)).zip(expected);
        Ok(
            compared.fold(Comparison::default(), |mut all, ((input, got), expected)| {
                all.item(input, got, expected);
                all
            }),
        )
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        if self.parts() == 1 {
            let (inputs, expected) = self.prepared.get_or_init(|| self.make(0));
            let comparison = self.compare(bench, inputs, expected)?;
            return Ok(Outcome::of(inputs.len(), comparison, self.undecided_limit()));
        }
        let (mut all, mut items) = (Comparison::default(), 0);
        for part in 0..self.parts() {
            let (inputs, expected) = self.make(part);
            all.merge(self.compare(bench, &inputs, &expected)?);
            items += inputs.len();
        }
        Ok(Outcome::of(items, all, self.undecided_limit()))
    }

    /// Only random and spaced cases of hardened functions stay inside the documented domain.
    fn undecided_limit(&self) -> f64 {
        match (self.generator, self.probe.form) {
            (Generator::Spaced { .. } | Generator::Random { .. }, Form::Hardened) => UNDECIDED_LIMIT,
            (Generator::Spaced { .. } | Generator::Random { .. }, Form::Published)
            | (Generator::Control | Generator::Edge, _) => 1.0,
        }
    }
}

impl Case for ProbeCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        let known = (self.generator == Generator::Control).then_some("known answers");
        known.into_iter().chain(oracle::BASIS).collect()
    }

    fn arguments(&self) -> Vec<String> {
        let full = matches!(
            self.generator,
            Generator::Random { count: FULL, .. } | Generator::Spaced { count: spaced::FULL }
        );
        full.then(|| "--full".to_owned()).into_iter().collect()
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        Ok(vec![Module::Probe(self.probe.id)])
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}

#[cfg(test)]
mod tests {
    use bossage_shaders::PROBES;

    use super::id;

    #[test]
    fn names_follow_the_technique() {
        let name = |function: &str| {
            id(
                PROBES.iter().find(|probe| probe.function() == function).unwrap(),
                "edge",
            )
            .to_string()
        };
        assert_eq!(name("parallax_offset"), "parallax_offset/hardened/edge");
        assert_eq!(
            name("parallax_offset_published"),
            "parallax_offset/published/edge:fn=parallax_offset_published"
        );
        assert_eq!(name("parallax_offset_limited"), "parallax_offset_limited/edge");
        assert_eq!(
            name("highlight_power"),
            "blinn_phong/hardened/edge:fn=highlight_power"
        );
    }
}
