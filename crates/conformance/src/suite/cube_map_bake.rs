//! Bakes of the normalisation cube map: the kernel's codes against its twin on the CPU and the f64 reference, texel by texel.
//!
//! What is allowed comes from the kernel's own IR over acceptance intervals (`dispatch.rs`). A code is a step function of the
//! direction: where the interval of what is truncated holds no whole number there is one right code, and kernel and twin (which
//! computes in f64) both must have it; elsewhere the neighbours are allowed, and codes that differ are counted in the report.

use std::collections::BTreeMap;

use bossage_assets::normalisation_cube_map::{Depth, NormalisationCubeMap};
use bossage_assets::{CubeFace, Texels};
use bossage_bounds::{Accept, Scalar};
use bossage_runner::{BufferData, Resources};
use bossage_shaders::{Kernel, Probe};

use super::kernel_case::{KernelCase, twin_and_rules};
use crate::bench::Bench;
use crate::bound::Bound;
use crate::case::{Case, Outcome, with_causes};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::dispatch::{Dispatch, Kept, byte_bounds, half_bounds};
use crate::module::Module;
use crate::oracle;
use crate::route::Prepared;
use crate::tolerance::UNDECIDED_LIMIT;
use crate::undecided::code_share;

/// Texels an edge: the smallest, an odd one, and sizes that are in use.
const SIZES: [u32; 5] = [1, 2, 7, 16, 64];

/// One size at one depth.
struct CubeMapBake {
    id: CaseId,
    size: u32,
    depth: Depth,
    expected: Kept<Vec<[Expected; 4]>>,
}

/// Every size at 8 and 16 bits.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    SIZES.into_iter().flat_map(|size| {
        [(Depth::Eight, "08"), (Depth::Sixteen, "16")].map(|(depth, bits)| {
            let id = CaseId::new("normalisation_cube_map", None, "bake")
                .with("bits", bits)
                .with("size", format!("{size:03}"));
            let expected = Kept::default();
            Box::new(CubeMapBake {
                id,
                size,
                depth,
                expected,
            }) as Box<dyn Case>
        })
    })
}

impl CubeMapBake {
    fn kernel(&self) -> Kernel {
        match self.depth {
            Depth::Eight => Kernel::NormalisationCubeMap,
            Depth::Sixteen => Kernel::NormalisationCubeMap16,
        }
    }

    fn largest_code(&self) -> f32 {
        match self.depth {
            Depth::Eight => 255.0,
            Depth::Sixteen => 65_535.0,
        }
    }

    fn words_a_texel(&self) -> usize {
        match self.depth {
            Depth::Eight => 1,
            Depth::Sixteen => 2,
        }
    }

    fn texel_count(&self) -> usize {
        6 * self.size as usize * self.size as usize
    }

