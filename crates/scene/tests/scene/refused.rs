//! What a scene asks for and cannot have is named at its field: pins without their maps, alpha, codecs, cube maps, normalisers,
//! settings.

use bossage_scene::{Origin, Setting};

use crate::bad_input::folder;
use crate::fixture::{Folder, LAMP, SUN, one_plane};

/// One mistake in a scene of one plane: the field that is named, and what is said of it.
fn refused(folder: &Folder, scene: &str, field: &str, says: &str, helps: &str) {
    let error = folder.load(scene).expect_err(field);
    let found = error
        .problems()
        .iter()
        .find(|problem| problem.field == field)
        .unwrap_or_else(|| panic!("`{field}` is not named:\n{error}"));
    assert!(found.message.contains(says), "{says}:\n{error}");
    assert!(found.hint.contains(helps), "{helps}:\n{error}");
    let shown = error.to_string();
    assert!(
        shown.contains(&format!("scene.toml:{}:{}", found.line, found.column)) && shown.contains('^'),
        "{shown}"
    );
}

const NORMAL: &str = "normal = { map = \"normal.png\", codec = \"unorm\" }\n";
const HEIGHT: &str = "height = { map = \"height.png\", scale = 0.04, bias = -0.02 }\n";
const COLOR: &str = "albedo = { map = \"color.png\" }\n";

