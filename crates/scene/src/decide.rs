//! Each effect of a material, kept or dropped, in order of dependence: light, what it falls on, relief, frames.
//!
//! Every rule states what it measured. The decisions and the canonical feature set agree: what is dropped here is not in the
//! permutation, and what is kept is.

use bossage_shaders::{
    Albedo, Alpha, FeatureSet, Form, LightingSpace, Lights, NormalSource, Normaliser as Normalises, Relief,
    Shading, Shadow, Transform,
};
use glam::DVec3;

use crate::decide_shading::beside_places;
use crate::facts::{MaterialFacts, has_mirrored_uv};
use crate::model::{AlphaMode, Light, LightKind, Material, Normaliser, Object, Scene, TechniquePin};
use crate::plan::{Effect, EffectId, Evidence, Fact, MaterialPlan, ObjectView, Predicted, State};
use crate::relief;
use crate::technique::Technique;
use crate::views::View;

/// How far below the cutoff a filtered alpha may come to lie by rounding although no texel is: half an 8-bit step, well
/// above the error of any filter of at least 8 bits.
const ALPHA_MARGIN: f64 = 0.5 / 255.0;

/// What all rules look at.
pub(crate) struct Subject<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) material: &'a Material,
    pub(crate) facts: MaterialFacts,
    pub(crate) objects: Vec<&'a Object>,
    pub(crate) views: Vec<&'a View>,
    active_lights: Vec<&'a Light>,
    /// Its share of the scene's time.
    pub(crate) time_ms: Option<f64>,
}

/// An effect's entry, as [`Effect`] without its id.
pub(crate) struct Decision {
    pub(crate) kept: bool,
    pub(crate) reason: String,
    pub(crate) evidence: Evidence,
}

impl Decision {
    pub(crate) fn kept(reason: impl Into<String>, evidence: Evidence) -> Self {
        Self {
            kept: true,
            reason: reason.into(),
            evidence,
        }
    }

    pub(crate) fn dropped(reason: impl Into<String>, evidence: Evidence) -> Self {
        Self {
            kept: false,
            reason: reason.into(),
            evidence,
        }
    }

    fn into_effect(self, id: EffectId) -> Effect {
        let state = if self.kept { State::Kept } else { State::Dropped };
        Effect {
            id,
            state,
            reason: self.reason,
            evidence: self.evidence,
        }
    }
}

