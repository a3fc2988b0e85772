//! What a surface needs, as a value: the key of a permutation.
//!
//! A [`FeatureSet`] lists the effects of one material under one set of lights. Two feature sets that lead to the same
//! code have the same [canonical](FeatureSet::canonical) form, and a permutation is named after it. A permutation is a
//! *pair* of modules, one a stage; [`FeatureSet::vertex`] and [`FeatureSet::fragment`] give the key of each, so stages are
//! shared and the number of modules is a sum over the stages, not a product.
//!
//! Not here: which sets are equal (`canonical.rs`), deriving a feature set from content (`scene`), and the code itself
//! (`/shaders`).

use serde::{Deserialize, Serialize};

/// How the texture coordinate is displaced by the height map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Relief {
    /// Not at all: no height map is bound.
    #[default]
    None,
    /// `uv + z(h) · V.xy / V.z`.
    ParallaxOffset,
    /// `uv + z(h) · V.xy`.
    ParallaxOffsetLimited,
    /// `uv − (Δ, Δ)` with Δ from the normal map's slope, and ambient light occluded by 1 − k·Δ. Reads the normal map.
    ParallaxSlopeAo,
    /// The same Δ, shifted along the view.
    ParallaxSlopeAoDirected,
    /// The mesh's own vertices, moved along N by z(h), with new normals: nothing is left for the fragment stage to do.
    Displacement,
    /// A few steps along the view by the height above the ray. Reads heights and the third component of normals from one map.
    ParallaxIterative,
    /// A linear march along the view ray.
    SteepParallax,
    /// A linear march and one secant step.
    ParallaxOcclusion,
    /// A linear march and bisection.
    Relief,
    /// Free cones, from a map of heights and cones.
    ConeStep,
    /// Cones that cross the surface once, and bisection.
    RelaxedConeStep,
    /// The first meeting itself. Reads heights and a map of window maxima.
    Exact,
}

impl Relief {
    /// All of them, in order.
    pub const ALL: [Self; 13] = [
        Self::None,
        Self::ParallaxOffset,
        Self::ParallaxOffsetLimited,
        Self::ParallaxSlopeAo,
        Self::ParallaxSlopeAoDirected,
        Self::Displacement,
        Self::ParallaxIterative,
        Self::SteepParallax,
        Self::ParallaxOcclusion,
        Self::Relief,
        Self::ConeStep,
        Self::RelaxedConeStep,
        Self::Exact,
    ];

    /// Whether the shift comes from the slope of the normal map and occludes ambient light.
    #[must_use]
    pub fn is_slope(self) -> bool {
        matches!(self, Self::ParallaxSlopeAo | Self::ParallaxSlopeAoDirected)
    }

    /// Whether the shift comes from the elevation z(h).
    #[must_use]
    pub fn is_offset(self) -> bool {
        matches!(self, Self::ParallaxOffset | Self::ParallaxOffsetLimited)
    }

    /// Whether the view ray is followed to where it meets the heights.
    #[must_use]
    pub fn is_search(self) -> bool {
        match self {
            Self::ParallaxIterative
            | Self::SteepParallax
            | Self::ParallaxOcclusion
            | Self::Relief
            | Self::ConeStep
            | Self::RelaxedConeStep
            | Self::Exact => true,
            Self::None
            | Self::ParallaxOffset
            | Self::ParallaxOffsetLimited
            | Self::ParallaxSlopeAo
            | Self::ParallaxSlopeAoDirected
            | Self::Displacement => false,
        }
    }

    /// Whether a map is read that is baked for it from the heights.
    #[must_use]
    pub fn reads_relief_map(self) -> bool {
        matches!(
            self,
            Self::ParallaxIterative | Self::ConeStep | Self::RelaxedConeStep | Self::Exact
        )
    }

    /// Whether the fragment stage reads the height map itself for it.
    #[must_use]
    pub fn reads_heights(self) -> bool {
        self.shifts() && (!self.reads_relief_map() || self == Self::Exact)
    }

    /// Whether the fragment stage shifts its texture coordinate.
    #[must_use]
    pub fn shifts(self) -> bool {
        self.is_offset() || self.is_slope() || self.is_search()
    }
}

/// What light does on the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shading {
    /// Ambient light, Lambert's cosine, and a highlight where there is one.
    #[default]
    BlinnPhong,
    /// The second article's: light wraps round to the far side. One light.
    WrapLambert,
    /// Lambert's cosine with the slope of the height map toward the light added. One light.
    Emboss,
    /// The third article's combiner in one pass. One light.
    Dot3SinglePass,
    /// The same in two: light to the target, then the colour multiplied in by blending.
    Dot3TwoPass,
}

impl Shading {
    /// All of them, in order.
    pub const ALL: [Self; 5] = [
        Self::BlinnPhong,
        Self::WrapLambert,
        Self::Emboss,
        Self::Dot3SinglePass,
        Self::Dot3TwoPass,
    ];

    /// The word used in scene files, names of permutations and plans.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::BlinnPhong => "blinn_phong",
            Self::WrapLambert => "wrap_lambert",
            Self::Emboss => "emboss",
            Self::Dot3SinglePass => "dot3_single_pass",
            Self::Dot3TwoPass => "dot3_two_pass",
        }
    }

    /// Whether it is the third article's.
    #[must_use]
    pub fn is_dot3(self) -> bool {
        matches!(self, Self::Dot3SinglePass | Self::Dot3TwoPass)
    }
}

