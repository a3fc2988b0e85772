//! Draws: complete for the planned shader and for the one with all effects, and right in their numbers.

use bossage_scene::{Draw, Pass, Settings, Texels, TextureShape, draws, draws_with, plan};
use bossage_shaders::{FeatureSet, LightingSpace, Shading, Stage};

use crate::fixture::{Folder, LAMP, SUN, example, one_plane};

/// Every member of the surface's uniform buffers and how many floats it takes.
const UNIFORMS: [(&str, usize); 25] = [
    ("light.radiance", 4),
    ("light.vector", 4),
    ("lights.count", 4),
    ("lights.items", 128),
    ("material.albedo", 4),
    ("material.alpha_cutoff", 1),
    ("material.ambient", 4),
    ("material.emboss_step", 1),
    ("material.light_half_width", 1),
    ("material.normal_decode", 2),
    ("material.occlusion", 1),
    ("material.relief", 4),
    ("material.search", 4),
    ("material.shininess", 1),
    ("material.specular", 4),
    ("material.tile_width", 1),
    ("object.clip_from_local", 16),
    ("object.cofactor", 16),
    ("object.displacement", 4),
    ("object.handedness_sign", 4),
    ("object.world_from_local", 16),
    ("view.backward", 4),
    ("view.clip_w", 4),
    ("view.clip_z", 4),
    ("view.eye", 4),
];

fn complete(draw: &Draw) {
    let sizes: Vec<(&str, usize)> = draw
        .uniforms
        .iter()
        .map(|(name, values)| (name.as_str(), values.len()))
        .collect();
    assert_eq!(sizes, UNIFORMS, "{}", draw.object);
    assert!(
        draw.uniforms.values().flatten().all(|value| value.is_finite()),
        "{}",
        draw.object
    );
    // `relief_map` is there where the technique that was chosen reads one.
    let names = draw.textures.keys().map(String::as_str);
    let names: Vec<&str> = names.filter(|name| *name != "relief_map").collect();
    assert_eq!(
        names,
        [
            "albedo_map",
            "environment_map",
            "height_map",
            "normal_map",
            "normalisation_map"
        ]
    );
    for (name, texture) in &draw.textures {
        let faces = match texture.shape {
            TextureShape::Plane => 1,
            TextureShape::Cube => 6,
        };
        let is_cube = ["environment_map", "normalisation_map"].contains(&name.as_str());
        assert_eq!(texture.shape == TextureShape::Cube, is_cube, "{name}");
        let last = texture.levels.last().expect("at least one level");
        // The map of a search has the levels that the search reads.
        let is_chain = !is_cube && name != "relief_map";
        assert!(!is_chain || (last.width, last.height) == (1, 1), "{name}");
        assert!(
            texture
                .levels
                .iter()
                .all(|level| level.texels.len() == faces * level.width as usize * level.height as usize),
            "{name}"
        );
    }
    assert_eq!(draw.mesh.tangents.len(), draw.mesh.positions.len());
}

#[test]
fn complete_for_the_plan_and_for_all_effects() {
    for name in [
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
        "shadows.toml",
    ] {
        let scene = example(name);
        let plan = plan(&scene);
        let planned = draws(&scene, &plan);
        let full = draws_with(&scene, |material| {
            (plan.everything(material), plan.settings(material))
        });
        assert_eq!(
            (planned.len(), full.len()),
            (scene.objects.len(), scene.objects.len())
        );
        for (planned, full) in planned.iter().zip(&full) {
            complete(planned);
            complete(full);
            // Both describe the same surface: only what is folded into the colour may differ.
            let differing: Vec<&str> = UNIFORMS
                .iter()
                .map(|(name, _)| *name)
                .filter(|name| planned.uniforms[*name] != full.uniforms[*name])
                .collect();
            assert!(differing.is_empty(), "{name} {}: {differing:?}", planned.object);
        }
    }
}

