//! Single decisions: each effect dropped when the content does not call for it, and kept again when one texel, one light or
//! one number changes.

use bossage_scene::{EffectId, Fact, MaterialPlan, Plan, State, plan};

use crate::fixture::{CAMERA, Folder, LAMP, SUN, one_plane, only};

fn state(material: &MaterialPlan, id: EffectId) -> State {
    material.effect(id).state
}

fn number(material: &MaterialPlan, id: EffectId, fact: &str) -> f64 {
    match &material.effect(id).evidence[fact] {
        Fact::Number(number) => *number,
        other => panic!("{fact} is {other:?}"),
    }
}

/// What one effect becomes for a plane with the given lights, material keys and object keys.
fn decided(folder: &Folder, lights: &str, material: &str, object: &str, id: EffectId) -> State {
    state(
        only(&plan(&folder.scene(&one_plane(lights, material, object)))),
        id,
    )
}

const HEIGHT: &str = "normal = { map = \"n.png\", codec = \"unorm\" }\nheight = { map = \"h.png\", scale = 0.04, bias = -0.02 }";

fn bumpy(folder: &Folder) {
    folder.normal("n.png", |x, y| [100 + 5 * x as u8, 100 + 5 * y as u8, 240]);
    folder.height("h.png", |x, y| f32::from((x ^ y) & 1 == 1));
}

#[test]
fn a_flat_normal_map_is_dropped_and_one_texel_brings_it_back() {
    let folder = Folder::new();
    let kept = |codec| {
        let material = format!("normal = {{ map = \"n.png\", codec = \"{codec}\" }}");
        decided(&folder, SUN, &material, "", EffectId::NormalMap) == State::Kept
    };
    folder.normal("n.png", |_, _| [128, 128, 255]);
    assert!(!kept("unorm") && !kept("biased"));
    folder.normal("n.png", |_, _| [127, 127, 255]);
    // 127 is half a step from 0 for unorm, and a whole step for biased, whose 0 is exactly 128.
    assert!(!kept("unorm") && kept("biased"));
    folder.normal("n.png", |x, y| {
        if (x, y) == (5, 3) {
            [128, 131, 255]
        } else {
            [128, 128, 255]
        }
    });
    assert!(kept("unorm") && kept("biased"));
}

#[test]
fn a_constant_tilted_normal_is_kept() {
    let folder = Folder::new();
    folder.normal("n.png", |_, _| [160, 128, 250]);
    let scene = folder.scene(&one_plane(
        SUN,
        "normal = { map = \"n.png\", codec = \"unorm\" }",
        "",
    ));
    let plan = plan(&scene);
    let effect = only(&plan).effect(EffectId::NormalMap);
    assert_eq!(effect.state, State::Kept);
    assert!(effect.reason.contains("tilted"), "{}", effect.reason);
    // (2·160 − 255)/255 = 65/255, exactly as f64 rounds it.
    assert_eq!(
        number(only(&plan), EffectId::NormalMap, "max_off_flat"),
        65.0 / 255.0
    );
}

#[test]
fn no_light_needs_neither_normals_nor_highlight() {
    let folder = Folder::new();
    bumpy(&folder);
    let material = "specular = [1.0, 1.0, 1.0]\nnormal = { map = \"n.png\", codec = \"unorm\" }";
    for (lights, expected) in [
        (String::new(), State::Dropped),
        (format!("{SUN}intensity = 0.0\n"), State::Dropped),
        (format!("{SUN}color = [0.0, 0.0, 0.0]\n"), State::Dropped),
        (format!("{SUN}intensity = 0.001\n"), State::Kept),
    ] {
        for id in [EffectId::Lighting, EffectId::Specular, EffectId::NormalMap] {
            assert_eq!(
                decided(&folder, &lights, material, "", id),
                expected,
                "{id:?} {lights}"
            );
        }
    }
}

