//! `bossage bake --gpu`: the bake kernels of the library on an adapter; without a driver on the evaluator.

use std::collections::BTreeMap;

use bossage_assets::max_mip::codes::MaxCodes;
use bossage_assets::normalisation_cube_map::Depth;
use bossage_assets::{ConeMap, EdgeMode, HeightField, NormalCodec, NormalMap, NormalisationCubeMap, Texels};
use bossage_conformance::cone_passes;
use bossage_runner::{
    BufferData, Code, ComputeJob, ComputeOutput, Machine, Resources, Shader as Stage, TextureData,
};
use bossage_shaders::Kernel;

use crate::args::Global;
use crate::args::bake::{Bake, NormalKind};
use crate::console::Console;
use crate::error::Result;
use crate::{inputs, machine, run};

/// Invocations of a workgroup along each axis, as the kernels declare.
const WORKGROUP_SIDE: u32 = 8;

pub(super) fn bake(args: &Bake, field: &HeightField, global: &Global, console: Console) -> Result<NormalMap> {
    let (kernel, uniforms, codec) = kernel(args, field)?;
    let height_map = TextureData::r32f(field.width, field.height, &field.texels);
    let texels = BufferData::Output(field.texels.len() * 4);
    let resources = Resources {
        uniforms,
        buffers: BTreeMap::from([("texels".to_owned(), texels)]),
        textures: BTreeMap::from([("height_map".to_owned(), &height_map)]),
        ..Resources::default()
    };
    let [x, y] = [field.width, field.height].map(|side| side.div_ceil(WORKGROUP_SIDE));
    let output = Kernels::open(global, console)?.dispatch(kernel, resources, [x, y, 1])?;
    let texels = output.words("texels").into_iter().map(u32::to_le_bytes).collect();
    Ok(NormalMap {
        width: field.width,
        height: field.height,
        codec,
        texels,
    })
}

/// The normalisation cube map.
pub(super) fn normalisation_cube(
    size: u32,
    depth: Depth,
    global: &Global,
    console: Console,
) -> Result<NormalisationCubeMap> {
    // The twin says which sizes there are.
    NormalisationCubeMap::check_size(size, depth)?;
    let (kernel, words) = match depth {
        Depth::Eight => (Kernel::NormalisationCubeMap, 1),
        Depth::Sixteen => (Kernel::NormalisationCubeMap16, 2),
    };
    let side = size.div_ceil(WORKGROUP_SIDE);
    let face_words = words * (size * size) as usize;
    let kernels = Kernels::open(global, console)?;
    let texels = BufferData::Output(4 * 6 * face_words);
    let uniforms = BTreeMap::from([("bake.size".to_owned(), vec![size as f32])]);
    let found = kernels.run(kernel, uniforms, &[("texels", texels)], [side, side, 6])?;
    let found = found.buffers.get("texels").map(Vec::as_slice).unwrap_or_default();
    let face = |index: usize| {
        let bytes = found.get(4 * face_words * index..).unwrap_or_default();
        let bytes = bytes.get(..4 * face_words).unwrap_or(bytes);
        match depth {
            Depth::Eight => Texels::Unorm8(bytes.to_vec()),
            Depth::Sixteen => {
                let codes = bytes.as_chunks::<2>().0.iter();
                Texels::Unorm16(codes.map(|code| u16::from_le_bytes(*code)).collect())
            }
        }
    };
    Ok(NormalisationCubeMap {
        size,
        faces: [0, 1, 2, 3, 4, 5].map(face),
    })
}

/// The levels of a normal map, the map itself first.
pub(super) fn mips(map: &NormalMap, global: &Global, console: Console) -> Result<Vec<NormalMap>> {
    let kernels = Kernels::open(global, console)?;
    let codec = vec![match map.codec {
        NormalCodec::Unorm => 0.0,
        NormalCodec::Biased => 1.0,
    }];
    let uniforms = |[width, height]: [u32; 2]| {
        BTreeMap::from([
            ("bake.size".to_owned(), vec![width as f32, height as f32]),
            ("bake.codec".to_owned(), codec.clone()),
        ])
    };
    let mut size = [map.width, map.height];
    let mut means = kernels.means(
        Kernel::NormalMipsDecode,
        uniforms(size),
        ("texels", map.texels.as_flattened()),
        size,
    )?;
    let mut levels = vec![map.clone()];
    while size != [1, 1] {
        let smaller = size.map(|side| (side / 2).max(1));
        means = kernels.means(Kernel::NormalMips, uniforms(size), ("means", &means), smaller)?;
        size = smaller;
        let count = (size[0] * size[1]) as usize;
        let buffers = [
            ("means", BufferData::Bytes(&means)),
            ("texels", BufferData::Output(4 * count)),
        ];
        let groups = [(count as u32).div_ceil(64), 1, 1];
        let found = kernels.run(Kernel::NormalMipsEncode, uniforms(size), &buffers, groups)?;
        levels.push(NormalMap {
            width: size[0],
            height: size[1],
            codec: map.codec,
            texels: found.words("texels").into_iter().map(u32::to_le_bytes).collect(),
        });
    }
    Ok(levels)
}

