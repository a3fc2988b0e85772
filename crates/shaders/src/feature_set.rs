//! What a surface needs, as a value: the key of a permutation.
//!
//! A [`FeatureSet`] lists the effects of one material under one set of lights. Two feature sets that lead to the same
//! code have the same [canonical](FeatureSet::canonical) form, and a permutation is named after it. A permutation is a
//! *pair* of modules, one a stage; [`FeatureSet::vertex`] and [`FeatureSet::fragment`] give the key of each, so stages are
//! shared and the number of modules is a sum over the stages, not a product.
//!
//! Not here: deriving a feature set from content (`scene`), and the code itself (`/shaders`).

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
    /// Where the normal comes from.
    pub normal: NormalSource,
    /// How many lights of which kind.
    pub lights: Lights,
    /// Whether there is a specular lobe.
    pub specular: bool,
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
    /// Drops what cannot change a pixel, so that equal code has an equal key. Idempotent.
    ///
    /// - no albedo map → nothing to mask (an object whose constant alpha is below its cutoff is not drawn at all: that is
    ///   the planner's decision, not a shader's)
    /// - no light → no specular lobe and no use for a normal map
    /// - nothing sampled → nothing to displace
    /// - neither light nor relief → no vector of any kind: no space, no transform of directions, no form
    /// - published formulas transform normals by the object's matrix itself → no cofactor matrix
    /// - object space needs angles kept and one light: otherwise world space
    /// - no tangent frame → no handedness
    #[must_use]
    pub fn canonical(mut self) -> Self {
        if self.albedo == Albedo::Constant {
            self.alpha = Alpha::Opaque;
        }
        if self.lights == Lights::None {
            self.specular = false;
            self.normal = NormalSource::Geometric;
        }
        if self.albedo == Albedo::Constant && self.normal == NormalSource::Geometric {
            self.relief = Relief::None;
        }
        if !self.has_normal() {
            self.transform = Transform::Rigid;
            self.space = LightingSpace::World;
            self.form = Form::Hardened;
        }
        if self.form == Form::Published {
            self.transform = Transform::Rigid;
        }
        if self.transform == Transform::General || self.lights == Lights::Many {
            self.space = LightingSpace::World;
        }
        if !self.has_tangent() {
            self.mirrored_uv = false;
        }
        self
    }

    /// The same pinned technique, form and space with every other effect on: the shader against which a planned one is
    /// compared to prove that dropping was safe.
    ///
    /// Without relief, the limited offset is switched on: with `material.relief = 0` it shifts by exactly zero whatever the
    /// view. Object space stays with one light and a rigid transform, since that is all it is defined for.
    #[must_use]
    pub fn all_effects(self) -> Self {
        let object = self.canonical().space == LightingSpace::Object;
        FeatureSet {
            relief: if self.relief == Relief::None {
                Relief::ParallaxOffsetLimited
            } else {
                self.relief
            },
            normal: NormalSource::Map,
            lights: match (object, self.lights) {
                (true, Lights::Point) => Lights::Point,
                (true, _) => Lights::Directional,
                (false, _) => Lights::Many,
            },
            specular: true,
            albedo: Albedo::Map,
            alpha: Alpha::Mask,
            transform: if object {
                Transform::Rigid
            } else {
                Transform::General
            },
            mirrored_uv: true,
            space: self.space,
            form: self.form,
        }
        .canonical()
    }

    /// Whether a normal crosses from the vertex to the fragment stage.
    #[must_use]
    pub fn has_normal(&self) -> bool {
        self.lights != Lights::None || self.relief != Relief::None
    }

    /// Whether a tangent frame is needed.
    #[must_use]
    pub fn has_tangent(&self) -> bool {
        self.normal == NormalSource::Map || self.relief != Relief::None
    }

    /// Whether the vector to the eye is needed.
    #[must_use]
    pub fn has_view(&self) -> bool {
        self.specular || self.relief != Relief::None
    }

    /// Whether the position crosses to the fragment stage.
    #[must_use]
    pub fn has_position(&self) -> bool {
        self.has_view() || matches!(self.lights, Lights::Point | Lights::Many)
    }

    /// Whether a texture coordinate is needed.
    #[must_use]
    pub fn has_uv(&self) -> bool {
        self.albedo == Albedo::Map || self.normal == NormalSource::Map || self.relief != Relief::None
    }

    /// Whether the handedness of the tangent frame crosses to the fragment stage (as the fourth component of the tangent).
    #[must_use]
    pub fn has_handedness(&self) -> bool {
        self.has_tangent() && (self.mirrored_uv || self.transform == Transform::General)
    }
}
