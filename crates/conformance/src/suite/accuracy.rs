//! Accuracy cases: every built-in function and operator of floats, one shader each, over random and hard arguments.
//!
//! The expectation is the acceptance interval of the very module that is run ([`Accept`]), the truth the same module over
//! float64 ([`F64`]). This is the check of both sides: a driver that leaves an interval breaks a rule of the language, or the
//! interval is wrong. What a driver is known to break is listed in [`deviations`], each with a witness that is run first;
//! an entry whose witness no longer shows is a failure.

pub mod deviations;
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
use crate::compare::{Comparison, Expected};
use crate::module::Module;
use crate::verdict::Verdict;
use deviations::Deviation;
use functions::Function;

/// Evaluations of one function in an ordinary run.
pub const ORDINARY: usize = 10_000;
/// Evaluations of one function in a full run.
pub const FULL: usize = 10_000_000;

/// Evaluations that are generated, run and judged at a time.
const PART: usize = 100_000;

const ENTRY: &str = "accuracy";

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
        let id = CaseId::new("accuracy", None, "random")
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

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let text = shader(self.function);
        let assembled = AssembledShader {
            name: format!("{ENTRY}_{}", self.function.name),
            wgsl: text.clone(),
            features: Vec::new(),
            modules: Vec::new(),
        };
        let prepared = bench.route.prepare(&assembled)?;
        let program = program(&text)?;
        let known = deviations::of(self.function.name, bench.route, bench.device.info());
        let run = |values: &[f32]| -> Result<Comparison, String> {
            let shader = prepared.shader(ENTRY)?;
            let items = values.len() / 2;
            let got = run_probe(bench.device, shader.code, shader.entry, values, 1, items)
                .map_err(|error| with_causes(&error))?;
            let expected = expected(&program, values)?;
            let mut all = Comparison::default();
            for ((item, got), expected) in values.chunks_exact(2).zip(&got).zip(&expected) {
                all.item(item, &[*got], &[*expected]);
            }
            Ok(all)
        };
        let mut all = Comparison::default();
        if let Some(known) = known {
            let witness = run(&known.witness)?;
            if witness.refused == 0 {
                return Ok(stale(known, witness));
            }
            all.merge(witness);
        }
        for part in 0..self.count.div_ceil(PART) {
            let count = PART.min(self.count - part * PART);
            all.merge(run(&inputs::generate(self.function, count, part, self.seed))?);
        }
        Ok(verdict(self.count, all, known))
    }
}

/// A known deviation is an expected failure; anything else is judged as usual.
fn verdict(count: usize, comparison: Comparison, known: Option<&Deviation>) -> Outcome {
    let refused = comparison.refused;
    let outcome = Outcome::of(count, comparison, 1.0);
    match known {
        Some(known) if outcome.verdict == Verdict::Fail => Outcome {
            verdict: Verdict::ExpectedFail,
            reason: Some(format!(
                "{refused} of {} outputs: {}",
                outcome.comparison.outputs, known.reason
            )),
            ..outcome
        },
        Some(_) | None => outcome,
    }
}

fn stale(known: &Deviation, comparison: Comparison) -> Outcome {
    Outcome {
        inputs: 1,
        comparison,
        verdict: Verdict::Fail,
        reason: Some(format!(
            "the known deviation does not show at its witness any more ({}): take it out of the list",
            known.reason
        )),
    }
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
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::route::Route;

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
    fn a_deviation_is_expected_where_it_is_listed_and_stale_where_it_does_not_show() {
        let known = Deviation {
            route: None,
            driver: "none",
            function: "add",
            witness: [1.0, 2.0],
            reason: "never",
        };
        let mut bad = Comparison::default();
        let values = [1.0, 2.0];
        let e = expected(&program(&shader(find("add"))).unwrap(), &values).unwrap();
        bad.item(&values, &[4.0], &e);
        assert_eq!(
            verdict(1, bad.clone(), Some(&known)).verdict,
            Verdict::ExpectedFail
        );
        assert_eq!(verdict(1, bad, None).verdict, Verdict::Fail);
        let mut good = Comparison::default();
        good.item(&values, &[3.0], &e);
        assert_eq!(stale(&known, good).verdict, Verdict::Fail);
    }

    #[test]
    fn a_deviation_of_a_route_is_none_of_another() {
        let info = bossage_embedded::info();
        let of = |route| deviations::of("sign", route, &info).map(|known| known.route);
        assert_eq!(of(Route::Hlsl), Some(Some(Route::Hlsl)));
        assert_eq!((of(Route::Glsl), of(Route::Wgsl)), (None, None));
    }

    #[test]
    fn deviations_name_functions_that_there_are() {
        for known in deviations::ALL {
            assert!(
                functions::ALL.iter().any(|f| f.name == known.function),
                "{}",
                known.function
            );
        }
    }
}
