//! A user's shader: the error is that of a perfect machine against the formula in f64, the interval that of its own IR. All outputs
//! are hunted as one. Of a stage that is drawn all four invocations of an input get the same, so derivatives are zero.

use std::time::Duration;

use bossage_bounds::ranges::{Declared, Point, Seed, Style};
use bossage_translate::Shader;
use rayon::prelude::*;

use super::{Goal, Hunted, Measured, Options, Prey, Score, Subject, Told, finding, hunt as hunt_subject};
use crate::case::with_causes;
use crate::compare::NamedInput;
use crate::error::Error;
use crate::ulp::error_ulps;
use crate::user::{self, Found, Plan, Ready};

/// Hunts the entry points of a shader.
///
/// # Errors
/// As [`user::run`].
pub fn hunt(
    shader: &Shader,
    declared: Option<&Declared>,
    user_options: &user::Options,
    options: &Options,
    told: Told<'_>,
) -> Result<Hunted, Error> {
    let plans = user::plans(shader, declared, user_options)?;
    let time = options.time.map(|time| time.div_f64(plans.len().max(1) as f64));
    let mut hunted = Hunted::default();
    for plan in &plans {
        told(&plan.entry);
        let name = format!("{}/{}", plan.shader, plan.entry);
        let one = plan
            .ready
            .as_ref()
            .map_err(Clone::clone)
            .and_then(|ready| of_entry(plan, ready, options, time));
        match one {
            Ok(one) => hunted.add(one),
            Err(reason) => hunted.skipped.push((name, reason)),
        }
    }
    Ok(hunted)
}

fn of_entry(plan: &Plan, ready: &Ready, options: &Options, time: Option<Duration>) -> Result<Hunted, String> {
    let subject = ShaderSubject { plan, ready };
    let (prey, evaluated) = hunt_subject(&subject, options, time)?;
    Ok(Hunted {
        findings: prey
            .iter()
            .map(|one| finding(&subject, one, options.seed))
            .collect(),
        kept: prey.iter().map(|one| kept(&subject, one, options.seed)).collect(),
        evaluated: vec![(subject.name(), evaluated)],
        ..Hunted::default()
    })
}

/// As the shader's corpus has it.
fn kept(subject: &ShaderSubject<'_>, prey: &Prey, seed: u64) -> Found {
    let [inputs, texels] = Found::tables(&subject.ready.inputs, &prey.point);
    Found {
        entry: subject.plan.entry.clone(),
        goal: prey.goal,
        output: subject.output(prey.score.output),
        ulps: prey.score.ulps,
        seed,
        inputs,
        texels,
    }
}

struct ShaderSubject<'a> {
    plan: &'a Plan,
    ready: &'a Ready,
}

impl Subject for ShaderSubject<'_> {
    fn name(&self) -> String {
        format!("{}/{}", self.plan.shader, self.plan.entry)
    }

    fn keys(&self) -> usize {
        1
    }

    fn groups(&self) -> Vec<std::ops::Range<usize>> {
        let groups = self.ready.inputs.groups.iter();
        groups.map(|group| group.scalars.clone()).collect()
    }

    fn sample(&self, seed: &mut Seed) -> Point {
        let style = if seed.below(2) == 0 {
            Style::Edge
        } else {
            Style::Random
        };
        self.ready.inputs.sample(seed, style)
    }

    fn is_free(&self, _group: &std::ops::Range<usize>) -> bool {
        true
    }

    fn mend(&self, point: &mut Point) {
        self.ready.inputs.mend(point);
    }

    fn measure(&self, points: &[Point]) -> Result<Vec<Measured>, String> {
        points.par_iter().map(|point| self.at(point)).collect()
    }

    fn output(&self, output: usize) -> String {
        self.ready.name(output)
    }

    fn inputs(&self, point: &Point, output: usize) -> Vec<NamedInput> {
        self.ready.named_inputs(point, &self.ready.name(output))
    }
}

impl ShaderSubject<'_> {
    fn at(&self, point: &Point) -> Result<Measured, String> {
        let ready = self.ready;
        let points = ready.alike(point);
        let expected = user::expect::at(ready, &points).map_err(|error| with_causes(&error))?;
        let got = user::expect::perfect(ready, &points).map_err(|error| with_causes(&error))?;
        let mut measured = Measured::of(1);
        for (output, (got, allowed)) in got.iter().zip(&expected.allowed).enumerate() {
            let bound = user::judge::bound(allowed);
            let x = user::judge::number(got);
            if !bound.contains(x) {
                measured.refused.get_or_insert((output, x));
            }
            if !bound.is_settled() {
                continue;
            }
            if let Some(ulps) = bound.width_ulps() {
                measured.keep(0, Goal::Width, Score { ulps, output });
            }
            let formula = expected
                .formula
                .as_ref()
                .and_then(|all| user::judge::formula(&all[output]));
            if let Some(truth) = formula.filter(|truth| bound.contains(*truth)) {
                let ulps = error_ulps(x, truth);
                measured.keep(0, Goal::Error, Score { ulps, output });
            }
        }
        Ok(measured)
    }
}