#[test]
fn lights_decide_on_vector_and_loop() {
    let folder = Folder::new();
    let states = |lights: &str| {
        let of = |id| decided(&folder, lights, "", "", id) == State::Kept;
        (of(EffectId::LightVector), of(EffectId::LightLoop))
    };
    assert_eq!(states(SUN), (false, false));
    assert_eq!(states(LAMP), (true, false));
    assert_eq!(states(&format!("{SUN}{LAMP}")), (true, true));
    // A black second light is no light.
    assert_eq!(states(&format!("{SUN}{LAMP}intensity = 0.0\n")), (false, false));
}

#[test]
fn specular_zero_needs_no_half_vector() {
    let folder = Folder::new();
    let of = |material: &str| decided(&folder, SUN, material, "", EffectId::Specular);
    assert_eq!(of("specular = [0.0, 0.0, 0.0]"), State::Dropped);
    assert_eq!(of("specular = [0.0, 0.0, 0.001]"), State::Kept);
    // What f32 rounds to 0 is 0 in the shader.
    assert_eq!(of("specular = [1e-46, 0.0, 0.0]"), State::Dropped);
}

#[test]
fn opaque_texels_need_no_discard_and_one_hole_does() {
    let folder = Folder::new();
    let material = "albedo = { map = \"c.png\" }\nalpha = { mode = \"mask\", cutoff = 0.5 }";
    let of = || decided(&folder, SUN, material, "", EffectId::AlphaDiscard);
    folder.color("c.png", |x, y| [x as u8, y as u8, 0, 200]);
    assert_eq!(of(), State::Dropped);
    folder.color("c.png", |x, y| {
        [x as u8, y as u8, 0, if (x, y) == (7, 7) { 10 } else { 200 }]
    });
    assert_eq!(of(), State::Kept);
    // 128/255 = 0.50196 lies above 0.501 by less than half a step: filtering might fall below.
    folder.color("c.png", |x, y| [x as u8, y as u8, 0, 128]);
    let close = material.replace("0.5 }", "0.501 }");
    assert_eq!(
        decided(&folder, SUN, &close, "", EffectId::AlphaDiscard),
        State::Kept
    );
    let opaque = material.replace("mode = \"mask\", cutoff = 0.5", "mode = \"opaque\"");
    assert_eq!(
        decided(&folder, SUN, &opaque, "", EffectId::AlphaDiscard),
        State::Dropped
    );
}

#[test]
fn what_is_cut_out_everywhere_is_not_drawn() {
    let folder = Folder::new();
    let material = "albedo = { color = [1.0, 1.0, 1.0, 0.25] }\nalpha = { mode = \"mask\", cutoff = 0.5 }";
    let scene = folder.scene(&one_plane(SUN, material, ""));
    let planned = plan(&scene);
    assert!(!only(&planned).drawn);
    assert!(bossage_scene::draws(&scene, &planned).is_empty());
    let visible = folder.scene(&one_plane(SUN, &material.replace("0.25", "0.5"), ""));
    assert!(only(&plan(&visible)).drawn);
}

#[test]
fn a_constant_albedo_map_becomes_a_colour() {
    let folder = Folder::new();
    let of = || {
        decided(
            &folder,
            SUN,
            "albedo = { map = \"c.png\" }",
            "",
            EffectId::AlbedoMap,
        )
    };
    folder.color("c.png", |_, _| [10, 20, 30, 255]);
    assert_eq!(of(), State::Dropped);
    folder.color("c.png", |x, y| {
        [10, 20, if (x, y) == (0, 7) { 31 } else { 30 }, 255]
    });
    assert_eq!(of(), State::Kept);
    // Alpha is part of what the shader writes.
    folder.color("c.png", |x, y| {
        [10, 20, 30, if (x, y) == (4, 4) { 254 } else { 255 }]
    });
    assert_eq!(of(), State::Kept);
}

