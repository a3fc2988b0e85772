//! What to draw: per object its mesh, feature set, uniforms by the shader's names and textures.
//!
//! Every draw carries *all* uniforms and textures that any feature set could ask for, neutral where the material has none: a
//! flat normal, height 0 with relief 0, white albedo, lights of radiance 0, cutoff 0, black surroundings. So one list serves
//! the planned shader and the all-effects shader alike, and both describe the same surface.

use std::collections::BTreeMap;
use std::sync::Arc;

use bossage_assets::{EdgeMode, Mesh};
use bossage_shaders::{Albedo, FeatureSet, LightingSpace, Relief, Stage};
use glam::{DMat4, DVec3, DVec4};

use crate::camera::Matrices;
use crate::facts::MaterialFacts;
use crate::model::{AlphaMode, Elevation, Light, Material, Normaliser, Object, ReflectionPin, Scene, Shadow};
use crate::plan::Plan;
use crate::relief_map;
use crate::schema::{LIGHT_HALF_WIDTH, MAX_LIGHTS};
use crate::technique::{self, Settings};
use crate::textures::Texture;
use crate::tile::Tile;

/// One object with all a renderer needs.
#[derive(Clone, Debug)]
pub struct Draw {
    /// The object's name.
    pub object: String,
    /// The material's name.
    pub material: String,
    /// The permutation to draw it with.
    pub features: FeatureSet,
    /// The mesh, local space, with tangents.
    pub mesh: Arc<Mesh>,
    /// Values by name (`object.clip_from_local`), matrices column by column, arrays flat.
    pub uniforms: BTreeMap<String, Vec<f32>>,
    /// `albedo_map`, `normal_map`, `height_map`; `relief_map` where the feature set reads one; the cubes `environment_map` and `normalisation_map`.
    pub textures: BTreeMap<String, Arc<Texture>>,
    /// Address mode of `surface_sampler`, on both axes.
    pub edge: EdgeMode,
}

/// One time that an object is drawn. All use the one vertex module, so that they meet at the same depths, to the bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    /// The fragment module.
    pub fragment: Stage,
    /// Whether its colour, alpha included, is multiplied into what the target holds, where the depth is exactly its own, and no
    /// depth is written. Otherwise it replaces what is farther away.
    pub multiplies: bool,
}

impl Draw {
    /// How often the object is drawn, in this order.
    #[must_use]
    pub fn passes(&self) -> Vec<Pass> {
        let fragments = self.features.stages().iter().filter_map(|&stage| match stage {
            Stage::Vertex | Stage::FragmentCapture | Stage::FragmentGivenHit => None,
            Stage::Fragment | Stage::SecondPass => Some(Pass {
                fragment: stage,
                multiplies: stage == Stage::SecondPass,
            }),
        });
        fragments.collect()
    }
}

/// The draws of a scene as planned, in scene order. Objects whose every fragment would be discarded are left out.
#[must_use]
pub fn draws(scene: &Scene, plan: &Plan) -> Vec<Draw> {
    let drawn = |object: &Object| plan.materials[object.material].drawn;
    let look = |material: usize| (plan.features(material), plan.settings(material));
    build(scene, &look, &drawn)
}

/// The draws of a scene with feature sets and settings of the caller's choosing, by material index; every object is drawn.
#[must_use]
pub fn draws_with(scene: &Scene, look: impl Fn(usize) -> (FeatureSet, Settings)) -> Vec<Draw> {
    build(scene, &look, &|_| true)
}

