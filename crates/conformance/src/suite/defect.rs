//! Known defects of the published forms: each has a witness input and a property that the published form breaks there.
//!
//! The break is expected and reported as such. If the property holds, the defect is gone or the form is not what was
//! published: **that** is the failure. Where a hardened form exists, it must keep the property at the same witness.
//!
//! Two kinds of evidence. Most defects show in the output of every machine. Some only make the result *open*: at L = 0 the
//! published `dot3` clamps a NaN, and a machine that clamps NaN to 0 hides it. For those the witness is that the accuracy
//! rules leave the published form's result open and decide the hardened form's.

use bossage_runner::{is_unwritten, run_probe};
use bossage_shaders::{PROBES, Probe};

use super::probe;
use crate::bench::Bench;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::Comparison;
use crate::module::Module;
use crate::oracle;
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
}

/// All known defects that a single function shows.
pub const DEFECTS: &[Defect] = &[
    Defect {
        name: "flat_view",
        published: "parallax_offset_published",
        hardened: Some("parallax_offset"),
        witness: &[0.5, 0.5, 0.02, 1.0, 0.0, 0.0],
        cured_witness: None,
        property: within_a_tile,
        evidence: Evidence::Output,
        about: "at V.z = 0 the shift is infinite",
    },
    Defect {
        name: "grazing_view",
        published: "parallax_offset_published",
        hardened: Some("parallax_offset"),
        witness: &[0.5, 0.5, 0.02, 1.0, 0.0, 1e-4],
        cured_witness: None,
        property: within_a_tile,
        evidence: Evidence::Output,
        about: "the shift grows without bound as V.z goes to 0: here 200 tiles",
    },
    Defect {
        name: "view_from_below",
        published: "parallax_offset_published",
        hardened: Some("parallax_offset"),
        witness: &[0.5, 0.5, 0.02, 0.8, 0.0, -0.6],
        cured_witness: None,
        property: |out| {
            ensure(out[0] >= 0.5, || {
                format!("a view along +u shifts to {}, along −u", out[0])
            })
        },
        evidence: Evidence::Output,
        about: "for V.z < 0 the shift turns round",
    },
    Defect {
        name: "opposite_light",
        published: "half_vector_published",
        hardened: Some("half_vector"),
        witness: &[1.0, 0.0, 0.0, -1.0, 0.0, 0.0],
        cured_witness: None,
        property: finite,
        evidence: Evidence::Output,
        about: "L = −V makes the half vector 0/0",
    },
    Defect {
        name: "opposite_light",
        published: "blinn_phong_published",
        hardened: Some("blinn_phong"),
        witness: &[
            0.6, 0.0, 0.8, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.5, 0.5, 0.5, 1.0, 1.0, 1.0, 16.0,
        ],
        cured_witness: None,
        property: |out| {
            let diffuse = 0.3;
            ensure(out.iter().all(|c| (c - diffuse).abs() < 1e-5), || {
                format!("without a half vector only the diffuse 0.3 is due, not {out:?}")
            })
        },
        evidence: Evidence::Rules,
        about: "L = −V makes the highlight pow(NaN, p): the diffuse colour may be lost or a full highlight appear",
    },
    Defect {
        name: "zero_light",
        published: "dot3_published",
        hardened: Some("dot3"),
        witness: &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
        cured_witness: None,
        property: |out| {
            ensure(out.iter().all(|c| *c == 0.0), || {
                format!("no light gives {out:?}")
            })
        },
        evidence: Evidence::Rules,
        about: "L = 0 is normalised to 0/0",
    },
    Defect {
        name: "tiny_light",
        published: "normalise_published",
        hardened: Some("normalise"),
        witness: &[0.0, 0.0, 1e-23],
        cured_witness: None,
        property: unit,
        evidence: Evidence::Output,
        about: "the square of 1e-23 is zero in f32: the direction is lost",
    },
    Defect {
        name: "huge_light",
        published: "normalise_published",
        hardened: Some("normalise"),
        witness: &[0.0, 0.0, 2e19],
        cured_witness: None,
        property: unit,
        evidence: Evidence::Output,
        about: "the square of 2e19 overflows: the direction is lost",
    },
    Defect {
        name: "byte_zero",
        published: "codec_biased_decode_published",
        hardened: Some("codec_biased_decode"),
        witness: &[0.0, 128.0, 255.0],
        cured_witness: None,
        property: |out| ensure(out[0] >= -1.0, || format!("byte 0 decodes to {}", out[0])),
        evidence: Evidence::Output,
        about: "byte 0 decodes to −1.0079",
    },
    Defect {
        name: "truncation",
        published: "codec_biased_encode_published",
        hardened: Some("codec_biased_encode"),
        witness: &[0.9 / 127.0, 0.0, 1.0],
        cured_witness: None,
        property: |out| {
            ensure((out[0] - 128.9).abs() <= 0.5, || {
                format!("128.9 is encoded as {}", out[0])
            })
        },
        evidence: Evidence::Output,
        about: "truncation errs by up to a whole step instead of half of one",
    },
    Defect {
        name: "no_zero",
        published: "codec_unorm_decode",
        hardened: None,
        witness: &[128.0 / 255.0, 127.0 / 255.0, 1.0],
        cured_witness: None,
        property: |out| {
            ensure(out[0] == 0.0 || out[1] == 0.0, || {
                format!("bytes 128 and 127 decode to {} and {}", out[0], out[1])
            })
        },
        evidence: Evidence::Output,
        about: "no byte stands for 0: a flat map tilts by 0.318°",
    },
    Defect {
        name: "axes_swapped",
        published: "height_to_normal_forward_published",
        hardened: Some("height_to_normal_forward"),
        // A rise to the next column, none to the next row.
        witness: &[0.0, 0.0, 1.0, 1.0],
        cured_witness: Some(&[0.0, 1.0, 0.0, 1.0, 1.0]),
        property: |out| {
            ensure(out[0] < 0.0 && out[1] == 0.0, || {
                format!("a slope along u gives ({}, {})", out[0], out[1])
            })
        },
        evidence: Evidence::Output,
        about: "the first axis is the row: a slope along u lands in green",
    },
    Defect {
        name: "no_texture_area",
        published: "frame_from_uv_triangle_published",
        hardened: Some("frame_from_uv_triangle"),
        witness: &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0],
        cured_witness: None,
        property: finite,
        evidence: Evidence::Output,
        about: "a triangle without texture area divides by zero",
    },
    Defect {
        name: "tangent_along_normal",
        published: "frame_from_uv_vertex_published",
        hardened: Some("frame_from_uv_vertex"),
        witness: &[0.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, 1.0, 0.0],
        cured_witness: Some(&[0.0, 0.0, 1.0, 0.0, 0.0, 3.0, 0.0, 1.0, 0.0, 3.0]),
        property: |out| unit(&out[..3]),
        evidence: Evidence::Output,
        about: "T parallel to N leaves no tangent",
    },
    Defect {
        name: "tangent_not_unit",
        published: "frame_from_uv_vertex_published",
        hardened: Some("frame_from_uv_vertex"),
        witness: &[0.0, 0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.0],
        cured_witness: Some(&[0.0, 0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.0, 3.0]),
        property: |out| unit(&out[..3]),
        evidence: Evidence::Output,
        about: "T' = T − (N·T) N is not a unit vector",
    },
    Defect {
        name: "non_uniform_scale",
        published: "normal_transform_published",
        hardened: Some("normal_transform"),
        // Stretched by 4 along x, the surface through (1, 0, −1)/√2 and y leans: its image holds (4, 0, −1).
        witness: &[4.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.8, 0.0, 0.6],
        cured_witness: None,
        property: |out| {
            let across = out[0] * (4.0 * 0.6) + out[2] * -0.8;
            let length = out.iter().map(|x| x * x).sum::<f32>().sqrt();
            ensure((across / length).abs() < 1e-5, || {
                format!("the normal {out:?} leans {across} out of the surface")
            })
        },
        evidence: Evidence::Output,
        about: "under non-uniform scale the normal is no longer perpendicular to the surface",
    },
    Defect {
        name: "zero_to_the_zeroth",
        published: "highlight_power_published",
        hardened: Some("highlight_power"),
        witness: &[0.0, 0.0],
        cured_witness: None,
        property: |out| {
            ensure(out[0] == 0.0, || {
                format!(
                    "a surface that the half vector does not face shines with {}",
                    out[0]
                )
            })
        },
        evidence: Evidence::Rules,
        about: "pow(0, 0) is left open by the language",
    },
];