/// Evidence from names and facts.
pub(crate) fn evidence<const N: usize>(facts: [(&'static str, Fact); N]) -> Evidence {
    facts.into_iter().collect()
}

/// Plans one material, whose relief may take so long a frame.
pub(crate) fn material(scene: &Scene, views: &[View], index: usize, time_ms: Option<f64>) -> MaterialPlan {
    let material = &scene.materials[index];
    let used = || {
        scene
            .objects
            .iter()
            .zip(views)
            .filter(move |(object, _)| object.material == index)
    };
    let subject = Subject {
        scene,
        material,
        facts: MaterialFacts::of(material),
        objects: used().map(|(object, _)| object).collect(),
        views: used().map(|(_, view)| view).collect(),
        active_lights: scene.active_lights().collect(),
        time_ms,
    };
    subject.plan()
}

impl Subject<'_> {
    fn plan(&self) -> MaterialPlan {
        let mut asked = FeatureSet {
            lights: self.lights(),
            shading: self.material.shading,
            normaliser: match self.material.normaliser {
                Normaliser::Arithmetic => Normalises::Arithmetic,
                Normaliser::Cube(_) => Normalises::Cube,
            },
            form: self.material.form,
            space: self.material.lighting_space,
            ..FeatureSet::default()
        };
        let lighting = self.lighting();
        let light_vector = self.light_vector(asked.lights);
        let light_loop = self.light_loop();
        let specular = self.specular(lighting.kept);
        asked.specular = specular.kept;
        let environment = self.environment();
        asked.environment = environment.kept;
        let normal_map = self.normal_map(lighting.kept, environment.kept);
        asked.normal = chosen(normal_map.kept, NormalSource::Map, NormalSource::Geometric);
        let (alpha_discard, drawn) = self.alpha_discard();
        asked.alpha = chosen(alpha_discard.kept, Alpha::Mask, Alpha::Opaque);
        let albedo_map = self.albedo_map(lighting.kept, alpha_discard.kept);
        asked.albedo = chosen(albedo_map.kept, Albedo::Map, Albedo::Constant);
        let relief = relief::decide(self, normal_map.kept || albedo_map.kept);
        // What is chosen can be drawn, and so can what is pinned.
        asked.relief = relief.technique.relief().unwrap_or_default();
        let shadow = self.shadow(lighting.kept, relief.technique);
        asked.shadow = chosen(shadow.kept, self.material.shadow.feature(), Shadow::None);
        let pixel_depth = self.pixel_depth(relief.technique);
        asked.pixel_depth = pixel_depth.kept;
        let emboss = self.emboss();
        let mut features = FeatureSet {
            shading: chosen(
                self.material.shading == Shading::Emboss && !emboss.kept,
                Shading::BlinnPhong,
                asked.shading,
            ),
            ..asked
        }
        .canonical();
        let cofactor = self.cofactor_matrix(&features);
        features.transform = chosen(cofactor.kept, Transform::General, Transform::Rigid);
        features.mirrored_uv =
            features.has_tangent() && self.objects.iter().any(|object| has_mirrored_uv(&object.mesh));
        let handedness = self.handedness(&features);
        let features = features.canonical();
        let effects = [
            (EffectId::Lighting, lighting),
            (EffectId::LightVector, light_vector),
            (EffectId::LightLoop, light_loop),
            (EffectId::Specular, specular),
            (EffectId::Environment, environment),
            (EffectId::NormalMap, normal_map),
            (EffectId::NormalisationCube, self.normalisation_cube()),
            (EffectId::AlbedoMap, albedo_map),
            (EffectId::AlphaDiscard, alpha_discard),
            (EffectId::Relief, relief.decision),
            (EffectId::Shadow, shadow),
            (EffectId::PixelDepth, pixel_depth),
            (EffectId::AmbientOcclusion, self.ambient_occlusion()),
            (EffectId::Emboss, emboss),
            (EffectId::Displacement, self.displacement()),
            (EffectId::SecondPass, self.second_pass()),
            (EffectId::CofactorMatrix, cofactor),
            (EffectId::Handedness, handedness),
        ];
        // A canonical feature set has no relief where nothing is left for it to move.
        let drawn_by = chosen(features.relief == Relief::None, Technique::None, relief.technique);
        MaterialPlan {
            name: self.material.name.clone(),
            technique: drawn_by.id(),
            settings: drawn_by.settings(),
            how: drawn_by,
            technique_by: chosen(self.material.technique == TechniquePin::Auto, "auto", "pinned"),
            shading: features.shading.as_str(),
            shading_by: chosen(self.material.shading == Shading::BlinnPhong, "auto", "pinned"),
            permutation: features.name(),
            features,
            everything: self.everything(&asked, &features, relief.approximates),
            drawn,
            effects: effects
                .into_iter()
                .map(|(id, decision)| match features.shows_place() {
                    true => beside_places(id, decision).into_effect(id),
                    false => decision.into_effect(id),
                })
                .collect(),
            predicted: relief.predicted,
            choice: relief.choice,
            objects: self.object_views(),
            notes: self.notes(&features),
        }
    }

    /// Everything on that goes with what was asked for: with a pinned shading even where the plan drops it, since that is what
    /// has to be shown to change nothing. Relief that was left out within a budget stays out: it does change something.
    fn everything(&self, asked: &FeatureSet, planned: &FeatureSet, approximates: bool) -> FeatureSet {
        let full = FeatureSet {
            shading: asked.shading,
            ..*planned
        }
        .all_effects();
        let relief = chosen(approximates, Relief::None, full.relief);
        FeatureSet { relief, ..full }.canonical()
    }

    fn object_views(&self) -> Vec<ObjectView> {
        let view = |(object, view): (&&Object, &&View)| ObjectView {
            name: object.name.clone(),
            footprint: view.footprint(),
        };
        self.objects.iter().zip(&self.views).map(view).collect()
    }

    fn notes(&self, features: &FeatureSet) -> Vec<String> {
        let mut notes = Vec::new();
        if self.objects.is_empty() {
            notes.push("no object uses this material".to_owned());
        }
        let placed = features.shows_place();
        if self.material.lighting_space == LightingSpace::Object && placed {
            notes.push(
                "places on the relief are found in world space, so lighting_space = \"object\" is not used"
                    .to_owned(),
            );
        } else if self.material.lighting_space == LightingSpace::Object && features.lights == Lights::Many {
            notes.push(
                "lighting_space = \"object\" is defined for one light; with several, world space is used"
                    .to_owned(),
            );
        }
        if self.material.lighting_space == LightingSpace::Object && features.environment && !placed {
            notes.push(
                "the environment is mirrored in world space, so lighting_space = \"object\" is not used"
                    .to_owned(),
            );
        }
        if self.material.form == Form::Published && features.has_normal() && features.form == Form::Hardened {
            notes.push("through a normalisation cube map `dot3` has one form: `form = \"published\"` changes only tangents".to_owned());
        }
        notes
    }

    fn lights(&self) -> Lights {
        match self.active_lights.as_slice() {
            [] => Lights::None,
            [light] => match light.kind {
                LightKind::Directional { .. } => Lights::Directional,
                LightKind::Point { .. } => Lights::Point,
            },
            _ => Lights::Many,
        }
    }

    fn lighting(&self) -> Decision {
        let (active, all) = (self.active_lights.len(), self.scene.lights.len());
        let facts = evidence([("lights", count(all)), ("lights_not_black", count(active))]);
        match (active, all) {
            (0, 0) => Decision::dropped("the scene has no lights", facts),
            (0, _) => Decision::dropped("every light is black", facts),
            _ => Decision::kept(
                format!(
                    "{active} of {all} light{} not black",
                    if active == 1 { " is" } else { "s are" }
                ),
                facts,
            ),
        }
    }

    fn light_vector(&self, lights: Lights) -> Decision {
        let points = self
            .active_lights
            .iter()
            .filter(|light| matches!(light.kind, LightKind::Point { .. }))
            .count();
        let facts = evidence([
            ("point_lights", count(points)),
            ("lights_not_black", count(self.active_lights.len())),
        ]);
        match lights {
            Lights::None => Decision::dropped("there is no light", facts),
            Lights::Directional => Decision::dropped(
                "one directional light: its vector is the same for every pixel",
                facts,
            ),
            Lights::Point => Decision::kept("a point light's vector differs from pixel to pixel", facts),
            Lights::Many => Decision::kept("the loop over lights handles both kinds", facts),
        }
    }

    fn light_loop(&self) -> Decision {
        let active = self.active_lights.len();
        let facts = evidence([("lights_not_black", count(active))]);
        match active {
            0 => Decision::dropped("there is no light", facts),
            1 => Decision::dropped("one light needs no loop", facts),
            _ => Decision::kept(format!("{active} lights"), facts),
        }
    }

    fn normal_map(&self, lit: bool, mirrors: bool) -> Decision {
        let (shading, technique) = (self.material.shading, self.material.technique);
        let Some(normal) = self.facts.normal else {
            return Decision::dropped("the material has none", Evidence::new());
        };
        let facts = evidence([
            ("constant", Fact::Text(normal.constant.to_string())),
            ("first_normal", Fact::Numbers(normal.first.to_vec())),
            ("max_off_flat", Fact::Number(normal.max_off_flat)),
            ("codec_half_quantum", Fact::Number(normal.half_quantum)),
        ]);
        if shading == Shading::Emboss {
            Decision::dropped("embossing stands in for it", facts)
        } else if technique == TechniquePin::Displacement {
            Decision::dropped("displaced vertices have normals of their own", facts)
        } else if lit && shading.is_dot3() {
            Decision::kept(
                format!("`{}` reads it, whatever it holds", shading.as_str()),
                facts,
            )
        } else if technique.relief().is_some_and(Relief::is_slope) {
            Decision::kept(format!("`{}` reads slopes from it", technique.as_str()), facts)
        } else if normal.is_flat() {
            Decision::dropped(
                "every normal is (0, 0, 1) as near as the codec can write it",
                facts,
            )
        } else if !lit && !mirrors {
            Decision::dropped("there is no light for it to change", facts)
        } else if normal.constant {
            Decision::kept(
                "its normal is constant but tilted: dropping it would change the light",
                facts,
            )
        } else {
            Decision::kept("its normals vary", facts)
        }
    }

    /// Also whether anything of the material is drawn at all.
    fn alpha_discard(&self) -> (Decision, bool) {
        let alpha = &self.facts.albedo;
        let AlphaMode::Mask { cutoff } = self.material.alpha else {
            return (Decision::dropped("alpha.mode is opaque", Evidence::new()), true);
        };
        let facts = evidence([
            ("cutoff", Fact::Number(cutoff)),
            ("alpha_min", Fact::Number(alpha.alpha_min)),
            ("alpha_max", Fact::Number(alpha.alpha_max)),
            ("texels_below_cutoff", Fact::Number(alpha.below_cutoff)),
        ]);
        // Without a map nothing is filtered, and the comparison is the shader's own.
        let margin = if self.material.albedo.map.is_some() {
            ALPHA_MARGIN
        } else {
            0.0
        };
        if (alpha.alpha_max as f32) < (cutoff - margin) as f32 {
            (
                Decision::dropped("every fragment would be discarded: nothing is drawn", facts),
                false,
            )
        } else if alpha.alpha_min as f32 >= (cutoff + margin) as f32 {
            (
                Decision::dropped("no texel's alpha is below the cutoff", facts),
                true,
            )
        } else {
            (
                Decision::kept(
                    "some texels are below the cutoff, or so near that filtering may be",
                    facts,
                ),
                true,
            )
        }
    }

    fn albedo_map(&self, lit: bool, masked: bool) -> Decision {
        let albedo = &self.facts.albedo;
        if self.material.albedo.map.is_none() {
            return Decision::dropped("the material has none", Evidence::new());
        }
        let facts = evidence([
            ("constant_rgb", Fact::Text(albedo.constant_rgb.to_string())),
            ("constant_alpha", Fact::Text(albedo.constant_alpha.to_string())),
            (
                "first_texel_linear",
                Fact::Numbers(albedo.first.to_array().to_vec()),
            ),
        ]);
        let dark = !lit && self.scene.ambient.as_vec3() == glam::Vec3::ZERO;
        if masked {
            Decision::kept("its alpha is needed for the mask", facts)
        } else if albedo.constant_rgb && albedo.constant_alpha {
            Decision::dropped("one colour everywhere: folded into the constant", facts)
        } else if dark && albedo.constant_alpha {
            Decision::dropped("there is neither light nor ambient light to see it by", facts)
        } else {
            Decision::kept("its texels vary", facts)
        }
    }

    /// Without the cofactor matrix the shader carries directions by the object's matrix and does not normalise them there. A
    /// lone normal may come out at any length; a tangent frame keeps its proportions only at unit length, and its
    /// handedness only without a reflection.
    fn cofactor_matrix(&self, features: &FeatureSet) -> Decision {
        let stretched = self.names(|object| !object.transform.keeps_angles());
        let scaled = self.names(|object| object.transform.scale.abs() != DVec3::ONE);
        let mirrored = self.names(|object| object.transform.mirrors());
        let facts = evidence([
            ("scale_differs_by_axis", Fact::Names(stretched.clone())),
            ("scale_not_1", Fact::Names(scaled.clone())),
            ("mirrored", Fact::Names(mirrored.clone())),
            ("tangent_frame", Fact::Text(features.has_tangent().to_string())),
        ]);
        if !features.has_normal() {
            Decision::dropped("no normal is used", facts)
        } else if features.space == LightingSpace::Object {
            Decision::dropped(
                "light and eye are brought to object space: normals stay where they are",
                facts,
            )
        } else if features.form == Form::Published {
            Decision::dropped(
                "the published formula carries normals by the object's own matrix",
                facts,
            )
        } else if !stretched.is_empty() {
            Decision::kept(format!("scale differs by axis: {}", stretched.join(", ")), facts)
        } else if (features.has_tangent() || features.relief == Relief::Displacement) && !mirrored.is_empty()
        {
            Decision::kept(
                format!("mirrored, with a tangent frame: {}", mirrored.join(", ")),
                facts,
            )
        } else if features.has_tangent() && !scaled.is_empty() {
            Decision::kept(
                format!(
                    "scaled, with a tangent frame that needs unit vectors: {}",
                    scaled.join(", ")
                ),
                facts,
            )
        } else if scaled.is_empty() {
            Decision::dropped("every transform is rigid", facts)
        } else {
            Decision::dropped(
                "one scale for all axes leaves the direction of a normal as it is",
                facts,
            )
        }
    }

    fn handedness(&self, features: &FeatureSet) -> Decision {
        let mirrored_uv = self.names(|object| has_mirrored_uv(&object.mesh));
        let facts = evidence([("mirrored_uv", Fact::Names(mirrored_uv))]);
        if !features.has_tangent() {
            Decision::dropped("no tangent frame is used", facts)
        } else if features.mirrored_uv {
            Decision::kept("some vertices have a left-handed frame (mirrored texture)", facts)
        } else if features.relief.is_search() {
            Decision::kept("a search along the view ray has no form without it", facts)
        } else if features.has_handedness() {
            Decision::kept(
                "a general transform may mirror: the sign of its determinant goes along",
                facts,
            )
        } else {
            Decision::dropped("no mirrored UVs and no mirroring transform", facts)
        }
    }

    fn names(&self, is: impl Fn(&Object) -> bool) -> Vec<String> {
        self.objects
            .iter()
            .filter(|object| is(object))
            .map(|object| object.name.clone())
            .collect()
    }
}

/// One of two, by a condition.
fn chosen<T>(first: bool, one: T, other: T) -> T {
    if first { one } else { other }
}

pub(crate) fn count(n: usize) -> Fact {
    Fact::Count(n as u64)
}

/// The predicted error where nothing is displaced and nothing should be.
pub(crate) const NO_ERROR: Predicted = Predicted {
    error_texels_p99: Some(0.0),
    error_px_p99: Some(0.0),
    time_ms: Some(0.0),
    ops: None,
    fetches: None,
};