/// The maxima of the surface, level by level.
pub(super) fn max_mip(
    field: &HeightField,
    edge: EdgeMode,
    global: &Global,
    console: Console,
) -> Result<Vec<MaxCodes>> {
    let kernels = Kernels::open(global, console)?;
    let level = |kernel: Kernel, from: &[u16], size: [u32; 2], to: [u32; 2]| -> Result<MaxCodes> {
        let uniforms = BTreeMap::from([
            ("bake.size".to_owned(), size.map(|side| side as f32).to_vec()),
            ("bake.edge_mode".to_owned(), vec![edge_number(edge)]),
        ]);
        let words: Vec<u8> = from
            .iter()
            .flat_map(|code| u32::from(*code).to_le_bytes())
            .collect();
        let buffers = [
            ("codes", BufferData::Bytes(&words)),
            ("maxima", BufferData::Output(4 * (to[0] * to[1]) as usize)),
        ];
        let side = |axis: usize| to[axis].div_ceil(WORKGROUP_SIDE);
        let found = kernels.run(kernel, uniforms, &buffers, [side(0), side(1), 1])?;
        Ok(MaxCodes {
            width: to[0],
            height: to[1],
            codes: found
                .words("maxima")
                .into_iter()
                .map(|code| code as u16)
                .collect(),
        })
    };
    let mut size = [field.width, field.height];
    let mut levels = vec![level(Kernel::MaxMipTexels, &field.to_unorm16_up(), size, size)?];
    while let Some(last) = levels.last().filter(|_| size != [1, 1]) {
        let smaller = size.map(|side| (side / 2).max(1));
        let next = level(Kernel::MaxMip, &last.codes, size, smaller)?;
        levels.push(next);
        size = smaller;
    }
    Ok(levels)
}

/// Free or relaxed cones.
pub(super) fn cones(
    field: &HeightField,
    edge: EdgeMode,
    relaxed: bool,
    global: &Global,
    console: Console,
) -> Result<ConeMap> {
    let kernels = Kernels::open(global, console)?;
    let ratios = cone_passes::ratios(field, edge, relaxed, |pass| {
        let [x, y, _] = pass.invocations.map(|count| count.div_ceil(WORKGROUP_SIDE));
        let uniforms = pass.uniforms.into_iter().collect();
        kernels.run(pass.kernel, uniforms, &pass.buffers, [x, y, 1])
    })?;
    Ok(ConeMap {
        width: field.width,
        height: field.height,
        ratios,
    })
}

/// The library's kernels on a device.
struct Kernels {
    machine: Box<dyn Machine>,
    library: bossage_shaders::Library,
}

impl Kernels {
    fn open(global: &Global, console: Console) -> Result<Self> {
        let (library, _) = inputs::library(global)?;
        let machine = machine::open(None, console)?;
        Ok(Self { machine, library })
    }

    /// A kernel that reads no textures.
    fn run(
        &self,
        kernel: Kernel,
        uniforms: Uniforms,
        buffers: &[(&str, BufferData<'_>)],
        workgroups: [u32; 3],
    ) -> Result<ComputeOutput> {
        let resources = Resources {
            uniforms,
            buffers: buffers
                .iter()
                .map(|(name, data)| ((*name).to_owned(), *data))
                .collect(),
            ..Resources::default()
        };
        self.dispatch(kernel, resources, workgroups)
    }

    fn dispatch(
        &self,
        kernel: Kernel,
        resources: Resources<'_>,
        workgroups: [u32; 3],
    ) -> Result<ComputeOutput> {
        let assembled = self.library.assemble_kernel(kernel)?;
        let entry = inputs::entry(&assembled)?;
        let job = ComputeJob {
            name: &assembled.name,
            shader: Stage {
                code: Code::Wgsl(&assembled.wgsl),
                entry: &entry,
            },
            resources,
            workgroups,
        };
        Ok(job.run(self.machine.as_ref())?)
    }

    /// The averages of a level of this size, as the bytes of four floats a texel.
    fn means(
        &self,
        kernel: Kernel,
        uniforms: Uniforms,
        (name, from): (&str, &[u8]),
        [width, height]: [u32; 2],
    ) -> Result<Vec<u8>> {
        let count = (width * height) as usize;
        let buffers = [
            (name, BufferData::Bytes(from)),
            ("smaller", BufferData::Output(16 * count)),
        ];
        let [x, y, _] = kernel.workgroup_size();
        let groups = match y {
            1 => [(count as u32).div_ceil(x), 1, 1],
            _ => [width.div_ceil(x), height.div_ceil(y), 1],
        };
        let mut found = self.run(kernel, uniforms, &buffers, groups)?;
        Ok(found.buffers.remove("smaller").unwrap_or_default())
    }
}

type Uniforms = BTreeMap<String, Vec<f32>>;

fn kernel(args: &Bake, field: &HeightField) -> Result<(Kernel, Uniforms, NormalCodec)> {
    let uniform = |name: &str, value: Vec<f32>| (format!("bake.{name}"), value);
    match args.normal {
        NormalKind::Central => {
            let bake = run::bake::central(args, field)?;
            let uniforms = BTreeMap::from([
                uniform("slope", bake.slope.to_vec()),
                uniform("byte_scale_offset", bake.byte_scale_offset().to_vec()),
                uniform("edge_mode", vec![edge_number(bake.edge)]),
            ]);
            Ok((Kernel::HeightToNormal, uniforms, bake.codec))
        }
        NormalKind::Forward => {
            let scale = run::bake::texels_per_step(args, field);
            let uniforms = BTreeMap::from([uniform("height_scale", vec![scale])]);
            Ok((
                Kernel::HeightToNormalForwardPublished,
                uniforms,
                NormalCodec::Biased,
            ))
        }
    }
}

/// The kernels' number of an edge mode.
const fn edge_number(edge: EdgeMode) -> f32 {
    match edge {
        EdgeMode::Wrap => 0.0,
        EdgeMode::Mirror => 1.0,
        EdgeMode::Clamp => 2.0,
    }
}
