//! Every class of wrong input: exit code 2, a message that names the thing and what to do, and nothing written.
//!
//! Each case is run through `emit` into a folder that does not exist before and must not exist after.

mod tool;

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use tool::{Run, bossage, entries, repository, text};

/// A folder with a scene in it that is right, to be made wrong in one place.
struct Playground {
    folder: TempDir,
}

impl Playground {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let playground = Self { folder };
        playground.write("height.png", &png(4, 4));
        playground.write("scene.toml", SCENE.as_bytes());
        playground
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, bytes: &[u8]) {
        fs::write(self.path(name), bytes).unwrap();
    }

    /// The scene with `old` replaced.
    fn edit(&self, old: &str, new: &str) {
        assert!(SCENE.contains(old), "the scene has no {old:?}");
        self.write("scene.toml", SCENE.replace(old, new).as_bytes());
    }

    /// Emits an input, expecting refusal: exit code 2 and no output folder.
    #[track_caller]
    fn refused(&self, input: &str) -> Run {
        let (input, out) = (self.path(input), self.path("out"));
        let run = bossage(&["emit", text(&input), "-o", text(&out)]).exits(2);
        assert!(!out.exists(), "something was written: {:?}", entries(&out));
        assert_eq!(run.stdout, "");
        run
    }

    #[track_caller]
    fn scene_refused(&self, old: &str, new: &str) -> Run {
        self.edit(old, new);
        self.refused("scene.toml").says(&["scene.toml"])
    }
}

const SCENE: &str = r#"schema = 1
ambient = [0.1, 0.1, 0.1]

[camera]
position = [0.0, 0.0, 3.0]
target = [0.0, 0.0, 0.0]
fov_deg = 45.0
near = 0.1
far = 10.0
size = [64, 48]

[[lights]]
name = "sun"
kind = "directional"
direction = [0.0, 0.0, -1.0]

[[materials]]
name = "stone"
albedo = { map = "height.png" }
height = { map = "height.png", scale = 0.04, bias = -0.02 }
technique = "auto"

[[objects]]
name = "wall"
shape = "plane"
material = "stone"
"#;

fn png(width: u32, height: u32) -> Vec<u8> {
    let picture = image::RgbImage::from_fn(width, height, |x, y| {
        image::Rgb([(x * 40) as u8, (y * 40) as u8, 7])
    });
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// The scene that all others are made from is right: otherwise each refusal below could be another one.
#[test]
fn the_scene_itself_is_right() {
    let playground = Playground::new();
    let (scene, out) = (playground.path("scene.toml"), playground.path("out"));
    bossage(&["emit", text(&scene), "-o", text(&out)]).exits(0);
    assert!(entries(&out).contains(&"manifest.json".to_owned()));
}

#[test]
fn missing_image() {
    let playground = Playground::new();
    fs::remove_file(playground.path("height.png")).unwrap();
    playground.refused("scene.toml").says(&["height.png", "^"]);
}

#[test]
fn truncated_image() {
    let playground = Playground::new();
    playground.write("height.png", &png(64, 64)[..100]);
    playground
        .refused("scene.toml")
        .says(&["height.png", "truncated"]);
}

#[test]
fn empty_image() {
    let playground = Playground::new();
    playground.write("height.png", b"");
    playground.refused("scene.toml").says(&["height.png", "empty"]);
}

#[test]
fn zero_sized_image() {
    let playground = Playground::new();
    // A BMP of 0 by 0 pixels: its encoder refuses to make one, so the header is written by hand.
    let mut bmp = b"BM\x36\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0".to_vec();
    bmp.extend([0; 8]);
    bmp.extend(b"\x01\0\x18\0");
    bmp.extend([0; 24]);
    playground.write("height.bmp", &bmp);
    playground
        .scene_refused(
            "height = { map = \"height.png\"",
            "height = { map = \"height.bmp\"",
        )
        .says(&["height.bmp"]);
}

#[test]
fn absurdly_large_image_names_the_limit() {
    let playground = Playground::new();
    let mut header = png(4, 4);
    // Width of the PNG header, which is checked before its checksum matters; the checksum is mended all the same.
    header[16..20].copy_from_slice(&1_000_000_u32.to_be_bytes());
    let crc = crc32(&header[12..29]);
    header[29..33].copy_from_slice(&crc.to_be_bytes());
    playground.write("height.png", &header);
    playground.refused("scene.toml").says(&["height.png", "16384"]);
}

/// The checksum of PNG chunks (ISO 3309), bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32| {
        if crc & 1 == 1 {
            crc >> 1 ^ 0xEDB8_8320
        } else {
            crc >> 1
        }
    };
    !bytes.iter().fold(!0, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| step(crc))
    })
}

#[test]
fn wrong_format_image() {
    let playground = Playground::new();
    playground.write("height.png", b"this is a text and no picture at all");
    playground.refused("scene.toml").says(&["height.png"]);
}

