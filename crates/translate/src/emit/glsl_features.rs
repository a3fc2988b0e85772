//! What a GLSL version lacks, with the place in the shader that asks for it.
//!
//! naga says which features are missing but not where they are used; this looks for the first use of each.

use naga::back::glsl::{Error, Features};
use naga::{
    BuiltIn, Expression, ImageClass, ImageDimension, ImageQuery, Interpolation, Sampling, Span, Statement,
    TypeInner,
};

use crate::diagnostic::{Code, Diagnostic};
use crate::emit::Job;
use crate::ir;
use crate::shader::Unit;

/// A GLSL error of naga's with a place where there is one.
pub(super) fn diagnostic(job: &Job<'_>, error: &Error) -> Diagnostic {
    match error {
        Error::MissingFeatures(missing) => missing_features(job, *missing),
        other => job.failed(other),
    }
}

fn missing_features(job: &Job<'_>, missing: Features) -> Diagnostic {
    let words: Vec<&str> = FEATURES
        .iter()
        .filter(|(feature, _)| missing.contains(*feature))
        .map(|(_, words)| *words)
        .collect();
    let place = FEATURES
        .iter()
        .filter(|(feature, _)| missing.contains(*feature))
        .find_map(|(feature, _)| find(job.unit, *feature));
    let what = if words.is_empty() {
        format!("{missing:?}")
    } else {
        words.join(" and ")
    };
    let message = format!("GLSL {} has no {what}", job.options.glsl);
    job.refuse(Code::Unsupported, message, place)
}

const FEATURES: [(Features, &str); 21] = [
    (Features::COMPUTE_SHADER, "compute shaders"),
    (Features::BUFFER_STORAGE, "storage buffers"),
    (Features::DYNAMIC_ARRAY_SIZE, "runtime-sized arrays"),
    (Features::IMAGE_LOAD_STORE, "storage textures"),
    (Features::FULL_IMAGE_FORMATS, "storage textures of this format"),
    (Features::IMAGE_SIZE, "size query of storage textures"),
    (
        Features::TEXTURE_LEVELS,
        "query of the number of mip levels (textureNumLevels)",
    ),
    (
        Features::TEXTURE_SAMPLES,
        "query of the number of samples (textureNumSamples)",
    ),
    (Features::TEXTURE_ATOMICS, "texture atomics"),
    (
        Features::TEXTURE_SHADOW_LOD,
        "explicit level for this depth texture",
    ),
    (Features::CUBE_TEXTURES_ARRAY, "cube map arrays"),
    (Features::MULTISAMPLED_TEXTURES, "multisampled textures"),
    (
        Features::MULTISAMPLED_TEXTURE_ARRAYS,
        "multisampled texture arrays",
    ),
    (Features::DOUBLE_TYPE, "64-bit floats"),
    (
        Features::NOPERSPECTIVE_QUALIFIER,
        "linear (noperspective) interpolation",
    ),
    (Features::SAMPLE_QUALIFIER, "interpolation at samples"),
    (Features::SAMPLE_VARIABLES, "sample index"),
    (Features::CLIP_DISTANCE, "clip distances"),
    (Features::MULTI_VIEW, "view index"),
    (Features::DUAL_SOURCE_BLENDING, "dual-source blending"),
    (Features::SUBGROUP_OPERATIONS, "subgroup operations"),
];