fn build(
    scene: &Scene,
    look: &dyn Fn(usize) -> (FeatureSet, Settings),
    drawn: &dyn Fn(&Object) -> bool,
) -> Vec<Draw> {
    let environment = scene
        .environment
        .as_ref()
        .map(|environment| Arc::new(Texture::environment(&environment.map)));
    let looks: Vec<_> = (0..scene.materials.len()).map(look).collect();
    let prepare =
        |(material, look): (_, &(FeatureSet, _))| Prepared::new(material, environment.as_ref(), look.0);
    let prepared: Vec<Prepared> = scene.materials.iter().zip(&looks).map(prepare).collect();
    let draw = |object: &Object| {
        let prepared = &prepared[object.material];
        let (features, settings) = &looks[object.material];
        let mut uniforms = uniforms(scene, object, prepared, features);
        uniforms.insert("material.search".to_owned(), search(prepared.material, settings));
        Draw {
            object: object.name.clone(),
            material: prepared.material.name.clone(),
            features: *features,
            mesh: object.mesh.clone(),
            uniforms,
            textures: prepared.textures.clone(),
            edge: prepared.material.address,
        }
    };
    scene
        .objects
        .iter()
        .filter(|object| drawn(object))
        .map(draw)
        .collect()
}

/// A material with its textures uploaded once for all its objects.
struct Prepared<'a> {
    material: &'a Material,
    facts: MaterialFacts,
    textures: BTreeMap<String, Arc<Texture>>,
}

impl<'a> Prepared<'a> {
    fn new(material: &'a Material, environment: Option<&Arc<Texture>>, features: FeatureSet) -> Self {
        let albedo = material
            .albedo
            .map
            .as_ref()
            .map_or_else(|| Texture::constant([1.0; 4]), |(_, map)| Texture::color(map));
        let normal = material
            .normal
            .as_ref()
            .map_or_else(flat_normal, |normal| Texture::normal(&normal.map, normal.mips));
        let height = material.height.as_ref().map_or_else(
            || Texture::constant_height(0.0),
            |height| Texture::height(&height.field),
        );
        let normalisation = match &material.normaliser {
            Normaliser::Arithmetic => Texture::smallest_normalisation(),
            Normaliser::Cube(map) => Texture::normalisation(map),
        };
        let textures = [
            ("albedo_map", albedo),
            ("normal_map", normal),
            ("height_map", height),
            ("normalisation_map", normalisation),
        ];
        let mut textures: BTreeMap<String, Arc<Texture>> = textures
            .into_iter()
            .map(|(name, texture)| (name.to_owned(), Arc::new(texture)))
            .collect();
        let relief_map = relief_map::bake(features.relief, material.height.as_ref(), material.address);
        textures.extend(relief_map.map(|map| ("relief_map".to_owned(), Arc::new(map))));
        // What mirrors nothing has nothing around it, whatever shader draws it.
        let black = || Arc::new(Texture::constant_environment([0.0, 0.0, 0.0, 1.0]));
        let mirrored = environment.filter(|_| material.reflection != ReflectionPin::None);
        textures.insert(
            "environment_map".to_owned(),
            mirrored.cloned().unwrap_or_else(black),
        );
        Self {
            material,
            facts: MaterialFacts::of(material),
            textures,
        }
    }
}

/// (0, 0, 1) exactly, by the biased codec: (128 − 128)/127 = 0, which no unorm byte decodes to.
fn flat_normal() -> Texture {
    Texture::constant_bytes([128, 128, 255, 255])
}

fn normal_decode(material: &Material) -> [f32; 2] {
    let codec = material
        .normal
        .as_ref()
        .map_or(bossage_assets::NormalCodec::Biased, |normal| normal.map.codec);
    codec.scale_bias()
}

fn uniforms(
    scene: &Scene,
    object: &Object,
    prepared: &Prepared<'_>,
    features: &FeatureSet,
) -> BTreeMap<String, Vec<f32>> {
    let matrices = Matrices::new(&scene.camera, object);
    let lights: Vec<&Light> = scene.lights.iter().filter(|light| !light.is_black()).collect();
    let mut all = object_uniforms(&matrices);
    let eye = matrices.point(features.space, scene.camera.position);
    all.insert("view.eye".to_owned(), padded(eye, 1.0));
    let backward = (scene.camera.position - scene.camera.target).normalize();
    let backward = matrices.direction(features.space, backward);
    all.insert("view.backward".to_owned(), padded(backward, 0.0));
    let clip = matrices.clip_from(features.space);
    all.insert(
        "view.clip_z".to_owned(),
        clip.row(2).as_vec4().to_array().to_vec(),
    );
    all.insert(
        "view.clip_w".to_owned(),
        clip.row(3).as_vec4().to_array().to_vec(),
    );
    all.insert(
        "material.tile_width".to_owned(),
        vec![tile_width(&matrices, object, features)],
    );
    all.insert("object.displacement".to_owned(), displacement(object, prepared));
    all.extend(light_uniforms(&matrices, &lights, features));
    all.extend(material_uniforms(scene, prepared, features));
    all
}

