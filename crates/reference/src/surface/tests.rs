use bossage_assets::{EdgeMode, HeightField};
use glam::{DVec2, DVec3, DVec4};

use super::{
    DepthRows, Fragment, Interpolants, Light, Material, Pass, Relief, SearchMaps, Shading, Shadow, Viewer,
    depth, shade,
};
use crate::Form;
use crate::cube::Seams;
use crate::dot3_single_pass::Normaliser;
use crate::environment_bump::Environment;
use crate::relief_ray::Layer;
use crate::relief_search::Search;
use crate::texture::Texture;

fn plain() -> Material {
    Material {
        albedo: DVec4::new(0.5, 0.25, 1.0, 1.0),
        albedo_map: None,
        normal_map: None,
        normal_decode: DVec2::new(2.0, -1.0),
        height_map: None,
        search_maps: None,
        relief: Relief::None,
        shadow: Shadow::None,
        depth: None,
        ambient: DVec3::splat(0.5),
        specular: None,
        shininess: 1.0,
        shading: Shading::BlinnPhong,
        reflection: None,
        alpha_cutoff: None,
        edge: EdgeMode::Wrap,
    }
}

const FACING: Interpolants = Interpolants {
    position: DVec3::ZERO,
    normal: DVec3::Z,
    tangent: DVec4::new(1.0, 0.0, 0.0, 1.0),
    uv: DVec2::new(0.25, 0.25),
};
const ABOVE: Viewer = Viewer {
    eye: DVec3::Z,
    backward: DVec3::Z,
};
const SUN: Light = Light::Directional {
    toward: DVec3::Z,
    radiance: DVec3::ONE,
};

#[test]
fn ambient_and_a_light_from_the_front() {
    let color = shade(&plain(), &[SUN], &ABOVE, &FACING, Form::Hardened);
    assert_eq!(color, Fragment::Color(DVec4::new(0.75, 0.375, 1.5, 1.0)));
}

#[test]
fn a_normal_map_turns_the_light_away() {
    // Texel (255, 128+, 128+) decodes to n = (1, ~0, ~0): nearly along T, so the light from N barely reaches it.
    let map = Texture {
        width: 1,
        height: 1,
        texels: vec![DVec4::new(1.0, 0.5, 0.5, 1.0)],
    };
    let material = Material {
        normal_map: Some(map),
        ..plain()
    };
    let color = shade(&material, &[SUN], &ABOVE, &FACING, Form::Hardened);
    assert_eq!(color, Fragment::Color(DVec4::new(0.25, 0.125, 0.5, 1.0)));
}

#[test]
fn alpha_cuts() {
    let material = Material {
        alpha_cutoff: Some(0.5),
        albedo: DVec4::new(1.0, 1.0, 1.0, 0.25),
        ..plain()
    };
    assert_eq!(
        shade(&material, &[], &ABOVE, &FACING, Form::Hardened),
        Fragment::Discarded
    );
}

#[test]
fn relief_moves_the_lookup() {
    let height_map = Texture::from_r32float(1, 1, &[1.0]);
    let albedo_map = Texture::from_rgba8(2, 1, &[0, 0, 0, 255, 255, 255, 255, 255]);
    let relief = Relief::OffsetLimited {
        scale: 0.5 * 2f64.sqrt(),
        bias: 0.0,
        v_factor: 1.0,
    };
    let material = Material {
        height_map: Some(height_map),
        albedo_map: Some(albedo_map),
        relief,
        ..plain()
    };
    // The eye at 45° along +u shifts by scale · V.x = 0.5: from the black texel's centre to the white one's.
    let Fragment::Color(color) = shade(
        &material,
        &[],
        &seen_from(DVec3::new(1.0, 0.0, 1.0)),
        &FACING,
        Form::Hardened,
    ) else {
        panic!("opaque material was cut");
    };
    // Weights next to 1 lose at most a few units of 2^-53.
    assert!((color.x - 0.25).abs() < 1e-15);
}

fn seen_from(eye: DVec3) -> Viewer {
    Viewer { eye, ..ABOVE }
}

fn color(material: &Material, viewer: &Viewer, light: Light, form: Form) -> DVec4 {
    match shade(material, &[light], viewer, &FACING, form) {
        Fragment::Color(color) => color,
        Fragment::Discarded => panic!("an opaque material was cut"),
    }
}

/// A normal that leans 0.6 along T.
fn leaning() -> Option<Texture> {
    Some(Texture {
        width: 1,
        height: 1,
        texels: vec![DVec4::new(0.8, 0.5, 0.9, 1.0)],
    })
}