#[test]
fn constant_heights_are_no_relief_and_one_texel_is() {
    let folder = Folder::new();
    bumpy(&folder);
    let of = || decided(&folder, SUN, HEIGHT, "", EffectId::Relief);
    for level in [0.0, 0.5, 1.0] {
        folder.height("h.png", |_, _| level);
        assert_eq!(of(), State::Dropped, "{level}");
    }
    folder.height("h.png", |x, y| if (x, y) == (2, 6) { 1.0 } else { 0.0 });
    assert_eq!(of(), State::Kept);
}

#[test]
fn relief_below_a_pixel_is_dropped() {
    let folder = Folder::new();
    bumpy(&folder);
    let at = |distance: f64, budget: f64| {
        let text = one_plane(SUN, HEIGHT, "");
        let camera = CAMERA.replace("2.0]", &format!("{distance}]"));
        folder.scene(&text.replace(CAMERA, &format!("{camera}[budget]\nerror_px = {budget}\n")))
    };
    let (near, far) = (plan(&at(2.0, 0.5)), plan(&at(20.0, 0.5)));
    assert_eq!(state(only(&near), EffectId::Relief), State::Kept);
    assert_eq!(state(only(&far), EffectId::Relief), State::Dropped);
    assert_eq!(only(&far).technique, "none");
    let px = |plan: &Plan| number(only(plan), EffectId::Relief, "displacement_px_max");
    // Elevation 0.02 of a 2-unit tile is 0.04 units. The plane's nearest edge is at depth d = 20 − sin 50° = 19.234; the bound
    // is focal · stretch · 0.04 / (d − 0.04) with focal = 50 / tan 30° = 86.603 and stretch = sqrt(1 + (75² + 50²) / focal²)
    // = 1.4434: 0.2605. The vertices are f32, 2^-24 relative: 1e-6 covers the few operations on them.
    let depth = 20.0 - 50f64.to_radians().sin();
    let focal = 50.0 / 30f64.to_radians().tan();
    let stretch = (1.0 + (75f64 * 75.0 + 50.0 * 50.0) / (focal * focal)).sqrt();
    let expected = focal * stretch * 0.04 / (depth - 0.04);
    assert!((px(&far) - expected).abs() < 1e-6, "{} {expected}", px(&far));
    // A finer budget does not bring it back, and the plan says that it is not met.
    let fine = plan(&at(20.0, 1e-3));
    let effect = only(&fine).effect(EffectId::Relief);
    assert_eq!(effect.state, State::Dropped);
    assert!(effect.reason.contains("not met"), "{}", effect.reason);
    assert!(!only(&far).effect(EffectId::Relief).reason.contains("not met"));
    // The sampled error is below the bound.
    let sampled = only(&far).predicted.error_px_p99.expect("rays are sampled");
    assert!(sampled > 0.0 && sampled <= px(&far), "{sampled}");
}

#[test]
fn a_pin_overrides_and_says_so() {
    let folder = Folder::new();
    bumpy(&folder);
    folder.height("h.png", |_, _| 0.25);
    for (pin, state, technique) in [
        ("parallax_offset", State::Kept, "parallax_offset"),
        ("none", State::Dropped, "none"),
        ("auto", State::Dropped, "none"),
    ] {
        let scene = folder.scene(&one_plane(SUN, &format!("{HEIGHT}\ntechnique = \"{pin}\""), ""));
        let plan = plan(&scene);
        let effect = only(&plan).effect(EffectId::Relief);
        assert_eq!((effect.state, only(&plan).technique), (state, technique), "{pin}");
        assert_eq!(
            effect.reason.contains("pinned"),
            pin != "auto",
            "{}",
            effect.reason
        );
        assert_eq!(
            only(&plan).technique_by,
            if pin == "auto" { "auto" } else { "pinned" }
        );
    }
}

#[test]
fn relief_without_a_map_to_displace_is_dropped() {
    let folder = Folder::new();
    bumpy(&folder);
    let height_only = "height = { map = \"h.png\", scale = 0.04, bias = -0.02 }";
    assert_eq!(
        decided(&folder, SUN, height_only, "", EffectId::Relief),
        State::Dropped
    );
    // The normal map is dropped without light, and the relief with it.
    assert_eq!(decided(&folder, "", HEIGHT, "", EffectId::Relief), State::Dropped);
}

