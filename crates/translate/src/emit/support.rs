//! What a target cannot express, said before its writer runs.
//!
//! naga 30.0.1's writers are not total: given a valid module they may panic (`unreachable!`, `unimplemented!`) or write
//! something that the target's compilers refuse. Reached so far by valid input, and therefore refused here:
//!
//! - GLSL panics on external textures, per-vertex interpolation, ray queries, cooperative matrices; it writes `textureGather`
//!   in versions without it, and 16-bit integers without their extension.
//! - SPIR-V panics on external textures.
//! - HLSL panics on a sampler whose group has no index buffer and on push constants without a target (both are always
//!   given here), writes 16- and 64-bit types and wave operations in shader models without them, drops early depth tests.
//! - MSL drops early depth tests, and reaches `unreachable!` on 64-bit floats in vertex inputs.
//! - WGSL writes types that only naga reads (f64, i64, 16-bit integers, binding arrays).

use crate::diagnostic::{Code, Diagnostic};
use crate::emit::Job;
use crate::features::Feature;
use crate::target::{GlslVersion, ShaderModel, Target};

/// Refuses what the target cannot express.
pub(super) fn check(job: &Job<'_>) -> Result<(), Diagnostic> {
    check_version(job)?;
    for feature in Feature::ALL {
        if job.unit.features.contains(feature)
            && let Some(lacking) = lacking(feature, job)
        {
            let message = format!("{} cannot be expressed in {lacking}", feature.name());
            return Err(job.refuse(Code::Unsupported, message, feature.find(job.unit)));
        }
    }
    Ok(())
}

fn check_version(job: &Job<'_>) -> Result<(), Diagnostic> {
    let (known, given, what) = match job.target {
        Target::Spirv => (
            matches!(job.options.spirv, (1, 0..=6)),
            job.options.spirv,
            "SPIR-V 1.0 to 1.6 can be emitted",
        ),
        Target::Msl => (
            matches!(job.options.msl, (2, 0..=4) | (3, 0..=2) | (4, 0)),
            job.options.msl,
            "MSL 2.0 to 2.4, 3.0 to 3.2 and 4.0 can be emitted",
        ),
        Target::Hlsl | Target::Glsl | Target::Wgsl => return Ok(()),
    };
    if known {
        return Ok(());
    }
    let message = format!("{what}, not {}.{}", given.0, given.1);
    Err(Diagnostic::new(Code::Unsupported, message).in_file(job.shader.name()))
}

/// Why the target cannot express it; `None` if it can.
fn lacking(feature: Feature, job: &Job<'_>) -> Option<String> {
    let options = job.options;
    match job.target {
        Target::Spirv => in_spirv(feature),
        Target::Hlsl => in_hlsl(feature, options.hlsl),
        Target::Msl => in_msl(feature, options.msl),
        Target::Glsl => in_glsl(feature, options.glsl),
        Target::Wgsl => in_wgsl(feature),
    }
}

fn in_spirv(feature: Feature) -> Option<String> {
    (feature == Feature::ExternalTexture).then(|| "SPIR-V".to_owned())
}

fn in_hlsl(feature: Feature, model: ShaderModel) -> Option<String> {
    let from = |first: ShaderModel| {
        (model < first).then(|| format!("HLSL shader model {model} (it comes with {first})"))
    };
    match feature {
        Feature::Float16 | Feature::Int16 => from(ShaderModel::V6_2),
        Feature::Int64 | Feature::Subgroup => from(ShaderModel::V6_0),
        Feature::BindingArray => from(ShaderModel::V5_1),
        Feature::SamplerArray
        | Feature::ExternalTexture
        | Feature::RayQuery
        | Feature::CooperativeMatrix
        | Feature::PerVertex
        | Feature::EarlyDepthTest
        | Feature::ClipDistances => Some("HLSL as we emit it".to_owned()),
        Feature::Float64
        | Feature::TextureGather
        | Feature::DepthLoad
        | Feature::Immediates
        | Feature::InvariantPosition => None,
    }
}

fn in_msl(feature: Feature, version: (u8, u8)) -> Option<String> {
    match feature {
        Feature::Float64 => Some("MSL".to_owned()),
        Feature::Int64 if version < (2, 3) => {
            Some(format!("MSL {}.{} (they come with 2.3)", version.0, version.1))
        }
        Feature::InvariantPosition if version < (2, 1) => {
            Some(format!("MSL {}.{} (it comes with 2.1)", version.0, version.1))
        }
        Feature::ExternalTexture
        | Feature::RayQuery
        | Feature::CooperativeMatrix
        | Feature::PerVertex
        | Feature::EarlyDepthTest => Some("MSL as we emit it".to_owned()),
        Feature::Float16
        | Feature::Int16
        | Feature::Int64
        | Feature::BindingArray
        | Feature::SamplerArray
        | Feature::Subgroup
        | Feature::TextureGather
        | Feature::DepthLoad
        | Feature::ClipDistances
        | Feature::InvariantPosition
        | Feature::Immediates => None,
    }
}

fn in_glsl(feature: Feature, version: GlslVersion) -> Option<String> {
    match feature {
        Feature::Float16
        | Feature::Int16
        | Feature::Int64
        | Feature::BindingArray
        | Feature::SamplerArray
        | Feature::ExternalTexture
        | Feature::RayQuery
        | Feature::CooperativeMatrix
        | Feature::PerVertex => Some("GLSL as we emit it".to_owned()),
        Feature::DepthLoad => Some("GLSL, whose shadow samplers only compare".to_owned()),
        Feature::TextureGather => matches!(version, GlslVersion::Core330 | GlslVersion::Es300)
            .then(|| format!("GLSL {version} (it comes with 400 and es310)")),
        Feature::EarlyDepthTest => matches!(version, GlslVersion::Core330 | GlslVersion::Es300)
            .then(|| format!("GLSL {version} (they come with 420 and es310)")),
        // naga's own check covers these, version by version.
        Feature::Float64
        | Feature::Subgroup
        | Feature::ClipDistances
        | Feature::Immediates
        | Feature::InvariantPosition => None,
    }
}

fn in_wgsl(feature: Feature) -> Option<String> {
    match feature {
        Feature::Float64
        | Feature::Int16
        | Feature::Int64
        | Feature::BindingArray
        | Feature::SamplerArray
        | Feature::RayQuery
        | Feature::CooperativeMatrix
        | Feature::PerVertex
        | Feature::EarlyDepthTest
        | Feature::Immediates => Some("WGSL (only naga's dialect has them)".to_owned()),
        Feature::Float16
        | Feature::ExternalTexture
        | Feature::Subgroup
        | Feature::TextureGather
        | Feature::DepthLoad
        | Feature::ClipDistances
        | Feature::InvariantPosition => None,
    }
}
