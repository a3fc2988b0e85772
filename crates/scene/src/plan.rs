//! The plan: per material, each effect kept or dropped with its reason and evidence; which permutations that makes; what error
//! is to be expected.
//!
//! A material has one permutation: the union of what its objects need. Keys of the JSON form are those of the command line's
//! `plan` schema, version 1.

use std::collections::BTreeMap;
use std::path::PathBuf;

use bossage_shaders::FeatureSet;
use serde::Serialize;

use crate::choose::Choice;
use crate::decide;
use crate::model::Scene;
use crate::relief;
use crate::technique::{Settings, Technique};
use crate::views::{Footprint, View};

/// What a scene calls for.
#[derive(Clone, Debug, Serialize)]
pub struct Plan {
    /// Version of this form.
    pub schema: u32,
    /// The scene file.
    pub scene: PathBuf,
    /// The error it was made for: pixels, 99th percentile.
    pub budget_px: Option<f64>,
    /// The time it was made for: milliseconds of relief in a frame.
    pub budget_ms: Option<f64>,
    /// The cost profile that times are of.
    pub profile: String,
    /// One entry a material, in scene order.
    pub materials: Vec<MaterialPlan>,
    /// Distinct feature sets, by name, with the materials that share each.
    pub permutations: Vec<Permutation>,
}

impl Plan {
    /// The feature set of a material, by its index in the scene.
    #[must_use]
    pub fn features(&self, material: usize) -> FeatureSet {
        self.materials[material].features
    }

    /// The feature set with everything on that goes with what a material pins, by its index in the scene: what the planned
    /// picture is compared with to prove that dropping was safe.
    #[must_use]
    pub fn everything(&self, material: usize) -> FeatureSet {
        self.materials[material].everything
    }

    /// The settings of a material's relief technique, by its index in the scene.
    #[must_use]
    pub fn settings(&self, material: usize) -> Settings {
        self.materials[material].settings.clone()
    }

    /// The budget in words.
    #[must_use]
    pub fn wanted(&self) -> String {
        let error = self.budget_px.map(|px| format!("at most {px} px of error"));
        let profile = &self.profile;
        let time = self
            .budget_ms
            .map(|ms| format!("at most {ms} ms of relief a frame on {profile}"));
        [error, time].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    /// Fills in the static cost of one permutation, as its manifest states it, for every material that shares it.
    pub fn set_cost(&mut self, permutation: &str, ops: u32, fetches: u32) {
        for material in self
            .materials
            .iter_mut()
            .filter(|material| material.permutation == permutation)
        {
            material.predicted.ops = Some(ops);
            material.predicted.fetches = Some(fetches);
        }
    }
}

/// One material's part of the plan.
#[derive(Clone, Debug, Serialize)]
pub struct MaterialPlan {
    /// The material.
    pub name: String,
    /// The relief technique: `none`, or its id.
    pub technique: &'static str,
    /// Its settings.
    pub settings: Settings,
    /// Both as one value.
    #[serde(skip)]
    pub how: Technique,
    /// `auto` or `pinned`: who decided the technique.
    pub technique_by: &'static str,
    /// What light does: `blinn_phong`, or the id of the shading.
    pub shading: &'static str,
    /// `auto` or `pinned`: who decided the shading.
    pub shading_by: &'static str,
    /// Name of the permutation.
    pub permutation: String,
    /// The permutation.
    pub features: FeatureSet,
    /// The permutation with everything on that goes with what the scene pins: drawn with the same numbers it must give the
    /// same picture.
    #[serde(skip)]
    pub everything: FeatureSet,
    /// Whether anything is drawn: a mask that discards every fragment draws nothing.
    pub drawn: bool,
    /// Every effect, in a fixed order.
    pub effects: Vec<Effect>,
    /// What to expect.
    pub predicted: Predicted,
    /// How the relief technique was chosen, where there was a choice.
    pub choice: Option<Choice>,
    /// The objects that use it and how the camera sees them.
    pub objects: Vec<ObjectView>,
    /// What else a reader should know.
    pub notes: Vec<String>,
}

impl MaterialPlan {
    /// One effect's entry.
    #[must_use]
    pub fn effect(&self, id: EffectId) -> &Effect {
        // `effects` holds every id, in the order of the enum.
        &self.effects[id as usize]
    }
}

/// An object and its footprint.
#[derive(Clone, Debug, Serialize)]
pub struct ObjectView {
    /// The object.
    pub name: String,
    /// How the camera sees it; none when it is out of view.
    pub footprint: Option<Footprint>,
}

/// What an effect is called, in the order of the plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EffectId {
    /// Any light at all.
    Lighting,
    /// A light vector computed per pixel.
    LightVector,
    /// A loop over lights.
    LightLoop,
    /// The specular lobe with its half vector.
    Specular,
    /// The environment mirrored in the perturbed normal.
    Environment,
    /// The normal map.
    NormalMap,
    /// The cube map that normalises the light vector.
    NormalisationCube,
    /// The albedo map.
    AlbedoMap,
    /// Discarding fragments by alpha.
    AlphaDiscard,
    /// Displacing texture coordinates by the height map.
    Relief,
    /// What of the relief stands before the lights.
    Shadow,
    /// The depth of the place on the relief in place of the polygon's.
    PixelDepth,
    /// Ambient light occluded by the slope of the normal map.
    AmbientOcclusion,
    /// The slope of the height map toward the light, added to the diffuse term.
    Emboss,
    /// Displacing vertices by the height map.
    Displacement,
    /// A second pass that multiplies the colour in.
    SecondPass,
    /// The cofactor matrix for normals.
    CofactorMatrix,
    /// The sign of the tangent frame.
    Handedness,
}

