//! `bossage bake`: maps from a height image, and the normalisation cube map, on the processor or on an adapter.
//! The maps that tracing reads are in `bake_relief`.
//!
//! Everything that one call writes is written together or not at all. An adapter writes the same bytes, but for codes that lie
//! within the rounding of f32 of a boundary between two: there the accuracy rules leave it the choice.

use std::path::Path;

use bossage_assets::{
    Channel, EdgeMode, HeightField, NormalCodec, NormalEncoding, NormalMap, NormalisationCubeMap,
    height_to_normal, height_to_normal_forward, load_image, normal_mips, normalisation_cube_map::Depth,
};

use crate::Verdict;
use crate::args::Global;
use crate::args::bake::{Bake, Bits, ChannelName, CodecName, EdgeName, NormalKind};
use crate::console::{self, Console};
use crate::error::{Error, Result};
use crate::output::Outputs;
use crate::{cube_files, picture};

pub(crate) fn run(args: &Bake, global: &Global, console: Console) -> Result<Verdict> {
    check_flags(args)?;
    let mut files = Files::default();
    if let Some(path) = &args.height {
        let field = heights(args, path, console)?;
        let stem = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
        normal_map(args, &field, &stem, global, console, &mut files)?;
        let baker = super::bake_relief::Baker {
            field: &field,
            edge: relief_edge(args),
            adapter: args.gpu.then_some((global, console)),
        };
        for (name, png) in baker.files(args.relief)? {
            files.add(args, &format!("{stem}_{name}"), png)?;
        }
    }
    if let Some(size) = args.normalisation_cube {
        let map = if args.gpu {
            super::bake_gpu::normalisation_cube(size, depth(args.bits), global, console)?
        } else {
            NormalisationCubeMap::generate(size, depth(args.bits))?
        };
        for (name, png) in cube_files::encode(&map)? {
            files.add(args, &name, png)?;
        }
    }
    files.write()
}

/// What will be written, and the names to print.
#[derive(Default)]
struct Files {
    outputs: Outputs,
    names: String,
}

impl Files {
    fn add(&mut self, args: &Bake, name: &str, bytes: Vec<u8>) -> Result<()> {
        let path = args.output.join(name);
        self.names.push_str(&format!("{}\n", path.display()));
        self.outputs.add(path, "bake", bytes)
    }

    fn write(self) -> Result<Verdict> {
        self.outputs.commit()?;
        console::print(&self.names)?;
        Ok(Verdict::Fine)
    }
}

fn heights(args: &Bake, path: &Path, console: Console) -> Result<HeightField> {
    let field = HeightField::from_image(&load_image(path)?, channel(args.channel))?;
    let (low, high) = field.range();
    console.note(format_args!(
        "{}: {} x {}, heights {low} to {high}",
        path.display(),
        field.width,
        field.height
    ));
    Ok(field)
}

fn normal_map(
    args: &Bake,
    field: &HeightField,
    stem: &str,
    global: &Global,
    console: Console,
    files: &mut Files,
) -> Result<()> {
    let map = match (encoding(args), args.gpu) {
        (NormalEncoding::Linear(_), true) => super::bake_gpu::bake(args, field, global, console)?,
        (NormalEncoding::Linear(_), false) => bake(args, field)?,
        (encoding, _) => encoded(args, field, encoding)?,
    };
    files.add(args, &format!("{stem}_normal.png"), png(&map)?)?;
    if !args.mips {
        return Ok(());
    }
    let levels = if args.gpu {
        super::bake_gpu::mips(&map, global, console)?
    } else {
        normal_mips::chain(&map, normal_mips::NormalMips::default())
    };
    for (level, map) in levels.iter().enumerate().skip(1) {
        files.add(args, &format!("{stem}_normal_mip{level}.png"), png(map)?)?;
    }
    Ok(())
}

fn png(map: &NormalMap) -> Result<Vec<u8>> {
    picture::png_rgba8(map.width, map.height, map.texels.as_flattened())
}

