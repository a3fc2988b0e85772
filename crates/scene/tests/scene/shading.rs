//! Decisions on shading, slope relief, reflection and displacement: kept and dropped by content, with the numbers that say so.

use bossage_scene::{EffectId, MaterialPlan, Plan, Scene, State, draws, draws_with, plan};
use bossage_shaders::{Form, LightingSpace, NormalSource, Normaliser, Relief, Shading, Shadow};

use crate::bad_input::folder;
use crate::fixture::{Folder, LAMP, SUN, one_plane, only};

const HEIGHT: &str = "height = { map = \"height.png\", scale = 0.04, bias = -0.02 }\n";
const NORMAL: &str = "normal = { map = \"normal.png\", codec = \"unorm\" }\n";
const COLOR: &str = "albedo = { map = \"color.png\" }\n";

fn planned(folder: &Folder, lights: &str, material: &str) -> (Scene, Plan) {
    let scene = folder.scene(&one_plane(lights, material, ""));
    let plan = plan(&scene);
    (scene, plan)
}

fn state(plan: &MaterialPlan, id: EffectId) -> (State, &str) {
    let effect = plan.effect(id);
    (effect.state, effect.reason.as_str())
}

/// The effects, their order in the plan, and the canonical set agree.
fn agrees(material: &MaterialPlan) {
    let kept = |id| material.effect(id).state == State::Kept;
    let set = material.features;
    assert_eq!(set.canonical(), set);
    assert_eq!(kept(EffectId::Specular), set.specular);
    assert_eq!(kept(EffectId::Environment), set.environment);
    assert_eq!(kept(EffectId::NormalMap), set.normal == NormalSource::Map);
    assert_eq!(
        kept(EffectId::NormalisationCube),
        set.normaliser == Normaliser::Cube
    );
    assert_eq!(kept(EffectId::Relief), set.relief.shifts());
    assert_eq!(kept(EffectId::Shadow), set.shadow != Shadow::None);
    assert_eq!(kept(EffectId::PixelDepth), set.pixel_depth);
    assert_eq!(kept(EffectId::AmbientOcclusion), set.relief.is_slope());
    assert_eq!(kept(EffectId::Displacement), set.relief == Relief::Displacement);
    assert_eq!(kept(EffectId::Emboss), set.shading == Shading::Emboss);
    assert_eq!(kept(EffectId::SecondPass), set.second_pass().is_some());
}

#[test]
fn embossing_of_constant_heights_is_dropped_and_one_texel_brings_it_back() {
    let folder = folder();
    let material = format!(
        "{}shading = \"emboss\"",
        HEIGHT.replace("height.png", "level.png")
    );
    folder.height("level.png", |_, _| 0.5);
    let (_, plan) = planned(&folder, SUN, &material);
    let (kept, reason) = state(only(&plan), EffectId::Emboss);
    assert!(
        kept == State::Dropped && reason.contains("height does not vary"),
        "{plan}"
    );
    assert_eq!(only(&plan).features.shading, Shading::BlinnPhong);
    // What has to be shown to change nothing still has it.
    assert_eq!(plan.everything(0).shading, Shading::Emboss);
    folder.height("level.png", |x, y| if (x, y) == (3, 4) { 0.6 } else { 0.5 });
    let (_, plan) = planned(&folder, SUN, &material);
    assert_eq!(state(only(&plan), EffectId::Emboss).0, State::Kept);
    assert!(state(only(&plan), EffectId::NormalMap).0 == State::Dropped);
    agrees(only(&plan));
}

