//! `bossage render`: a scene as a PNG, or two ways of drawing it side by side with their difference.

use bossage_runner::Machine;
use bossage_scene::Scene;
use bossage_shaders::Library;

use crate::Verdict;
use crate::args::Global;
use crate::args::render::Render;
use crate::console::{self, Console};
use crate::error::Result;
use crate::output::{check_writable, write_whole};
use crate::picture::{Difference, Linear, difference};
use crate::{drawing, inputs, machine, technique};

pub(crate) fn run(args: &Render, global: &Global, console: Console) -> Result<Verdict> {
    let (library, _) = inputs::library(global)?;
    let mut variants = variants(args)?;
    if let Some(size) = args.size {
        for scene in &mut variants {
            scene.camera.size = [size.width, size.height];
        }
    }
    check_writable(&args.output)?;
    let machine = machine::open(args.adapter.as_deref(), console)?;
    console.note(format_args!("{} on {}", args.scene.display(), machine.info()));
    let pictures = variants
        .iter()
        .map(|scene| picture(machine.as_ref(), scene, &library))
        .collect::<Result<Vec<_>>>()?;
    let picture = match pictures.as_slice() {
        [a, b] => compared(a, b, console),
        _ => Linear::beside(&pictures),
    };
    write_whole(&args.output, picture.png()?)?;
    console::print(&format!("{}\n", args.output.display()))?;
    Ok(Verdict::Fine)
}

/// The scenes to draw: as the file has it, in one other way, or in each of two.
fn variants(args: &Render) -> Result<Vec<Scene>> {
    let ways: Vec<&String> = args
        .technique
        .iter()
        .chain(args.compare.iter().flat_map(|pair| &pair.0))
        .collect();
    if ways.is_empty() {
        return Ok(vec![bossage_scene::load(&args.scene)?]);
    }
    ways.into_iter()
        .map(|way| technique::varied(&args.scene, way))
        .collect()
}

/// A scene, planned and drawn.
pub(crate) fn picture(machine: &dyn Machine, scene: &Scene, library: &Library) -> Result<Linear> {
    drawing::draw(machine, scene, &bossage_scene::plan(scene), library)
}

fn compared(a: &Linear, b: &Linear, console: Console) -> Linear {
    let Difference {
        picture,
        amplification,
        max,
        mean,
    } = difference(a, b);
    console.note(format_args!(
        "left, middle: the two; right: |difference| × {amplification:.4}; in linear light max {max:.6}, mean {mean:.6}"
    ));
    Linear::beside(&[a.clone(), b.clone(), picture])
}
