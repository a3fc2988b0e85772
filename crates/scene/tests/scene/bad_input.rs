//! Every mistake is shown with file, line, column, caret and field, and what to do about it; all of them at once.

mod table;

use table::{CASES, Case, GOOD};

use crate::fixture::Folder;

pub(crate) fn folder() -> Folder {
    let folder = Folder::new();
    folder.color("color.png", |x, y| {
        [x as u8 * 30, y as u8 * 30, 9, if x == y { 0 } else { 255 }]
    });
    folder.normal("normal.png", |x, _| [100 + x as u8, 128, 250]);
    folder.height("height.png", |x, y| (x + y) as f32 / 14.0);
    folder.write("empty.png", b"");
    let whole = std::fs::read(folder.path("color.png")).expect("just written");
    folder.write("cut.png", &whole[..whole.len() / 2]);
    folder
}

#[test]
fn the_good_scene_is_good() {
    let scene = folder().scene(GOOD);
    assert_eq!(
        (scene.materials.len(), scene.objects.len(), scene.lights.len()),
        (1, 1, 1)
    );
}

#[test]
fn each_mistake_is_shown_where_it_is() {
    let folder = folder();
    for case in CASES {
        assert!(
            GOOD.contains(case.from),
            "the case no longer fits the good scene: {}",
            case.from
        );
        let text = GOOD.replacen(case.from, case.to, 1);
        check(&folder, &text, case);
    }
}

fn check(folder: &Folder, text: &str, case: &Case) {
    let error = folder.load(text).expect_err(case.to);
    let shown = error.to_string();
    let problems = error.problems();
    assert!(
        problems.iter().any(|problem| problem.field == case.field),
        "{}:\n{shown}",
        case.field
    );
    let problem = problems
        .iter()
        .find(|problem| problem.field == case.field)
        .expect("asserted above");
    assert!(problem.message.contains(case.says), "{}\n{shown}", case.says);
    assert!(problem.hint.contains(case.helps), "{}\n{shown}", case.helps);

    let at = text
        .find(case.at)
        .unwrap_or_else(|| panic!("`{}` is not in the broken scene", case.at));
    let line = text[..at].matches('\n').count() + 1;
    let column = at - text[..at].rfind('\n').map_or(0, |newline| newline + 1) + 1;
    assert_eq!((problem.line, problem.column), (line, column), "{shown}");
    assert!(shown.contains(&format!("scene.toml:{line}:{column}")), "{shown}");
    assert!(
        shown.contains(&format!("`{}`", case.field)) && shown.contains("help: "),
        "{shown}"
    );
    let source = text.lines().nth(line - 1).expect("the line was counted");
    assert!(shown.contains(source.trim()) && shown.contains('^'), "{shown}");
}

/// The whole text of one report, as a person sees it.
#[test]
fn a_report_reads_well() {
    let text = GOOD.replacen("near = 0.1", "near = -0.1", 1);
    let folder = folder();
    let shown = folder.load(&text).expect_err("near is negative").to_string();
    let path = folder.path("scene.toml").display().to_string();
    let expected = "error: `camera.near`: -0.1 is out of range
  --> PATH:9:8
  |
9 | near = -0.1
  |        ^^^^
  |
  = help: must be greater than 0

PATH: 1 problem";
    assert_eq!(shown.replace(&path, "PATH"), expected);
}

#[test]
fn all_mistakes_are_reported_in_file_order() {
    let text = GOOD
        .replacen("fov_deg = 45.0", "fov_deg = -1", 1)
        .replacen("color.png", "missing.png", 1)
        .replacen("\"plane\"", "\"disc\"", 1)
        .replacen("intensity", "intenisty", 1);
    let error = folder().load(&text).expect_err("four mistakes");
    let fields: Vec<&str> = error
        .problems()
        .iter()
        .map(|problem| problem.field.as_str())
        .collect();
    assert_eq!(
        fields,
        [
            "camera.fov_deg",
            "lights[0].intenisty",
            "materials[0].albedo.map",
            "objects[0].shape"
        ]
    );
}

#[test]
fn syntax_mistakes_are_shown_with_their_place() {
    let text = GOOD.replacen("near = 0.1", "near = = 0.1", 1);
    let error = folder().load(&text).expect_err("not TOML");
    let problem = &error.problems()[0];
    assert_eq!(problem.line, 9, "{error}");
    assert!(problem.message.starts_with("not TOML"), "{error}");
}

#[test]
fn names_are_unique() {
    let text = format!("{GOOD}\n[[objects]]\nname = \"wall\"\nshape = \"cube\"\nmaterial = \"bricks\"\n");
    let error = folder().load(&text).expect_err("two walls");
    let problem = &error.problems()[0];
    assert_eq!(
        (problem.field.as_str(), error.problems().len()),
        ("objects[1].name", 1),
        "{error}"
    );
    assert!(
        problem.message.contains("`wall` is already that of `objects[0]`"),
        "{error}"
    );
}

