//! Flags → emission options.

use bossage_translate::{EmitOptions, GlslVersion, ShaderModel, Stage, Target};

use crate::args::emit::{GlslVersion as GlslName, HlslVersion, MslVersion, StageName, TargetName, Versions};

/// The options that the version flags ask for.
pub(crate) fn options(versions: &Versions) -> EmitOptions {
    EmitOptions {
        hlsl: hlsl(versions.hlsl),
        msl: msl(versions.msl),
        glsl: glsl(versions.glsl),
        ..EmitOptions::default()
    }
}

/// The targets asked for, in the order in which they are always emitted, each once.
pub(crate) fn targets(names: &[TargetName]) -> Vec<Target> {
    Target::ALL
        .into_iter()
        .filter(|target| names.iter().any(|name| self::target(*name) == *target))
        .collect()
}

const fn target(name: TargetName) -> Target {
    match name {
        TargetName::Spirv => Target::Spirv,
        TargetName::Hlsl => Target::Hlsl,
        TargetName::Msl => Target::Msl,
        TargetName::Glsl => Target::Glsl,
        TargetName::Wgsl => Target::Wgsl,
    }
}

pub(crate) const fn stage(name: StageName) -> Stage {
    match name {
        StageName::Vertex => Stage::Vertex,
        StageName::Fragment => Stage::Fragment,
        StageName::Compute => Stage::Compute,
    }
}

const fn hlsl(version: HlslVersion) -> ShaderModel {
    match version {
        HlslVersion::V5_0 => ShaderModel::V5_0,
        HlslVersion::V5_1 => ShaderModel::V5_1,
        HlslVersion::V6_0 => ShaderModel::V6_0,
    }
}

const fn msl(version: MslVersion) -> (u8, u8) {
    match version {
        MslVersion::V2_0 => (2, 0),
        MslVersion::V2_1 => (2, 1),
        MslVersion::V2_2 => (2, 2),
        MslVersion::V2_3 => (2, 3),
        MslVersion::V2_4 => (2, 4),
        MslVersion::V3_0 => (3, 0),
        MslVersion::V3_1 => (3, 1),
        MslVersion::V3_2 => (3, 2),
    }
}

const fn glsl(version: GlslName) -> GlslVersion {
    match version {
        GlslName::Core330 => GlslVersion::Core330,
        GlslName::Core450 => GlslVersion::Core450,
        GlslName::Es300 => GlslVersion::Es300,
        GlslName::Es310 => GlslVersion::Es310,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn targets_come_in_one_order_and_once() {
        let asked = [TargetName::Wgsl, TargetName::Spirv, TargetName::Wgsl];
        assert_eq!(targets(&asked), [Target::Spirv, Target::Wgsl]);
    }

    /// The versions that the flags default to are those that the library defaults to.
    #[test]
    fn defaults_agree_with_the_library() {
        use clap::Parser;
        let cli = crate::args::Cli::try_parse_from(["bossage", "emit", "a.wgsl", "-o", "x"]).unwrap();
        let crate::args::Command::Emit(emit) = cli.command else {
            panic!("emit was asked for")
        };
        assert_eq!(options(&emit.versions), EmitOptions::default());
        assert_eq!(targets(&emit.target), Target::ALL);
    }
}
