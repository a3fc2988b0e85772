//! What the examples call for: facts a reader of each file would expect.

use std::path::Path;

use bossage_scene::{EffectId, MaterialPlan, Plan, State, plan};

use crate::fixture::{example, only};

fn kept(material: &MaterialPlan) -> Vec<&'static str> {
    material
        .effects
        .iter()
        .filter(|effect| effect.state == State::Kept)
        .map(|effect| effect.id.as_str())
        .collect()
}

fn material<'a>(plan: &'a Plan, name: &str) -> &'a MaterialPlan {
    plan.materials
        .iter()
        .find(|material| material.name == name)
        .expect("a material of that name")
}

#[test]
fn every_example_loads_and_plans() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .expect("the examples folder")
        .map(|entry| {
            entry
                .expect("a readable entry")
                .file_name()
                .into_string()
                .expect("a plain name")
        })
        .filter(|name| name.ends_with(".toml"))
        .collect();
    names.sort();
    assert_eq!(
        names,
        [
            "brick_wall.toml",
            "bump_and_parallax.toml",
            "bumped_cube.toml",
            "displacement.toml",
            "dot3_cube.toml",
            "dot3_cube_two_pass.toml",
            "elevation.toml",
            "emboss.toml",
            "environment_bump.toml",
            "gallery.toml",
            "height_to_normal.toml",
            "nothing.toml",
            "parallax_occlusion.toml",
            "pixel_depth.toml",
            "shadows.toml"
        ]
    );
    for name in names {
        let scene = example(&name);
        let first = plan(&scene);
        assert_eq!(
            first.to_string(),
            plan(&example(&name)).to_string(),
            "{name} is planned alike twice"
        );
        for material in &first.materials {
            assert_eq!(material.effects.len(), EffectId::ALL.len());
            assert!(
                material
                    .effects
                    .iter()
                    .zip(EffectId::ALL)
                    .all(|(effect, id)| effect.id == id)
            );
            assert!(material.notes.is_empty(), "{name}: {:?}", material.notes);
        }
    }
}

#[test]
fn brick_wall_needs_relief_normals_and_a_highlight() {
    let plan = plan(&example("brick_wall.toml"));
    let bricks = only(&plan);
    assert_eq!(
        kept(bricks),
        [
            "lighting",
            "specular",
            "normal_map",
            "albedo_map",
            "relief",
            "handedness"
        ]
    );
    assert!(bricks.choice.is_some());
    assert!(
        bricks.objects[0]
            .footprint
            .is_some_and(|seen| seen.area_px > 50_000.0)
    );
    assert!(
        bricks
            .predicted
            .error_px_p99
            .is_some_and(|px| px > 0.0 && px < 20.0),
        "{plan}"
    );
}

#[test]
fn elevation_has_a_tile_that_is_not_square() {
    let scene = example("elevation.toml");
    let height = scene.materials[0].height.as_ref().expect("heights");
    assert_eq!((height.field.width, height.field.height), (403, 344));
    assert_eq!(
        height.elevation.scale.to_array(),
        [0.84019 / 29.98, 0.84019 / 31.88]
    );
    assert_eq!(height.elevation.bias, -height.elevation.scale);
    assert_eq!(
        kept(only(&plan(&scene))),
        ["lighting", "normal_map", "relief", "handedness"]
    );
}

#[test]
fn bumped_cube_is_the_third_article() {
    let plan = plan(&example("bumped_cube.toml"));
    let cube = only(&plan);
    assert_eq!(kept(cube), ["lighting", "normal_map"]);
    assert_eq!(cube.features.space, bossage_shaders::LightingSpace::Object);
    assert_eq!(cube.features.lights, bossage_shaders::Lights::Directional);
}

/// Each article's picture calls for its technique, and for no other article's.
#[test]
fn the_articles_pictures_call_for_their_techniques() {
    let of = |name: &str| {
        let plan = plan(&example(name));
        let of_material = |material: &MaterialPlan| (material.technique, material.shading, kept(material));
        plan.materials.iter().map(of_material).collect::<Vec<_>>()
    };
    assert_eq!(
        of("bump_and_parallax.toml"),
        [(
            "parallax_offset_limited",
            "blinn_phong",
            vec![
                "lighting",
                "light_vector",
                "specular",
                "normal_map",
                "albedo_map",
                "relief"
            ]
        )]
    );
    assert_eq!(
        of("parallax_occlusion.toml"),
        [(
            "parallax_slope_ao",
            "wrap_lambert",
            vec![
                "lighting",
                "normal_map",
                "albedo_map",
                "relief",
                "ambient_occlusion"
            ]
        )]
    );
    let mut dot3 = vec![
        "lighting",
        "light_vector",
        "normal_map",
        "normalisation_cube",
        "albedo_map",
    ];
    assert_eq!(of("dot3_cube.toml"), [("none", "dot3_single_pass", dot3.clone())]);
    dot3.push("second_pass");
    assert_eq!(of("dot3_cube_two_pass.toml"), [("none", "dot3_two_pass", dot3)]);
    assert_eq!(
        of("emboss.toml"),
        [("none", "emboss", vec!["lighting", "light_vector", "emboss"])]
    );
    assert_eq!(
        of("environment_bump.toml"),
        [
            (
                "none",
                "blinn_phong",
                vec!["lighting", "specular", "environment", "normal_map"]
            ),
            ("none", "blinn_phong", vec!["lighting", "specular", "environment"])
        ]
    );
    assert_eq!(
        of("displacement.toml"),
        [(
            "displacement",
            "blinn_phong",
            vec!["lighting", "albedo_map", "displacement"]
        )]
    );
    assert_eq!(
        of("height_to_normal.toml"),
        [
            ("none", "blinn_phong", vec!["lighting", "albedo_map"]),
            ("none", "blinn_phong", vec!["lighting", "normal_map"])
        ]
    );
}

