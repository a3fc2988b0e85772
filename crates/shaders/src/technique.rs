//! The table of techniques: where each one's code lives, which forms it has, and where it comes from.

use crate::feature_set::Form;

/// One technique of the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Technique {
    /// The name that shader file, reference file, case and snapshot share.
    pub id: &'static str,
    /// The files that hold it, below `shaders/`.
    pub files: &'static [&'static str],
    /// The forms that exist.
    pub forms: &'static [Form],
    /// Where the published form comes from.
    pub source: &'static str,
}

impl Technique {
    /// The technique of that name.
    #[must_use]
    pub fn find(id: &str) -> Option<&'static Technique> {
        TECHNIQUES.iter().find(|technique| technique.id == id)
    }
}

const BOTH: &[Form] = &[Form::Published, Form::Hardened];
const HARDENED: &[Form] = &[Form::Hardened];
const PARALLAX_BUMP: &str = "Dachsbacher, Parallax Bump Mapping (PC Underground)";
const DOT3: &str = "Pettersen, Bumpmapping (DOT3 and normalisation cube maps)";
const HEIGHT_MAPS: &str = "Normal Maps und Height Maps (OpenGL tutorials)";
const SLOPE_AO: &str = "Parallax Mapping + Ambient Occlusion (OpenGL tutorials)";