/// Flags that ask for what there is not are refused.
fn check_flags(args: &Bake) -> Result<()> {
    let refuse = |what: String| Err(Error::Call(what));
    if !args.scale.is_finite() {
        return refuse(format!("--scale {}: a finite number is needed", args.scale));
    }
    let published = |flag: &str, why: &str| refuse(format!("--normal forward does not take {flag}: {why}"));
    let codec = args.codec.filter(|codec| *codec != CodecName::Biased);
    if args.normal == NormalKind::Forward && args.edge.is_some() && args.relief.flags().next().is_none() {
        return published("--edge", "as published, its border is flat");
    }
    if let Some(codec) = codec.filter(|_| args.normal == NormalKind::Forward) {
        let flag = format!("--codec {}", name(codec));
        return published(&flag, "as published, it writes biased bytes");
    }
    if args.gpu && args.relief.window_maxima {
        return refuse("--gpu does not take --window-maxima: there is no kernel for it".to_owned());
    }
    let folded = codec.filter(|codec| *codec != CodecName::Unorm).map(name);
    match folded {
        Some(codec) if args.gpu => refuse(format!(
            "--gpu does not take --codec {codec}: the kernels write unorm and biased bytes"
        )),
        Some(codec) if args.mips => refuse(format!(
            "--mips does not take --codec {codec}: levels are averaged in a linear code; use unorm or biased"
        )),
        Some(_) | None => Ok(()),
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

/// A map in an encoding that is not linear: the bytes are the encoding's, alpha holds the height.
fn encoded(args: &Bake, field: &HeightField, encoding: NormalEncoding) -> Result<NormalMap> {
    let normals = height_to_normal::normals(field, &central(args, field)?);
    let texel = |(normal, height): (&glam::Vec3, &f32)| {
        let [r, g, b] = encoding.encode(*normal);
        [r, g, b, (height * 255.0 + 0.5) as u8]
    };
    Ok(NormalMap {
        width: field.width,
        height: field.height,
        // Says nothing here: the bytes are not in a linear code.
        codec: NormalCodec::Unorm,
        texels: normals.iter().zip(&field.texels).map(texel).collect(),
    })
}

/// What the central bake is given. Texels are square, so a scale in widths of the image is another one in heights of it.
pub(super) fn central(args: &Bake, field: &HeightField) -> Result<height_to_normal::Bake> {
    let codec = match encoding(args) {
        NormalEncoding::Linear(codec) => codec,
        NormalEncoding::Snorm | NormalEncoding::TwoChannel | NormalEncoding::Octahedral => NormalCodec::Unorm,
    };
    let edge = relief_edge(args);
    let scale = [args.scale, args.scale * field.width as f32 / field.height as f32];
    Ok(height_to_normal::Bake::central(field, scale, edge, codec)?)
}

/// The published bake measures elevation in texels a step of the height byte; we are given tiles between heights 0 and 1.
pub(super) fn texels_per_step(args: &Bake, field: &HeightField) -> f32 {
    args.scale * field.width as f32 / 255.0
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

fn encoding(args: &Bake) -> NormalEncoding {
    let default = match args.normal {
        NormalKind::Central => CodecName::Unorm,
        NormalKind::Forward => CodecName::Biased,
    };
    match args.codec.unwrap_or(default) {
        CodecName::Unorm => NormalEncoding::Linear(NormalCodec::Unorm),
        CodecName::Biased => NormalEncoding::Linear(NormalCodec::Biased),
        CodecName::Snorm => NormalEncoding::Snorm,
        CodecName::TwoChannel => NormalEncoding::TwoChannel,
        CodecName::Octahedral => NormalEncoding::Octahedral,
    }
}

const fn name(codec: CodecName) -> &'static str {
    match codec {
        CodecName::Unorm => "unorm",
        CodecName::Biased => "biased",
        CodecName::Snorm => "snorm",
        CodecName::TwoChannel => "two_channel",
        CodecName::Octahedral => "octahedral",
    }
}

const fn depth(bits: Bits) -> Depth {
    match bits {
        Bits::Eight => Depth::Eight,
        Bits::Sixteen => Depth::Sixteen,
    }
}

/// What lies beyond the border, but for the published normal map.
fn relief_edge(args: &Bake) -> EdgeMode {
    edge(args.edge.unwrap_or(EdgeName::Wrap))
}

const fn edge(name: EdgeName) -> EdgeMode {
    match name {
        EdgeName::Wrap => EdgeMode::Wrap,
        EdgeName::Mirror => EdgeMode::Mirror,
        EdgeName::Clamp => EdgeMode::Clamp,
    }
}