#[test]
fn slope_relief_occludes_ambient_light() {
    // n = (0.6, 0, 0.8), V from above: Δ = 0.36·0.8·s·h = 0.288 · 0.01; ao = 1 − 40·Δ = 0.8848.
    let material = Material {
        normal_map: leaning(),
        height_map: Some(Texture::from_r32float(1, 1, &[1.0])),
        relief: Relief::Slope {
            directed: false,
            form: Form::Hardened,
            scale: 0.01,
            v_factor: 1.0,
            occlusion: 40.0,
        },
        ..plain()
    };
    let dark = Light::Directional {
        toward: DVec3::Z,
        radiance: DVec3::ZERO,
    };
    let lit = color(&material, &ABOVE, dark, Form::Hardened);
    assert!((lit.x - 0.25 * 0.8848).abs() < 1e-15, "{lit}");
    // The second article's shading: 0.75·(0.8848·0.5 + 0.5·0.8 + 0.5)·0.5.
    let wrapped = Material {
        shading: Shading::WrapLambert,
        ..material
    };
    let lit = color(&wrapped, &ABOVE, SUN, Form::Hardened);
    assert!(
        (lit.x - 0.75 * (0.4424 + 0.9) * 0.5).abs() < 1e-15 && lit.w == 1.0,
        "{lit}"
    );
    let published = color(&wrapped, &ABOVE, SUN, Form::Published);
    assert!((published.w - 0.75 * (0.4424 + 0.9)).abs() < 1e-15, "{published}");
}

#[test]
fn the_published_slope_takes_one_direction_for_all_pixels() {
    let material = Material {
        normal_map: leaning(),
        height_map: Some(Texture::from_r32float(1, 1, &[1.0])),
        relief: Relief::Slope {
            directed: false,
            form: Form::Published,
            scale: 0.01,
            v_factor: 1.0,
            occlusion: 40.0,
        },
        ..plain()
    };
    let from = |eye| color(&material, &seen_from(eye), SUN, Form::Published);
    assert_eq!(from(DVec3::Z), from(DVec3::new(3.0, 0.0, 1.0)));
}

#[test]
fn embossing_adds_the_fall_toward_the_light() {
    // Heights 0.75 here and 0.25 half a tile toward the light: 0.8 + 0.5, saturated.
    let falls = Material {
        shading: Shading::Emboss { step: 0.5 / 0.6 },
        height_map: Some(Texture::from_r32float(2, 1, &[0.75, 0.25])),
        ambient: DVec3::ZERO,
        ..plain()
    };
    let from = |toward| Light::Directional {
        toward,
        radiance: DVec3::ONE,
    };
    let toward = DVec3::new(0.6, 0.0, 0.8);
    assert_eq!(color(&falls, &ABOVE, from(toward), Form::Hardened).x, 0.5);
    // The other way round it rises: 0.8 − 0.5.
    let rises = Material {
        height_map: Some(Texture::from_r32float(2, 1, &[0.25, 0.75])),
        ..falls
    };
    assert!((color(&rises, &ABOVE, from(toward), Form::Hardened).x - 0.15).abs() < 1e-15);
    // From below there is no light, whatever the heights say.
    let below = color(&rises, &ABOVE, from(DVec3::new(-0.6, 0.0, -0.8)), Form::Hardened);
    assert_eq!(below.truncate(), DVec3::ZERO);
}

#[test]
fn dot3_passes_multiply_to_the_single_pass() {
    let of = |pass| Material {
        shading: Shading::Dot3 {
            normaliser: Normaliser::Guarded,
            pass,
        },
        normal_map: leaning(),
        ambient: DVec3::splat(0.125),
        ..plain()
    };
    let [single, first, second] =
        [Pass::Single, Pass::First, Pass::Second].map(|pass| color(&of(pass), &ABOVE, SUN, Form::Hardened));
    assert!((first.x - 0.925).abs() < 1e-15 && first.w == 1.0);
    assert_eq!(second, DVec4::new(0.5, 0.25, 1.0, 1.0));
    assert_eq!(single, first * second);
    // More light than the combiner holds is cut off before the colour, in one pass as in two.
    let bright = Light::Directional {
        toward: DVec3::Z,
        radiance: DVec3::splat(3.0),
    };
    assert_eq!(color(&of(Pass::Single), &ABOVE, bright, Form::Hardened), second);
}

#[test]
fn the_environment_is_mirrored_in_the_perturbed_normal() {
    let faces = (0..6).map(|face| DVec4::splat(f64::from(face)));
    let environment = Environment {
        size: 1,
        texels: faces.collect(),
        seams: Seams::Face,
    };
    let material = Material {
        reflection: Some((environment, DVec3::new(0.5, 1.0, 0.0))),
        ambient: DVec3::ZERO,
        ..plain()
    };
    let dark = Light::Directional {
        toward: DVec3::Z,
        radiance: DVec3::ZERO,
    };
    // Straight above a level surface: +Z, face 4.
    let seen = color(&material, &ABOVE, dark, Form::Hardened);
    assert_eq!(seen, DVec4::new(2.0, 4.0, 0.0, 1.0));
    // N = (0.6, 0, 0.8): R = 2·0.8·N − z = (0.96, 0, 0.28): +X, face 0.
    let bent = Material {
        normal_map: leaning(),
        ..material
    };
    assert_eq!(color(&bent, &ABOVE, dark, Form::Hardened).truncate(), DVec3::ZERO);
}

