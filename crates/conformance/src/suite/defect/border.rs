//! The flat border of the published bake, which no single function shows: the kernels themselves on a wave that does not stop at
//! the border.

use bossage_assets::{EdgeMode, HeightField, NormalCodec, height_to_normal::Bake};
use bossage_runner::{BufferData, ComputeJob, Resources, TextureData};
use bossage_shaders::Kernel;

use crate::bench::Bench;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::Comparison;
use crate::module::Module;
use crate::verdict::Verdict;

/// Texels a side; one period of the wave.
const SIDE: u32 = 16;

/// The published bake, which must show the defect, or the hardened one, which must not.
pub(super) struct BorderCase {
    id: CaseId,
    cured: bool,
}

/// Both.
pub(super) fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    [false, true].into_iter().map(|cured| {
        let (form, kind) = if cured {
            ("hardened", "cure")
        } else {
            ("published", "defect")
        };
        let id = CaseId::new("height_to_normal_forward", Some(form), kind).with("defect", "flat_border");
        Box::new(BorderCase { id, cured }) as Box<dyn Case>
    })
}

/// Steepest at the border: h = ½ + ½ sin(2πx / side).
fn wave() -> HeightField {
    HeightField::from_fn(SIDE, SIDE, |x, _| {
        0.5 + 0.5 * (std::f32::consts::TAU * x as f32 / SIDE as f32).sin()
    })
}

impl BorderCase {
    fn kernel(&self) -> Kernel {
        if self.cured {
            Kernel::HeightToNormalForward
        } else {
            Kernel::HeightToNormalForwardPublished
        }
    }

    /// The texel in the middle of the left border.
    fn border_texel(&self, bench: &Bench<'_>) -> Result<[u8; 4], String> {
        let (field, kernel) = (wave(), self.kernel());
        let bake = Bake::forward(&field, [0.25; 2], EdgeMode::Wrap, NormalCodec::Biased)
            .map_err(|error| with_causes(&error))?;
        let module = bench.module(&Module::Kernel(kernel))?;
        let texture = TextureData::r32f(SIDE, SIDE, &field.texels);
        let mut resources = Resources::default();
        resources.uniforms.extend([
            ("bake.slope".to_owned(), bake.slope.to_vec()),
            (
                "bake.byte_scale_offset".to_owned(),
                bake.byte_scale_offset().to_vec(),
            ),
            ("bake.edge_mode".to_owned(), vec![0.0]),
            // The same elevation, in texels a byte step.
            ("bake.height_scale".to_owned(), vec![0.25 * SIDE as f32 / 255.0]),
        ]);
        resources.textures.insert("height_map".to_owned(), &texture);
        let size = 4 * field.texels.len();
        resources
            .buffers
            .insert("texels".to_owned(), BufferData::Output(size));
        let [x, y, _] = kernel.workgroup_size();
        let name = self.id.to_string();
        let job = ComputeJob {
            name: &name,
            shader: module.shader(kernel.entry())?,
            resources,
            workgroups: [SIDE.div_ceil(x), SIDE.div_ceil(y), 1],
        };
        let output = job.run(bench.device).map_err(|error| with_causes(&error))?;
        let word = output.words("texels").get((SIDE / 2 * SIDE) as usize).copied();
        word.map(u32::to_le_bytes)
            .ok_or_else(|| "the kernel wrote no texel in the middle of the border".to_owned())
    }

    fn judge(&self, texel: [u8; 4]) -> Outcome {
        // Flat is (128, 128, 255); the wave rises here by about 0.77 a texture unit, in red (hardened) or green (published).
        let flat = texel[0] == 128 && texel[1] == 128;
        let (verdict, reason) = match (flat, self.cured) {
            (true, false) => (
                Verdict::ExpectedFail,
                Some("all border texels are (0, 0, 1): a seam in a map that is called tileable".to_owned()),
            ),
            (false, false) => (
                Verdict::Fail,
                Some(format!(
                    "the known defect did not show: the border texel is {texel:?}"
                )),
            ),
            (true, true) => (
                Verdict::Fail,
                Some("the cure has the defect: a flat border".to_owned()),
            ),
            (false, true) => (Verdict::Pass, None),
        };
        Outcome {
            inputs: 1,
            comparison: Comparison::of_property(4),
            verdict,
            reason,
        }
    }
}

impl Case for BorderCase {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        vec!["property at a witness"]
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        Ok(vec![Module::Kernel(self.kernel())])
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        match self.border_texel(bench) {
            Ok(texel) => self.judge(texel),
            Err(reason) => Outcome::failed(reason),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{BorderCase, CaseId};
    use crate::verdict::Verdict;

    #[test]
    fn a_flat_border_is_expected_of_one_form_and_a_failure_of_the_other() {
        let verdict = |cured, texel| {
            let id = CaseId::new("height_to_normal_forward", None, "border");
            BorderCase { id, cured }.judge(texel).verdict
        };
        assert_eq!(verdict(false, [128, 128, 255, 0]), Verdict::ExpectedFail);
        assert_eq!(verdict(false, [90, 128, 240, 0]), Verdict::Fail);
        assert_eq!(verdict(true, [128, 128, 255, 0]), Verdict::Fail);
        assert_eq!(verdict(true, [90, 128, 240, 0]), Verdict::Pass);
    }
}