/// The first use of a feature.
fn find(unit: &Unit, feature: Features) -> Option<Span> {
    match feature {
        Features::BUFFER_STORAGE | Features::DYNAMIC_ARRAY_SIZE => storage_buffer(unit),
        Features::IMAGE_LOAD_STORE | Features::FULL_IMAGE_FORMATS => {
            image(unit, |_, class| matches!(class, ImageClass::Storage { .. }))
        }
        Features::IMAGE_SIZE => query(unit, |q| matches!(q, ImageQuery::Size { .. })),
        Features::TEXTURE_LEVELS => query(unit, |q| matches!(q, ImageQuery::NumLevels)),
        Features::TEXTURE_SAMPLES => query(unit, |q| matches!(q, ImageQuery::NumSamples)),
        Features::TEXTURE_ATOMICS => ir::find_statement(unit, |s| matches!(s, Statement::ImageAtomic { .. })),
        Features::TEXTURE_SHADOW_LOD => depth_sample(unit),
        Features::CUBE_TEXTURES_ARRAY => image(unit, |dim, _| dim == ImageDimension::Cube),
        Features::MULTISAMPLED_TEXTURES | Features::MULTISAMPLED_TEXTURE_ARRAYS => {
            image(unit, |_, class| class.is_multisampled())
        }
        Features::DOUBLE_TYPE => ir::find_type(unit, |t| ir::scalar_of(t) == Some(naga::Scalar::F64)),
        Features::NOPERSPECTIVE_QUALIFIER => varying(unit, |binding| {
            matches!(
                binding,
                naga::Binding::Location {
                    interpolation: Some(Interpolation::Linear),
                    ..
                }
            )
        }),
        Features::SAMPLE_QUALIFIER => varying(unit, |binding| {
            matches!(
                binding,
                naga::Binding::Location {
                    sampling: Some(Sampling::Sample),
                    ..
                }
            )
        }),
        Features::SAMPLE_VARIABLES => builtin(unit, BuiltIn::SampleIndex),
        Features::CLIP_DISTANCE => builtin(unit, BuiltIn::ClipDistances),
        Features::MULTI_VIEW => builtin(unit, BuiltIn::ViewIndex),
        Features::SUBGROUP_OPERATIONS => ir::find_expression(unit, |e| {
            matches!(
                e,
                Expression::SubgroupBallotResult | Expression::SubgroupOperationResult { .. }
            )
        }),
        // The entry point itself is the place.
        _ => None,
    }
}

fn storage_buffer(unit: &Unit) -> Option<Span> {
    let variables = &unit.module.global_variables;
    variables
        .iter()
        .find(|(_, v)| matches!(v.space, naga::AddressSpace::Storage { .. }))
        .map(|(handle, _)| variables.get_span(handle))
}

fn image(unit: &Unit, wanted: impl Fn(ImageDimension, ImageClass) -> bool) -> Option<Span> {
    ir::find_type(
        unit,
        |inner| matches!(*inner, TypeInner::Image { dim, class, .. } if wanted(dim, class)),
    )
}

fn query(unit: &Unit, wanted: impl Fn(ImageQuery) -> bool) -> Option<Span> {
    ir::find_expression(
        unit,
        |e| matches!(*e, Expression::ImageQuery { query, .. } if wanted(query)),
    )
}

fn depth_sample(unit: &Unit) -> Option<Span> {
    ir::find_expression(unit, |e| {
        matches!(*e, Expression::ImageSample { depth_ref: Some(_), level, .. }
            if level != naga::SampleLevel::Auto)
    })
}

fn builtin(unit: &Unit, wanted: BuiltIn) -> Option<Span> {
    varying(unit, |binding| *binding == naga::Binding::BuiltIn(wanted))
}

/// Arguments and members have no place of their own in the IR; that of the first expression that reads the argument
/// comes nearest.
fn varying(unit: &Unit, wanted: impl Fn(&naga::Binding) -> bool) -> Option<Span> {
    let function = &unit.entry().function;
    let at = function.arguments.iter().position(|argument| {
        argument.binding.as_ref().is_some_and(&wanted) || member_bindings(unit, argument.ty).any(&wanted)
    })?;
    let index = u32::try_from(at).ok()?;
    function
        .expressions
        .iter()
        .find(|(_, e)| **e == Expression::FunctionArgument(index))
        .map(|(handle, _)| function.expressions.get_span(handle))
}

fn member_bindings(unit: &Unit, ty: naga::Handle<naga::Type>) -> impl Iterator<Item = &naga::Binding> {
    let members = match &unit.module.types[ty].inner {
        TypeInner::Struct { members, .. } => members.as_slice(),
        _ => &[],
    };
    members.iter().filter_map(|member| member.binding.as_ref())
}
