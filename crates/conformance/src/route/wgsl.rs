//! Route `wgsl`: the assembled text itself; wgpu compiles it with naga and adds its bounds checks.

use bossage_shaders::AssembledShader;
use bossage_translate::{Contents, EmitOptions, Shader, manifest};

use super::{Fault, Prepared, Text};

pub(super) fn prepare(
    shader: Shader,
    assembled: &AssembledShader,
    fault: Option<&Fault>,
) -> Result<Prepared, String> {
    let mut text = Contents::Text(assembled.wgsl.clone());
    if let Some(fault) = fault {
        fault.plant([&mut text])?;
    }
    let text = String::from_utf8_lossy(text.bytes()).into_owned();
    let manifest = manifest(&shader, &EmitOptions::default(), &[]);
    let entries = shader
        .entry_points()
        .map(|(name, _)| (name.to_owned(), Text::Wgsl(text.clone())))
        .collect();
    Ok(Prepared::new(shader, manifest, entries))
}