fn ensure(holds: bool, otherwise: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(otherwise()) }
}

fn finite(out: &[f32]) -> Result<(), String> {
    ensure(out.iter().all(|x| x.is_finite()), || format!("{out:?}"))
}

/// A shift of at most one tile from the middle of the texture.
fn within_a_tile(out: &[f32]) -> Result<(), String> {
    ensure(out.iter().all(|x| (x - 0.5).abs() <= 1.0), || {
        format!("uv {out:?}")
    })
}

/// Unit length to a part in 10⁵: f32 rounding leaves below 1e-6, the defects are off by 1 or NaN.
fn unit(out: &[f32]) -> Result<(), String> {
    let length = out.iter().map(|x| x * x).sum::<f32>().sqrt();
    ensure((length - 1.0).abs() < 1e-5, || format!("length {length}"))
}

/// A defect that must show, or its cure, which must not have it.
struct DefectCase {
    id: CaseId,
    defect: &'static Defect,
    probe: &'static Probe,
    cured: bool,
}

/// Two cases a defect: that the published form has it, and that the hardened form has not.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    DEFECTS.iter().flat_map(|defect| {
        let shown = DefectCase::new(defect, defect.published, false);
        let cured = defect
            .hardened
            .and_then(|function| DefectCase::new(defect, function, true));
        shown
            .into_iter()
            .chain(cured)
            .map(|case| Box::new(case) as Box<dyn Case>)
    })
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
        let probe = self.probe;
        let module = bench.module(&Module::Probe(probe.id))?;
        let shader = module.shader(probe.entry)?;
        run_probe(
            bench.device,
            shader.code,
            shader.entry,
            self.witness(),
            probe.output_floats,
            1,
        )
        .map_err(|error| with_causes(&error))
    }

    /// `Err` says how the defect shows. A cure must keep the property and be decided by the rules.
    fn shown(&self, out: &[f32]) -> Result<(), String> {
        let expected = oracle::expected(self.probe, self.witness()).unwrap_or_default();
        let open = expected.iter().any(|e| !e.bound.is_decided());
        match self.defect.evidence {
            Evidence::Rules if open => Err(format!(
                "the accuracy rules leave the result open; this machine gives {out:?}"
            )),
            Evidence::Rules if !self.cured => Ok(()),
            Evidence::Rules | Evidence::Output => (self.defect.property)(out),
        }
    }

    fn judge(&self, out: &[f32]) -> Outcome {
        if out.len() != self.probe.output_floats || out.iter().copied().any(is_unwritten) {
            return Outcome::failed("the shader did not write all outputs");
        }
        let (verdict, reason) = match (self.shown(out), self.cured) {
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
            Evidence::Rules => vec!["property at a witness", "accuracy rules at the input"],
        }
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        Ok(vec![Module::Probe(self.probe.id)])
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        match self.outputs(bench) {
            Ok(out) => self.judge(&out),
            Err(reason) => Outcome::failed(reason),
        }
    }
}