/// A wall of height 1 at column 32 of 64 over ground at ¼, seen straight from above, so that each place is met where it is.
fn walled(shadow: Shadow) -> Material {
    Material {
        search_maps: Some(SearchMaps {
            heights: HeightField::from_fn(64, 4, |x, _| if x == 32 { 1.0 } else { 0.25 }),
            cones: None,
            normal_z: None,
        }),
        relief: Relief::Search {
            search: Search::Relief {
                layers: 64,
                refinements: 8,
            },
            layer: Layer::below(0.2),
        },
        shadow,
        ..plain()
    }
}

/// Red of the wall's ground so far before the crest, under a light toward +x.
fn before_the_wall(material: &Material, distance: f64, toward: DVec3) -> f64 {
    let at = Interpolants {
        uv: DVec2::new(32.5 / 64.0 - distance, 0.5),
        ..FACING
    };
    let light = Light::Directional {
        toward: toward.normalize(),
        radiance: DVec3::ONE,
    };
    match shade(material, &[light], &ABOVE, &at, Form::Hardened) {
        Fragment::Color(color) => color.x,
        Fragment::Discarded => panic!("an opaque material was cut"),
    }
}

/// At 45° over a layer of 0.2 the shadow of ¾ of it is 0.15 long.
#[test]
fn a_wall_keeps_the_light_off_the_ground_before_it() {
    let low = DVec3::new(1.0, 0.0, 1.0);
    let [plain, hard] = [Shadow::None, Shadow::Hard { samples: 64 }].map(walled);
    let lit = before_the_wall(&plain, 0.05, low);
    assert_eq!(lit, before_the_wall(&hard, 0.2, low));
    // Ambient light alone.
    assert_eq!(before_the_wall(&hard, 0.05, low), 0.25);
    // Where the wall's crest is as high as the light, half of a wide light is seen; a sample finds the crest to a 13th of its height.
    let soft = walled(Shadow::Soft {
        samples: 64,
        half_width: 0.5,
    });
    let share = (before_the_wall(&soft, 0.15, low) - 0.25) / (lit - 0.25);
    assert!((0.45..0.65).contains(&share), "{share}");
    assert_eq!(before_the_wall(&soft, 0.05, low), 0.25);
    assert_eq!(before_the_wall(&soft, 0.3, low), lit);
}

/// Without shadows a slope that faces a light below the polygon is lit.
#[test]
fn a_light_below_the_horizon_lights_no_relief() {
    let tilted = Texture {
        width: 1,
        height: 1,
        texels: vec![DVec4::new(1.0, 0.5, 0.5, 1.0)],
    };
    let below = DVec3::new(1.0, 0.0, -0.1);
    let [plain, hard] = [Shadow::None, Shadow::Hard { samples: 4 }].map(|shadow| Material {
        normal_map: Some(tilted.clone()),
        ..walled(shadow)
    });
    assert!(before_the_wall(&plain, 0.2, below) > 0.7);
    assert_eq!(before_the_wall(&hard, 0.2, below), 0.25);
}

/// Seen straight from above, from 1 over the polygon: the ground lies ¾ of a layer of 0.2 tiles of width 2 below it.
#[test]
fn the_depth_is_that_of_the_ground_and_not_of_the_polygon() {
    // clip.w is the distance from the eye's plane, and clip.z is that less a tenth.
    let rows = DepthRows {
        clip_z: DVec4::new(0.0, 0.0, -1.0, ABOVE.eye.z - 0.1),
        clip_w: DVec4::new(0.0, 0.0, -1.0, ABOVE.eye.z),
        tile_width: 2.0,
    };
    let deep = Material {
        depth: Some(rows),
        ..walled(Shadow::None)
    };
    let at = Interpolants {
        uv: DVec2::new(0.25, 0.5),
        ..FACING
    };
    let seen = |material: &Material| depth(material, &ABOVE, &at, Form::Hardened);
    let below = -0.75 * 0.2 * 2.0;
    let expected = (0.9 - below) / (1.0 - below);
    let got = seen(&deep).expect("a search finds a place");
    // The search finds t to a 64th of a layer, halved eight times; depth changes by less than 0.2 · 2 · 0.1 of that.
    assert!((got - expected).abs() < 0.04 / 64.0 / 256.0, "{got} {expected}");
    assert_eq!(seen(&walled(Shadow::None)), None);
    let flat = Material {
        relief: Relief::None,
        ..deep
    };
    assert_eq!(seen(&flat), None);
}