#[test]
fn shadows_go_with_a_search_and_have_the_rest_beside_them() {
    let folder = folder();
    folder.height("level.png", |_, _| 0.5);
    let relief = format!("{COLOR}{HEIGHT}technique = \"relief\"\n");
    let soft = format!("{relief}shadow = \"soft\"\nlight_samples = 9\nlight_half_width = 0.5");
    let (scene, plan) = planned(&folder, SUN, &soft);
    let one = only(&plan);
    agrees(one);
    assert_eq!(one.features.shadow, Shadow::Soft);
    for id in [EffectId::Specular, EffectId::NormalMap, EffectId::LightLoop] {
        let (kept, reason) = state(one, id);
        assert!(
            kept == State::Kept && reason.contains("changes nothing here"),
            "{plan}"
        );
    }
    // No cube map is bound where nothing is mirrored.
    assert_eq!(state(one, EffectId::Environment).0, State::Dropped, "{plan}");
    let draw = draws(&scene, &plan).remove(0);
    assert_eq!(draw.uniforms["material.search"][3], 9.0);
    assert_eq!(draw.uniforms["material.light_half_width"], [0.5]);
    let level = HEIGHT.replace("height.png", "level.png");
    for (lights, material, says) in [
        ("", format!("{relief}shadow = \"hard\""), "there is no light"),
        (
            SUN,
            format!("{COLOR}{level}shadow = \"hard\""),
            "no relief is drawn",
        ),
        (SUN, relief.clone(), "asks for none"),
    ] {
        let (_, plan) = planned(&folder, lights, &material);
        agrees(only(&plan));
        let (kept, reason) = state(only(&plan), EffectId::Shadow);
        assert!(kept == State::Dropped && reason.contains(says), "{plan}");
    }
}

#[test]
fn depth_of_the_relief_goes_with_a_search_lit_or_not() {
    let folder = folder();
    let deep = format!("{COLOR}{HEIGHT}technique = \"relief\"\npixel_depth = true\n");
    for lights in ["", SUN] {
        let (scene, plan) = planned(&folder, lights, &deep);
        let one = only(&plan);
        agrees(one);
        assert!(
            one.features.pixel_depth && one.features.shadow == Shadow::None,
            "{plan}"
        );
        let (kept, reason) = state(one, EffectId::Lighting);
        assert!(kept == State::Kept, "{plan}");
        assert_eq!(
            reason.contains("changes nothing here"),
            lights.is_empty(),
            "{plan}"
        );
        let draw = draws(&scene, &plan).remove(0);
        // The rows of clip space give what the vertex stage gives, at the object's middle.
        let [local, world] =
            ["object.clip_from_local", "object.world_from_local"].map(|name| &draw.uniforms[name]);
        let place = [world[12], world[13], world[14], 1.0];
        for (row, name) in [(2, "view.clip_z"), (3, "view.clip_w")] {
            let got: f32 = draw.uniforms[name].iter().zip(place).map(|(a, b)| a * b).sum();
            assert!(
                (got - local[12 + row]).abs() < 1e-5,
                "{name}: {got} {}",
                local[12 + row]
            );
        }
        assert!(draw.uniforms["material.tile_width"][0] > 0.0);
    }
    let offset = deep.replace("technique = \"relief\"\n", "");
    let (_, plan) = planned(&folder, SUN, &offset);
    agrees(only(&plan));
    let asked = state(only(&plan), EffectId::PixelDepth);
    assert_eq!(
        asked.0 == State::Kept,
        only(&plan).features.relief.is_search(),
        "{plan}"
    );
}

#[test]
fn dot3_is_what_its_article_has() {
    let folder = folder();
    let material = format!(
        "{COLOR}{NORMAL}{HEIGHT}specular = [0.5, 0.5, 0.5]\nshading = \"dot3_two_pass\"\n\
         normaliser = {{ kind = \"cube\", size = 16, bits = 16 }}\nlighting_space = \"object\""
    );
    let (scene, plan) = planned(&folder, LAMP, &material);
    let one = only(&plan);
    agrees(one);
    assert_eq!(
        state(one, EffectId::Specular),
        (State::Dropped, "`dot3_two_pass` has no highlight")
    );
    assert_eq!(
        state(one, EffectId::Relief),
        (State::Dropped, "`dot3` shifts no texture")
    );
    assert_eq!(state(one, EffectId::NormalisationCube).0, State::Kept);
    assert_eq!(one.features.space, LightingSpace::Object);
    assert_eq!((one.shading, one.shading_by), ("dot3_two_pass", "pinned"));
    let draw = draws(&scene, &plan).remove(0);
    assert_eq!(draw.textures["normalisation_map"].levels[0].width, 16);
}

