//! `bossage bake`: maps from a height image, on the processor or on an adapter, with the same bytes.

use std::path::{Path, PathBuf};

use bossage_assets::{
    Channel, EdgeMode, HeightField, NormalCodec, NormalMap, height_to_normal, height_to_normal_forward,
    load_image,
};

use crate::Verdict;
use crate::args::Global;
use crate::args::bake::{Bake, ChannelName, CodecName, EdgeName, NormalKind};
use crate::console::{self, Console};
use crate::error::{Error, Result};
use crate::output::write_whole;
use crate::picture;

pub(crate) fn run(args: &Bake, global: &Global, console: Console) -> Result<Verdict> {
    check_flags(args)?;
    let field = HeightField::from_image(&load_image(&args.height)?, channel(args.channel))?;
    let (low, high) = field.range();
    console.note(format_args!(
        "{}: {} x {}, heights {low} to {high}",
        args.height.display(),
        field.width,
        field.height
    ));
    let map = if args.gpu {
        super::bake_gpu::bake(args, &field, global, console)?
    } else {
        bake(args, &field)?
    };
    let path = output_path(args);
    write_whole(
        &path,
        picture::png_rgba8(map.width, map.height, map.texels.as_flattened())?,
    )?;
    console::print(&format!("{}\n", path.display()))?;
    Ok(Verdict::Fine)
}

/// The published forward bake has one codec and a flat border: flags that ask for something else are refused.
fn check_flags(args: &Bake) -> Result<()> {
    let refuse = |flag: &str, why: &str| {
        Err(Error::Call(format!(
            "--normal forward does not take {flag}: {why}"
        )))
    };
    if !args.scale.is_finite() {
        return Err(Error::Call(format!(
            "--scale {}: a finite number is needed",
            args.scale
        )));
    }
    match args.normal {
        NormalKind::Forward if args.edge.is_some() => refuse("--edge", "as published, its border is flat"),
        NormalKind::Forward if matches!(args.codec, Some(CodecName::Unorm)) => {
            refuse("--codec unorm", "as published, it writes biased bytes")
        }
        NormalKind::Forward | NormalKind::Central => Ok(()),
    }
}

fn bake(args: &Bake, field: &HeightField) -> Result<NormalMap> {
    match args.normal {
        NormalKind::Central => Ok(height_to_normal::bake(field, &central(args, field)?)),
        NormalKind::Forward => Ok(height_to_normal_forward::bake(
            field,
            texels_per_step(args, field),
        )),
    }
}

/// What the central bake is given. Texels are square, so a scale in widths of the image is another one in heights of it.
pub(super) fn central(args: &Bake, field: &HeightField) -> Result<height_to_normal::Bake> {
    let codec = codec(args.codec.unwrap_or(CodecName::Unorm));
    let edge = edge(args.edge.unwrap_or(EdgeName::Wrap));
    let scale = [args.scale, args.scale * field.width as f32 / field.height as f32];
    Ok(height_to_normal::Bake::central(field, scale, edge, codec)?)
}

/// The published bake measures elevation in texels a step of the height byte; we are given tiles between heights 0 and 1.
pub(super) fn texels_per_step(args: &Bake, field: &HeightField) -> f32 {
    args.scale * field.width as f32 / 255.0
}

fn output_path(args: &Bake) -> PathBuf {
    let stem = args.height.file_stem().unwrap_or(args.height.as_os_str());
    let mut name = stem.to_owned();
    name.push("_normal.png");
    args.output.join(Path::new(&name))
}

const fn channel(name: ChannelName) -> Channel {
    match name {
        ChannelName::Red => Channel::Red,
        ChannelName::Green => Channel::Green,
        ChannelName::Blue => Channel::Blue,
        ChannelName::Alpha => Channel::Alpha,
        ChannelName::Luminance => Channel::Luminance,
    }
}

const fn codec(name: CodecName) -> NormalCodec {
    match name {
        CodecName::Unorm => NormalCodec::Unorm,
        CodecName::Biased => NormalCodec::Biased,
    }
}

const fn edge(name: EdgeName) -> EdgeMode {
    match name {
        EdgeName::Wrap => EdgeMode::Wrap,
        EdgeName::Mirror => EdgeMode::Mirror,
        EdgeName::Clamp => EdgeMode::Clamp,
    }
}