/// What of the relief may stand between a place on it and a light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shadow {
    /// Nothing: light reaches every place.
    #[default]
    None,
    /// `self_shadow`: a place is lit or it is not.
    Hard,
    /// `soft_shadow`: a share of each light is seen over the relief's horizon.
    Soft,
}

impl Shadow {
    /// All of them, in order.
    pub const ALL: [Self; 3] = [Self::None, Self::Hard, Self::Soft];
}

/// What makes a unit vector of the light vector of `dot3`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Normaliser {
    /// Division by the length.
    #[default]
    Arithmetic,
    /// A lookup in a normalisation cube map.
    Cube,
}

/// Where the shading normal comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NormalSource {
    /// The interpolated vertex normal.
    #[default]
    Geometric,
    /// A tangent-space normal map, decoded by `material.normal_decode`.
    Map,
}

/// How many lights of which kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Lights {
    /// Ambient light only.
    #[default]
    None,
    /// One directional light: no light vector is computed per pixel.
    Directional,
    /// One point light.
    Point,
    /// Up to sixteen lights of either kind, in a loop.
    Many,
}

/// Where the diffuse colour comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Albedo {
    /// `material.albedo` alone.
    #[default]
    Constant,
    /// `material.albedo` times the albedo map.
    Map,
}

/// What the alpha of the albedo map means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Alpha {
    /// Nothing.
    #[default]
    Opaque,
    /// A pixel whose alpha is below `material.alpha_cutoff` is discarded.
    Mask,
}

/// What the object's matrix may do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Transform {
    /// Rotation and translation only (a scale other than one, uniform or not, and a reflection are [`Transform::General`]).
    #[default]
    Rigid,
    /// Any invertible affine map: normals go by the cofactor matrix, and a reflection flips the handedness.
    General,
}

/// The space in which light and view vectors meet the normal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LightingSpace {
    /// World space, as the first founding article has it.
    #[default]
    World,
    /// Object space: eye and light are brought to the object once, on the CPU, as the third article has it.
    Object,
}

/// Which form of the formulas.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// As published, faults included.
    Published,
    /// The faults cured.
    #[default]
    Hardened,
}

impl Form {
    /// The word used in case ids and tables.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Form::Published => "published",
            Form::Hardened => "hardened",
        }
    }
}

/// The effects of one surface. Every field's default is the cheaper answer, except for `form`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FeatureSet {
    /// How the texture coordinate is displaced.
    pub relief: Relief,
    /// What of the relief stands before the lights.
    #[serde(default)]
    pub shadow: Shadow,
    /// Whether the depth written is that of the place on the relief.
    #[serde(default)]
    pub pixel_depth: bool,
    /// Where the normal comes from.
    pub normal: NormalSource,
    /// How many lights of which kind.
    pub lights: Lights,
    /// What light does on the surface.
    #[serde(default)]
    pub shading: Shading,
    /// What normalises the light vector of `dot3`.
    #[serde(default)]
    pub normaliser: Normaliser,
    /// Whether there is a specular lobe.
    pub specular: bool,
    /// Whether the surface mirrors a cube map by its specular colour.
    #[serde(default)]
    pub environment: bool,
    /// Where the diffuse colour comes from.
    pub albedo: Albedo,
    /// What alpha means.
    pub alpha: Alpha,
    /// What the object's matrix may do.
    pub transform: Transform,
    /// Whether some triangle's texture is mirrored (a `tangent.w` of −1 exists).
    pub mirrored_uv: bool,
    /// Where lighting happens.
    pub space: LightingSpace,
    /// Which form of the formulas.
    pub form: Form,
}

impl FeatureSet {
    /// Whether a normal crosses from the vertex to the fragment stage.
    #[must_use]
    pub fn has_normal(&self) -> bool {
        self.lights != Lights::None || self.relief.shifts() || self.environment
    }

    /// Whether the fragment stage needs a tangent frame.
    #[must_use]
    pub fn has_tangent(&self) -> bool {
        self.normal == NormalSource::Map || self.relief.shifts() || self.shading == Shading::Emboss
    }

    /// Whether the place that a search found shows by more than the maps read there: by a shadow, or by its depth.
    #[must_use]
    pub fn shows_place(&self) -> bool {
        self.shadow != Shadow::None || self.pixel_depth
    }

    /// Whether the vector to the eye is needed.
    #[must_use]
    pub fn has_view(&self) -> bool {
        self.specular || self.environment || (self.relief.shifts() && !self.has_view_axis())
    }

    /// Whether one viewing direction is needed for all pixels, as `parallax_slope_ao` has it as published.
    #[must_use]
    pub fn has_view_axis(&self) -> bool {
        self.relief == Relief::ParallaxSlopeAo && self.form == Form::Published
    }

    /// Whether the position crosses to the fragment stage.
    #[must_use]
    pub fn has_position(&self) -> bool {
        self.has_view() || matches!(self.lights, Lights::Point | Lights::Many)
    }

    /// Whether the fragment stage needs a texture coordinate.
    #[must_use]
    pub fn has_uv(&self) -> bool {
        self.albedo == Albedo::Map
            || self.normal == NormalSource::Map
            || self.relief.shifts()
            || self.shading == Shading::Emboss
    }

    /// Whether the handedness of the tangent frame crosses to the fragment stage (as the fourth component of the tangent).
    #[must_use]
    pub fn has_handedness(&self) -> bool {
        self.has_tangent() && (self.mirrored_uv || self.transform == Transform::General)
    }
}