#[test]
fn a_pinned_slope_keeps_its_map_without_light_and_occludes() {
    let folder = folder();
    let material = format!("{NORMAL}{HEIGHT}technique = \"parallax_slope_ao\"\nocclusion = 12.0");
    let (scene, plan) = planned(&folder, "", &material);
    let one = only(&plan);
    agrees(one);
    assert!(state(one, EffectId::NormalMap).1.contains("reads slopes"));
    assert_eq!(state(one, EffectId::AmbientOcclusion).0, State::Kept);
    assert_eq!((one.technique, one.technique_by), ("parallax_slope_ao", "pinned"));
    assert!(one.predicted.error_px_p99.is_some());
    assert_eq!(draws(&scene, &plan)[0].uniforms["material.occlusion"], [12.0]);
}

/// One viewing direction for all pixels: straight from the camera's axis, in the space of lighting.
#[test]
fn the_published_slope_gets_the_camera_s_axis() {
    let folder = folder();
    let material = format!(
        "{NORMAL}{HEIGHT}form = \"published\"\ntechnique = \"parallax_slope_ao\"\nlighting_space = \"object\""
    );
    let (scene, plan) = planned(&folder, SUN, &material);
    assert_eq!(only(&plan).features.form, Form::Published);
    let backward = &draws(&scene, &plan)[0].uniforms["view.backward"];
    // The camera looks along −z; the plane is turned by −50° about x, so that z is (0, −sin 50°, cos 50°) in it, to f32.
    let (sin, cos) = 50f32.to_radians().sin_cos();
    for (got, want) in backward.iter().zip([0.0, -sin, cos, 0.0]) {
        assert!((got - want).abs() < 1e-6, "{backward:?}");
    }
}

#[test]
fn the_wrapped_shading_asks_for_its_own_relief() {
    let folder = folder();
    let material = format!("{COLOR}{NORMAL}{HEIGHT}shading = \"wrap_lambert\"");
    let (scene, plan) = planned(&folder, SUN, &material);
    let one = only(&plan);
    agrees(one);
    assert!(
        state(one, EffectId::Relief).1.contains("none is pinned"),
        "{plan}"
    );
    // color.png has holes.
    assert_eq!(state(one, EffectId::AlphaDiscard).0, State::Kept);
    // All effects have the slope's relief on, and it shifts by nothing.
    assert_eq!(plan.everything(0).relief, Relief::ParallaxSlopeAo);
    let full = draws_with(&scene, |material| {
        (plan.everything(material), plan.settings(material))
    })
    .remove(0);
    assert_eq!(full.uniforms["material.relief"][0], 0.0);
}

#[test]
fn displaced_vertices_have_normals_of_their_own() {
    let folder = folder();
    let text = one_plane(
        SUN,
        &format!("{COLOR}{NORMAL}{HEIGHT}technique = \"displacement\""),
        "size = [4.0, 2.0]\nsegments = [16, 8]\nuv_repeat = [2.0, 2.0]",
    );
    let scene = folder.scene(&text);
    let plan = plan(&scene);
    let one = only(&plan);
    agrees(one);
    assert!(state(one, EffectId::NormalMap).1.contains("normals of their own"));
    assert_eq!(state(one, EffectId::Relief).0, State::Dropped);
    let draw = draws(&scene, &plan).remove(0);
    assert_eq!(draw.mesh.positions.len(), 17 * 9);
    // A tile is 2 by 1: z = 0.04·2 h − 0.02·2.
    let expected = [0.08, -0.04, 2.0, 1.0];
    for (got, want) in draw.uniforms["object.displacement"].iter().zip(expected) {
        assert!(
            (got - want).abs() < 1e-6,
            "{:?}",
            draw.uniforms["object.displacement"]
        );
    }
    // A finer grid misses less.
    let error = |segments: &str| {
        let scene = folder.scene(&text.replace("[16, 8]", segments));
        bossage_scene::plan(&scene).materials[0]
            .predicted
            .error_px_p99
            .expect("it is seen")
    };
    assert!(error("[64, 64]") < 0.5 * error("[4, 4]"));
}

