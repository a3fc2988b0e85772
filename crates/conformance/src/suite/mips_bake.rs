//! Mip chains of normal maps: the three kernels, level by level, against their twin on the CPU and the f64 reference.
//!
//! Each level is judged by itself, from the twin's level before: bytes to decoded normals, averages to smaller averages, averages
//! to bytes. What is allowed comes from the kernels' own IR over those inputs (`dispatch.rs`). Averages and bytes that
//! differ from the twin's are counted in the report.

use std::collections::BTreeMap;

use bossage_assets::mips::Level;
use bossage_assets::normal_mips::{self, NormalMips};
use bossage_assets::{NormalCodec, NormalMap};
use bossage_reference::{codec_biased, codec_unorm, normal_mips as reference};
use bossage_runner::{BufferData, Resources};
use bossage_shaders::Kernel;
use glam::{DVec3, DVec4, Vec4};
use rand::RngExt;

use super::kernel_case::{KernelCase, twin_and_rules};
use crate::bench::Bench;
use crate::case::{Case, Outcome};
use crate::case_id::CaseId;
use crate::compare::{Comparison, Expected};
use crate::dispatch::{Dispatch, Kept, byte_bounds, float_bounds};
use crate::generate::random::stream;
use crate::module::Module;
use crate::tolerance::UNDECIDED_LIMIT;

/// What is expected of each number of each texel.
type Expectations = Vec<[Expected; 4]>;

/// One map.
struct MipsBake {
    id: CaseId,
    map: NormalMap,
    /// The averages of each level, and the twin's map of it.
    means: Vec<Level>,
    maps: Vec<NormalMap>,
    base: Kept<Expectations>,
    levels: Kept<Vec<Expectations>>,
    bytes: Kept<Vec<Expectations>>,
}

/// Sides that are even, odd, one, and no multiples of a workgroup.
const SIDES: [(&str, u32, u32); 6] = [
    ("even", 64, 32),
    ("odd", 61, 37),
    ("one", 1, 1),
    ("row", 13, 1),
    ("column", 1, 3),
    ("thin", 2, 9),
];

/// Random bytes of every shape in both codes, a flat map, and one whose normals cancel.
pub fn cases() -> impl Iterator<Item = Box<dyn Case>> {
    let codecs = [(NormalCodec::Unorm, "unorm"), (NormalCodec::Biased, "biased")];
    codecs.into_iter().flat_map(|(codec, name)| {
        let rough = SIDES.map(|(shape, width, height)| (shape, noise(width, height, codec)));
        let others = [("flat", flat(17, 8, codec)), ("opposed", opposed(codec))];
        rough.into_iter().chain(others).map(move |(shape, map)| {
            let id = CaseId::new("normal_mips", Some("hardened"), "bake")
                .with("codec", name)
                .with("map", shape);
            Box::new(MipsBake::new(id, map)) as Box<dyn Case>
        })
    })
}

/// Random bytes; alphas are multiples of `alpha_step`.
fn noise(width: u32, height: u32, codec: NormalCodec) -> NormalMap {
    // A quarter of all averages of four bytes lies halfway between two, where rounding is open; of multiples of 16 none does,
    // nor does any of sixteen of them.
    let alpha_step = if width.is_multiple_of(4) { 16 } else { 1 };
    let mut rng = stream("mips", 1);
    NormalMap {
        width,
        height,
        codec,
        texels: (0..width * height)
            .map(|_| {
                let [r, g, b, a] = std::array::from_fn(|_| rng.random::<u8>());
                [r, g, b, a / alpha_step * alpha_step]
            })
            .collect(),
    }
}

fn flat(width: u32, height: u32, codec: NormalCodec) -> NormalMap {
    let [x, z] = [0.0, 1.0].map(|component| codec.encode(component));
    NormalMap {
        width,
        height,
        codec,
        texels: vec![[x, x, z, 255]; (width * height) as usize],
    }
}

/// Normals along +x and −x in a checkerboard: nothing is left of their average where the code has a zero.
fn opposed(codec: NormalCodec) -> NormalMap {
    let [plus, zero, minus] = [1.0, 0.0, -1.0].map(|component| codec.encode(component));
    let texel = |i: u32| {
        let x = if (i + i / 4).is_multiple_of(2) {
            plus
        } else {
            minus
        };
        [x, zero, zero, (64 * (i % 4)) as u8]
    };
    NormalMap {
        width: 4,
        height: 4,
        codec,
        texels: (0..16).map(texel).collect(),
    }
}

/// What is compared, and how much of it is not the twin's.
#[derive(Default)]
struct Tally {
    comparison: Comparison,
    texels: usize,
    different: usize,
}

