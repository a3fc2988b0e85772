//! Names of permutations and stages: stable, readable, and safe as file names.
//!
//! A name is the base word followed by the effects that are on, in a fixed order, joined by `-`. Only lower-case letters,
//! digits, `_` and `-` occur, so a name is safe on every file system and, with `-` replaced, as an identifier.

use crate::feature_set::{
    Albedo, Alpha, FeatureSet, Form, LightingSpace, Lights, NormalSource, Normaliser, Relief, Shading,
    Shadow, Transform,
};
use crate::stage::{FragmentKey, Pass, VertexKey};

impl FeatureSet {
    /// The name of the permutation, after its canonical form.
    ///
    /// ```
    /// use bossage_shaders::{Albedo, FeatureSet, Lights};
    /// let set = FeatureSet { lights: Lights::Point, albedo: Albedo::Map, ..FeatureSet::default() };
    /// assert_eq!(set.name(), "surface-point_light-albedo_map");
    /// ```
    #[must_use]
    pub fn name(&self) -> String {
        let set = self.canonical();
        join(
            "surface",
            [
                relief(set.relief),
                shadow(set.shadow),
                set.pixel_depth.then_some("pixel_depth"),
                normal(set.normal),
                lights(set.lights),
                shading(set.shading, Pass::Only),
                normaliser(set.normaliser),
                set.specular.then_some("specular"),
                set.environment.then_some("environment"),
                albedo(set.albedo),
                alpha(set.alpha),
                transform(set.transform),
                set.mirrored_uv.then_some("mirrored_uv"),
                space(set.space),
                form(set.form),
            ],
        )
    }
}

impl VertexKey {
    /// The name of the vertex module.
    #[must_use]
    pub fn name(&self) -> String {
        join(
            "surface_vertex",
            [
                self.position.then_some("position"),
                self.normal.then_some("normal"),
                self.tangent.then_some("tangent"),
                self.mirrored_uv.then_some("mirrored_uv"),
                self.uv.then_some("uv"),
                self.displacement.then_some("displacement"),
                transform(self.transform),
                space(self.space),
            ],
        )
    }
}

impl FragmentKey {
    /// The name of the fragment module.
    #[must_use]
    pub fn name(&self) -> String {
        join(
            "surface_fragment",
            [
                relief(self.relief),
                shadow(self.shadow),
                self.pixel_depth.then_some("pixel_depth"),
                normal(self.normal),
                lights(self.lights),
                shading(self.shading, self.pass),
                normaliser(self.normaliser),
                self.specular.then_some("specular"),
                self.environment.then_some("environment"),
                albedo(self.albedo),
                alpha(self.alpha),
                self.handedness.then_some("handedness"),
                form(self.form),
            ],
        )
    }
}

fn join<const N: usize>(base: &str, effects: [Option<&str>; N]) -> String {
    let words: Vec<&str> = std::iter::once(base)
        .chain(effects.into_iter().flatten())
        .collect();
    words.join("-")
}

fn relief(relief: Relief) -> Option<&'static str> {
    match relief {
        Relief::None => None,
        Relief::ParallaxOffset => Some("parallax_offset"),
        Relief::ParallaxOffsetLimited => Some("parallax_offset_limited"),
        Relief::ParallaxSlopeAo => Some("parallax_slope_ao"),
        Relief::ParallaxSlopeAoDirected => Some("parallax_slope_ao_directed"),
        Relief::Displacement => Some("displacement"),
        Relief::ParallaxIterative => Some("parallax_iterative"),
        Relief::SteepParallax => Some("steep_parallax"),
        Relief::ParallaxOcclusion => Some("parallax_occlusion"),
        Relief::Relief => Some("relief"),
        Relief::ConeStep => Some("cone_step"),
        Relief::RelaxedConeStep => Some("relaxed_cone_step"),
        Relief::Exact => Some("exact"),
    }
}

fn shadow(shadow: Shadow) -> Option<&'static str> {
    match shadow {
        Shadow::None => None,
        Shadow::Hard => Some("self_shadow"),
        Shadow::Soft => Some("soft_shadow"),
    }
}

fn normal(normal: NormalSource) -> Option<&'static str> {
    (normal == NormalSource::Map).then_some("normal_map")
}

fn lights(lights: Lights) -> Option<&'static str> {
    match lights {
        Lights::None => None,
        Lights::Directional => Some("directional_light"),
        Lights::Point => Some("point_light"),
        Lights::Many => Some("many_lights"),
    }
}

fn shading(shading: Shading, pass: Pass) -> Option<&'static str> {
    match (shading, pass) {
        (Shading::BlinnPhong, _) => None,
        (Shading::Dot3TwoPass, Pass::First) => Some("dot3_first_pass"),
        (Shading::Dot3TwoPass, Pass::Second) => Some("dot3_second_pass"),
        (
            Shading::WrapLambert | Shading::Emboss | Shading::Dot3SinglePass | Shading::Dot3TwoPass,
            Pass::Only | Pass::First | Pass::Second,
        ) => Some(shading.as_str()),
    }
}

fn normaliser(normaliser: Normaliser) -> Option<&'static str> {
    (normaliser == Normaliser::Cube).then_some("cube_normaliser")
}

fn albedo(albedo: Albedo) -> Option<&'static str> {
    (albedo == Albedo::Map).then_some("albedo_map")
}

fn alpha(alpha: Alpha) -> Option<&'static str> {
    (alpha == Alpha::Mask).then_some("alpha_mask")
}

fn transform(transform: Transform) -> Option<&'static str> {
    (transform == Transform::General).then_some("general_transform")
}

fn space(space: LightingSpace) -> Option<&'static str> {
    (space == LightingSpace::Object).then_some("object_space")
}

fn form(form: Form) -> Option<&'static str> {
    (form == Form::Published).then_some("published")
}
