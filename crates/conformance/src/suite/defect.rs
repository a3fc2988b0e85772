//! Known defects of the published forms: each has a witness input and a property that the published form breaks there.
//!
//! The break is expected and reported as such. If the property holds, the defect is gone or the form is not what was
//! published: **that** is the failure. Where a hardened form exists, it must keep the property at the same witness.
//!
//! Two kinds of evidence. Most defects show in the output of every machine. Some only make the result *open*: at L = 0 the
//! published `dot3` clamps a NaN, and a machine that clamps NaN to 0 hides it. For those the witness is that the accuracy
//! rules leave the published form's result open and decide the hardened form's.

mod border;
mod codecs;
mod frames;
mod property;
mod relief;
mod shading;

use std::sync::Arc;

use bossage_runner::{is_unwritten, run_probe};
use bossage_shaders::{PROBES, Probe};

use super::probe;
use crate::bench::Bench;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::Comparison;
use crate::generate::Inputs;
use crate::module::Module;
use crate::oracle;
use crate::route::Prepared;
use crate::verdict::Verdict;

/// What should hold of one item's outputs; `Err` says how it does not.
type Property = fn(&[f32]) -> Result<(), String>;

/// What shows a defect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// The output breaks the property, on every machine.
    Output,
    /// The accuracy rules leave the result open; whether it shows is the machine's choice.
    Rules,
}

/// One known defect.
#[derive(Debug)]
pub struct Defect {
    /// A short name, part of the case's name.
    pub name: &'static str,
    /// The function that has it.
    pub published: &'static str,
    /// The function that cures it; `None` where the fault lies in the format and has no cure there.
    pub hardened: Option<&'static str>,
    /// The witness: the published function's arguments.
    pub witness: &'static [f32],
    /// The cure's arguments, where they differ from the published function's.
    pub cured_witness: Option<&'static [f32]>,
    /// What should hold.
    pub property: Property,
    /// What shows that it does not.
    pub evidence: Evidence,
    /// The defect in a sentence.
    pub about: &'static str,
    /// What the hardened form does instead, or why nothing can be done.
    pub cure: &'static str,
}

/// All known defects that a single function shows.
pub fn defects() -> impl Iterator<Item = &'static Defect> {
    [codecs::ROWS, frames::ROWS, relief::ROWS, shading::ROWS]
        .into_iter()
        .flatten()
}

/// A defect that must show, or its cure, which must not have it.
struct DefectCase {
    id: CaseId,
    defect: &'static Defect,
    probe: &'static Probe,
    cured: bool,
}

/// Two cases a defect, those of whole kernels among them: that the published form has it, and that the hardened form has not.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let single = defects().flat_map(|defect| {
        let shown = DefectCase::new(defect, defect.published, false);
        let cured = defect
            .hardened
            .and_then(|function| DefectCase::new(defect, function, true));
        shown
            .into_iter()
            .chain(cured)
            .map(|case| Box::new(case) as Box<dyn Case>)
    });
    single.chain(border::cases())
}

impl DefectCase {
    fn new(defect: &'static Defect, function: &str, cured: bool) -> Option<Self> {
        let probe = PROBES.iter().find(|probe| probe.function() == function)?;
        let id = probe::id(probe, if cured { "cure" } else { "defect" }).with("defect", defect.name);
        Some(Self {
            id,
            defect,
            probe,
            cured,
        })
    }