#[test]
fn exact_offsets_are_predicted_exactly() {
    // A slope along v alone under a camera that looks straight down: at each pixel the ray meets a plane, and the error of
    // no technique is 0. Constant heights with a pin make the truth a plane at z = scale·h + bias, which parallax_offset
    // meets exactly: what is left is f64 rounding and the f32 of the mesh, far below 1e-6 texels of 8.
    let folder = Folder::new();
    bumpy(&folder);
    folder.height("h.png", |_, _| 0.25);
    let predicted = |pin: &str| {
        let scene = folder.scene(&one_plane(SUN, &format!("{HEIGHT}\ntechnique = \"{pin}\""), ""));
        only(&plan(&scene))
            .predicted
            .error_texels_p99
            .expect("it is in view")
    };
    assert!(
        predicted("parallax_offset") < 1e-6,
        "{}",
        predicted("parallax_offset")
    );
    // The limited form is off by z·tan(angle)·(1 − cos(angle)), and no relief by z·tan(angle): both visible.
    assert!(predicted("parallax_offset_limited") > 0.01);
    assert!(predicted("none") > predicted("parallax_offset_limited"));
}

#[test]
fn transforms_decide_on_the_cofactor_matrix() {
    let folder = Folder::new();
    bumpy(&folder);
    let mapped = "normal = { map = \"n.png\", codec = \"unorm\" }";
    let of = |material: &str, object: &str| {
        decided(&folder, SUN, material, object, EffectId::CofactorMatrix) == State::Kept
    };
    let cases = [
        ("", false, false),
        ("translate = [1.0, 0.0, 0.0]", false, false),
        ("scale = 2.0", false, true),
        ("scale = [-1.0, 1.0, 1.0]", false, true),
        ("scale = [-1.0, -1.0, 1.0]", false, false),
        ("scale = [1.0, 1.0, 1.000001]", true, true),
    ];
    for (object, plain, with_frame) in cases {
        assert_eq!(of("", object), plain, "no tangent frame: {object}");
        assert_eq!(of(mapped, object), with_frame, "tangent frame: {object}");
    }
    // Object space and the published formula have no use for it.
    assert!(!of(
        &format!("{mapped}\nlighting_space = \"object\""),
        "scale = 2.0"
    ));
    assert!(!of(
        &format!("{mapped}\nform = \"published\""),
        "scale = [1.0, 3.0, 1.0]"
    ));
}

#[test]
fn mirrored_uvs_and_mirroring_transforms_need_the_handedness() {
    let folder = Folder::new();
    bumpy(&folder);
    let mapped = "normal = { map = \"n.png\", codec = \"unorm\" }";
    let of = |material: &str, object: &str| {
        decided(&folder, SUN, material, object, EffectId::Handedness) == State::Kept
    };
    assert!(!of(mapped, ""));
    assert!(of(mapped, "uv_repeat = [-1.0, 1.0]"));
    assert!(!of(mapped, "uv_repeat = [-1.0, -1.0]"));
    assert!(of(mapped, "scale = [1.0, 1.0, -1.0]"));
    assert!(!of("", "uv_repeat = [-1.0, 1.0]"), "without a tangent frame");
}

#[test]
fn several_lights_are_lit_in_world_space() {
    let folder = Folder::new();
    bumpy(&folder);
    let material = "normal = { map = \"n.png\", codec = \"unorm\" }\nlighting_space = \"object\"";
    let planned = |lights: &str| plan(&folder.scene(&one_plane(lights, material, "scale = 2.0")));
    let (one, two) = (planned(SUN), planned(&format!("{SUN}{LAMP}")));
    assert_eq!(only(&one).features.space, bossage_shaders::LightingSpace::Object);
    assert_eq!(only(&two).features.space, bossage_shaders::LightingSpace::World);
    assert_eq!((only(&one).notes.len(), only(&two).notes.len()), (0, 1));
    assert_eq!(state(only(&two), EffectId::CofactorMatrix), State::Kept);
}