/// Pins that lack what they read, or meet what they do not go with.
#[test]
fn pins_that_cannot_be_honoured_are_named() {
    let folder = folder();
    let cases = [
        (
            format!("{NORMAL}technique = \"parallax_slope_ao\""),
            "technique",
            "needs `materials[0].height`",
            "add",
        ),
        (
            format!("{HEIGHT}{COLOR}technique = \"parallax_slope_ao_directed\""),
            "technique",
            "reads slopes from `materials[0].normal`",
            "bake",
        ),
        (
            format!("{COLOR}technique = \"displacement\""),
            "technique",
            "needs `materials[0].height`",
            "add",
        ),
        (
            format!("{HEIGHT}{NORMAL}form = \"published\"\ntechnique = \"parallax_slope_ao_directed\""),
            "technique",
            "no published form",
            "parallax_slope_ao",
        ),
        (
            format!("{HEIGHT}{NORMAL}technique = \"cone_map\""),
            "technique",
            "`cone_map` is not known",
            "parallax_offset",
        ),
        (
            format!("{HEIGHT}{NORMAL}technique = \"steep_parallax\"\nsteps = 4"),
            "steps",
            "technique `steep_parallax` has no steps",
            "it has `layers`",
        ),
        (
            format!("{HEIGHT}{NORMAL}layers = 4"),
            "layers",
            "technique `auto` has no layers",
            "remove it",
        ),
        (
            format!("{HEIGHT}{NORMAL}technique = \"relief\"\nlayers = 0"),
            "layers",
            "0 is out of range",
            "from 1 to 4096",
        ),
        (
            format!("{HEIGHT}{NORMAL}technique = \"exact\"\nform = \"published\""),
            "technique",
            "`exact` has one form",
            "set form to `hardened`",
        ),
        (
            format!("{HEIGHT}{NORMAL}technique = \"parallax_occlusion\"\nform = \"published\""),
            "technique",
            "`parallax_occlusion` has one form",
            "set form to `hardened`",
        ),
        (
            format!("{HEIGHT}{NORMAL}technique = \"relief\"\nshading = \"wrap_lambert\""),
            "technique",
            "`relief` does not go with shading `wrap_lambert`",
            "blinn_phong",
        ),
        (
            format!("{NORMAL}shadow = \"hard\""),
            "shadow",
            "there is no `materials[0].height`",
            "add",
        ),
        (
            format!("{HEIGHT}{NORMAL}technique = \"parallax_offset\"\nshadow = \"hard\""),
            "shadow",
            "`parallax_offset` finds no place",
            "`relief`",
        ),
        (
            format!("{HEIGHT}{NORMAL}shading = \"dot3_single_pass\"\nshadow = \"soft\""),
            "shadow",
            "do not go with shading `dot3_single_pass`",
            "blinn_phong",
        ),
        (
            format!("{HEIGHT}{NORMAL}light_samples = 4"),
            "light_samples",
            "there is no light_samples",
            "set shadow to",
        ),
        (
            format!("{HEIGHT}{NORMAL}shadow = \"hard\"\nlight_half_width = 0.5"),
            "light_half_width",
            "there is no light_half_width",
            "`soft`",
        ),
        (
            format!("{HEIGHT}{NORMAL}shadow = \"soft\"\nlight_half_width = 0.0"),
            "light_half_width",
            "0 is out of range",
            "from 0.001 to 1000",
        ),
        (
            format!("{NORMAL}pixel_depth = true"),
            "pixel_depth",
            "there is no `materials[0].height`",
            "add",
        ),
        (
            format!("{HEIGHT}{NORMAL}technique = \"none\"\npixel_depth = true"),
            "pixel_depth",
            "`none` finds no place",
            "`relief`",
        ),
        (
            format!("{HEIGHT}{NORMAL}shading = \"emboss\"\npixel_depth = true"),
            "pixel_depth",
            "does not go with shading `emboss`",
            "blinn_phong",
        ),
        (
            format!("{HEIGHT}{NORMAL}pixel_depth = 1"),
            "pixel_depth",
            "expected true or false, found an integer",
            "write true or false",
        ),
        (
            format!("{HEIGHT}{NORMAL}shadow = \"medium\""),
            "shadow",
            "`medium` is not known",
            "hard",
        ),
        (
            "shading = \"emboss\"".to_owned(),
            "shading",
            "needs `materials[0].height`",
            "blinn_phong",
        ),
        (
            format!("{HEIGHT}shading = \"dot3_single_pass\""),
            "shading",
            "needs `materials[0].normal`",
            "blinn_phong",
        ),
        (
            format!("{HEIGHT}{NORMAL}shading = \"dot3_two_pass\"\ntechnique = \"parallax_offset\""),
            "technique",
            "does not go with shading `dot3_two_pass`",
            "none",
        ),
        (
            format!("{HEIGHT}{NORMAL}shading = \"wrap_lambert\"\ntechnique = \"parallax_offset\""),
            "technique",
            "does not go with shading `wrap_lambert`",
            "parallax_slope_ao",
        ),
        (
            format!("{HEIGHT}shading = \"emboss\"\ntechnique = \"displacement\""),
            "technique",
            "emboss",
            "none",
        ),
        (
            format!("{NORMAL}shading = \"phong\""),
            "shading",
            "`phong` is not known",
            "blinn_phong",
        ),
        (
            "normaliser = { kind = \"cube\", size = 16 }".to_owned(),
            "normaliser",
            "`blinn_phong` has no normaliser",
            "dot3_single_pass",
        ),
    ];
    for (material, key, says, helps) in cases {
        refused(
            &folder,
            &one_plane(SUN, &material, ""),
            &format!("materials[0].{key}"),
            says,
            helps,
        );
    }
}

#[test]
fn alpha_that_a_shading_cannot_honour_is_named() {
    let folder = folder();
    for (shading, alpha, says) in [
        (
            "dot3_two_pass",
            "{ mode = \"mask\", cutoff = 0.5 }",
            "cannot cut out",
        ),
        ("wrap_lambert", "{ mode = \"mask\", cutoff = 0.5 }", "below 0.01"),
        ("wrap_lambert", "{ mode = \"opaque\" }", "below 0.01"),
    ] {
        let material = format!("{COLOR}{NORMAL}shading = \"{shading}\"\nalpha = {alpha}");
        refused(
            &folder,
            &one_plane(SUN, &material, ""),
            "materials[0].alpha",
            says,
            "alpha",
        );
    }
    for (shading, alpha) in [
        ("dot3_single_pass", "{ mode = \"mask\", cutoff = 0.5 }"),
        ("dot3_two_pass", "{ mode = \"opaque\" }"),
        ("wrap_lambert", "{ mode = \"mask\", cutoff = 0.01 }"),
    ] {
        let material = format!("{COLOR}{NORMAL}shading = \"{shading}\"\nalpha = {alpha}");
        folder.scene(&one_plane(SUN, &material, ""));
    }
}

