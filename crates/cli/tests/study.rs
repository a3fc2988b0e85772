//! `bossage study`, run as a user runs it: always without a driver, where everything but times is the same in every run.

mod tool;

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use tool::{bossage, bossage_without_adapter, command, entries, has_adapter, parsed, repository, text};

/// A small study of a folder, with further flags.
fn small(folder: &Path, more: &[&str]) -> tool::Run {
    let mut arguments = vec!["study", "-o", text(folder), "--rays", "64", "--view-deg", "60"];
    arguments.extend(more);
    bossage_without_adapter(&arguments)
}

fn study(folder: &Path) -> serde_json::Value {
    parsed(&fs::read_to_string(folder.join("study.json")).unwrap())
}

#[test]
fn a_study_has_its_numbers_and_says_why_times_are_missing() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let run = small(
        &out,
        &[
            "--map",
            "bricks",
            "--technique",
            "parallax_offset",
            "--technique",
            "relief",
        ],
    )
    .exits(0);
    assert!(
        run.stdout.contains("relief layers=16 refinements=5"),
        "{}",
        run.stdout
    );
    let study = study(&out);
    assert!(
        fs::read_to_string(out.join("index.html"))
            .unwrap()
            .contains("parallax_offset")
    );
    assert_eq!(study["schema"], 1);
    assert!(study["environment"].is_object());
    let points = study["points"].as_array().unwrap();
    assert_eq!(points.len(), 6);
    for point in points {
        assert_eq!(
            (&point["map"], point["view_deg"].as_f64(), point["rays"].as_u64()),
            (&"bricks".into(), Some(60.0), Some(64))
        );
        for key in ["mean", "p50", "p99", "max", "over_1"] {
            assert!(point["error_texels"][key].is_number(), "{key}");
        }
        assert!(point["ops"].as_f64().unwrap() > 0.0 && point["fetches"].as_f64().unwrap() >= 1.0);
        assert!(point["time_ms"].is_null() && point["no_time"].as_str().unwrap().contains("no driver"));
    }
    // The command that it names makes the same point again.
    let again = points[3]["rerun"].as_str().unwrap().to_owned();
    let words: Vec<&str> = again.split(' ').skip(1).collect();
    let other = folder.path().join("again");
    let words: Vec<&str> = words
        .into_iter()
        .map(|word| if word == "DIR" { text(&other) } else { word })
        .collect();
    bossage_without_adapter(&words).exits(0);
    assert_eq!(self::study(&other)["points"][0], points[3]);
}

#[test]
fn a_scene_is_seen_by_its_camera_too() {
    let folder = tempfile::tempdir().unwrap();
    let scene = repository("examples/brick_wall.toml");
    let run = small(
        folder.path(),
        &[
            "--scene",
            text(&scene),
            "--technique",
            "parallax_offset",
            "--quick",
        ],
    );
    run.exits(0);
    let study = study(folder.path());
    let points = study["points"].as_array().unwrap();
    assert_eq!(points.len(), 2);
    let seen = &points[1]["scene"];
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    assert!((0.001..1.0).contains(&number(&seen["flip"])), "{seen}");
    assert!(
        number(&seen["colour"]["mean"]) < number(&seen["colour"]["max"]),
        "{seen}"
    );
    assert!(seen["not_drawn"].is_null());
    for part in ["reference", "test", "flip"] {
        let name = format!("picture-brick_wall-parallax_offset-{part}.png");
        let picture = image::open(folder.path().join(&name)).unwrap();
        assert_eq!((picture.width(), picture.height()), (200, 150), "{name}");
    }
    assert!(points[0]["scene"].is_null());
    assert!(points[1]["scene"]["error_px"]["p99"].as_f64().unwrap() > 0.0);
    assert_eq!(points[1]["map"], "brick_wall/bricks");
}

#[test]
fn what_is_wrong_is_said_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let level = repository("examples/dot3_cube.toml");
    let cases: [(&[&str], &str); 11] = [
        (
            &["--technique", "paralax_oclusion"],
            "did you mean parallax_occlusion?",
        ),
        (&["--technique", "relief:layers=16"], "`refinements` is missing"),
        (&["--technique", ""], "unknown technique ``"),
        (&["--view-deg", "-5"], "degrees from the normal"),
        (&["--view-deg", "NaN"], "degrees from the normal"),
        (&["--depth", "-1"], "widths of the tile"),
        (&["--map", "no_such.png"], "no_such.png"),
        (
            &["--map", "bricks", "--map", "bricks"],
            "would both be called `bricks`",
        ),
        (&["--shader", "no_such.wgsl"], "no_such.wgsl"),
        (&["--scene", "no_such.toml"], "no_such.toml"),
        (&["--scene", text(&level)], "no material with a height map"),
    ];
    for (flags, says) in cases {
        small(&out, flags).exits(2).says(&[says]);
        assert!(!out.exists(), "{flags:?} left something");
    }
    let file = folder.path().join("file");
    fs::write(&file, "mine").unwrap();
    small(&file, &[]).exits(2).says(&["cannot write"]);
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
}

/// A height map of floats.
fn exr(path: &Path, heights: [f32; 4]) {
    let pixels = heights.iter().flat_map(|height| [*height; 3]).collect();
    image::Rgb32FImage::from_raw(2, 2, pixels)
        .unwrap()
        .save(path)
        .unwrap();
}

