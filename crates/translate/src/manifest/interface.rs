//! Inputs and outputs, with the names that each language gives them.
//!
//! naga names user-defined values by their location: `LOCn` in HLSL, `locn` or `attribute(n)` in MSL, `_vs2fs_locationn`
//! and its like in GLSL. Tests look each name up in the emitted text.

use naga::{BuiltIn, Interpolation, Sampling};

use crate::ir;
use crate::manifest::Varying;
use crate::shader::Unit;
use crate::target::Stage;
use crate::type_name::{builtin_name, type_name};

/// The inputs or outputs of an entry point, in the order of the source.
pub(super) fn varyings(unit: &Unit, output: bool) -> Vec<Varying> {
    ir::interface(unit, output)
        .into_iter()
        .map(|(name, ty, binding)| varying(unit.stage, output, name, type_name(&unit.module, ty), &binding))
        .collect()
}

fn varying(stage: Stage, output: bool, name: String, ty: String, binding: &naga::Binding) -> Varying {
    let mut varying = Varying {
        name,
        ty,
        location: None,
        builtin: None,
        interpolation: None,
        sampling: None,
        blend_src: None,
        hlsl: None,
        msl: None,
        glsl: None,
    };
    match *binding {
        naga::Binding::BuiltIn(builtin) => {
            varying.builtin = Some(builtin_name(builtin));
            varying.hlsl = hlsl_builtin(builtin).map(str::to_owned);
            varying.msl = msl_builtin(builtin).map(str::to_owned);
            varying.glsl = glsl_builtin(builtin, output).map(str::to_owned);
        }
        naga::Binding::Location {
            location,
            interpolation,
            sampling,
            blend_src,
            ..
        } => {
            varying.location = Some(location);
            varying.interpolation = interpolation.map(|i| interpolation_name(i).to_owned());
            varying.sampling = sampling.map(|s| sampling_name(s).to_owned());
            varying.blend_src = blend_src;
            varying.hlsl = Some(hlsl_name(stage, output, location, blend_src));
            varying.msl = Some(msl_name(stage, output, location));
            varying.glsl = Some(glsl_name(stage, output, location, blend_src));
        }
    }
    varying
}

fn hlsl_name(stage: Stage, output: bool, location: u32, blend_src: Option<u32>) -> String {
    match (stage, output) {
        (Stage::Fragment, true) if blend_src == Some(1) => "SV_Target1".to_owned(),
        (Stage::Fragment, true) => format!("SV_Target{location}"),
        _ => format!("LOC{location}"),
    }
}

fn msl_name(stage: Stage, output: bool, location: u32) -> String {
    match (stage, output) {
        (Stage::Vertex, false) => format!("attribute({location})"),
        (Stage::Fragment, true) => format!("color({location})"),
        _ => format!("user(loc{location})"),
    }
}

fn glsl_name(stage: Stage, output: bool, location: u32, blend_src: Option<u32>) -> String {
    match (stage, output) {
        (Stage::Vertex, false) => format!("_p2vs_location{location}"),
        (Stage::Fragment, true) if blend_src == Some(1) => "_fs2p_location1".to_owned(),
        (Stage::Fragment, true) => format!("_fs2p_location{location}"),
        _ => format!("_vs2fs_location{location}"),
    }
}

const fn interpolation_name(interpolation: Interpolation) -> &'static str {
    match interpolation {
        Interpolation::Perspective => "perspective",
        Interpolation::Linear => "linear",
        Interpolation::Flat => "flat",
        Interpolation::PerVertex => "per_vertex",
    }
}

const fn sampling_name(sampling: Sampling) -> &'static str {
    match sampling {
        Sampling::Center => "center",
        Sampling::Centroid => "centroid",
        Sampling::Sample => "sample",
        Sampling::First => "first",
        Sampling::Either => "either",
    }
}