#[test]
fn one_light_means_one_light() {
    let folder = folder();
    let dark = SUN.replacen("direction =", "intensity = 0.0\ndirection =", 1);
    for lights in [String::new(), dark.clone(), format!("{SUN}{LAMP}")] {
        for shading in ["wrap_lambert", "dot3_single_pass", "dot3_two_pass", "emboss"] {
            let material = format!("{HEIGHT}{NORMAL}shading = \"{shading}\"");
            refused(
                &folder,
                &one_plane(&lights, &material, ""),
                "materials[0].shading",
                "exactly one light",
                "one light",
            );
        }
    }
    folder.scene(&one_plane(
        &format!("{dark}{LAMP}"),
        &format!("{NORMAL}shading = \"dot3_single_pass\""),
        "",
    ));
    let tinted = one_plane(SUN, &format!("{NORMAL}shading = \"wrap_lambert\""), "").replacen(
        "schema = 1\n",
        "schema = 1\nambient = [0.1, 0.2, 0.3]\n",
        1,
    );
    refused(&folder, &tinted, "ambient", "one ambient value", "equal");
}

/// `[environment]` of the given faces in a scene whose material mirrors it.
fn surrounded(faces: &str, material: &str) -> String {
    one_plane(&format!("{SUN}[environment]\nfaces = [{faces}]\n"), material, "")
}

#[test]
fn cube_maps_are_checked_face_by_face() {
    let folder = folder();
    for name in ["px", "nx", "py", "ny", "pz", "nz"] {
        folder.color(&format!("{name}.png"), |_, _| [9, 9, 99, 255]);
    }
    let image = |width: u32, height: u32| {
        let texels = vec![[9, 9, 9, 255]; (width * height) as usize];
        bossage_assets::encode::color_png(&bossage_assets::ColorMap {
            width,
            height,
            texels,
        })
        .expect("a picture")
    };
    folder
        .write("small.png", &image(4, 4))
        .write("oblong.png", &image(8, 4));
    let six = |last: &str| format!("\"px.png\", \"nx.png\", \"py.png\", \"ny.png\", \"pz.png\", \"{last}\"");
    let mirror = "specular = [0.5, 0.5, 0.5]\nreflection = \"environment_bump\"";
    folder.scene(&surrounded(&six("nz.png"), mirror));
    let five = "\"px.png\", \"nx.png\", \"py.png\", \"ny.png\", \"pz.png\"";
    refused(
        &folder,
        &surrounded(five, mirror),
        "environment.faces",
        "6 faces, found 5",
        "six images",
    );
    refused(
        &folder,
        &surrounded(&six("small.png"), mirror),
        "environment.faces[5]",
        "4x4, the first is 8x8",
        "one size",
    );
    refused(
        &folder,
        &surrounded(&six("oblong.png"), mirror),
        "environment.faces[5]",
        "8x4",
        "square",
    );
    refused(
        &folder,
        &surrounded(&six("gone.png"), mirror),
        "environment.faces[5]",
        "gone.png",
        "images:",
    );
    let empty = one_plane(&format!("{SUN}[environment]\n"), mirror, "");
    refused(&folder, &empty, "environment.faces", "missing", "six images");
    // The pin itself.
    refused(
        &folder,
        &one_plane(SUN, mirror, ""),
        "materials[0].reflection",
        "no `[environment]`",
        "faces",
    );
    let dull = "reflection = \"environment_bump\"";
    refused(
        &folder,
        &surrounded(&six("nz.png"), dull),
        "materials[0].reflection",
        "`specular`, which is 0",
        "specular",
    );
    for other in [
        format!("{NORMAL}shading = \"dot3_single_pass\"\n"),
        format!("{NORMAL}{HEIGHT}technique = \"parallax_slope_ao\"\n"),
    ] {
        let material = format!("{other}{mirror}");
        refused(
            &folder,
            &surrounded(&six("nz.png"), &material),
            "materials[0].reflection",
            "does not go with",
            "auto",
        );
    }
}