impl Tally {
    fn add(
        &mut self,
        level: usize,
        got: impl Iterator<Item = [f32; 4]>,
        twin: impl Iterator<Item = [f32; 4]>,
        expected: &Expectations,
    ) -> Result<(), String> {
        let before = self.texels;
        for (i, ((got, twin), expected)) in got.zip(twin).zip(expected).enumerate() {
            let place = [level as f32, i as f32];
            self.comparison.item(&place, &got, expected);
            self.comparison.item(&place, &twin, expected);
            self.different += got.iter().zip(twin).filter(|(a, b)| **a != *b).count();
            self.texels += 1;
        }
        let count = self.texels - before;
        if count == expected.len() {
            return Ok(());
        }
        Err(format!(
            "level {level} has {count} texels instead of {}",
            expected.len()
        ))
    }
}

fn pair(
    truths: impl Iterator<Item = [f64; 4]>,
    bounds: impl Iterator<Item = [crate::bound::Bound; 4]>,
) -> Expectations {
    let texel = |(truth, bound): ([f64; 4], [_; 4])| {
        std::array::from_fn(|i| Expected {
            truth: truth[i],
            bound: bound[i],
        })
    };
    truths.zip(bounds).map(texel).collect()
}

impl MipsBake {
    fn new(id: CaseId, map: NormalMap) -> Self {
        Self {
            id,
            means: normal_mips::means(&map),
            maps: normal_mips::chain(&map, NormalMips::Naive),
            map,
            base: Kept::default(),
            levels: Kept::default(),
            bytes: Kept::default(),
        }
    }

    /// A kernel on a level: `input` is the buffer it reads, `output` the one it writes.
    fn dispatch<'a>(
        &self,
        name: &'a str,
        kernel: Kernel,
        size: [u32; 2],
        (name_in, bytes): (&str, &'a [u8]),
        (name_out, length): (&str, usize),
    ) -> Dispatch<'a> {
        let codec = match self.map.codec {
            NormalCodec::Unorm => 0.0,
            NormalCodec::Biased => 1.0,
        };
        let mut resources = Resources::default();
        resources.uniforms.extend([
            ("bake.size".to_owned(), size.map(|n| n as f32).to_vec()),
            ("bake.codec".to_owned(), vec![codec]),
        ]);
        resources.buffers.extend([
            (name_in.to_owned(), BufferData::Bytes(bytes)),
            (name_out.to_owned(), BufferData::Output(length)),
        ]);
        // The smaller level has an invocation a texel, a list one an item.
        let invocations = if kernel == Kernel::NormalMips {
            let [width, height] = size.map(|side| (side / 2).max(1));
            [width, height, 1]
        } else {
            [size[0] * size[1], 1, 1]
        };
        Dispatch {
            name,
            kernel,
            resources,
            invocations,
        }
    }

    /// Bytes to the base of the chain.
    fn judge_base(&self, bench: &Bench<'_>, tally: &mut Tally) -> Result<(), String> {
        let (name, twin) = (self.id.to_string(), &self.means[0]);
        let dispatch = self.dispatch(
            &name,
            Kernel::NormalMipsDecode,
            [self.map.width, self.map.height],
            ("texels", self.map.texels.as_flattened()),
            ("smaller", 16 * twin.texels.len()),
        );
        let module = bench.module(&Module::Kernel(dispatch.kernel))?;
        let expected = self.base.for_text(module.text(), || {
            let truths = self.map.texels.iter().map(|&[r, g, b, a]| {
                let [x, y, z] = [r, g, b].map(|byte| match self.map.codec {
                    NormalCodec::Unorm => codec_unorm::decode_byte(byte),
                    NormalCodec::Biased => codec_biased::decode_hardened(f64::from(byte)),
                });
                [x, y, z, f64::from(a) / 255.0]
            });
            means_expected(&dispatch, &module, truths)
        })?;
        let got = dispatch.run(bench)?.floats("smaller");
        tally.add(0, four(&got), floats_of(twin), &expected)
    }

    /// Each level to the next.
    fn judge_levels(&self, bench: &Bench<'_>, tally: &mut Tally) -> Result<(), String> {
        let name = self.id.to_string();
        let module = bench.module(&Module::Kernel(Kernel::NormalMips))?;
        let bytes: Vec<Vec<u8>> = self.means.iter().map(mean_bytes).collect();
        let dispatches: Vec<Dispatch<'_>> = self
            .means
            .windows(2)
            .zip(&bytes)
            .map(|(pair, bytes)| {
                let length = 16 * pair[1].texels.len();
                let size = [pair[0].width, pair[0].height];
                self.dispatch(
                    &name,
                    Kernel::NormalMips,
                    size,
                    ("means", bytes),
                    ("smaller", length),
                )
            })
            .collect();
        let expected = self.levels.for_text(module.text(), || {
            let levels = dispatches.iter().zip(&self.means);
            levels
                .map(|(dispatch, before)| {
                    let truths = next_level(before);
                    means_expected(dispatch, &module, truths.into_iter().map(|t| t.to_array()))
                })
                .collect()
        })?;
        for (at, (dispatch, expected)) in dispatches.iter().zip(&*expected).enumerate() {
            let got = dispatch.run(bench)?.floats("smaller");
            tally.add(at + 1, four(&got), floats_of(&self.means[at + 1]), expected)?;
        }
        Ok(())
    }

    /// Each level to bytes. The base of a chain is the map itself, not what its averages would encode to: it is left out.
    fn judge_bytes(&self, bench: &Bench<'_>, tally: &mut Tally) -> Result<(), String> {
        let name = self.id.to_string();
        let module = bench.module(&Module::Kernel(Kernel::NormalMipsEncode))?;
        let bytes: Vec<Vec<u8>> = self.means.iter().map(mean_bytes).collect();
        let dispatch = |at: usize| {
            let level = &self.means[at];
            let output = ("texels", 4 * level.texels.len());
            self.dispatch(
                &name,
                Kernel::NormalMipsEncode,
                [level.width, level.height],
                ("means", &bytes[at]),
                output,
            )
        };
        let expected = self.bytes.for_text(module.text(), || {
            let level = |at: usize| {
                let mut left = dispatch(at).accepted(&module, &BTreeMap::new())?;
                let words = left.remove("texels").ok_or("the kernel writes no texels")?;
                let truths = self.means[at].texels.iter().map(|mean| self.bytes_of(*mean));
                Ok(pair(truths, words.iter().map(byte_bounds)))
            };
            (1..self.means.len()).map(level).collect()
        })?;
        for (at, expected) in (1..).zip(&*expected) {
            let words = dispatch(at).run(bench)?.words("texels");
            let got = words.iter().map(|word| word.to_le_bytes().map(f32::from));
            let twin = self.maps[at].texels.iter().map(|texel| texel.map(f32::from));
            tally.add(at, got, twin, expected)?;
        }
        Ok(())
    }

    /// The bytes of an average: those of its unit normal, and its alpha.
    fn bytes_of(&self, mean: Vec4) -> [f64; 4] {
        let mean = mean.as_dvec4();
        let [x, y, z] = reference::naive(mean.truncate()).to_array().map(|component| {
            f64::from(match self.map.codec {
                NormalCodec::Unorm => codec_unorm::encode_byte(component),
                NormalCodec::Biased => codec_biased::encode_hardened(component),
            })
        });
        [x, y, z, (mean.w * 255.0 + 0.5).trunc()]
    }
}