#[cfg(test)]
mod tests {
    use bossage_shaders::PROBES;

    use super::{DEFECTS, DefectCase};
    use crate::verdict::Verdict;

    fn case(name: &str, cured: bool) -> DefectCase {
        let defect = DEFECTS.iter().find(|defect| defect.name == name).unwrap();
        let function = if cured {
            defect.hardened.unwrap()
        } else {
            defect.published
        };
        DefectCase::new(defect, function, cured).unwrap()
    }

    #[test]
    fn every_defect_names_probes_and_fits_them() {
        for defect in DEFECTS {
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
            case("byte_zero", false).judge(&[-1.0, 0.0, 1.0]).verdict,
            Verdict::Fail
        );
        assert_eq!(
            case("byte_zero", false).judge(&[-1.0079, 0.0, 1.0]).verdict,
            Verdict::ExpectedFail
        );
        assert_eq!(
            case("byte_zero", true).judge(&[-1.0079, 0.0, 1.0]).verdict,
            Verdict::Fail
        );
        assert_eq!(
            case("byte_zero", true).judge(&[-1.0, 0.0, 1.0]).verdict,
            Verdict::Pass
        );
    }

    #[test]
    fn a_defect_of_the_rules_shows_on_every_machine() {
        // A machine that clamps NaN to 0 and one that lets it through.
        for out in [[0.0; 3], [f32::NAN; 3]] {
            assert_eq!(
                case("zero_light", false).judge(&out).verdict,
                Verdict::ExpectedFail
            );
        }
        assert_eq!(case("zero_light", true).judge(&[0.0; 3]).verdict, Verdict::Pass);
        assert_eq!(
            case("zero_light", true).judge(&[f32::NAN; 3]).verdict,
            Verdict::Fail
        );
    }

    #[test]
    fn an_unwritten_output_is_no_defect() {
        let out = [bossage_runner::SENTINEL; 2];
        assert_eq!(case("flat_view", false).judge(&out).verdict, Verdict::Fail);
    }
}