impl EffectId {
    /// All of them, in order.
    pub const ALL: [Self; 18] = [
        Self::Lighting,
        Self::LightVector,
        Self::LightLoop,
        Self::Specular,
        Self::Environment,
        Self::NormalMap,
        Self::NormalisationCube,
        Self::AlbedoMap,
        Self::AlphaDiscard,
        Self::Relief,
        Self::Shadow,
        Self::PixelDepth,
        Self::AmbientOcclusion,
        Self::Emboss,
        Self::Displacement,
        Self::SecondPass,
        Self::CofactorMatrix,
        Self::Handedness,
    ];

    /// The word used in JSON and in the table.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Lighting => "lighting",
            Self::LightVector => "light_vector",
            Self::LightLoop => "light_loop",
            Self::Specular => "specular",
            Self::Environment => "environment",
            Self::NormalMap => "normal_map",
            Self::NormalisationCube => "normalisation_cube",
            Self::AlbedoMap => "albedo_map",
            Self::AlphaDiscard => "alpha_discard",
            Self::Relief => "relief",
            Self::Shadow => "shadow",
            Self::PixelDepth => "pixel_depth",
            Self::AmbientOcclusion => "ambient_occlusion",
            Self::Emboss => "emboss",
            Self::Displacement => "displacement",
            Self::SecondPass => "second_pass",
            Self::CofactorMatrix => "cofactor_matrix",
            Self::Handedness => "handedness",
        }
    }
}

/// Kept or dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// In the shader.
    Kept,
    /// Compiled out.
    Dropped,
}

/// One effect's decision.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Effect {
    /// Which effect.
    pub id: EffectId,
    /// Kept or dropped.
    pub state: State,
    /// Why, in words.
    pub reason: String,
    /// The numbers behind it.
    pub evidence: Evidence,
}

/// Named facts, sorted by name.
pub type Evidence = BTreeMap<&'static str, Fact>;

/// One fact.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Fact {
    /// A count.
    Count(u64),
    /// A measured or computed number.
    Number(f64),
    /// Several numbers.
    Numbers(Vec<f64>),
    /// A name.
    Text(String),
    /// Several names.
    Names(Vec<String>),
}

/// What to expect of a material's shader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Predicted {
    /// 99th percentile of the distance between the texture position shaded and the true one, texels; none where nothing of
    /// the material is seen.
    pub error_texels_p99: Option<f64>,
    /// The same in pixels on screen.
    pub error_px_p99: Option<f64>,
    /// Time of the relief in a frame by the cost profile, milliseconds; none without figures.
    pub time_ms: Option<f64>,
    /// Operations a pixel, from the manifest's static cost.
    pub ops: Option<u32>,
    /// Texture fetches a pixel, from the manifest's static cost.
    pub fetches: Option<u32>,
}

/// One shader permutation and who shares it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Permutation {
    /// Its name.
    pub name: String,
    /// Its features.
    pub features: FeatureSet,
    /// The materials that share it.
    pub materials: Vec<String>,
}

/// Derives what a scene calls for. Deterministic: the same files give the same plan.
#[must_use]
pub fn plan(scene: &Scene) -> Plan {
    let views: Vec<View> = scene
        .objects
        .iter()
        .map(|object| View::new(&scene.camera, object))
        .collect();
    let time_ms = times_ms(scene, &views);
    let materials: Vec<MaterialPlan> = (0..scene.materials.len())
        .map(|index| decide::material(scene, &views, index, time_ms[index]))
        .collect();
    Plan {
        schema: 1,
        scene: scene.path.clone(),
        budget_px: scene.budget.error_px,
        budget_ms: scene.budget.time_ms,
        profile: scene.budget.profile.name.clone(),
        permutations: permutations(&materials),
        materials,
    }
}

/// Each material's share of the time: as long a pixel for all whose technique is chosen. Pinned techniques come on top.
fn times_ms(scene: &Scene, views: &[View]) -> Vec<Option<f64>> {
    let area = |index: usize| -> f64 {
        let of_material = scene
            .objects
            .iter()
            .zip(views)
            .filter(|(object, _)| object.material == index);
        of_material.map(|(_, view)| view.area_px()).sum()
    };
    let areas: Vec<f64> = (0..scene.materials.len()).map(area).collect();
    let chosen = scene
        .materials
        .iter()
        .zip(&areas)
        .filter(|(material, _)| relief::is_chosen(material));
    let total: f64 = chosen.map(|(_, area)| area).sum();
    let share = |area: &f64| if total > 0.0 { area / total } else { 0.0 };
    areas
        .iter()
        .map(|area| Some(scene.budget.time_ms? * share(area)))
        .collect()
}

fn permutations(materials: &[MaterialPlan]) -> Vec<Permutation> {
    let mut by_name: BTreeMap<&str, Permutation> = BTreeMap::new();
    for material in materials {
        let new = || Permutation {
            name: material.permutation.clone(),
            features: material.features,
            materials: Vec::new(),
        };
        by_name
            .entry(&material.permutation)
            .or_insert_with(new)
            .materials
            .push(material.name.clone());
    }
    by_name.into_values().collect()
}