/// What is expected of averages that a kernel writes to `smaller`.
fn means_expected(
    dispatch: &Dispatch<'_>,
    module: &crate::route::Prepared,
    truths: impl Iterator<Item = [f64; 4]>,
) -> Result<Expectations, String> {
    let mut left = dispatch.accepted(module, &BTreeMap::new())?;
    let written = left.remove("smaller").ok_or("the kernel writes no averages")?;
    let bounds = float_bounds(&written);
    let (bounds, _) = bounds.as_chunks::<4>();
    Ok(pair(truths, bounds.iter().copied()))
}

/// The reference's next level; alpha is averaged like the normals.
fn next_level(before: &Level) -> Vec<DVec4> {
    let next = |of: fn(&Vec4) -> DVec3| {
        let level = reference::Level {
            width: before.width,
            height: before.height,
            texels: before.texels.iter().map(of).collect(),
        };
        level.next().texels
    };
    let normals = next(|t| t.truncate().as_dvec3());
    let alphas = next(|t| DVec3::splat(f64::from(t.w)));
    normals
        .into_iter()
        .zip(alphas)
        .map(|(normal, alpha)| normal.extend(alpha.x))
        .collect()
}

/// A level as the kernels read it.
fn mean_bytes(level: &Level) -> Vec<u8> {
    let floats = level.texels.iter().flat_map(|t| t.to_array());
    floats.flat_map(f32::to_le_bytes).collect()
}

fn floats_of(level: &Level) -> impl Iterator<Item = [f32; 4]> {
    level.texels.iter().map(|t| t.to_array())
}

fn four(floats: &[f32]) -> impl Iterator<Item = [f32; 4]> {
    floats.as_chunks::<4>().0.iter().copied()
}

impl KernelCase for MipsBake {
    fn id(&self) -> &CaseId {
        &self.id
    }

    fn basis(&self) -> Vec<&'static str> {
        twin_and_rules()
    }

    fn kernels(&self) -> Vec<Kernel> {
        vec![
            Kernel::NormalMipsDecode,
            Kernel::NormalMips,
            Kernel::NormalMipsEncode,
        ]
    }

    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String> {
        let mut tally = Tally::default();
        self.judge_base(bench, &mut tally)?;
        self.judge_levels(bench, &mut tally)?;
        self.judge_bytes(bench, &mut tally)?;
        let outcome = Outcome::of(tally.texels, tally.comparison, UNDECIDED_LIMIT);
        let note = format!(
            "{} of {} numbers differ from the twin, within what is allowed",
            tally.different,
            4 * tally.texels
        );
        let reason = outcome.reason.clone().or((tally.different > 0).then_some(note));
        Ok(Outcome { reason, ..outcome })
    }
}