#[test]
fn maps_of_all_kinds_work_and_heights_that_are_none_do_not() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    exr(&at("floats.exr"), [0.0, 0.25, 0.5, 1.0]);
    exr(&at("nan.exr"), [0.0, f32::NAN, 0.5, 1.0]);
    exr(&at("infinite.exr"), [0.0, f32::INFINITY, 0.5, 1.0]);
    exr(&at("high.exr"), [0.0, 2.0, 0.5, 1.0]);
    let sixteen = image::ImageBuffer::<image::Luma<u16>, _>::from_fn(5, 3, |x, y| {
        image::Luma([(x * 9000 + y * 7000) as u16])
    });
    sixteen.save(at("sixteen.png")).unwrap();
    image::GrayImage::from_pixel(1, 1, image::Luma([128]))
        .save(at("one.png"))
        .unwrap();
    image::GrayImage::from_pixel(7, 4, image::Luma([128]))
        .save(at("constant.png"))
        .unwrap();
    let techniques = [
        "--technique",
        "parallax_offset",
        "--technique",
        "parallax_occlusion:layers=16",
    ];
    let of = |name: &str| {
        let (out, map) = (at(&format!("{name}.out")), at(name));
        let mut flags = vec!["--map", text(&map)];
        flags.extend(techniques);
        (small(&out, &flags), out)
    };
    for name in ["floats.exr", "sixteen.png", "one.png", "constant.png"] {
        let (run, out) = of(name);
        run.exits(0);
        assert_eq!(study(&out)["points"].as_array().unwrap().len(), 2, "{name}");
    }
    for (name, says) in [("nan.exr", "NaN"), ("infinite.exr", "inf"), ("high.exr", "2")] {
        let (run, out) = of(name);
        run.exits(2).says(&[name, says]);
        assert!(!out.exists());
    }
}

#[test]
fn a_profile_needs_a_driver() {
    let folder = tempfile::tempdir().unwrap();
    let (out, profile) = (folder.path().join("out"), folder.path().join("profile.toml"));
    small(&out, &["--calibrate", text(&profile)])
        .exits(3)
        .says(&["--calibrate needs a driver"]);
    // One setting a technique does not tell a ray's price from a step's.
    small(&out, &["--calibrate", text(&profile), "--quick"])
        .exits(2)
        .says(&["--quick"]);
    assert!(entries(folder.path()).is_empty());
}

#[test]
fn a_profile_has_every_technique_that_was_timed() {
    if !has_adapter() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let (out, profile) = (folder.path().join("out"), folder.path().join("mine.toml"));
    let arguments = [
        "study",
        "--rays",
        "256",
        "--view-deg",
        "60",
        "--map",
        "bricks",
        "--technique",
        "parallax_occlusion",
    ];
    let mut arguments = arguments.to_vec();
    arguments.extend(["--calibrate", text(&profile), "-o", text(&out)]);
    bossage(&arguments).exits(0);
    for point in study(&out)["points"].as_array().unwrap() {
        let time = &point["time_ms"];
        let of = |key: &str| time[key].as_f64().unwrap();
        assert!(of("min") > 0.0 && of("min") <= of("median") && of("median") <= of("max"));
        assert!(time["runs"].as_u64().unwrap() >= 9 && point["no_time"].is_null());
    }
    let read = fs::read_to_string(&profile).unwrap();
    assert!(read.contains("[technique.parallax_occlusion]"), "{read}");
    // A scene takes it.
    let scene = fs::read_to_string(repository("examples/brick_wall.toml")).unwrap();
    let textures = repository("examples/textures");
    let scene = scene
        .replace("textures/", &format!("{}/", text(&textures)))
        .replace(
            "error_px = 1.0",
            &format!("error_px = 1.0\nprofile = \"{}\"", text(&profile)),
        );
    let file = folder.path().join("wall.toml");
    fs::write(&file, scene).unwrap();
    bossage_without_adapter(&["plan", text(&file)]).exits(0);
}

/// Kills a study when some of it is finished, and has it go on.
#[test]
fn a_study_that_is_killed_loses_no_finished_point() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let missing = "/nonexistent/icd.json";
    let arguments = [
        "study",
        "-o",
        text(&out),
        "--rays",
        "4096",
        "--map",
        "bricks",
        "--technique",
        "parallax_offset",
        "--technique",
        "parallax_occlusion:layers=64",
        "--view-deg",
        "0,30,45,60,75,80",
    ];
    let start = || {
        let mut command = command(&arguments);
        command
            .env("VK_ICD_FILENAMES", missing)
            .env("VK_DRIVER_FILES", missing)
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        command
    };
    let mut child = start().spawn().unwrap();
    let journal = out.join("points.jsonl");
    let begun = Instant::now();
    while fs::metadata(&journal).map_or(0, |file| file.len()) == 0
        && begun.elapsed() < Duration::from_secs(60)
    {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let finished = fs::read(&journal).unwrap();
    assert!(
        !finished.is_empty() && !out.join("study.json").exists(),
        "it was killed on the way"
    );
    assert!(start().status().unwrap().success());
    let whole = fs::read(&journal).unwrap();
    let lines = finished.iter().rposition(|byte| *byte == b'\n').unwrap() + 1;
    assert_eq!(
        whole[..lines],
        finished[..lines],
        "what was finished is as it was"
    );
    let points = study(&out);
    assert_eq!(points["points"].as_array().unwrap().len(), 12);
    assert_eq!(
        String::from_utf8(whole).unwrap().lines().count(),
        12,
        "nothing was measured twice"
    );
}
