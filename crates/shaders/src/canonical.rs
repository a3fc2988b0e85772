//! Which feature sets are the same permutation, and which one has everything on.
//!
//! The founding articles keep the number of permutations a sum. Each of their techniques goes with what its article has beside
//! it, and with nothing else:
//!
//! - `wrap_lambert`, `emboss` and `dot3` have one light, no highlight and no reflection;
//! - `wrap_lambert` goes with the second article's relief (`parallax_slope_ao` and its directed form) or with none;
//! - `emboss` *is* the relief, in place of a normal map: no other relief, no normal map;
//! - `dot3` reads a normal map and shifts nothing; in two passes the mask would be known only in the second, so there is none;
//! - `parallax_slope_ao` reads a normal map, and goes without a reflection; the directed form is a cure, so it has one form;
//! - `displacement` makes its own normals: no normal map;
//! - a search along the view ray goes with `blinn_phong` and has one form; it always carries the handedness, one factor beside dozens
//!   of fetches, and so takes half as many modules;
//! - shadows and depth are those of the place that a search found, so they go with a search alone; beside a search and a march toward
//!   each light the other effects cost little, so all but the mask and the reflection are on, neutral where a material has none: one
//!   shader a search, kind of shadow, depth, mask and reflection;
//! - a reflection is as bright as the specular colour, so where there is light there is a highlight too, and it is looked up in
//!   world space.
//!
//! A scene that asks for another combination is refused when it is loaded; here such a set falls back to the nearest that
//! exists, so that every value has a canonical form.

use crate::feature_set::{
    Albedo, Alpha, FeatureSet, Form, LightingSpace, Lights, NormalSource, Normaliser, Relief, Shading,
    Shadow, Transform,
};

impl FeatureSet {
    /// Drops what cannot change a pixel, so that equal code has an equal key. Idempotent.
    ///
    /// - no albedo map → nothing to mask (an object whose constant alpha is below its cutoff is not drawn at all: that is
    ///   the planner's decision, not a shader's)
    /// - no light → no specular lobe, no shading of a kind, and no use for a normal map but to reflect or to find slopes
    /// - nothing sampled → nothing to displace
    /// - neither light, relief nor reflection → no vector of any kind: no space, no transform of directions, no form
    /// - published formulas transform normals by the object's matrix itself → no cofactor matrix
    /// - object space needs angles kept and one light: otherwise world space
    /// - no tangent frame → no handedness; a search along the view ray → always
    /// - `dot3` through a cube map divides by nothing → its forms are one
    ///
    /// What goes with what is said in the module `canonical`.
    #[must_use]
    pub fn canonical(mut self) -> Self {
        if self.albedo == Albedo::Constant {
            self.alpha = Alpha::Opaque;
        }
        self.settle_shading();
        self.settle_relief();
        self.settle_place();
        self.settle_surroundings();
        if !self.has_normal() {
            self.transform = Transform::Rigid;
            self.space = LightingSpace::World;
            self.form = Form::Hardened;
        }
        if self.form == Form::Published {
            self.transform = Transform::Rigid;
        }
        if self.transform == Transform::General || self.lights == Lights::Many || self.environment {
            self.space = LightingSpace::World;
        }
        if !self.has_tangent() {
            self.mirrored_uv = false;
        } else if self.relief.is_search() {
            self.mirrored_uv = true;
        }
        self
    }

    /// What a kind of shading goes with.
    fn settle_shading(&mut self) {
        if matches!(self.lights, Lights::None | Lights::Many) {
            self.shading = Shading::BlinnPhong;
        }
        if !self.shading.is_dot3() {
            self.normaliser = Normaliser::Arithmetic;
        }
        match self.shading {
            Shading::BlinnPhong => return,
            Shading::WrapLambert => {
                if self.relief.is_offset() || self.relief.is_search() {
                    self.relief = Relief::None;
                }
            }
            Shading::Emboss => {
                self.relief = Relief::None;
                self.normal = NormalSource::Geometric;
            }
            Shading::Dot3SinglePass | Shading::Dot3TwoPass => {
                self.relief = Relief::None;
                self.normal = NormalSource::Map;
                if self.normaliser == Normaliser::Cube {
                    self.form = Form::Hardened;
                }
            }
        }
        if self.shading == Shading::Dot3TwoPass {
            self.alpha = Alpha::Opaque;
        }
        self.specular = false;
        self.environment = false;
    }