#[test]
fn numbers_that_make_no_sense() {
    let cases = [
        ("fov_deg = 45.0", "fov_deg = nan", "fov_deg"),
        ("near = 0.1", "near = -0.1", "near"),
        ("far = 10.0", "far = inf", "far"),
        ("scale = 0.04", "scale = -0.04", "scale"),
        (
            "ambient = [0.1, 0.1, 0.1]",
            "ambient = [0.1, -0.1, 0.1]",
            "ambient",
        ),
        (
            "direction = [0.0, 0.0, -1.0]",
            "direction = [0.0, 0.0, 0.0]",
            "direction",
        ),
        ("size = [64, 48]", "size = [64, 0]", "size"),
    ];
    for (old, new, field) in cases {
        Playground::new().scene_refused(old, new).says(&[field, "^"]);
    }
}

#[test]
fn unknown_key() {
    Playground::new()
        .scene_refused("fov_deg = 45.0", "fov_dge = 45.0")
        .says(&["fov_dge", "fov_deg", "^"]);
}

#[test]
fn unknown_technique_in_a_scene() {
    let run = Playground::new().scene_refused("technique = \"auto\"", "technique = \"paralax_offset\"");
    run.says(&["paralax_offset", "parallax_offset", "^"]);
}

#[test]
fn broken_toml() {
    Playground::new()
        .scene_refused("fov_deg = 45.0", "fov_deg = = 45.0")
        .says(&["^"]);
}

#[test]
fn meshes_without_what_a_mesh_needs() {
    let cases = [
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "uv"),
        ("v 0 0 0\nvt 0 0\n", "face"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 9/1\n", "mesh.obj"),
    ];
    for (obj, word) in cases {
        let playground = Playground::new();
        playground.write("mesh.obj", obj.as_bytes());
        let run = playground.scene_refused("shape = \"plane\"", "shape = \"obj\"\nfile = \"mesh.obj\"");
        assert!(run.stderr.to_lowercase().contains(word), "{word}: {}", run.stderr);
        assert!(run.stderr.contains("mesh.obj"), "{}", run.stderr);
    }
}

#[test]
fn syntax_error_in_wgsl_has_a_caret() {
    let playground = Playground::new();
    playground.write("bad.wgsl", b"fn f() -> f32 {\n  return 1.0 +;\n}\n");
    playground
        .refused("bad.wgsl")
        .says(&["bad.wgsl:2:", "^", "return 1.0 +;"]);
}

#[test]
fn type_error_in_wgsl_has_a_caret() {
    let playground = Playground::new();
    playground.write(
        "bad.wgsl",
        b"@fragment fn f() -> @location(0) vec4f {\n  let x: f32 = vec3f(1.0);\n  return vec4f(x);\n}\n",
    );
    playground.refused("bad.wgsl").says(&["bad.wgsl:2:", "^"]);
}

#[test]
fn syntax_error_in_wesl_has_a_caret() {
    let playground = Playground::new();
    playground.write("bad.wesl", b"fn f() -> f32 {\n  return 1.0 +;\n}\n");
    playground.refused("bad.wesl").says(&["bad.wesl", ":2:", "^"]);
}

#[test]
fn errors_in_glsl_have_a_caret() {
    let playground = Playground::new();
    playground.write("bad.frag", b"#version 450\nvoid main() {\n  float x = y;\n}\n");
    playground.refused("bad.frag").says(&["bad.frag:3:", "^"]);
}

#[test]
fn broken_spirv() {
    let playground = Playground::new();
    playground.write("bad.spv", b"\x03\x02\x23\x07 and then nothing that is SPIR-V");
    playground.refused("bad.spv").says(&["bad.spv"]);
    playground.write("empty.spv", b"");
    playground.refused("empty.spv").says(&["empty.spv"]);
}

/// All wrong shaders are told of at once, not one a run.
#[test]
fn several_wrong_shaders_are_all_shown() {
    let playground = Playground::new();
    playground.write("a.wgsl", b"fn f( {}");
    playground.write("b.wgsl", b"fn g( {}");
    let (a, b, out) = (
        playground.path("a.wgsl"),
        playground.path("b.wgsl"),
        playground.path("out"),
    );
    bossage(&["emit", text(&a), text(&b), "-o", text(&out)])
        .exits(2)
        .says(&["a.wgsl", "b.wgsl"]);
    assert!(!out.exists());
}

#[test]
fn files_that_are_no_input() {
    let playground = Playground::new();
    playground.refused("nowhere.wgsl").says(&["nowhere.wgsl"]);
    playground.refused("nowhere.toml").says(&["nowhere.toml"]);
    playground.write("a.wgls", b"");
    playground
        .refused("a.wgls")
        .says(&["a.wgls", "did you mean wgsl?"]);
    playground.write("a.glsl", b"#version 450\nvoid main() {}\n");
    playground.refused("a.glsl").says(&["a.glsl", "--stage"]);
    playground.write("latin.wgsl", b"// \xe9t\xe9\n");
    playground
        .refused("latin.wgsl")
        .says(&["latin.wgsl", "UTF-8", "byte 3"]);
    fs::create_dir(playground.path("folder.wgsl")).unwrap();
    playground.refused("folder.wgsl").says(&["folder.wgsl"]);
}

