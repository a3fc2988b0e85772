//! Route `wgsl`: the assembled text itself; wgpu compiles it with naga and adds its bounds checks.

use bossage_shaders::AssembledShader;
use bossage_translate::{EmitOptions, Shader, manifest};

use super::{Prepared, Text};

pub(super) fn prepare(shader: Shader, assembled: &AssembledShader) -> Prepared {
    let manifest = manifest(&shader, &EmitOptions::default(), &[]);
    let entries = shader
        .entry_points()
        .map(|(name, _)| (name.to_owned(), Text::Wgsl(assembled.wgsl.clone())))
        .collect();
    Prepared::new(shader, manifest, entries)
}
