//! Probe cases: one function of the library over hand-picked, hard and random inputs.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use bossage_runner::run_probe;
use bossage_shaders::{Form, PROBES, Probe, Technique};

use crate::bench::Bench;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::generate::{Inputs, control, edge, random, spaced};
use crate::hunt::corpus::{self, Corpus};
use crate::module::Module;
use crate::oracle;
use crate::route::Prepared;
use crate::undecided;
use crate::verdict::Verdict;
use crate::width::{self, golden};

/// Random items of one probe in an ordinary run.
pub const ORDINARY: usize = 10_000;
/// Random items of one probe in a full run.
pub const FULL: usize = 1_000_000;

/// Items that are generated, run and judged at a time. Expectations of a case with one part are kept between routes; longer
/// ones compute them again, to save memory.
const PART: usize = ORDINARY;

/// Where the inputs come from.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Generator {
    Control,
    Edge,
    Spaced {
        count: usize,
    },
    Random {
        count: usize,
        seed: u64,
    },
    /// Hard inputs that a hunt found.
    Corpus(&'static Corpus),
}

/// Items with what is expected of them.
#[derive(Debug)]
struct Part {
    inputs: Inputs,
    expected: Vec<Vec<Expected>>,
    /// The assembled shader that the intervals belong to.
    text: String,
}

/// One function with one generator.
struct ProbeCase {
    id: CaseId,
    probe: &'static Probe,
    generator: Generator,
    /// Kept between routes and adapters, as long as they run the same shader.
    prepared: Mutex<Option<Arc<Part>>>,
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
    let hunted = |probe: &Probe| corpora().iter().find(|corpus| corpus.probe == probe.function());
    PROBES
        .iter()
        .flat_map(move |probe| {
            let corpus = hunted(probe).map(Generator::Corpus);
            generators
                .into_iter()
                .chain(corpus)
                .map(move |generator| (probe, generator))
        })
        .filter(|(probe, generator)| *generator != Generator::Control || !control::rows(probe).is_empty())
        .map(|(probe, generator)| Box::new(ProbeCase::new(probe, generator)) as Box<dyn Case>)
}

/// The embedded corpora, read once. They are part of the program: a wrong one ends it, and a test finds it before.
fn corpora() -> &'static [Corpus] {
    static READ: OnceLock<Vec<Corpus>> = OnceLock::new();
    READ.get_or_init(|| corpus::embedded().unwrap_or_else(|why| panic!("the embedded corpus: {why}")))
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

/// The form that names of cases have for a technique's hardened form: none where there is but one.
pub(crate) fn form_of(technique: &str) -> Option<&'static str> {
    let both = Technique::find(technique).is_some_and(|technique| technique.forms.len() > 1);
    both.then(|| Form::Hardened.as_str())
}

impl ProbeCase {
    fn new(probe: &'static Probe, generator: Generator) -> Self {
        let id = match generator {
            Generator::Control => id(probe, "control"),
            Generator::Edge => id(probe, "edge"),
            Generator::Spaced { count } => id(probe, "spaced").with("n", count),
            Generator::Random { count, seed } => id(probe, "random").with("n", count).with("seed", seed),
            Generator::Corpus(_) => id(probe, "corpus"),
        };
        Self {
            id,
            probe,
            generator,
            prepared: Mutex::default(),
        }
    }

    fn parts(&self) -> usize {
        match self.generator {
            Generator::Control | Generator::Edge | Generator::Corpus(_) => 1,
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
            Generator::Corpus(corpus) => {
                let mut inputs = Inputs::of(self.probe);
                for found in &corpus.found {
                    inputs.values.extend(&found.input);
                }
                inputs
            }
            Generator::Random { count, seed } => {
                random::generate(self.probe, PART.min(count - part * PART), part, seed)
            }
        }
    }

