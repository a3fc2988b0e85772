//! Accuracy cases: every built-in function and operator of floats, one shader each, over random and hard arguments.
//!
//! The expectation is the acceptance interval of the very module that is run ([`Accept`]), the truth the same module over
//! float64 ([`F64`]). This is the check of both sides: a driver that leaves an interval breaks a rule of the language, or the
//! interval is wrong. What a driver is known to break is listed in [`crate::deviation`], each with a witness that is run first.

pub mod functions;
pub mod inputs;

use bossage_bounds::{Accept, F64, Limits, Program, run_probe as evaluate};
use bossage_runner::run_probe;
use bossage_shaders::AssembledShader;
use bossage_translate::{Shader, Source};

use crate::bench::Bench;
use crate::bound::Bound;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::Expected;
use crate::deviation::{self, Deviation, Judged};
use crate::module::Module;
use crate::route::Prepared;
use functions::Function;

/// Evaluations of one function in an ordinary run.
pub const ORDINARY: usize = 10_000;
/// Evaluations of one function in a full run.
pub const FULL: usize = 10_000_000;

/// Evaluations that are generated, run and judged at a time.
const PART: usize = 100_000;

const ENTRY: &str = "accuracy";
/// What stands for a technique in the names of these cases.
pub const TECHNIQUE: &str = "accuracy";

/// One function.
struct AccuracyCase {
    id: CaseId,
    function: &'static Function,
    count: usize,
    seed: u64,
}

/// The cases of all functions.
pub fn cases(full: bool, seed: u64) -> impl Iterator<Item = Box<dyn Case>> {
    let count = if full { FULL } else { ORDINARY };
    functions::ALL
        .iter()
        .map(move |function| Box::new(AccuracyCase::new(function, count, seed)) as Box<dyn Case>)
}

/// The shader of a function: arguments `x` and `y` in, the result out.
#[must_use]
pub fn shader(function: &Function) -> String {
    format!(
        "@group(0) @binding(0) var<storage, read> inputs: array<f32>;
@group(0) @binding(1) var<storage, read_write> outputs: array<f32>;

@compute @workgroup_size(64)
fn {ENTRY}(@builtin(global_invocation_id) id: vec3u) {{
    let i = id.x;
    if i >= arrayLength(&outputs) {{
        return;
    }}
    let x = inputs[2u * i];
    let y = inputs[2u * i + 1u];
    outputs[i] = {};
}}
",
        function.expression
    )
}

impl AccuracyCase {
    fn new(function: &'static Function, count: usize, seed: u64) -> Self {
        let id = CaseId::new(TECHNIQUE, None, "random")
            .with("fn", function.name)
            .with("n", count)
            .with("seed", seed);
        Self {
            id,
            function,
            count,
            seed,
        }
    }

    /// Runs the function on every bench: what is expected is computed once for all of them.
    fn judge(&self, benches: &[Bench<'_>]) -> Result<Vec<Outcome>, String> {
        let text = shader(self.function);
        let assembled = AssembledShader {
            name: format!("{ENTRY}_{}", self.function.name),
            wgsl: text.clone(),
            features: Vec::new(),
            modules: Vec::new(),
        };
        let program = program(&text)?;
        let subject = format!("accuracy/{}", self.function.name);
        let mut trials: Vec<Trial<'_, '_>> = benches
            .iter()
            .map(|bench| Trial::new(bench, &assembled, &subject))
            .collect();
        for trial in &mut trials {
            trial.run_witness(&program)?;
        }
        for part in 0..self.count.div_ceil(PART) {
            let count = PART.min(self.count - part * PART);
            let values = inputs::generate(self.function, count, part, self.seed);
            let expected = expected(&program, &values)?;
            for trial in &mut trials {
                trial.run(&values, &expected);
            }
        }
        Ok(trials
            .into_iter()
            .map(|trial| trial.outcome(self.count))
            .collect())
    }
}

/// One function on one bench. What goes wrong there ends this trial and no other.
struct Trial<'a, 'b> {
    bench: &'a Bench<'b>,
    known: Option<&'static Deviation>,
    state: Result<(Prepared, Judged), String>,
}

impl<'a, 'b> Trial<'a, 'b> {
    fn new(bench: &'a Bench<'b>, assembled: &AssembledShader, subject: &str) -> Self {
        let known = deviation::of(subject, bench.route, bench.device.info());
        let prepared = bench.route.prepare(assembled);
        Self {
            bench,
            known,
            state: prepared.map(|prepared| (prepared, Judged::new(known))),
        }
    }

    fn run_witness(&mut self, program: &Program) -> Result<(), String> {
        if let Some(known) = self.known {
            let expected = expected(program, known.witness)?;
            self.run(known.witness, &expected);
        }
        Ok(())
    }

    /// Runs pairs of arguments and judges what comes back.
    fn run(&mut self, values: &[f32], expected: &[Expected]) {
        let Ok((prepared, judged)) = &mut self.state else {
            return;
        };
        match run_pairs(self.bench, prepared, values) {
            Ok(got) => {
                for ((item, got), expected) in values.chunks_exact(2).zip(&got).zip(expected) {
                    judged.item(item, &[*got], &[*expected]);
                }
            }
            Err(problem) => self.state = Err(problem),
        }
    }