    fn dispatch<'a>(&self, name: &'a str) -> Dispatch<'a> {
        let mut resources = Resources::default();
        resources
            .uniforms
            .insert("bake.size".to_owned(), vec![self.size as f32]);
        resources.buffers.insert(
            "texels".to_owned(),
            BufferData::Output(4 * self.words_a_texel() * self.texel_count()),
        );
        Dispatch {
            name,
            kernel: self.kernel(),
            resources,
            // One face too many: nothing may come of it.
            invocations: [self.size, self.size, 7],
        }
    }

    /// The bounds of a texel's four codes.
    fn bounds(&self, words: &[Scalar<Accept>]) -> [Bound; 4] {
        match (self.depth, words) {
            (Depth::Eight, [word]) => byte_bounds(word),
            (Depth::Sixteen, [low, high]) => {
                let ([r, g], [b, a]) = (half_bounds(low), half_bounds(high));
                [r, g, b, a]
            }
            (Depth::Eight | Depth::Sixteen, _) => [Bound::OPEN; 4],
        }
    }

    /// The codes of every texel by the reference, face by face, row by row; alpha is full.
    fn truths(&self) -> Result<Vec<[f64; 4]>, String> {
        let probe = Probe::find("normalisation_cube_map_code").ok_or("no function of a texel's code")?;
        let (n, largest) = (self.size, self.largest_code());
        let texels = (0..6).flat_map(|face| (0..n).flat_map(move |y| (0..n).map(move |x| [face, x, y])));
        let code = |[face, x, y]: [u32; 3]| {
            let input = [face as f32, x as f32, y as f32, n as f32, largest];
            match oracle::truth_of(probe, &input).as_deref() {
                Some(&[r, g, b]) => Ok([r, g, b, f64::from(largest)]),
                _ => Err("no truth of a texel's code".to_owned()),
            }
        };
        texels.map(code).collect()
    }

    fn expectations(&self, dispatch: &Dispatch<'_>, module: &Prepared) -> Result<Vec<[Expected; 4]>, String> {
        let mut left = dispatch.accepted(module, &BTreeMap::new())?;
        let words = left.remove("texels").ok_or("the kernel writes no texels")?;
        let texels = words.chunks(self.words_a_texel()).zip(self.truths()?);
        let texel = |(words, truth): (&[_], [f64; 4])| {
            let bounds = self.bounds(words);
            std::array::from_fn(|i| Expected {
                truth: truth[i],
                bound: bounds[i],
            })
        };
        Ok(texels.map(texel).collect())
    }

    fn unpack(&self, words: &[u32]) -> [f32; 4] {
        match (self.depth, words) {
            (Depth::Eight, [word]) => word.to_le_bytes().map(f32::from),
            (Depth::Sixteen, [low, high]) => {
                [low & 0xffff, low >> 16, high & 0xffff, high >> 16].map(|code| code as f32)
            }
            (Depth::Eight | Depth::Sixteen, _) => [bossage_runner::SENTINEL; 4],
        }
    }

    /// The twin's codes in the same order.
    fn twin(&self) -> Result<Vec<[f32; 4]>, String> {
        let map =
            NormalisationCubeMap::generate(self.size, self.depth).map_err(|error| with_causes(&error))?;
        let of_face = |face: CubeFace| -> Vec<f32> {
            match &map.faces[face as usize] {
                Texels::Unorm8(codes) => codes.iter().map(|&code| f32::from(code)).collect(),
                Texels::Unorm16(codes) => codes.iter().map(|&code| f32::from(code)).collect(),
                Texels::Float32(codes) => codes.clone(),
            }
        };
        let codes: Vec<f32> = CubeFace::ALL.into_iter().flat_map(of_face).collect();
        Ok(codes.as_chunks::<4>().0.to_vec())
    }

    /// The share of codes that may lie next to a boundary: of 16 bits more, as each is narrower.
    fn undecided_limit(&self) -> f64 {
        match self.depth {
            Depth::Eight => UNDECIDED_LIMIT,
            Depth::Sixteen => code_share(65_535.0),
        }
    }
}

impl KernelCase for CubeMapBake {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        twin_and_rules()
    }

    fn kernels(&self) -> Vec<Kernel> {
        vec![self.kernel()]
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let name = self.id.to_string();
        let dispatch = self.dispatch(&name);
        let module = bench.module(&Module::Kernel(dispatch.kernel))?;
        let expected = self
            .expected
            .for_text(module.text(), || self.expectations(&dispatch, &module))?;
        let words = dispatch.run(bench)?.words("texels");
        let twin = self.twin()?;
        let (mut comparison, mut different) = (Comparison::default(), 0);
        let texels = words.chunks(self.words_a_texel()).zip(&twin).zip(&*expected);
        for (index, ((words, twin), expected)) in texels.enumerate() {
            let got = self.unpack(words);
            comparison.item(&[index as f32], &got, expected);
            comparison.item(&[index as f32], twin, expected);
            different += got.iter().zip(twin).filter(|(a, b)| a != b).count();
        }
        let outcome = Outcome::of(self.texel_count(), comparison, self.undecided_limit());
        let note = format!(
            "{different} of {} codes differ from the twin, each next to a rounding boundary",
            4 * self.texel_count()
        );
        let reason = outcome.reason.clone().or((different > 0).then_some(note));
        Ok(Outcome { reason, ..outcome })
    }
}