/// The length of a tile along u in lighting space; 1 where there are no texture coordinates, or nobody asks.
fn tile_width(matrices: &Matrices, object: &Object, features: &FeatureSet) -> f32 {
    if !features.pixel_depth {
        return 1.0;
    }
    let tile = match features.space {
        LightingSpace::World => {
            let mut mesh = Mesh::clone(&object.mesh);
            for position in &mut mesh.positions {
                *position = matrices
                    .world_from_local
                    .transform_point3(position.as_dvec3())
                    .as_vec3();
            }
            Tile::of(&mesh)
        }
        LightingSpace::Object => Tile::of(&object.mesh),
    };
    tile.map_or(1.0, |tile| tile.side.x as f32)
}

fn object_uniforms(matrices: &Matrices) -> BTreeMap<String, Vec<f32>> {
    BTreeMap::from([
        (
            "object.clip_from_local".to_owned(),
            columns(matrices.clip_from_local),
        ),
        (
            "object.world_from_local".to_owned(),
            columns(matrices.world_from_local),
        ),
        (
            "object.cofactor".to_owned(),
            columns(DMat4::from_mat3(matrices.cofactor)),
        ),
        (
            "object.handedness_sign".to_owned(),
            vec![matrices.handedness as f32, 0.0, 0.0, 0.0],
        ),
    ])
}

fn light_uniforms(
    matrices: &Matrices,
    lights: &[&Light],
    features: &FeatureSet,
) -> BTreeMap<String, Vec<f32>> {
    let one = |light: &Light| {
        let vector = matrices
            .light_vector(features.space, light)
            .map(|v| v as f32)
            .to_vec();
        (vector, padded(light.radiance(), 0.0))
    };
    let dark = || (vec![0.0, 0.0, 1.0, 0.0], vec![0.0; 4]);
    let (vector, radiance) = lights.first().map_or_else(dark, |light| one(light));
    let mut items: Vec<f32> = lights
        .iter()
        .take(MAX_LIGHTS)
        .flat_map(|light| {
            let (v, r) = one(light);
            [v, r].concat()
        })
        .collect();
    items.resize(MAX_LIGHTS * 8, 0.0);
    BTreeMap::from([
        ("light.vector".to_owned(), vector),
        ("light.radiance".to_owned(), radiance),
        (
            "lights.count".to_owned(),
            vec![lights.len().min(MAX_LIGHTS) as f32, 0.0, 0.0, 0.0],
        ),
        ("lights.items".to_owned(), items),
    ])
}

fn material_uniforms(
    scene: &Scene,
    prepared: &Prepared<'_>,
    features: &FeatureSet,
) -> BTreeMap<String, Vec<f32>> {
    let material = prepared.material;
    let albedo = match features.albedo {
        Albedo::Constant => folded(prepared),
        Albedo::Map => material.albedo.color,
    };
    let cutoff = match material.alpha {
        AlphaMode::Opaque => 0.0,
        AlphaMode::Mask { cutoff } => cutoff,
    };
    let specular = material.specular.extend(material.shininess);
    BTreeMap::from([
        ("material.albedo".to_owned(), albedo.as_vec4().to_array().to_vec()),
        ("material.ambient".to_owned(), padded(scene.ambient, 0.0)),
        (
            "material.specular".to_owned(),
            specular.as_vec4().to_array().to_vec(),
        ),
        ("material.shininess".to_owned(), vec![material.shininess as f32]),
        ("material.relief".to_owned(), relief(prepared, features)),
        ("material.light_half_width".to_owned(), vec![half_width(material)]),
        ("material.occlusion".to_owned(), vec![material.occlusion as f32]),
        ("material.emboss_step".to_owned(), vec![emboss_step(material)]),
        ("material.alpha_cutoff".to_owned(), vec![cutoff as f32]),
        (
            "material.normal_decode".to_owned(),
            normal_decode(material).to_vec(),
        ),
    ])
}