#[test]
fn two_inputs_of_one_name() {
    let playground = Playground::new();
    let shader = b"@compute @workgroup_size(1) fn main() {}";
    for folder in ["a", "b"] {
        fs::create_dir(playground.path(folder)).unwrap();
        playground.write(&format!("{folder}/same.wgsl"), shader);
    }
    let (a, b, out) = (
        playground.path("a/same.wgsl"),
        playground.path("b/same.wgsl"),
        playground.path("out"),
    );
    bossage(&["emit", text(&a), text(&b), "-o", text(&out)])
        .exits(2)
        .says(&["a/same.wgsl", "b/same.wgsl", "same."]);
    assert!(!out.exists());
}

#[test]
fn typos_in_the_call_are_answered_with_the_right_word() {
    let cases: &[(&[&str], &[&str])] = &[
        (&["emti", "a.wgsl"], &["emti", "'emit'"]),
        (
            &["emit", "a.wgsl", "-o", "x", "-t", "spriv"],
            &["spriv", "'spirv'"],
        ),
        (
            &["emit", "a.wgsl", "-o", "x", "--glls", "450"],
            &["--glls", "'--glsl'"],
        ),
        (
            &["emit", "a.wgsl", "-o", "x", "--hlsl", "7_0"],
            &["7_0", "5_0, 5_1, 6_0"],
        ),
        (&["emit", "a.wgsl"], &["--output"]),
        (&["emit", "-o", "x"], &["INPUT"]),
        (
            &["render", "a.toml", "-o", "x.png", "--size", "640"],
            &["640", "WIDTHxHEIGHT"],
        ),
        (
            &["render", "a.toml", "-o", "x.png", "--compare", "none"],
            &["--compare"],
        ),
        (
            &["conform", "--route", "spriv"],
            &["spriv", "did you mean spirv?"],
        ),
        (&["conform", "--shard", "3/2"], &["3/2", "I/N"]),
        (
            &["conform", "paralax_ofset"],
            &["paralax_ofset", "did you mean parallax_offset?"],
        ),
        (
            &["bake", "a.png", "-o", "x", "--scale", "nan"],
            &["NaN", "finite"],
        ),
        (
            &[
                "bake", "a.png", "-o", "x", "--normal", "forward", "--edge", "wrap",
            ],
            &["--edge", "flat"],
        ),
        (&["bake", "-o", "x"], &["HEIGHT"]),
        (
            &["bake", "-o", "x", "--normalisation-cube", "0"],
            &["normalisation cube map", "at least 1 texel"],
        ),
        (
            &["bake", "-o", "x", "--normalisation-cube", "5000", "--bits", "16"],
            &["5000", "4729"],
        ),
        (
            &["bake", "-o", "x", "--normalisation-cube", "8", "--mips"],
            &["HEIGHT"],
        ),
        (
            &["bake", "a.png", "-o", "x", "--codec", "snorm", "--gpu"],
            &["--codec snorm", "unorm and biased"],
        ),
        (
            &["bake", "a.png", "-o", "x", "--codec", "octahedral", "--mips"],
            &["--codec octahedral", "linear"],
        ),
        (&["completions", "bsh"], &["bsh", "'bash'"]),
    ];
    let before = entries(Path::new("."));
    for (call, words) in cases {
        bossage(call).exits(2).says(words);
    }
    assert_eq!(entries(Path::new(".")), before);
}

#[test]
fn unknown_technique_on_the_command_line() {
    let scene = repository("examples/brick_wall.toml");
    let out = tempfile::tempdir().unwrap();
    let picture = out.path().join("x.png");
    let run = bossage(&[
        "render",
        text(&scene),
        "-o",
        text(&picture),
        "--technique",
        "paralax_offset",
    ]);
    run.exits(2)
        .says(&["paralax_offset", "did you mean parallax_offset?"]);
    let scene = repository("examples/bumped_cube.toml");
    let run = bossage(&[
        "render",
        text(&scene),
        "-o",
        text(&picture),
        "--technique",
        "parallax_offset",
    ]);
    run.exits(2).says(&["no material has a height map"]);
    assert!(entries(out.path()).is_empty());
}

#[test]
fn a_shader_folder_that_is_none() {
    let playground = Playground::new();
    let (scene, nowhere) = (playground.path("scene.toml"), playground.path("nowhere"));
    bossage(&["plan", text(&scene), "--shader-dir", text(&nowhere)])
        .exits(2)
        .says(&["nowhere"]);
    fs::create_dir(&nowhere).unwrap();
    bossage(&["plan", text(&scene), "--shader-dir", text(&nowhere)])
        .exits(2)
        .says(&["nowhere"]);
}