#[test]
fn equal_needs_share_a_permutation_and_a_difference_parts_them() {
    let folder = Folder::new();
    let two = |second: &str| {
        let materials = format!(
            "[[materials]]\nname = \"m\"\nspecular = [0.1, 0.1, 0.1]\n[[materials]]\nname = \"k\"\n{second}\n"
        );
        let object =
            |name: &str| format!("[[objects]]\nname = \"{name}\"\nshape = \"cube\"\nmaterial = \"{name}\"\n");
        plan(&folder.scene(&format!("{CAMERA}{SUN}{materials}{}{}", object("m"), object("k"))))
    };
    let shared = two("specular = [0.9, 0.0, 0.0]\nshininess = 5.0\nform = \"hardened\"");
    assert_eq!(shared.permutations.len(), 1);
    assert_eq!(shared.permutations[0].materials, ["m", "k"]);
    assert_eq!(two("specular = [0.0, 0.0, 0.0]").permutations.len(), 2);
}

/// What the decisions say and what the permutation holds are one.
#[test]
fn decisions_agree_with_the_canonical_features() {
    use bossage_shaders::{Albedo, Alpha, Lights, NormalSource, Relief, Transform};
    let folder = Folder::new();
    bumpy(&folder);
    folder.color("c.png", |x, y| {
        [x as u8 * 9, y as u8, 3, if x == y { 0 } else { 255 }]
    });
    let lights = ["", SUN, LAMP, &format!("{SUN}{LAMP}")].map(str::to_owned);
    let parts = [
        "albedo = { map = \"c.png\" }",
        "alpha = { mode = \"mask\", cutoff = 0.5 }",
        "normal = { map = \"n.png\", codec = \"unorm\" }",
        "height = { map = \"h.png\", scale = 0.04, bias = -0.02 }",
        "specular = [0.5, 0.5, 0.5]",
        "form = \"published\"",
    ];
    let objects = ["", "scale = [1.0, 2.0, 1.0]", "uv_repeat = [-1.0, 1.0]"];
    for lights in &lights {
        for mask in 0..1u32 << parts.len() {
            let chosen: Vec<&str> = (0..parts.len())
                .filter(|i| mask >> i & 1 == 1)
                .map(|i| parts[i])
                .collect();
            for object in objects {
                let plan = plan(&folder.scene(&one_plane(lights, &chosen.join("\n"), object)));
                let material = only(&plan);
                let (features, kept) = (material.features, |id| state(material, id) == State::Kept);
                let label = format!("{lights}{chosen:?}{object}");
                assert_eq!(features, features.canonical(), "{label}");
                assert_eq!(
                    kept(EffectId::Lighting),
                    features.lights != Lights::None,
                    "{label}"
                );
                assert_eq!(
                    kept(EffectId::LightLoop),
                    features.lights == Lights::Many,
                    "{label}"
                );
                assert_eq!(kept(EffectId::Specular), features.specular, "{label}");
                assert_eq!(
                    kept(EffectId::NormalMap),
                    features.normal == NormalSource::Map,
                    "{label}"
                );
                assert_eq!(
                    kept(EffectId::AlbedoMap),
                    features.albedo == Albedo::Map,
                    "{label}"
                );
                assert_eq!(
                    kept(EffectId::AlphaDiscard),
                    features.alpha == Alpha::Mask,
                    "{label}"
                );
                assert_eq!(kept(EffectId::Relief), features.relief != Relief::None, "{label}");
                assert_eq!(
                    kept(EffectId::CofactorMatrix),
                    features.transform == Transform::General,
                    "{label}"
                );
                assert_eq!(kept(EffectId::Handedness), features.has_handedness(), "{label}");
                assert_eq!(material.permutation, features.name(), "{label}");
            }
        }
    }
}