const fn hlsl_builtin(builtin: BuiltIn) -> Option<&'static str> {
    Some(match builtin {
        BuiltIn::Position { .. } => "SV_Position",
        BuiltIn::InstanceIndex => "SV_InstanceID",
        BuiltIn::VertexIndex => "SV_VertexID",
        BuiltIn::FragDepth => "SV_Depth",
        BuiltIn::FrontFacing => "SV_IsFrontFace",
        BuiltIn::PrimitiveIndex => "SV_PrimitiveID",
        BuiltIn::SampleIndex => "SV_SampleIndex",
        BuiltIn::SampleMask => "SV_Coverage",
        BuiltIn::GlobalInvocationId => "SV_DispatchThreadID",
        BuiltIn::LocalInvocationId => "SV_GroupThreadID",
        BuiltIn::LocalInvocationIndex => "SV_GroupIndex",
        BuiltIn::WorkGroupId => "SV_GroupID",
        BuiltIn::ViewIndex => "SV_ViewID",
        // NumWorkGroups comes from the special constants, subgroup values from functions; the rest is not emitted.
        _ => return None,
    })
}

const fn msl_builtin(builtin: BuiltIn) -> Option<&'static str> {
    Some(match builtin {
        BuiltIn::Position { invariant: false } => "position",
        BuiltIn::Position { invariant: true } => "position, invariant",
        BuiltIn::ViewIndex => "amplification_id",
        BuiltIn::BaseInstance => "base_instance",
        BuiltIn::BaseVertex => "base_vertex",
        BuiltIn::ClipDistances => "clip_distance",
        BuiltIn::InstanceIndex => "instance_id",
        BuiltIn::PointSize => "point_size",
        BuiltIn::VertexIndex => "vertex_id",
        BuiltIn::FragDepth => "depth(any)",
        BuiltIn::PointCoord => "point_coord",
        BuiltIn::FrontFacing => "front_facing",
        BuiltIn::PrimitiveIndex => "primitive_id",
        BuiltIn::SampleIndex => "sample_id",
        BuiltIn::SampleMask => "sample_mask",
        BuiltIn::GlobalInvocationId => "thread_position_in_grid",
        BuiltIn::LocalInvocationId => "thread_position_in_threadgroup",
        BuiltIn::LocalInvocationIndex => "thread_index_in_threadgroup",
        BuiltIn::WorkGroupId => "threadgroup_position_in_grid",
        BuiltIn::WorkGroupSize => "dispatch_threads_per_threadgroup",
        BuiltIn::NumWorkGroups => "threadgroups_per_grid",
        BuiltIn::NumSubgroups => "simdgroups_per_threadgroup",
        BuiltIn::SubgroupId => "simdgroup_index_in_threadgroup",
        BuiltIn::SubgroupSize => "threads_per_simdgroup",
        BuiltIn::SubgroupInvocationId => "thread_index_in_simdgroup",
        _ => return None,
    })
}

const fn glsl_builtin(builtin: BuiltIn, output: bool) -> Option<&'static str> {
    Some(match builtin {
        BuiltIn::Position { .. } if output => "gl_Position",
        BuiltIn::Position { .. } => "gl_FragCoord",
        BuiltIn::ClipDistances => "gl_ClipDistance",
        BuiltIn::InstanceIndex => "gl_InstanceID",
        BuiltIn::PointSize => "gl_PointSize",
        BuiltIn::VertexIndex => "gl_VertexID",
        BuiltIn::FragDepth => "gl_FragDepth",
        BuiltIn::PointCoord => "gl_PointCoord",
        BuiltIn::FrontFacing => "gl_FrontFacing",
        BuiltIn::PrimitiveIndex => "gl_PrimitiveID",
        BuiltIn::SampleIndex => "gl_SampleID",
        BuiltIn::SampleMask if output => "gl_SampleMask",
        BuiltIn::SampleMask => "gl_SampleMaskIn",
        BuiltIn::GlobalInvocationId => "gl_GlobalInvocationID",
        BuiltIn::LocalInvocationId => "gl_LocalInvocationID",
        BuiltIn::LocalInvocationIndex => "gl_LocalInvocationIndex",
        BuiltIn::WorkGroupId => "gl_WorkGroupID",
        BuiltIn::WorkGroupSize => "gl_WorkGroupSize",
        BuiltIn::NumWorkGroups => "gl_NumWorkGroups",
        BuiltIn::NumSubgroups => "gl_NumSubgroups",
        BuiltIn::SubgroupId => "gl_SubgroupID",
        BuiltIn::SubgroupSize => "gl_SubgroupSize",
        BuiltIn::SubgroupInvocationId => "gl_SubgroupInvocationID",
        BuiltIn::ViewIndex => "gl_ViewIndex",
        _ => return None,
    })
}