/// The constant colour that stands for colour and map: what is constant in the map is folded in; what varies there and is
/// left out, because it cannot be seen, leaves its constant alone.
fn folded(prepared: &Prepared<'_>) -> DVec4 {
    let (color, facts) = (prepared.material.albedo.color, &prepared.facts.albedo);
    let rgb = if facts.constant_rgb {
        facts.first.truncate()
    } else {
        color.truncate()
    };
    rgb.extend(if facts.constant_alpha {
        facts.first.w
    } else {
        color.w
    })
}

/// Scale and bias along u, then the factor by which both differ along v (tiles that are not square). Zero where there is no
/// relief: without heights, where none is pinned or another kind than the shader's is, and where heights are constant (such a
/// surface is the polygon itself, see the schema) unless the scene pins a technique.
fn relief(prepared: &Prepared<'_>, features: &FeatureSet) -> Vec<f32> {
    let technique = prepared.material.technique;
    let is_plane = match technique.relief() {
        None => {
            let constant = prepared.facts.height.is_none_or(|height| height.is_constant());
            constant || features.relief.is_slope()
        }
        Some(Relief::None) => true,
        Some(pinned) => pinned != features.relief,
    };
    match &prepared.material.height {
        Some(height) if !is_plane => {
            let Elevation { scale, bias } = height.elevation;
            let v_factor = if scale.x == 0.0 { 1.0 } else { scale.y / scale.x };
            [scale.x, bias.x, v_factor, 0.0].map(|x| x as f32).to_vec()
        }
        Some(_) | None => vec![0.0, 0.0, 1.0, 0.0],
    }
}

/// Layers, steps or iterations, refinements, the sampler's edge mode, and samples toward each light.
fn search(material: &Material, settings: &Settings) -> Vec<f32> {
    let [steps, refinements] = technique::numbers(settings);
    let edge = match material.address {
        EdgeMode::Wrap => 0.0,
        EdgeMode::Mirror => 1.0,
        EdgeMode::Clamp => 2.0,
    };
    vec![
        steps as f32,
        refinements as f32,
        edge,
        material.shadow.samples() as f32,
    ]
}

/// Half the extent of the lights, that of the schema where shadows are not soft.
fn half_width(material: &Material) -> f32 {
    match material.shadow {
        Shadow::Soft { half_width, .. } => half_width as f32,
        Shadow::None | Shadow::Hard { .. } => LIGHT_HALF_WIDTH as f32,
    }
}

/// The texels toward the light in texture coordinates of the longer side.
fn emboss_step(material: &Material) -> f32 {
    let side = material
        .height
        .as_ref()
        .map_or(1, |height| height.field.width.max(height.field.height));
    (material.emboss_texels / f64::from(side)) as f32
}

/// Scale and bias in the object's units, then the lengths of a tile along u and v. Nothing moves without heights, or without
/// texture coordinates.
fn displacement(object: &Object, prepared: &Prepared<'_>) -> Vec<f32> {
    let tile = Tile::of(&object.mesh);
    let (Some(height), Some(tile)) = (&prepared.material.height, tile) else {
        return vec![0.0, 0.0, 1.0, 1.0];
    };
    let Elevation { scale, bias } = height.elevation;
    [
        scale.x * tile.side.x,
        bias.x * tile.side.x,
        tile.side.x,
        tile.side.y,
    ]
    .map(|x| x as f32)
    .to_vec()
}

fn padded(v: DVec3, w: f64) -> Vec<f32> {
    v.extend(w).as_vec4().to_array().to_vec()
}

fn columns(m: DMat4) -> Vec<f32> {
    m.as_mat4().to_cols_array().to_vec()
}