    fn witness(&self) -> &'static [f32] {
        match self.defect.cured_witness {
            Some(witness) if self.cured => witness,
            _ => self.defect.witness,
        }
    }

    fn outputs(&self, bench: &Bench<'_>) -> Result<Vec<f32>, String> {
        let module = self.module(bench)?;
        let shader = module.shader(self.probe.entry)?;
        run_probe(
            bench.device,
            shader.code,
            shader.entry,
            self.witness(),
            self.probe.output_floats,
            1,
        )
        .map_err(|error| with_causes(&error))
    }

    fn module(&self, bench: &Bench<'_>) -> Result<Arc<Prepared>, String> {
        bench.module(&Module::Probe(self.probe.id))
    }

    /// Whether the accuracy rules leave an output open at the witness.
    fn is_open(&self, bench: &Bench<'_>) -> Result<bool, String> {
        let program = self.module(bench)?.program(self.probe.entry)?;
        let inputs = Inputs {
            values: self.witness().to_vec(),
            stride: self.witness().len(),
        };
        let bounds = oracle::bounds(self.probe, &program, &inputs)?;
        Ok(bounds.iter().any(|bound| !bound.is_decided()))
    }

    /// `Err` says how the defect shows. A cure must keep the property and be decided by the rules.
    fn shown(&self, out: &[f32], open: bool) -> Result<(), String> {
        match self.defect.evidence {
            Evidence::Rules if open => Err(format!(
                "the accuracy rules leave the result open; this machine gives {out:?}"
            )),
            Evidence::Rules if !self.cured => Ok(()),
            Evidence::Rules | Evidence::Output => (self.defect.property)(out),
        }
    }

    fn judge(&self, out: &[f32], open: bool) -> Outcome {
        if out.len() != self.probe.output_floats || out.iter().copied().any(is_unwritten) {
            return Outcome::failed("the shader did not write all outputs");
        }
        let (verdict, reason) = match (self.shown(out, open), self.cured) {
            (Err(how), false) => (
                Verdict::ExpectedFail,
                Some(format!("{}: {how}", self.defect.about)),
            ),
            (Ok(()), false) => (
                Verdict::Fail,
                Some(format!(
                    "the known defect did not show ({}); got {out:?}",
                    self.defect.about
                )),
            ),
            (Err(how), true) => (Verdict::Fail, Some(format!("the cure has the defect: {how}"))),
            (Ok(()), true) => (Verdict::Pass, None),
        };
        let comparison = Comparison::of_property(out.len());
        Outcome {
            inputs: 1,
            comparison,
            verdict,
            reason,
        }
    }
}

impl Case for DefectCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        match self.defect.evidence {
            Evidence::Output => vec!["property at a witness"],
            Evidence::Rules => vec!["property at a witness", "accuracy rules over the shader's IR"],
        }
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        Ok(vec![Module::Probe(self.probe.id)])
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        match (self.outputs(bench), self.is_open(bench)) {
            (Ok(out), Ok(open)) => self.judge(&out, open),
            (Err(reason), _) | (_, Err(reason)) => Outcome::failed(reason),
        }
    }
}

#[cfg(test)]
mod tests {
    use bossage_shaders::PROBES;

    use super::{DefectCase, defects};
    use crate::verdict::Verdict;

    fn case(name: &str, cured: bool) -> DefectCase {
        let defect = defects().find(|defect| defect.name == name).unwrap();
        let function = if cured {
            defect.hardened.unwrap()
        } else {
            defect.published
        };
        DefectCase::new(defect, function, cured).unwrap()
    }

    #[test]
    fn every_defect_names_probes_and_fits_them() {
        for defect in defects() {
            for (function, witness) in [
                (Some(defect.published), defect.witness),
                (defect.hardened, defect.cured_witness.unwrap_or(defect.witness)),
            ] {
                let Some(function) = function else { continue };
                let probe = PROBES.iter().find(|probe| probe.function() == function);
                let probe = probe.unwrap_or_else(|| panic!("{}: no probe `{function}`", defect.name));
                assert_eq!(witness.len(), probe.input_floats, "{}: {function}", defect.name);
            }
        }
    }

    #[test]
    fn a_missing_defect_is_a_failure_and_a_shown_one_is_expected() {
        assert_eq!(
            case("byte_zero", false).judge(&[-1.0, 0.0, 1.0], false).verdict,
            Verdict::Fail
        );
        assert_eq!(
            case("byte_zero", false)
                .judge(&[-1.0079, 0.0, 1.0], false)
                .verdict,
            Verdict::ExpectedFail
        );
        assert_eq!(
            case("byte_zero", true).judge(&[-1.0079, 0.0, 1.0], false).verdict,
            Verdict::Fail
        );
        assert_eq!(
            case("byte_zero", true).judge(&[-1.0, 0.0, 1.0], false).verdict,
            Verdict::Pass
        );
    }

    #[test]
    fn a_defect_of_the_rules_shows_on_every_machine() {
        // A machine that clamps NaN to 0 and one that lets it through.
        for out in [[0.0; 3], [f32::NAN; 3]] {
            assert_eq!(
                case("zero_light", false).judge(&out, true).verdict,
                Verdict::ExpectedFail
            );
        }
        assert_eq!(
            case("zero_light", true).judge(&[0.0; 3], false).verdict,
            Verdict::Pass
        );
        assert_eq!(
            case("zero_light", true).judge(&[f32::NAN; 3], false).verdict,
            Verdict::Fail
        );
    }

    #[test]
    fn an_unwritten_output_is_no_defect() {
        let out = [bossage_runner::SENTINEL; 2];
        assert_eq!(case("flat_view", false).judge(&out, false).verdict, Verdict::Fail);
    }
}
