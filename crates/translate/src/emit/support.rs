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

use naga::{Expression, ImageClass, Interpolation, Scalar, ScalarKind, Span, Statement, TypeInner};

use crate::diagnostic::{Code, Diagnostic};
use crate::emit::Job;
use crate::ir;
use crate::shader::Unit;
use crate::target::{GlslVersion, ShaderModel, Target};
use crate::type_name::scalar_name;

/// A thing that a shader may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Feature {
    Float16,
    Float64,
    Int16,
    Int64,
    BindingArray,
    SamplerArray,
    ExternalTexture,
    RayQuery,
    CooperativeMatrix,
    Subgroup,
    TextureGather,
    PerVertex,
    EarlyDepthTest,
    ClipDistances,
    Immediates,
}

impl Feature {
    const ALL: [Self; 15] = [
        Self::Float16,
        Self::Float64,
        Self::Int16,
        Self::Int64,
        Self::BindingArray,
        Self::SamplerArray,
        Self::ExternalTexture,
        Self::RayQuery,
        Self::CooperativeMatrix,
        Self::Subgroup,
        Self::TextureGather,
        Self::PerVertex,
        Self::EarlyDepthTest,
        Self::ClipDistances,
        Self::Immediates,
    ];

    fn name(self) -> String {
        match self {
            Self::Float16 => format!("16-bit floats ({})", scalar_name(Scalar::F16)),
            Self::Float64 => format!("64-bit floats ({})", scalar_name(Scalar::F64)),
            Self::Int16 => "16-bit integers".to_owned(),
            Self::Int64 => "64-bit integers".to_owned(),
            Self::BindingArray => "binding arrays".to_owned(),
            Self::SamplerArray => "arrays of samplers".to_owned(),
            Self::ExternalTexture => "external textures".to_owned(),
            Self::RayQuery => "ray queries".to_owned(),
            Self::CooperativeMatrix => "cooperative matrices".to_owned(),
            Self::Subgroup => "subgroup operations".to_owned(),
            Self::TextureGather => "textureGather".to_owned(),
            Self::PerVertex => "per-vertex interpolation".to_owned(),
            Self::EarlyDepthTest => "forced early depth tests".to_owned(),
            Self::ClipDistances => "clip distances".to_owned(),
            Self::Immediates => "push constants".to_owned(),
        }
    }

    /// Where the shader uses it first; `None` if it does not.
    fn find(self, unit: &Unit) -> Option<Span> {
        match self {
            Self::Float16 => find_scalar(unit, ScalarKind::Float, 2),
            Self::Float64 => find_scalar(unit, ScalarKind::Float, 8),
            Self::Int16 => find_integer(unit, 2),
            Self::Int64 => find_integer(unit, 8),
            Self::BindingArray => ir::find_type(unit, |t| matches!(t, TypeInner::BindingArray { .. })),
            Self::SamplerArray => find_sampler_array(unit),
            Self::ExternalTexture => ir::find_type(unit, |t| {
                matches!(
                    t,
                    TypeInner::Image {
                        class: ImageClass::External,
                        ..
                    }
                )
            }),
            Self::RayQuery => ir::find_type(unit, |t| {
                matches!(
                    t,
                    TypeInner::RayQuery { .. } | TypeInner::AccelerationStructure { .. }
                )
            }),
            Self::CooperativeMatrix => {
                ir::find_type(unit, |t| matches!(t, TypeInner::CooperativeMatrix { .. }))
            }
            Self::Subgroup => find_subgroup(unit),
            Self::TextureGather => ir::find_expression(unit, |e| {
                matches!(e, Expression::ImageSample { gather: Some(_), .. })
            }),
            Self::PerVertex => find_input(unit, |binding| {
                matches!(
                    binding,
                    naga::Binding::Location {
                        interpolation: Some(Interpolation::PerVertex),
                        ..
                    }
                )
            }),
            Self::EarlyDepthTest => unit.entry().early_depth_test.map(|_| Span::UNDEFINED),
            Self::ClipDistances => find_clip_distances(unit),
            Self::Immediates => crate::resources::immediates(unit)
                .map(|(handle, _)| unit.module.global_variables.get_span(handle)),
        }
    }

    /// Why the target cannot express it; `None` if it can.
    fn lacking(self, job: &Job<'_>) -> Option<String> {
        let options = job.options;
        match job.target {
            Target::Spirv => self.lacking_in_spirv(),
            Target::Hlsl => self.lacking_in_hlsl(options.hlsl),
            Target::Msl => self.lacking_in_msl(options.msl),
            Target::Glsl => self.lacking_in_glsl(options.glsl),
            Target::Wgsl => self.lacking_in_wgsl(),
        }
    }

    fn lacking_in_spirv(self) -> Option<String> {
        (self == Self::ExternalTexture).then(|| "SPIR-V".to_owned())
    }