#[test]
fn a_reflection_needs_surroundings_and_something_to_mirror_with() {
    let folder = folder();
    for name in ["px", "nx", "py", "ny", "pz"] {
        folder.color(&format!("{name}.png"), |_, _| [0, 0, 0, 255]);
    }
    let faces = "faces = [\"px.png\", \"nx.png\", \"py.png\", \"ny.png\", \"pz.png\", \"nz.png\"]";
    let decide = |sky: u8, material: &str| {
        folder.color("nz.png", |_, _| [sky, 0, 0, 255]);
        let (scene, plan) = planned(&folder, &format!("{SUN}[environment]\n{faces}\n"), material);
        agrees(only(&plan));
        let effect = only(&plan).effect(EffectId::Environment);
        (effect.state, effect.reason.clone(), scene, plan)
    };
    let shiny = "specular = [0.5, 0.5, 0.5]\n";
    let (kept, _, _, plan) = decide(200, &format!("{shiny}lighting_space = \"object\""));
    assert_eq!(kept, State::Kept);
    assert_eq!(only(&plan).features.space, LightingSpace::World);
    assert!(
        only(&plan).notes.iter().any(|note| note.contains("world space")),
        "{plan}"
    );
    for (sky, material, reason) in [
        (0, shiny.to_owned(), "black"),
        (200, String::new(), "specular is 0"),
        (200, format!("{shiny}reflection = \"none\""), "pinned to none"),
        (
            200,
            format!("{shiny}{NORMAL}shading = \"dot3_single_pass\""),
            "mirrors nothing",
        ),
        (
            200,
            format!("{shiny}{NORMAL}{HEIGHT}technique = \"parallax_slope_ao\""),
            "without a reflection",
        ),
    ] {
        let (kept, why, scene, plan) = decide(sky, &material);
        assert!(kept == State::Dropped && why.contains(reason), "{why}");
        // What everything-on would mirror is black, or is not mirrored at all.
        let full = draws_with(&scene, |material| {
            (plan.everything(material), plan.settings(material))
        })
        .remove(0);
        let dark = full.uniforms["material.specular"][..3] == [0.0; 3]
            || full.textures["environment_map"].levels[0].texels
                == bossage_scene::Texels::Rgba32Float(vec![[0.0, 0.0, 0.0, 1.0]; 6]);
        assert!(dark || sky == 0 || !full.features.environment, "{material}");
    }
}

#[test]
fn tangents_from_normals_are_pinned_in_both_forms() {
    let folder = folder();
    for (form, handedness) in [("hardened", 1.0), ("published", -1.0)] {
        let material = format!("{NORMAL}tangents = \"from_normal\"\nform = \"{form}\"");
        let (scene, plan) = planned(&folder, SUN, &material);
        let mesh = &scene.objects[0].mesh;
        assert!(
            mesh.tangents.iter().all(|tangent| tangent.w == handedness),
            "{form}"
        );
        assert_eq!(only(&plan).features.mirrored_uv, handedness < 0.0);
    }
}

#[test]
fn mips_of_normals_are_pinned() {
    let folder = folder();
    folder.normal("rough.png", |x, _| {
        if x % 2 == 0 {
            [255, 128, 128]
        } else {
            [0, 128, 128]
        }
    });
    let last = |mips: &str| {
        let material = format!("normal = {{ map = \"rough.png\", codec = \"unorm\", mips = \"{mips}\" }}");
        let (scene, plan) = planned(&folder, SUN, &material);
        let texture = draws(&scene, &plan)[0].textures["normal_map"].clone();
        texture.levels.last().expect("a last level").texels.clone()
    };
    // Averaged, opposite normals cancel to bytes near 128; normalised, what is left of them is stretched to full length.
    let bossage_scene::Texels::Rgba8Unorm(averaged) = last("averaged") else {
        panic!("bytes")
    };
    assert!(
        averaged[0][..3].iter().all(|byte| byte.abs_diff(128) <= 1),
        "{averaged:?}"
    );
    assert_ne!(last("normalised"), last("averaged"));
}