#[test]
fn a_pin_names_the_map_it_lacks() {
    let pinned = GOOD.replacen("\"auto\"", "\"parallax_offset\"", 1);
    assert!(folder().load(&pinned).is_ok());
    let without_height = pinned.replacen(
        "height = { map = \"height.png\", scale = 0.04, bias = -0.02 }\n",
        "",
        1,
    );
    let error = folder().load(&without_height).expect_err("no height map");
    assert_eq!(error.problems()[0].field, "materials[0].technique");
    assert!(
        error.problems()[0]
            .message
            .contains("needs `materials[0].height`"),
        "{error}"
    );
    let without_texture = pinned.replacen(", map = \"color.png\"", "", 1).replacen(
        "normal = { map = \"normal.png\", codec = \"unorm\" }\n",
        "",
        1,
    );
    let error = folder().load(&without_texture).expect_err("nothing to displace");
    assert!(
        error.problems()[0].message.contains("nothing to displace"),
        "{error}"
    );
}

#[test]
fn object_space_refuses_a_scale_that_bends_angles() {
    let object_space = GOOD.replacen("technique = \"auto\"", "lighting_space = \"object\"", 1);
    assert!(
        folder()
            .load(&object_space.replacen("scale = [1.0, 1.0, 1.0]", "scale = [-2.0, 2.0, 2.0]", 1))
            .is_ok()
    );
    let error =
        folder().load(&object_space.replacen("scale = [1.0, 1.0, 1.0]", "scale = [1.0, 2.0, 1.0]", 1));
    let error = error.expect_err("a stretched object");
    assert_eq!(error.problems()[0].field, "objects[0].scale", "{error}");
}

#[test]
fn too_many_lights_and_no_objects() {
    let light =
        |i: usize| format!("[[lights]]\nname = \"l{i}\"\nkind = \"point\"\nposition = [0.0, 0.0, 1.0]\n");
    let lights: String = (0..16).map(light).collect();
    let error = folder().load(&format!("{GOOD}{lights}")).expect_err("17 lights");
    assert!(
        error.problems()[0]
            .message
            .contains("17 lights; the shader's array holds 16"),
        "{error}"
    );
    let alone = GOOD.split("[[objects]]").next().expect("text before the objects");
    let error = folder().load(alone).expect_err("no objects");
    assert_eq!(error.problems()[0].field, "objects");
}

#[test]
fn meshes_are_checked() {
    let folder = folder();
    folder.write("bare.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("far.obj", b"v 0 0 0\nvt 0 0\nf 1/1 2/1 9/1\n");
    let with = |file: &str| {
        GOOD.replacen(
            "shape = \"plane\"\nsize = [2.0, 2.0]",
            &format!("shape = \"obj\"\nfile = \"{file}\""),
            1,
        )
    };
    for (file, says) in [
        ("bare.obj", "no texture coordinates"),
        ("far.obj", "far.obj:3"),
        ("gone.obj", "cannot be read"),
    ] {
        let error = folder.load(&with(file)).expect_err(file);
        assert_eq!(error.problems()[0].field, "objects[0].file", "{error}");
        assert!(error.problems()[0].message.contains(says), "{error}");
    }
}

#[test]
fn a_file_that_is_not_there_or_no_text_is_an_error_and_no_panic() {
    let folder = Folder::new();
    let error = bossage_scene::load(&folder.path("none.toml")).expect_err("there is no file");
    assert!(error.to_string().contains("none.toml") && error.problems().is_empty());
    folder.write("binary.toml", &[0xff, 0xfe, 0x00]);
    assert!(bossage_scene::load(&folder.path("binary.toml")).is_err());
    assert!(folder.load("").expect_err("an empty scene").problems().len() >= 3);
}

proptest::proptest! {
    /// Whatever is cut out of a scene, or put in: an answer, never a panic, and problems lie inside the text.
    #[test]
    fn damage_is_reported_and_never_panics(from in 0usize..1000, length in 0usize..40, noise in "[ -~äé\n]{0,6}") {
        let text = GOOD.replace("color.png", "x.png").replace("normal.png", "x.png").replace("height.png", "x.png");
        let (from, to) = (from.min(text.len()), (from + length).min(text.len()));
        let damaged = format!("{}{noise}{}", &text[..from], &text[to..]);
        if let Err(error) = bossage_scene::load_str("memory.toml", &damaged) {
            let _ = error.to_string();
            for problem in error.problems() {
                proptest::prop_assert!(problem.span.end <= damaged.len() && problem.line >= 1 && problem.column >= 1);
            }
        }
    }
}