/// Every technique, sorted by name.
pub const TECHNIQUES: &[Technique] = &[
    Technique {
        id: "blinn_phong",
        files: &["techniques/blinn_phong.wesl"],
        forms: BOTH,
        source: PARALLAX_BUMP,
    },
    Technique {
        id: "codec_biased",
        files: &["techniques/codec_biased.wesl"],
        forms: BOTH,
        source: HEIGHT_MAPS,
    },
    Technique {
        id: "codec_octahedral",
        files: &["techniques/codec_octahedral.wesl"],
        forms: BOTH,
        source: "Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors (2014)",
    },
    Technique {
        id: "codec_snorm",
        files: &["techniques/codec_snorm.wesl"],
        forms: HARDENED,
        source: "the fixed-point conversions of the graphics interfaces",
    },
    Technique {
        id: "codec_two_channel",
        files: &["techniques/codec_two_channel.wesl"],
        forms: BOTH,
        source: "two-channel normal maps (BC5, RG8); no single source",
    },
    Technique {
        id: "codec_unorm",
        files: &["techniques/codec_unorm.wesl"],
        forms: HARDENED,
        source: HEIGHT_MAPS,
    },
    Technique {
        id: "cone_step",
        files: &["techniques/cone_step.wesl", "entry/relief_hits.wesl"],
        forms: HARDENED,
        source: "Dummer, Cone Step Mapping (2006)",
    },
    Technique {
        id: "displacement",
        files: &["techniques/displacement.wesl"],
        forms: HARDENED,
        source: PARALLAX_BUMP,
    },
    Technique {
        id: "dot3",
        files: &["techniques/dot3.wesl"],
        forms: BOTH,
        source: DOT3,
    },
    Technique {
        id: "dot3_single_pass",
        files: &["techniques/dot3_single_pass.wesl"],
        forms: BOTH,
        source: DOT3,
    },
    Technique {
        id: "dot3_two_pass",
        files: &["techniques/dot3_two_pass.wesl"],
        forms: HARDENED,
        source: DOT3,
    },
    Technique {
        id: "emboss",
        files: &["techniques/emboss.wesl"],
        forms: HARDENED,
        source: "Schlag, Fast Embossing Effects on Raster Image Data (1994)",
    },
    Technique {
        id: "environment_bump",
        files: &["techniques/environment_bump.wesl"],
        forms: BOTH,
        source: DOT3,
    },
    Technique {
        id: "exact",
        files: &["techniques/exact.wesl", "entry/relief_hits.wesl"],
        forms: HARDENED,
        source: "the closed first root of the bilinear patch; no single source",
    },
    Technique {
        id: "frame_from_normal",
        files: &["techniques/frame_from_normal.wesl"],
        forms: BOTH,
        source: PARALLAX_BUMP,
    },
    Technique {
        id: "frame_from_uv",
        files: &["techniques/frame_from_uv.wesl", "entry/frame_from_uv.wesl"],
        forms: BOTH,
        source: PARALLAX_BUMP,
    },
    Technique {
        id: "frame_mikktspace",
        files: &["techniques/frame_mikktspace.wesl"],
        forms: HARDENED,
        source: "Mikkelsen, Simulation of Wrinkled Surfaces Revisited (2008)",
    },
    Technique {
        id: "height_to_normal",
        files: &["techniques/height_to_normal.wesl", "entry/height_to_normal.wesl"],
        forms: HARDENED,
        source: "central differences; no single source",
    },
    Technique {
        id: "height_to_normal_forward",
        files: &[
            "techniques/height_to_normal_forward.wesl",
            "entry/height_to_normal_forward.wesl",
        ],
        forms: BOTH,
        source: HEIGHT_MAPS,
    },
    Technique {
        id: "height_to_normal_fourth_order",
        files: &["techniques/height_to_normal_fourth_order.wesl"],
        forms: HARDENED,
        source: "Fornberg, Generation of Finite Difference Formulas on Arbitrarily Spaced Grids (1988)",
    },
    Technique {
        id: "light_to_tangent",
        files: &["techniques/light_to_tangent.wesl"],
        forms: HARDENED,
        source: PARALLAX_BUMP,
    },
    Technique {
        id: "normal_mips",
        files: &["techniques/normal_mips.wesl", "entry/normal_mips.wesl"],
        forms: BOTH,
        source: HEIGHT_MAPS,
    },
    Technique {
        id: "normal_transform",
        files: &["techniques/normal_transform.wesl"],
        forms: BOTH,
        source: PARALLAX_BUMP,
    },
    Technique {
        id: "normalisation_cube_map",
        files: &[
            "techniques/normalisation_cube_map.wesl",
            "entry/normalisation_cube_map.wesl",
        ],
        forms: HARDENED,
        source: DOT3,
    },
    Technique {
        id: "parallax_iterative",
        files: &["techniques/parallax_iterative.wesl", "entry/relief_hits.wesl"],
        forms: HARDENED,
        source: "Premecz, Iterative Parallax Mapping with Slope Information (2006)",
    },
    Technique {
        id: "parallax_occlusion",
        files: &["techniques/parallax_occlusion.wesl", "entry/relief_hits.wesl"],
        forms: HARDENED,
        source: "Brawley and Tatarchuk, Parallax Occlusion Mapping (2004)",
    },
    Technique {
        id: "parallax_offset",
        files: &["techniques/parallax_offset.wesl"],
        forms: BOTH,
        source: PARALLAX_BUMP,
    },
    Technique {
        id: "parallax_offset_limited",
        files: &["techniques/parallax_offset_limited.wesl"],
        forms: HARDENED,
        source: PARALLAX_BUMP,
    },
    Technique {
        id: "parallax_slope_ao",
        files: &["techniques/parallax_slope_ao.wesl"],
        forms: BOTH,
        source: SLOPE_AO,
    },
    Technique {
        id: "parallax_slope_ao_directed",
        files: &["techniques/parallax_slope_ao_directed.wesl"],
        forms: HARDENED,
        source: SLOPE_AO,
    },
    Technique {
        id: "pixel_depth",
        files: &["techniques/pixel_depth.wesl"],
        forms: HARDENED,
        source: "the displaced place through the vertex transform; no single source",
    },
    Technique {
        id: "relaxed_cone_step",
        files: &["techniques/relaxed_cone_step.wesl", "entry/relief_hits.wesl"],
        forms: HARDENED,
        source: "Policarpo and Oliveira, Relaxed Cone Stepping for Relief Mapping (2007)",
    },
    Technique {
        id: "relief",
        files: &["techniques/relief.wesl", "entry/relief_hits.wesl"],
        forms: HARDENED,
        source: "Policarpo et al., Real-Time Relief Mapping on Arbitrary Polygonal Surfaces (2005)",
    },
    Technique {
        id: "self_shadow",
        files: &["techniques/self_shadow.wesl", "entry/relief_light.wesl"],
        forms: HARDENED,
        source: "Policarpo et al., Real-Time Relief Mapping on Arbitrary Polygonal Surfaces (2005)",
    },
    Technique {
        id: "soft_shadow",
        files: &["techniques/soft_shadow.wesl", "entry/relief_light.wesl"],
        forms: BOTH,
        source: "Tatarchuk, Dynamic Parallax Occlusion Mapping with Approximate Soft Shadows (2006)",
    },
    Technique {
        id: "steep_parallax",
        files: &["techniques/steep_parallax.wesl", "entry/relief_hits.wesl"],
        forms: HARDENED,
        source: "McGuire and McGuire, Steep Parallax Mapping (2005)",
    },
    Technique {
        id: "wrap_lambert",
        files: &["techniques/wrap_lambert.wesl"],
        forms: BOTH,
        source: SLOPE_AO,
    },
];
