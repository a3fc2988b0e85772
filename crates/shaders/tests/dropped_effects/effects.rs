//! Each effect, the feature sets that keep it, and the words that only it brings.

use bossage_shaders::{
    Albedo, Alpha, FeatureSet, Lights, NormalSource, Normaliser, Relief, Shading, Shadow, Transform,
};

/// What a feature set may drop, and the words that are its own in each stage.
pub(super) struct Effect {
    pub(super) name: &'static str,
    pub(super) on: fn(&FeatureSet) -> bool,
    pub(super) vertex: &'static [&'static str],
    pub(super) fragment: &'static [&'static str],
}

pub(super) const EFFECTS: &[Effect] = &[
    Effect {
        name: "relief",
        on: |set| set.relief.shifts(),
        vertex: &[],
        fragment: &["relief"],
    },
    Effect {
        name: "elevation",
        on: |set| set.relief.is_offset() || set.relief == Relief::ParallaxIterative || set.pixel_depth,
        vertex: &[],
        fragment: &["elevation"],
    },
    Effect {
        name: "height map in the fragment stage",
        // A march toward a light calls whatever map its heights are in by this name.
        on: |set| set.relief.reads_heights() || set.shading == Shading::Emboss || set.shadow != Shadow::None,
        vertex: &[],
        fragment: &["height_map"],
    },
    Effect {
        name: "a height",
        on: |set| set.relief.shifts() || set.shading == Shading::Emboss,
        vertex: &[],
        fragment: &["height"],
    },
    Effect {
        name: "search",
        on: |set| set.relief.is_search(),
        vertex: &[],
        fragment: &[
            "search",
            "HitRecord",
            "HeightRead",
            "hit",
            "level",
            "relief_level",
        ],
    },
    Effect {
        name: "search along the ray",
        on: |set| set.relief.is_search() && set.relief != Relief::ParallaxIterative,
        vertex: &[],
        fragment: &["ReliefRay", "relief_ray", "ray"],
    },
    Effect {
        name: "map baked for a search",
        on: |set| set.relief.reads_relief_map(),
        vertex: &[],
        fragment: &["relief_map"],
    },
    Effect {
        name: "flattest view",
        on: |set| {
            set.relief == Relief::ParallaxOffset
                || (set.relief.is_search() && set.relief != Relief::ParallaxIterative)
                || set.shows_place()
        },
        vertex: &[],
        fragment: &["MIN_VIEW_Z"],
    },
    Effect {
        name: "shadow",
        on: |set| set.shadow != Shadow::None,
        vertex: &[],
        fragment: &["light_rise", "BIAS_HEIGHT", "seen"],
    },
    Effect {
        name: "self_shadow",
        on: |set| set.shadow == Shadow::Hard,
        vertex: &[],
        fragment: &["self_shadow"],
    },
    Effect {
        name: "soft_shadow",
        on: |set| set.shadow == Shadow::Soft,
        vertex: &[],
        fragment: &["soft_shadow", "seen_share", "light_half_width"],
    },
    Effect {
        name: "pixel_depth",
        on: |set| set.pixel_depth,
        vertex: &[],
        fragment: &[
            "pixel_depth",
            "relief_place",
            "clip_z",
            "clip_w",
            "tile_width",
            "SMALLEST_DISTANCE",
        ],
    },
    Effect {
        name: "march",
        on: |set| {
            matches!(
                set.relief,
                Relief::SteepParallax | Relief::ParallaxOcclusion | Relief::Relief
            )
        },
        vertex: &[],
        fragment: &["first_below"],
    },
    Effect {
        name: "parallax_iterative",
        on: |set| set.relief == Relief::ParallaxIterative,
        vertex: &[],
        fragment: &["parallax_iterative"],
    },
    Effect {
        name: "steep_parallax",
        on: |set| set.relief == Relief::SteepParallax,
        vertex: &[],
        fragment: &["steep_parallax"],
    },
    Effect {
        name: "parallax_occlusion",
        on: |set| set.relief == Relief::ParallaxOcclusion,
        vertex: &[],
        fragment: &["parallax_occlusion", "secant_share"],
    },
    Effect {
        name: "cone_step",
        on: |set| set.relief == Relief::ConeStep,
        vertex: &[],
        fragment: &["cone_step"],
    },
    Effect {
        name: "relaxed_cone_step",
        on: |set| set.relief == Relief::RelaxedConeStep,
        vertex: &[],
        fragment: &["relaxed_cone_step"],
    },
    Effect {
        name: "exact",
        on: |set| set.relief == Relief::Exact,
        vertex: &[],
        fragment: &["exact", "free_until", "patch_along", "first_root", "window_map"],
    },
    Effect {
        name: "tangent-space vector",
        on: |set| {
            set.relief.is_offset()
                || set.relief.is_search()
                || set.relief == Relief::ParallaxSlopeAoDirected
                || set.shading == Shading::Emboss
                || set.shading.is_dot3()
        },
        vertex: &[],
        fragment: &["light_to_tangent"],
    },
    Effect {
        name: "slope relief",
        on: |set| set.relief.is_slope(),
        vertex: &[],
        fragment: &[
            "slope_texel",
            "slope_normal",
            "slope_view_dir",
            "parallax_slope_ao_delta",
            "parallax_slope_ao_delta_published",
            "slope_occlusion",
            "occlusion",
        ],
    },
    Effect {
        name: "parallax_slope_ao",
        on: |set| set.relief == Relief::ParallaxSlopeAo,
        vertex: &[],
        fragment: &["parallax_slope_ao"],
    },
    Effect {
        name: "parallax_slope_ao_directed",
        on: |set| set.relief == Relief::ParallaxSlopeAoDirected,
        vertex: &[],
        fragment: &["parallax_slope_ao_directed"],
    },
    Effect {
        name: "view axis",
        on: FeatureSet::has_view_axis,
        vertex: &[],
        fragment: &["backward"],
    },
    Effect {
        name: "displacement",
        on: |set| set.relief == Relief::Displacement,
        vertex: &[
            "height_map",
            "surface_sampler",
            "displacement",
            "displaced_position",
            "displaced_normal",
            "displacement_normal",
            "height_at",
        ],
        fragment: &[],
    },
    Effect {
        name: "wrap lambert",
        on: |set| set.shading == Shading::WrapLambert,
        vertex: &[],
        fragment: &[
            "wrap_lambert",
            "wrap_lambert_factor",
            "wrapped",
            "factor",
            "wrap_lambert_is_hole",
        ],
    },
    Effect {
        name: "emboss",
        on: |set| set.shading == Shading::Emboss,
        vertex: &[],
        fragment: &[
            "emboss",
            "emboss_step",
            "emboss_uv",
            "embossed",
            "height_toward_light",
        ],
    },
    Effect {
        name: "dot3",
        on: |set| set.shading.is_dot3(),
        vertex: &[],
        fragment: &["dot3_combiner", "light_ts", "normal_color", "light_color"],
    },
    Effect {
        name: "dot3 single pass",
        on: |set| set.shading == Shading::Dot3SinglePass,
        vertex: &[],
        fragment: &["dot3_single_pass"],
    },
    Effect {
        name: "dot3 first pass",
        on: |set| set.shading == Shading::Dot3TwoPass,
        vertex: &[],
        fragment: &["dot3_first_pass"],
    },
    Effect {
        name: "normalisation cube map",
        on: |set| set.normaliser == Normaliser::Cube,
        vertex: &[],
        fragment: &["normalisation_map"],
    },
    Effect {
        name: "environment",
        on: |set| set.environment,
        vertex: &[],
        fragment: &["environment_map", "reflected_dir", "environment_bump"],
    },
    Effect {
        name: "parallax_offset",
        on: |set| set.relief == Relief::ParallaxOffset,
        vertex: &[],
        fragment: &["parallax_offset", "parallax_offset_published"],
    },
    Effect {
        name: "parallax_offset_limited",
        on: |set| set.relief == Relief::ParallaxOffsetLimited,
        vertex: &[],
        fragment: &["parallax_offset_limited"],
    },
    Effect {
        name: "normal map",
        on: |set| set.normal == NormalSource::Map,
        vertex: &[],
        fragment: &[
            "normal_map",
            "normal_decode",
            "normal_texel",
            "normal_ts",
            "combine_frame",
        ],
    },
    Effect {
        name: "tangent",
        on: |set| set.has_tangent() || set.relief == Relief::Displacement,
        vertex: &["tangent"],
        fragment: &[],
    },
    Effect {
        name: "tangent frame",
        on: FeatureSet::has_tangent,
        vertex: &["lighting_space_tangent", "tangent_transform"],
        fragment: &["tangent", "tangent_dir", "bitangent_dir", "bitangent", "cross"],
    },
    Effect {
        name: "handedness",
        on: FeatureSet::has_handedness,
        vertex: &["lighting_space_handedness", "handedness"],
        fragment: &["bitangent"],
    },
    Effect {
        name: "light",
        on: |set| set.lights != Lights::None,
        vertex: &[],
        fragment: &[
            "light_dir",
            "radiance",
            "lambert",
            "blinn_phong",
            "Light",
            "vector",
        ],
    },
    Effect {
        name: "normal in the vertex stage",
        on: |set| set.has_normal() || set.relief == Relief::Displacement,
        vertex: &["normal"],
        fragment: &[],
    },
    Effect {
        name: "normal",
        on: FeatureSet::has_normal,
        vertex: &["lighting_space_normal"],
        fragment: &["normal"],
    },
    Effect {
        name: "many lights",
        on: |set| set.lights == Lights::Many,
        vertex: &[],
        fragment: &["lights", "Lights", "MAX_LIGHTS", "items", "count"],
    },
    Effect {
        name: "specular",
        on: |set| set.specular,
        vertex: &[],
        fragment: &[
            "shininess",
            "blinn_phong",
            "blinn_phong_published",
            "half_vector",
            "highlight_power",
            "pow",
        ],
    },
    Effect {
        name: "view",
        on: |set| set.has_view() || set.has_view_axis(),
        vertex: &[],
        fragment: &["view", "View"],
    },
    Effect {
        name: "view vector",
        on: FeatureSet::has_view,
        vertex: &[],
        fragment: &["eye"],
    },
    Effect {
        name: "specular colour",
        on: |set| set.specular || set.environment,
        vertex: &[],
        fragment: &["specular"],
    },
    Effect {
        name: "sampler",
        on: |set| set.has_uv() || set.environment,
        vertex: &[],
        fragment: &["surface_sampler"],
    },
    Effect {
        name: "position",
        on: FeatureSet::has_position,
        vertex: &[],
        fragment: &["position"],
    },
    Effect {
        name: "albedo map",
        on: |set| set.albedo == Albedo::Map,
        vertex: &[],
        fragment: &["albedo_map"],
    },
    Effect {
        name: "alpha mask",
        on: |set| set.alpha == Alpha::Mask,
        vertex: &[],
        fragment: &["discard", "alpha_cutoff"],
    },
    Effect {
        name: "texture coordinate in the vertex stage",
        on: |set| set.has_uv() || set.relief == Relief::Displacement,
        vertex: &["uv"],
        fragment: &[],
    },
    Effect {
        name: "texture coordinate",
        on: FeatureSet::has_uv,
        vertex: &[],
        fragment: &["uv", "uv_dx", "uv_dy", "dpdx", "dpdy", "textureSampleGrad"],
    },
    Effect {
        name: "general transform",
        on: |set| set.transform == Transform::General,
        vertex: &["cofactor", "handedness_sign", "normal_transform_by_cofactor"],
        fragment: &[],
    },
    Effect {
        name: "capture",
        on: |_| false,
        vertex: &[],
        fragment: &[
            "captured_position",
            "captured_normal",
            "captured_tangent",
            "captured_uv",
        ],
    },
];