#[test]
fn nothing_needs_nothing() {
    let plan = plan(&example("nothing.toml"));
    let plaster = only(&plan);
    assert_eq!(kept(plaster), Vec::<&str>::new());
    assert_eq!(plaster.features, bossage_shaders::FeatureSet::default());
    assert_eq!(plaster.predicted.error_px_p99, Some(0.0));
    // The maps are dropped for what they hold, not only for want of light.
    assert!(plaster.effect(EffectId::NormalMap).reason.contains("(0, 0, 1)"));
    assert!(
        plaster
            .effect(EffectId::Relief)
            .reason
            .contains("height does not vary")
    );
}

#[test]
fn gallery_shares_and_parts() {
    let plan = plan(&example("gallery.toml"));
    assert_eq!(
        material(&plan, "brass").permutation,
        material(&plan, "steel").permutation
    );
    assert_eq!(plan.permutations.len(), plan.materials.len() - 1);
    let has = |name, id: EffectId| material(&plan, name).effect(id).state == State::Kept;
    assert!(has("grating", EffectId::AlphaDiscard) && !has("bricks", EffectId::AlphaDiscard));
    assert!(material(&plan, "bricks").choice.is_some() && material(&plan, "brass").choice.is_none());
    assert!(has("brass", EffectId::CofactorMatrix) && !has("clay", EffectId::CofactorMatrix));
    assert!(has("steel", EffectId::Handedness) && !has("clay", EffectId::Handedness));
    assert!(
        plan.materials
            .iter()
            .all(|material| material.features.lights == bossage_shaders::Lights::Many)
    );
}

#[test]
fn json_has_the_agreed_keys() {
    let json = serde_json::to_value(plan(&example("brick_wall.toml"))).expect("plans are plain data");
    assert_eq!(json["schema"], 1);
    let material = &json["materials"][0];
    for key in ["name", "technique", "permutation", "effects", "predicted"] {
        assert!(!material[key].is_null(), "{key}");
    }
    assert_eq!(material["name"], "bricks");
    for key in ["error_texels_p99", "error_px_p99"] {
        assert!(material["predicted"][key].is_f64(), "{key}");
    }
    // Static costs come from the manifest; until then the keys are there and empty.
    assert!(
        material["predicted"]
            .get("ops")
            .is_some_and(serde_json::Value::is_null)
    );
    assert!(
        material["predicted"]
            .get("fetches")
            .is_some_and(serde_json::Value::is_null)
    );
    for effect in material["effects"].as_array().expect("an array") {
        assert!(effect["id"].is_string() && effect["reason"].is_string() && effect["evidence"].is_object());
        assert!(effect["state"] == "kept" || effect["state"] == "dropped");
    }
    assert_eq!(json["permutations"][0]["materials"][0], "bricks");
}

#[test]
fn costs_are_filled_in_by_permutation() {
    let mut plan = plan(&example("gallery.toml"));
    let shared = material(&plan, "brass").permutation.clone();
    plan.set_cost(&shared, 120, 1);
    assert_eq!(material(&plan, "steel").predicted.ops, Some(120));
    assert_eq!(material(&plan, "clay").predicted.ops, None);
}

#[test]
fn the_readme_names_every_key_and_its_default() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme =
        std::fs::read_to_string(folder.join("../../examples/README.md")).expect("examples/README.md");
    let schema = std::fs::read_to_string(folder.join("src/schema.rs")).expect("src/schema.rs");
    let rows = |text: &str, lead: &str| -> Vec<String> {
        let table = text
            .lines()
            .filter_map(|line| line.strip_prefix(lead))
            .filter(|line| line.starts_with("| `"));
        table
            .map(|line| line.replace("\\[", "[").replace("\\]", "]"))
            .collect()
    };
    let stated = rows(&schema, "//! ");
    assert!(stated.len() > 30);
    let format = readme
        .split("## The format")
        .nth(1)
        .expect("the section on the format");
    assert_eq!(
        rows(format, ""),
        stated,
        "the table of examples/README.md is that of the schema module"
    );
}