#[test]
fn two_passes_multiply_the_colour_in_and_one_does_not() {
    let scene = example("bumped_cube.toml");
    let plan = plan(&scene);
    let passes = |shading: Shading| {
        let mut draw = draws(&scene, &plan).remove(0);
        draw.features.shading = shading;
        draw.passes()
    };
    let first = Pass {
        fragment: Stage::Fragment,
        multiplies: false,
    };
    assert_eq!(passes(Shading::Dot3SinglePass), [first]);
    let second = Pass {
        fragment: Stage::SecondPass,
        multiplies: true,
    };
    assert_eq!(passes(Shading::Dot3TwoPass), [first, second]);
}

fn single(text: &str, folder: &Folder) -> Draw {
    let scene = folder.scene(text);
    let plan = plan(&scene);
    draws(&scene, &plan).remove(0)
}

#[test]
fn what_a_material_lacks_is_neutral() {
    let draw = single(&one_plane("", "", ""), &Folder::new());
    assert_eq!(draw.uniforms["material.relief"], [0.0, 0.0, 1.0, 0.0]);
    assert_eq!(draw.uniforms["material.alpha_cutoff"], [0.0]);
    assert_eq!(draw.uniforms["lights.count"], [0.0; 4]);
    assert_eq!(draw.uniforms["light.radiance"], [0.0; 4]);
    let texels = |name: &str| draw.textures[name].levels[0].texels.clone();
    assert_eq!(texels("albedo_map"), Texels::Rgba32Float(vec![[1.0; 4]]));
    assert_eq!(texels("height_map"), Texels::R32Float(vec![0.0]));
    // The neutral normal decodes to (0, 0, 1): c·scale + bias with c = byte/255. Two roundings of numbers near 1, and the
    // three constants' own: 5 · 2^-24 < 3e-7.
    let Texels::Rgba8Unorm(normal) = texels("normal_map") else {
        panic!("normal maps are bytes")
    };
    let [scale, bias] = draw.uniforms["material.normal_decode"][..] else {
        panic!("two numbers")
    };
    let decoded = normal[0].map(|byte| f32::from(byte) / 255.0 * scale + bias);
    for (got, want) in decoded.iter().zip([0.0, 0.0, 1.0]) {
        assert!((got - want).abs() < 3e-7, "{decoded:?}");
    }
}

#[test]
fn a_constant_map_is_folded_into_the_colour() {
    let folder = Folder::new();
    folder.color("c.png", |_, _| [255, 0, 188, 255]);
    let draw = single(
        &one_plane(SUN, "albedo = { map = \"c.png\", color = [0.5, 1.0, 0.25] }", ""),
        &folder,
    );
    let light = bossage_assets::linear_from_srgb_byte(188);
    // Products of an f32 and a power of two: exact.
    assert_eq!(draw.uniforms["material.albedo"], [0.5, 0.0, 0.25 * light, 1.0]);
    let scene = folder.scene(&one_plane(
        SUN,
        "albedo = { map = \"c.png\", color = [0.5, 1.0, 0.25] }",
        "",
    ));
    let full = draws_with(&scene, |_| (FeatureSet::default().all_effects(), Settings::new())).remove(0);
    assert_eq!(full.uniforms["material.albedo"], [0.5, 1.0, 0.25, 1.0]);
}

#[test]
fn constant_heights_displace_nothing_unless_pinned() {
    let folder = Folder::new();
    folder
        .height("h.png", |_, _| 1.0)
        .normal("n.png", |x, _| [x as u8 * 9, 128, 250]);
    let material = "normal = { map = \"n.png\", codec = \"unorm\" }\nheight = { map = \"h.png\", scale = 0.5, bias = -0.25 }";
    let relief = |extra: &str| {
        single(&one_plane(SUN, &format!("{material}\n{extra}"), ""), &folder).uniforms["material.relief"]
            .clone()
    };
    assert_eq!(relief(""), [0.0, 0.0, 1.0, 0.0]);
    assert_eq!(relief("technique = \"parallax_offset\""), [0.5, -0.25, 1.0, 0.0]);
}

