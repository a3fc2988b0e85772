//! What a target cannot express, said before its writer runs.
//!
//! naga 30.0.1's writers are not total: given a valid module they may panic, or write something that the target's own
//! compilers refuse. The table below states for each feature where it can be used; beside what the languages really lack,
//! it refuses what naga is known to write wrongly:
//!
//! - panics: GLSL on external textures, per-vertex interpolation, ray queries and cooperative matrices; SPIR-V on external
//!   textures; HLSL on a sampler or push constants without a register (both always get one here); GLSL on a texture offset
//!   that is written `vec2i(1)` (repaired in [`crate::repairs`]);
//! - SPIR-V: sample masks that are no arrays, subgroup operations below 1.3;
//! - HLSL: 16- and 64-bit types and wave operations in shader models without them, early depth tests dropped;
//! - HLSL: offsets into textures of three dimensions written as two (repaired in [`super::sample_arguments`]);
//! - MSL: early depth tests dropped; gradients of cubes and volumes written as two-dimensional (repaired there too);
//! - GLSL: sample masks that are no arrays, depth textures sampled without comparison, `textureGather`, the primitive index
//!   and barycentric coordinates in versions without them, arrays of arrays in 330 (by a
//!   misspelt extension), 16-bit integers and lone subgroup values without their extension, extensions that only one vendor has (storage formats in ES) or no ES 3.0 compiler knows (clip distances);
//! - WGSL: types that only naga reads, and subgroup operations without `enable subgroups;`.
//!
//! `tests/corners.rs` holds each of these to independent compilers.

use crate::diagnostic::{Code, Diagnostic};
use crate::emit::Job;
use crate::features::Feature;
use crate::target::{GlslVersion, ShaderModel, Target};

/// From which version of a language a feature can be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Since {
    /// Any that we emit.
    Always,
    /// This one: 13 is SPIR-V 1.3, 62 shader model 6.2, 21 MSL 2.1, 450 and 310 GLSL.
    Version(u32),
    /// None.
    Never,
}

use Since::{Always as Y, Never as N, Version as V};

/// SPIR-V, HLSL, MSL, GLSL core, GLSL ES, WGSL. What depends on more than the version is left to naga (`Y`).
const fn row(feature: Feature) -> [Since; 6] {
    match feature {
        Feature::Float16 => [Y, V(62), Y, N, N, Y],
        Feature::Float64 => [Y, Y, N, Y, N, N],
        Feature::Int16 => [Y, V(62), Y, N, N, N],
        Feature::Int64 => [Y, V(60), V(23), N, N, N],
        Feature::NestedArray => [Y, Y, Y, V(430), V(310), Y],
        Feature::BindingArray => [Y, V(51), Y, N, N, N],
        Feature::SamplerArray => [Y, N, Y, N, N, N],
        Feature::ExternalTexture => [N, N, N, N, N, Y],
        Feature::RayQuery => [V(14), N, N, N, N, N],
        Feature::CooperativeMatrix => [Y, N, N, N, N, N],
        Feature::Subgroup => [V(13), V(60), Y, Y, Y, N],
        Feature::LoneSubgroupValue => [Y, Y, Y, N, N, N],
        Feature::TextureGather => [Y, Y, Y, V(400), V(310), Y],
        Feature::TextureAtomic => [Y, Y, V(31), Y, Y, N],
        Feature::DepthRead => [Y, Y, Y, N, N, Y],
        Feature::StorageFormat => [Y, Y, Y, Y, N, Y],
        Feature::PerVertex => [Y, N, N, N, N, N],
        Feature::EarlyDepthTest => [Y, N, N, V(420), V(310), N],
        Feature::ClipDistances => [Y, N, Y, Y, N, Y],
        Feature::SampleMask => [N, Y, Y, N, N, Y],
        Feature::Barycentric => [Y, N, V(23), V(450), N, N],
        Feature::PrimitiveIndex => [Y, Y, V(23), Y, V(310), Y],
        Feature::ViewIndex => [Y, V(62), V(22), Y, Y, N],
        Feature::Immediates => [Y, Y, Y, Y, Y, N],
        Feature::InvariantPosition => [Y, Y, V(21), Y, Y, Y],
    }
}

/// Refuses what the target cannot express.
pub(super) fn check(job: &Job<'_>) -> Result<(), Diagnostic> {
    check_version(job)?;
    let used = Feature::ALL
        .into_iter()
        .filter(|feature| job.unit.features.contains(*feature));
    for feature in used {
        if let Some(lacking) = lacking(feature, job) {
            let message = format!("{} cannot be expressed in {lacking}", feature.name());
            return Err(job.refuse(Code::Unsupported, message, feature.find(job.unit)));
        }
    }
    Ok(())
}

/// Why the target cannot express it; `None` if it can.
fn lacking(feature: Feature, job: &Job<'_>) -> Option<String> {
    let [spirv, hlsl, msl, core, es, wgsl] = row(feature);
    let options = job.options;
    let (since, version, name) = match job.target {
        Target::Spirv => (spirv, ten(options.spirv), "SPIR-V"),
        Target::Hlsl => (hlsl, model(options.hlsl), "HLSL shader model"),
        Target::Msl => (msl, ten(options.msl), "MSL"),
        Target::Glsl => {
            let (is_es, version) = glsl(options.glsl);
            if is_es {
                (es, version, "GLSL ES")
            } else {
                (core, version, "GLSL")
            }
        }
        Target::Wgsl => (wgsl, 0, "WGSL"),
    };
    match since {
        Since::Always => None,
        Since::Never => Some(format!(
            "{} as we emit it",
            name.trim_end_matches(" shader model")
        )),
        Since::Version(first) if version >= first => None,
        Since::Version(first) => Some(format!(
            "{name} {} (it comes with {})",
            dotted(version),
            dotted(first)
        )),
    }
}

fn ten((major, minor): (u8, u8)) -> u32 {
    u32::from(major) * 10 + u32::from(minor)
}

const fn model(model: ShaderModel) -> u32 {
    match model {
        ShaderModel::V5_0 => 50,
        ShaderModel::V5_1 => 51,
        ShaderModel::V6_0 => 60,
        ShaderModel::V6_2 => 62,
    }
}

/// Whether it is a version for ES, and its number.
const fn glsl(version: GlslVersion) -> (bool, u32) {
    match version {
        GlslVersion::Core330 => (false, 330),
        GlslVersion::Core430 => (false, 430),
        GlslVersion::Core450 => (false, 450),
        GlslVersion::Es300 => (true, 300),
        GlslVersion::Es310 => (true, 310),
    }
}

/// `21` is 2.1; GLSL's three digits are written without a point.
fn dotted(version: u32) -> String {
    if version < 100 {
        format!("{}.{}", version / 10, version % 10)
    } else {
        version.to_string()
    }
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