    fn lacking_in_hlsl(self, model: ShaderModel) -> Option<String> {
        let from = |first: ShaderModel| {
            (model < first).then(|| format!("HLSL shader model {model} (it comes with {first})"))
        };
        match self {
            Self::Float16 | Self::Int16 => from(ShaderModel::V6_2),
            Self::Int64 | Self::Subgroup => from(ShaderModel::V6_0),
            Self::BindingArray => from(ShaderModel::V5_1),
            Self::SamplerArray
            | Self::ExternalTexture
            | Self::RayQuery
            | Self::CooperativeMatrix
            | Self::PerVertex
            | Self::EarlyDepthTest
            | Self::ClipDistances => Some("HLSL as we emit it".to_owned()),
            Self::Float64 | Self::TextureGather | Self::Immediates => None,
        }
    }

    fn lacking_in_msl(self, version: (u8, u8)) -> Option<String> {
        match self {
            Self::Float64 => Some("MSL".to_owned()),
            Self::Int64 if version < (2, 3) => {
                Some(format!("MSL {}.{} (they come with 2.3)", version.0, version.1))
            }
            Self::ExternalTexture
            | Self::RayQuery
            | Self::CooperativeMatrix
            | Self::PerVertex
            | Self::EarlyDepthTest => Some("MSL as we emit it".to_owned()),
            Self::Float16
            | Self::Int16
            | Self::Int64
            | Self::BindingArray
            | Self::SamplerArray
            | Self::Subgroup
            | Self::TextureGather
            | Self::ClipDistances
            | Self::Immediates => None,
        }
    }

    fn lacking_in_glsl(self, version: GlslVersion) -> Option<String> {
        match self {
            Self::Float16
            | Self::Int16
            | Self::Int64
            | Self::BindingArray
            | Self::SamplerArray
            | Self::ExternalTexture
            | Self::RayQuery
            | Self::CooperativeMatrix
            | Self::PerVertex => Some("GLSL as we emit it".to_owned()),
            Self::TextureGather => matches!(version, GlslVersion::Core330 | GlslVersion::Es300)
                .then(|| format!("GLSL {version} (it comes with 400 and es310)")),
            Self::EarlyDepthTest => matches!(version, GlslVersion::Core330 | GlslVersion::Es300)
                .then(|| format!("GLSL {version} (they come with 420 and es310)")),
            // naga's own check covers these, version by version.
            Self::Float64 | Self::Subgroup | Self::ClipDistances | Self::Immediates => None,
        }
    }

    fn lacking_in_wgsl(self) -> Option<String> {
        match self {
            Self::Float64
            | Self::Int16
            | Self::Int64
            | Self::BindingArray
            | Self::SamplerArray
            | Self::RayQuery
            | Self::CooperativeMatrix
            | Self::PerVertex
            | Self::EarlyDepthTest
            | Self::Immediates => Some("WGSL (only naga's dialect has them)".to_owned()),
            Self::Float16
            | Self::ExternalTexture
            | Self::Subgroup
            | Self::TextureGather
            | Self::ClipDistances => None,
        }
    }
}

/// Refuses what the target cannot express.
pub(super) fn check(job: &Job<'_>) -> Result<(), Diagnostic> {
    check_version(job)?;
    for feature in Feature::ALL {
        let Some(lacking) = feature.lacking(job) else {
            continue;
        };
        if let Some(span) = feature.find(job.unit) {
            let message = format!("{} cannot be expressed in {lacking}", feature.name());
            return Err(job.refuse(Code::Unsupported, message, Some(span)));
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

fn find_scalar(unit: &Unit, kind: ScalarKind, width: u8) -> Option<Span> {
    ir::find_type(unit, |t| {
        ir::scalar_of(t).is_some_and(|s| s.kind == kind && s.width == width)
    })
}

fn find_integer(unit: &Unit, width: u8) -> Option<Span> {
    find_scalar(unit, ScalarKind::Sint, width).or_else(|| find_scalar(unit, ScalarKind::Uint, width))
}

fn find_sampler_array(unit: &Unit) -> Option<Span> {
    ir::find_type(unit, |t| {
        matches!(*t, TypeInner::BindingArray { base, .. }
            if matches!(unit.module.types[base].inner, TypeInner::Sampler { .. }))
    })
}

fn find_subgroup(unit: &Unit) -> Option<Span> {
    ir::find_statement(unit, |statement| {
        matches!(
            statement,
            Statement::SubgroupBallot { .. }
                | Statement::SubgroupGather { .. }
                | Statement::SubgroupCollectiveOperation { .. }
        )
    })
}

fn find_input(unit: &Unit, wanted: impl Fn(&naga::Binding) -> bool) -> Option<Span> {
    ir::interface(unit, false)
        .iter()
        .any(|(_, _, binding)| wanted(binding))
        .then_some(Span::UNDEFINED)
}

fn find_clip_distances(unit: &Unit) -> Option<Span> {
    ir::interface(unit, true)
        .iter()
        .any(|(_, _, b)| *b == naga::Binding::BuiltIn(naga::BuiltIn::ClipDistances))
        .then_some(Span::UNDEFINED)
}