    /// A part's inputs with the outputs expected of each item. For control cases the known answers replace the truth, so that
    /// both oracles are checked against a third.
    fn make(&self, module: &Prepared, part: usize) -> Result<Part, String> {
        let inputs = self.inputs(part);
        let program = module.program(self.probe.entry)?;
        let mut expected = oracle::expected(self.probe, &program, &inputs)?;
        if self.generator == Generator::Control {
            for (item, row) in expected.iter_mut().zip(control::rows(self.probe)) {
                item.iter_mut()
                    .zip(row.outputs)
                    .for_each(|(e, known)| e.truth = *known);
            }
        }
        Ok(Part {
            inputs,
            expected,
            text: module.text().to_owned(),
        })
    }

    /// The only part of a short case, made once for each shader.
    fn only_part(&self, module: &Prepared) -> Result<Arc<Part>, String> {
        let mut kept = self.prepared.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(part) = kept.as_ref().filter(|part| part.text == module.text()) {
            return Ok(Arc::clone(part));
        }
        let part = Arc::new(self.make(module, 0)?);
        *kept = Some(Arc::clone(&part));
        Ok(part)
    }

    fn compare(&self, bench: &Bench<'_>, module: &Prepared, part: &Part) -> Result<Comparison, String> {
        let (probe, inputs) = (self.probe, &part.inputs);
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
        let mut all = self.comparison();
        let compared = inputs.items().zip(got.chunks(probe.output_floats));
        for ((input, got), expected) in compared.zip(&part.expected) {
            all.item(input, got, expected);
        }
        Ok(all)
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let module = bench.module(&Module::Probe(self.probe.id))?;
        let (mut all, mut items, mut wider) = (self.comparison(), 0, None);
        for index in 0..self.parts() {
            let part = if self.parts() == 1 {
                self.only_part(&module)?
            } else {
                Arc::new(self.make(&module, index)?)
            };
            all.merge(self.compare(bench, &module, &part)?);
            items += part.inputs.len();
            if index == 0 && self.has_reviewed_widths() {
                wider = golden::wider(self.probe, &width::measure(self.probe, &part.expected));
            }
        }
        let outcome = Outcome::of(items, all, self.undecided_limit());
        Ok(match (outcome.verdict, wider) {
            (Verdict::Pass | Verdict::Warn, Some(reason)) => Outcome {
                verdict: Verdict::Fail,
                reason: Some(reason),
                ..outcome
            },
            (Verdict::Pass | Verdict::Warn | Verdict::Fail | Verdict::Skip | Verdict::ExpectedFail, _) => {
                outcome
            }
        })
    }

    /// The table of widths was made from the first part of the usual stream.
    fn has_reviewed_widths(&self) -> bool {
        match self.generator {
            Generator::Random { count, seed } => count >= width::ITEMS && seed == random::SEED,
            Generator::Control | Generator::Edge | Generator::Spaced { .. } | Generator::Corpus(_) => false,
        }
    }

    /// Random inputs of hardened functions lie in the documented domain, where the rules must not leave anything open. Where the
    /// answer is known on paper there must be one alone.
    fn comparison(&self) -> Comparison {
        match (self.generator, self.probe.form) {
            (Generator::Control, _) => Comparison::demanding_one_answer(),
            (Generator::Random { .. }, Form::Hardened) => Comparison::demanding_answers(),
            (Generator::Random { .. }, Form::Published)
            | (Generator::Edge | Generator::Spaced { .. } | Generator::Corpus(_), _) => Comparison::default(),
        }
    }

    /// Edge inputs lie on the borders of the domain on purpose, and published forms are undefined in places: these are counted and not
    /// limited.
    fn undecided_limit(&self) -> f64 {
        let limit = |inputs| undecided::limit(self.probe.function(), inputs);
        match (self.generator, self.probe.form) {
            (Generator::Random { .. }, Form::Hardened) => limit(undecided::Inputs::Random),
            (Generator::Spaced { .. }, Form::Hardened) => limit(undecided::Inputs::Spaced),
            (Generator::Random { .. } | Generator::Spaced { .. }, Form::Published)
            | (Generator::Control | Generator::Edge | Generator::Corpus(_), _) => 1.0,
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