    /// What a relief technique goes with.
    fn settle_relief(&mut self) {
        if self.relief.is_slope() && self.normal == NormalSource::Geometric {
            self.relief = Relief::None;
        }
        if self.relief.is_slope() {
            self.environment = false;
        }
        match self.relief {
            Relief::ParallaxSlopeAoDirected
            | Relief::ParallaxIterative
            | Relief::SteepParallax
            | Relief::ParallaxOcclusion
            | Relief::Relief
            | Relief::ConeStep
            | Relief::RelaxedConeStep
            | Relief::Exact => self.form = Form::Hardened,
            Relief::Displacement => self.normal = NormalSource::Geometric,
            Relief::None
            | Relief::ParallaxOffset
            | Relief::ParallaxOffsetLimited
            | Relief::ParallaxSlopeAo => {}
        }
    }

    /// What goes with the effects of the place that a search found: shadows, and depth.
    fn settle_place(&mut self) {
        let searches = self.relief.is_search();
        self.pixel_depth &= searches;
        if !searches || self.lights == Lights::None {
            self.shadow = Shadow::None;
        }
        if self.shows_place() {
            self.normal = NormalSource::Map;
            self.albedo = Albedo::Map;
            self.lights = Lights::Many;
            self.specular = true;
        }
    }

    /// What is left to see by: lights and the environment.
    fn settle_surroundings(&mut self) {
        if self.lights == Lights::None {
            self.specular = false;
            if !self.environment && !self.relief.is_slope() {
                self.normal = NormalSource::Geometric;
            }
        } else if self.environment {
            self.specular = true;
        }
        let nothing_sampled = self.albedo == Albedo::Constant && self.normal == NormalSource::Geometric;
        if nothing_sampled && (self.relief.is_offset() || self.relief.is_search()) {
            self.relief = Relief::None;
        }
    }

    /// The same pinned techniques, form and space with every other effect on that goes with them: the shader against which a
    /// planned one is compared to prove that dropping was safe.
    ///
    /// Without relief one is switched on that `material.relief = 0` makes shift by exactly zero whatever the view: the limited
    /// offset, or with `wrap_lambert` the slope's, whose occlusion is then exactly 1. The environment of a scene without one
    /// is black. Object space stays with one light and a rigid transform, since that is all it is defined for, and kinds of
    /// shading that are defined for one light keep theirs.
    #[must_use]
    pub fn all_effects(self) -> Self {
        let planned = self.canonical();
        let object = planned.space == LightingSpace::Object;
        FeatureSet {
            relief: planned.relief_switched_on(),
            shadow: planned.shadow,
            pixel_depth: planned.pixel_depth,
            normal: NormalSource::Map,
            lights: match (planned.shading, object, planned.lights) {
                (Shading::BlinnPhong, false, _) => Lights::Many,
                (_, _, Lights::Point) => Lights::Point,
                (_, _, Lights::None | Lights::Directional | Lights::Many) => Lights::Directional,
            },
            specular: true,
            environment: !object,
            albedo: Albedo::Map,
            alpha: Alpha::Mask,
            transform: if object {
                Transform::Rigid
            } else {
                Transform::General
            },
            mirrored_uv: true,
            shading: planned.shading,
            normaliser: planned.normaliser,
            space: self.space,
            form: self.form,
        }
        .canonical()
    }

    fn relief_switched_on(self) -> Relief {
        match (self.relief, self.shading) {
            (Relief::None, Shading::BlinnPhong) => Relief::ParallaxOffsetLimited,
            (Relief::None, Shading::WrapLambert) => Relief::ParallaxSlopeAo,
            (Relief::None, Shading::Emboss | Shading::Dot3SinglePass | Shading::Dot3TwoPass) => Relief::None,
            (relief, _) => relief,
        }
    }
}