#[test]
fn lights_come_in_lighting_space() {
    let folder = Folder::new();
    let draw = |space: &str, lights: &str| {
        let material = format!("lighting_space = \"{space}\"");
        single(
            &one_plane(lights, &material, "translate = [0.0, 0.0, 0.5]\nscale = 2.0"),
            &folder,
        )
    };
    // World: toward the light, opposite to its direction.
    assert_eq!(draw("world", SUN).uniforms["light.vector"], [-0.0, 0.6, 0.8, 0.0]);
    // Object: the eye is at (0, 0, 2) − (0, 0, 0.5), turned back by 50° about x and halved.
    let object = draw("object", SUN);
    let (sin, cos) = 50f64.to_radians().sin_cos();
    assert_eq!(object.features.space, LightingSpace::Object);
    let close = |got: &[f32], want: [f64; 3]| {
        // The f64 chain rounds some 20 times at magnitude 1; then one rounding to f32.
        got.iter()
            .zip(want)
            .all(|(got, want)| (f64::from(*got) - want).abs() <= want.abs() * 2f64.powi(-24) + 1e-14)
    };
    assert!(
        close(&object.uniforms["view.eye"][..3], [0.0, -0.75 * sin, 0.75 * cos]),
        "{:?}",
        object.uniforms["view.eye"]
    );
    let turned = [0.0, 0.6 * cos - 0.8 * sin, 0.6 * sin + 0.8 * cos];
    assert!(
        close(&object.uniforms["light.vector"][..3], turned),
        "{:?}",
        object.uniforms["light.vector"]
    );
    assert_eq!(draw("object", LAMP).uniforms["light.vector"][3], 1.0);
}

#[test]
fn several_lights_are_listed_and_black_ones_left_out() {
    let folder = Folder::new();
    let dark = "[[lights]]\nname = \"off\"\nkind = \"point\"\nposition = [9.0, 9.0, 9.0]\nintensity = 0.0\n";
    let draw = single(
        &one_plane(&format!("{SUN}{dark}{LAMP}intensity = 0.5\n"), "", ""),
        &folder,
    );
    assert_eq!(draw.uniforms["lights.count"][0], 2.0);
    let items = &draw.uniforms["lights.items"];
    assert_eq!(items[..8], [-0.0, 0.6, 0.8, 0.0, 1.0, 1.0, 1.0, 0.0]);
    assert_eq!(items[8..16], [0.5, 1.0, 1.5, 1.0, 0.5, 0.5, 0.5, 0.0]);
    assert!(items[16..].iter().all(|value| *value == 0.0));
}

#[test]
fn cofactor_and_handedness_of_a_mirrored_stretch() {
    let draw = single(&one_plane(SUN, "", "scale = [-2.0, 3.0, 1.0]"), &Folder::new());
    assert_eq!(draw.uniforms["object.handedness_sign"][0], -1.0);
    let (world, cofactor) = (
        &draw.uniforms["object.world_from_local"],
        &draw.uniforms["object.cofactor"],
    );
    let column = |m: &[f32], i: usize| glam::Vec3::from_slice(&m[4 * i..4 * i + 3]);
    // cof(M) e_z = M e_x × M e_y. Products of magnitude 6 of f32-rounded entries, three roundings each: 6 · 4 · 2^-24 < 2e-6.
    let expected = column(world, 0).cross(column(world, 1));
    assert!((column(cofactor, 2) - expected).abs().max_element() < 2e-6);
    assert_eq!(cofactor[3], 0.0);
}

#[test]
fn positions_reach_clip_space() {
    let draw = single(&one_plane(SUN, "", ""), &Folder::new());
    let clip = glam::Mat4::from_cols_slice(&draw.uniforms["object.clip_from_local"]);
    let centre = clip * glam::Vec4::W;
    // The origin, 2 units in front of the camera: x = y = 0, w = 2, depth far/(far − near) · (1 − near/2) within f32.
    assert_eq!((centre.x, centre.y, centre.w), (0.0, 0.0, 2.0));
    let depth = 50.0 / (50.0 - 0.1) * (1.0 - 0.1 / 2.0);
    assert!((centre.z / centre.w - depth).abs() < 4.0 * f32::EPSILON);
}