#[test]
fn codecs_must_fit_the_image_and_the_bake() {
    let folder = folder();
    for codec in ["unorm", "biased", "snorm"] {
        let material = format!("normal = {{ map = \"height.png\", codec = \"{codec}\" }}");
        refused(
            &folder,
            &one_plane(SUN, &material, ""),
            "materials[0].normal.map",
            "needs 3 colour channels",
            "codec",
        );
    }
    for codec in ["two_channel", "octahedral"] {
        let material = format!("normal = {{ map = \"height.png\", codec = \"{codec}\" }}");
        refused(
            &folder,
            &one_plane(SUN, &material, ""),
            "materials[0].normal.map",
            "needs 2 colour channels",
            "codec",
        );
        let fits = format!("normal = {{ map = \"normal.png\", codec = \"{codec}\" }}");
        folder.scene(&one_plane(SUN, &fits, ""));
        let baked = format!("{HEIGHT}normal = {{ bake = \"central\", codec = \"{codec}\" }}");
        refused(
            &folder,
            &one_plane(SUN, &baked, ""),
            "materials[0].normal.codec",
            "cannot write",
            "unorm",
        );
    }
    let published =
        format!("{HEIGHT}form = \"published\"\nnormal = {{ bake = \"forward\", codec = \"unorm\" }}");
    refused(
        &folder,
        &one_plane(SUN, &published, ""),
        "materials[0].normal.bake",
        "writes `biased`",
        "hardened",
    );
    folder.scene(&one_plane(SUN, &published.replacen("unorm", "biased", 1), ""));
}

#[test]
fn normalisers_are_checked() {
    let folder = folder();
    let with = |normaliser: &str| {
        let material = format!("{NORMAL}shading = \"dot3_single_pass\"\nnormaliser = {normaliser}");
        one_plane(SUN, &material, "")
    };
    for (normaliser, key, says) in [
        ("{ kind = \"cube\" }", ".size", "missing"),
        ("{ kind = \"cube\", size = 0 }", ".size", "out of range"),
        ("{ kind = \"cube\", size = 5000 }", ".size", "out of range"),
        ("{ kind = \"cube\", size = 64, bits = 12 }", ".bits", "12 bits"),
        ("{ kind = \"arithmetic\", size = 64 }", ".size", "no size"),
        ("{ kind = \"lookup\" }", ".kind", "not known"),
    ] {
        refused(
            &folder,
            &with(normaliser),
            &format!("materials[0].normaliser{key}"),
            says,
            "",
        );
    }
    folder.scene(&with("{ kind = \"cube\", size = 16, bits = 16 }"));
}

/// A setting in place of the file's is checked as the file is.
#[test]
fn settings_are_checked_like_the_file() {
    let folder = folder();
    folder.write(
        "scene.toml",
        one_plane(SUN, &format!("{HEIGHT}{NORMAL}shininess = 8.0"), "").as_bytes(),
    );
    let with = |setting: &str| {
        let setting: Setting = setting.parse().expect("a setting");
        bossage_scene::load_with(&folder.path("scene.toml"), &[setting])
    };
    let scene = with("shading=dot3_two_pass").expect("a normal map is there");
    assert_eq!(scene.materials[0].shading, bossage_shaders::Shading::Dot3TwoPass);
    assert_eq!(
        with("shininess=16").expect("a number").materials[0].shininess,
        16.0
    );
    for (setting, field, says, at) in [
        ("shading=dot3", "materials[0].shading", "not known", 8..12),
        ("shinyness=16", "materials[0].shinyness", "unknown key", 0..9),
        ("shininess = -1", "materials[0].shininess", "out of range", 12..14),
        (
            "reflection=environment_bump",
            "materials[0].reflection",
            "no `[environment]`",
            11..27,
        ),
    ] {
        let error = with(setting).expect_err(setting);
        let problem = &error.problems()[0];
        assert!(
            problem.field == field && problem.message.contains(says),
            "{error}"
        );
        assert_eq!(problem.origin, Origin::Setting(setting.to_owned()), "{error}");
        assert_eq!((problem.span.clone(), problem.line), (at, 1), "{error}");
    }
}