    fn outcome(self, inputs: usize) -> Outcome {
        match self.state {
            Ok((_, judged)) => judged.outcome(inputs, 1.0),
            Err(problem) => Outcome::failed(problem),
        }
    }
}

fn run_pairs(bench: &Bench<'_>, prepared: &Prepared, values: &[f32]) -> Result<Vec<f32>, String> {
    let shader = prepared.shader(ENTRY)?;
    let items = values.len() / 2;
    run_probe(bench.device, shader.code, shader.entry, values, 1, items).map_err(|error| with_causes(&error))
}

fn program(text: &str) -> Result<Program, String> {
    let parsed = Shader::parse(ENTRY, &Source::Wgsl(text.to_owned())).map_err(|d| d.to_string())?;
    let (module, info) = parsed
        .module(ENTRY)
        .ok_or_else(|| format!("no entry point `{ENTRY}`"))?;
    Program::new(module, info, ENTRY).map_err(|error| with_causes(&error))
}

fn expected(program: &Program, values: &[f32]) -> Result<Vec<Expected>, String> {
    let items = values.len() / 2;
    let limits = Limits::default();
    let (bounds, _) =
        evaluate::<Accept>(program, values, items, items, &limits).map_err(|e| with_causes(&e))?;
    let (truth, _) = evaluate::<F64>(program, values, items, items, &limits).map_err(|e| with_causes(&e))?;
    let pairs = truth.into_iter().zip(bounds);
    Ok(pairs
        .map(|(truth, interval)| Expected {
            truth,
            bound: Bound::from(interval),
        })
        .collect())
}

impl Case for AccuracyCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        vec!["acceptance interval", "float64 evaluation of the same module"]
    }

    fn arguments(&self) -> Vec<String> {
        (self.count == FULL)
            .then(|| "--full".to_owned())
            .into_iter()
            .collect()
    }

    /// None of the library: the shader is the function.
    fn modules(&self) -> Result<Vec<Module>, String> {
        Ok(Vec::new())
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.run_all(std::slice::from_ref(bench)).remove(0)
    }

    fn run_all(&self, benches: &[Bench<'_>]) -> Vec<Outcome> {
        self.judge(benches)
            .unwrap_or_else(|problem| benches.iter().map(|_| Outcome::failed(&*problem)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::Comparison;

    fn find(name: &str) -> &'static Function {
        functions::ALL
            .iter()
            .find(|function| function.name == name)
            .unwrap()
    }

    #[test]
    fn every_shader_is_valid_and_has_arguments_on_which_the_rules_speak() {
        for function in functions::ALL {
            let values = inputs::generate(function, 2_000, 0, 1);
            let expected = expected(&program(&shader(function)).unwrap(), &values).unwrap();
            let decided = expected.iter().filter(|e| e.bound.is_decided()).count();
            assert!(decided >= 400, "{}: {decided} of 2000 are decided", function.name);
        }
    }

    /// The two domains are two oracles on one module: the truth lies in the interval.
    #[test]
    fn the_formula_lies_in_the_interval() {
        for function in functions::ALL {
            let values = inputs::generate(function, 2_000, 1, 7);
            let expected = expected(&program(&shader(function)).unwrap(), &values).unwrap();
            for (item, e) in values.chunks_exact(2).zip(expected) {
                let mut one = Comparison::default();
                one.item(item, &[e.bound.low() as f32], &[e]);
                let disagree = one.refusal == Some(crate::compare::Refusal::OraclesDisagree);
                assert!(!disagree, "{} of {item:?}: {e:?}", function.name);
            }
        }
    }

    /// Negative control for every rule: results just beyond the interval are refused, and a machine that is off by one part in
    /// a hundred is caught within the first inputs.
    #[test]
    fn a_machine_that_breaks_a_rule_is_caught() {
        for function in functions::ALL {
            let values = inputs::generate(function, 2_000, 2, 3);
            let expected = expected(&program(&shader(function)).unwrap(), &values).unwrap();
            let (mut beyond, mut off) = (0, 0);
            for (item, e) in values
                .chunks_exact(2)
                .zip(expected)
                .filter(|(_, e)| e.bound.is_decided())
            {
                let refused = |got: f32| {
                    let mut one = Comparison::default();
                    one.item(item, &[got], &[e]);
                    one.refused
                };
                let high = e.bound.high() as f32;
                let step = if f64::from(high) > e.bound.high() {
                    high
                } else {
                    high.next_up()
                };
                if step.is_finite()
                    && !step.is_subnormal()
                    && f64::from(step) > e.bound.high() * (1.0 + 1e-12)
                {
                    assert_eq!(refused(step), 1, "{} of {item:?}: {step:e}", function.name);
                    beyond += 1;
                }
                off += refused((1.02 * e.truth + 0.01) as f32);
            }
            assert!(
                beyond > 0 && off > 0,
                "{}: {beyond} beyond, {off} off",
                function.name
            );
        }
    }

    #[test]
    fn deviations_name_functions_that_there_are() {
        for known in deviation::ALL {
            if let Some(function) = known.subject.strip_prefix("accuracy/") {
                assert_eq!(find(function).name, function);
            }
        }
    }
}
