//! `bossage bake --gpu`: the bake kernels of the library on an adapter; without a driver on the evaluator.

use std::collections::BTreeMap;

use bossage_assets::{EdgeMode, HeightField, NormalCodec, NormalMap};
use bossage_runner::{BufferData, Code, ComputeJob, Resources, Shader as Stage, TextureData};
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
    let (library, _) = inputs::library(global)?;
    let assembled = library.assemble_kernel(kernel)?;
    let entry = inputs::entry(&assembled)?;
    let height_map = TextureData::r32f(field.width, field.height, &field.texels);
    let texels = BufferData::Output(field.texels.len() * 4);
    let job = ComputeJob {
        name: &assembled.name,
        shader: Stage {
            code: Code::Wgsl(&assembled.wgsl),
            entry: &entry,
        },
        resources: Resources {
            uniforms,
            buffers: BTreeMap::from([("texels".to_owned(), texels)]),
            textures: BTreeMap::from([("height_map".to_owned(), &height_map)]),
            ..Resources::default()
        },
        workgroups: [
            field.width.div_ceil(WORKGROUP_SIDE),
            field.height.div_ceil(WORKGROUP_SIDE),
            1,
        ],
    };
    let output = job.run(machine::open(None, console)?.as_ref())?;
    let texels = output.words("texels").into_iter().map(u32::to_le_bytes).collect();
    Ok(NormalMap {
        width: field.width,
        height: field.height,
        codec,
        texels,
    })
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
