//! The other commands, run as a user runs them, with a driver where there is one and always without.

mod tool;

use std::fs;
use std::path::{Path, PathBuf};

use tool::{Run, bossage, bossage_without_adapter, copy, entries, has_adapter, parsed, repository, text};

#[test]
fn plan_says_why() {
    let scene = repository("examples/brick_wall.toml");
    let table = bossage(&["plan", text(&scene)]).exits(0).stdout;
    assert!(
        table.contains("kept     relief") && table.contains("dropped  light_loop"),
        "{table}"
    );
    let plan = parsed(&bossage(&["plan", text(&scene), "--json"]).exits(0).stdout);
    assert_eq!(plan["schema"], 1);
    let material = &plan["materials"][0];
    for key in ["name", "technique", "permutation"] {
        assert!(material[key].is_string(), "{key}");
    }
    // Which it is depends on the bundled profile's figures.
    let technique = material["technique"].as_str().unwrap();
    let chosen = format!("material bricks: technique {technique}");
    let line = table.lines().find(|line| line.starts_with(&chosen));
    assert!(
        technique != "none" && line.is_some_and(|line| line.contains("(auto)")),
        "{table}"
    );
    for effect in material["effects"].as_array().unwrap() {
        assert!(effect["id"].is_string() && effect["reason"].is_string() && effect["evidence"].is_object());
        assert!(["kept", "dropped"].contains(&effect["state"].as_str().unwrap()));
    }
    for key in ["error_texels_p99", "error_px_p99", "ops", "fetches"] {
        assert!(
            material["predicted"][key].is_number(),
            "{key}: {}",
            material["predicted"]
        );
    }
}

#[test]
fn doctor_names_every_tool_with_a_way_to_get_it() {
    let report = parsed(&bossage(&["doctor", "--json"]).exits(0).stdout);
    assert_eq!(report["schema"], 1);
    let validators = report["validators"].as_array().unwrap();
    assert!(validators.len() >= 2);
    for validator in validators {
        match validator["state"].as_str().unwrap() {
            "enabled" => assert!(validator["version"].is_string()),
            "disabled" => assert!(validator["reason"].is_string()),
            other => panic!("{other}"),
        }
    }
    let without = bossage_without_adapter(&["doctor"]).exits(0).stdout;
    assert!(
        without.contains("DISABLED  no driver's adapter") && without.contains("mesa-vulkan-drivers"),
        "{without}"
    );
    for report in [&without, &bossage(&["doctor"]).exits(0).stdout] {
        assert!(report.contains("ENABLED   embedded [evaluator, cpu"), "{report}");
    }
}

#[test]
fn without_egl_route_opengl_says_what_is_missing_and_how_to_get_it() {
    // A module that Python reads first hides the library from it.
    let no_egl = repository("crates/remote/tests/opengl/no_egl");
    let run = |arguments: &[&str]| -> Run {
        let mut command = tool::command(arguments);
        command
            .env("PYTHONPATH", &no_egl)
            .env("PYTHONDONTWRITEBYTECODE", "1");
        command.output().unwrap().into()
    };
    // Without Python it is Python that is missing, with the same way to get both.
    let words = ["apt install python3 libegl1", "./x setup --full"];
    let demanded = run(&["conform", "codec_snorm", "--route", "opengl"])
        .exits(3)
        .says(&words);
    assert!(demanded.stdout.is_empty(), "{}", demanded.stdout);
    let listed = run(&["doctor"]).exits(0).stdout;
    let line = listed
        .lines()
        .find(|line| line.starts_with("DISABLED  opengl: "))
        .unwrap_or_else(|| panic!("{listed}"));
    assert!(words.iter().all(|word| line.contains(word)), "{line}");
    let routes = parsed(&run(&["doctor", "--json"]).exits(0).stdout)["routes"].clone();
    let opengl = routes
        .as_array()
        .unwrap()
        .iter()
        .find(|one| one["route"] == "opengl");
    assert!(opengl.unwrap()["reason"].is_string(), "{routes}");
}

#[test]
fn check_passes_good_shaders_and_fails_bad_ones() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
    let good = repository("examples/user_shader.wgsl");
    let run = bossage(&["check", text(&good), "--json", "--cache", text(&cache)]).exits(0);
    let report = parsed(&run.stdout);
    assert_eq!(report["schema"], 1);
    let input = &report["inputs"][0];
    assert_eq!(input["ok"], true);
    for target in ["spirv", "hlsl", "msl", "glsl", "wgsl"] {
        assert_eq!(input["targets"][target]["emitted"], true, "{target}");
    }
    for check in input["targets"]["spirv"]["checks"].as_array().unwrap() {
        assert!(check["tool"].is_string() && check["message"].is_string());
        assert_ne!(check["state"], "fail");
    }
    assert!(input["lints"].is_array());

    let bad = folder.path().join("bad.wgsl");
    fs::write(&bad, "fn f() -> f32 { return 1u; }").unwrap();
    let run = bossage(&[
        "check",
        text(&good),
        text(&bad),
        "--json",
        "--cache",
        text(&cache),
    ])
    .exits(2);
    let report = parsed(&run.stdout);
    assert_eq!(
        report["inputs"][0]["ok"], true,
        "the good one is checked all the same"
    );
    assert_eq!(report["inputs"][1]["ok"], false);
    assert!(
        report["inputs"][1]["error"]
            .as_str()
            .unwrap()
            .contains("bad.wgsl:1:")
    );

    // A compute shader cannot be expressed in OpenGL 3.3: the input is right, the check fails.
    let compute = folder.path().join("compute.wgsl");
    fs::write(&compute, "@compute @workgroup_size(1) fn main() {}").unwrap();
    let run = bossage(&["check", text(&compute), "--glsl", "330", "--cache", text(&cache)]).exits(1);
    assert!(run.stdout.contains("glsl   FAIL"), "{}", run.stdout);
}

/// Runs with a `spirv-val` first in the search path that rejects everything: the testers are tested too.
#[cfg(unix)]
fn bossage_with_a_hostile_validator(folder: &Path, arguments: &[&str]) -> Run {
    use std::os::unix::fs::PermissionsExt;
    let tool = folder.join("spirv-val");
    let script = "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 'SPIRV-Tools v0.0 hostile'; exit 0; fi\necho 'I do not like it'; exit 1\n";
    fs::write(&tool, script).unwrap();
    fs::set_permissions(&tool, fs::Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", text(folder), std::env::var("PATH").unwrap_or_default());
    let mut command = tool::command(arguments);
    command.env("PATH", path).env("XDG_CACHE_HOME", folder);
    command.output().unwrap().into()
}

#[cfg(unix)]
#[test]
fn what_an_external_compiler_rejects_fails_the_check_and_the_demo() {
    let folder = tempfile::tempdir().unwrap();
    let shader = repository("examples/user_shader.wgsl");
    let run = bossage_with_a_hostile_validator(folder.path(), &["check", text(&shader)]).exits(1);
    assert!(
        run.stdout.contains("spirv  FAIL") && run.stdout.contains("I do not like it"),
        "{}",
        run.stdout
    );
    let run = bossage_with_a_hostile_validator(folder.path(), &["check", text(&shader), "--json"]).exits(1);
    let check = &parsed(&run.stdout)["inputs"][0]["targets"]["spirv"]["checks"][0];
    assert_eq!(
        (check["tool"].as_str(), check["state"].as_str()),
        (Some("spirv-val"), Some("fail"))
    );
    let out = folder.path().join("demo");
    bossage_with_a_hostile_validator(folder.path(), &["demo", "-o", text(&out)]).exits(1);
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("Something failed") && page.contains("I do not like it"));
}

/// The library with one sign turned round, in a folder inside this one.
fn broken_library(folder: &Path) -> PathBuf {
    let shaders = folder.join("shaders");
    copy(&repository("shaders"), &shaders);
    let file = shaders.join("lib/lambert.wesl");
    let source = fs::read_to_string(&file).unwrap();
    let broken = source.replace("dot(normal, light_dir)", "dot(normal, -light_dir)");
    assert_ne!(broken, source);
    fs::write(&file, broken).unwrap();
    shaders
}

/// A library that is wrong in one sign must not pass.
#[test]
fn a_shader_broken_on_purpose_is_caught() {
    if !has_adapter() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let shaders = broken_library(folder.path());
    let run = bossage(&["conform", "dot3/hardened/", "--shader-dir", text(&shaders)]).exits(1);
    assert!(
        run.stdout.contains("FAIL: dot3/hardened/") && run.stdout.contains("again: bossage conform"),
        "{}",
        run.stdout
    );
}

#[test]
fn completions_know_every_command() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = bossage(&["completions", shell]).exits(0).stdout;
        for word in [
            "demo",
            "plan",
            "emit",
            "check",
            "conform",
            "render",
            "bake",
            "doctor",
            "shader-dir",
        ] {
            assert!(script.contains(word), "{shell} does not complete {word}");
        }
    }
}

#[test]
fn without_a_driver_everything_runs_embedded_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let scene = repository("examples/brick_wall.toml");
    let picture = folder.path().join("wall.png");
    let said = ["no Vulkan adapter", "`embedded`", "mesa-vulkan-drivers"];
    bossage_without_adapter(&["render", text(&scene), "-o", text(&picture), "--size", "96x72"])
        .exits(0)
        .says(&said);
    assert_is_a_picture(&picture, 96, 72);
    let height = repository("examples/textures/bricks_height.png");
    bossage_without_adapter(&["bake", text(&height), "-o", text(folder.path()), "--gpu"])
        .exits(0)
        .says(&said);
    let run = bossage_without_adapter(&["conform", "dot3/", "--json", "-"]).exits(0);
    let report = parsed(&run.stdout);
    assert_eq!(report["totals"]["fail"], 0);
    let cases = report["cases"].as_array().unwrap();
    let on = |route: &str, adapter: &str| {
        let is_it = |case: &&serde_json::Value| case["route"] == route && case["adapter"] == adapter;
        cases.iter().filter(is_it).count()
    };
    let (embedded, msl) = (on("embedded", "embedded"), on("msl", "clang"));
    assert!(embedded > 0 && embedded + msl == cases.len(), "{report}");
    let left_out = report["environment"]["not_run"].as_array().unwrap();
    let routes: Vec<_> = left_out
        .iter()
        .map(|one| one["route"].as_str().unwrap())
        .filter(|route| *route != "msl")
        .collect();
    assert_eq!(routes, ["wgsl", "spirv", "hlsl", "glsl", "opengl", "tint"]);
    // Clang is no driver: where it is, its route runs; where it is not, the report says so.
    assert_eq!(
        msl > 0,
        left_out.iter().all(|one| one["route"] != "msl"),
        "{report}"
    );
    assert!(
        left_out[0]["reason"]
            .as_str()
            .unwrap()
            .contains("mesa-vulkan-drivers")
    );
}

#[test]
fn without_a_driver_what_asks_for_one_exits_with_3_and_says_how_to_get_it() {
    let folder = tempfile::tempdir().unwrap();
    let scene = repository("examples/brick_wall.toml");
    let picture = folder.path().join("wall.png");
    let how = ["no Vulkan adapter", "mesa-vulkan-drivers"];
    bossage_without_adapter(&[
        "render",
        text(&scene),
        "-o",
        text(&picture),
        "--adapter",
        "lavapipe",
    ])
    .exits(3)
    .says(&how);
    bossage_without_adapter(&["conform", "dot3/", "--route", "spirv"])
        .exits(3)
        .says(&how);
    bossage_without_adapter(&["conform", "dot3/", "--adapter", "lavapipe"])
        .exits(3)
        .says(&["no adapter matches `lavapipe`", "embedded"]);
    assert!(entries(folder.path()).is_empty());
}

#[test]
fn a_route_and_an_adapter_that_do_not_go_together_are_a_wrong_call() {
    for (route, adapter) in [
        ("spirv", "embedded"),
        ("wgsl", "embedded"),
        ("embedded,wgsl", "embedded"),
    ] {
        bossage(&["conform", "dot3/", "--route", route, "--adapter", adapter])
            .exits(2)
            .says(&["does not run", "it runs:"]);
    }
    if has_adapter() {
        bossage(&["conform", "dot3/", "--route", "embedded", "--adapter", "lavapipe"])
            .exits(2)
            .says(&["does not run", "`embedded`"]);
    }
}

/// A library that is wrong in one sign must not pass on the machine without a driver either.
#[test]
fn a_shader_broken_on_purpose_is_caught_without_a_driver() {
    let folder = tempfile::tempdir().unwrap();
    let shaders = broken_library(folder.path());
    let run =
        bossage_without_adapter(&["conform", "dot3/hardened/", "--shader-dir", text(&shaders)]).exits(1);
    assert!(
        run.stdout.contains("FAIL: dot3/hardened/") && run.stdout.contains("route embedded on embedded"),
        "{}",
        run.stdout
    );
}

#[test]
fn an_adapter_that_is_not_there_is_named_with_those_that_are() {
    if has_adapter() {
        let run = bossage(&["conform", "dot3", "--adapter", "voodoo"]).exits(3);
        run.says(&["voodoo", "there are:"]);
    }
}

#[test]
fn the_demo_names_a_picture_and_a_page_that_stands_alone() {
    if has_adapter() {
        let page = demo(bossage);
        for route in ["wgsl", "spirv", "embedded"] {
            assert!(!page.contains(&format!("<code>{route}</code> is left out")));
        }
    }
}

#[test]
fn the_demo_is_whole_without_a_driver() {
    let page = demo(bossage_without_adapter);
    for said in [
        "is left out: no Vulkan adapter",
        "say nothing about a GPU",
        "Drawn on embedded",
    ] {
        assert!(page.contains(said), "{said}");
    }
}

/// Runs the demo; gives back its page.
fn demo(bossage: impl Fn(&[&str]) -> Run) -> String {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("demo");
    let run = bossage(&["demo", "-o", text(&out)]).exits(0);
    let picture = out.join("brick_wall.png");
    assert_eq!(
        run.stdout,
        format!(
            "picture: {}\nreport:  {}\n",
            picture.display(),
            out.join("report.html").display()
        )
    );
    assert_is_a_picture(&picture, 640, 480);
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    for part in [
        "SPIR-V",
        "HLSL",
        "MSL",
        "GLSL",
        "WGSL",
        "parallax_offset",
        "data:image/png;base64,",
        "spirv-val",
    ] {
        assert!(page.contains(part), "{part} is missing");
    }
    for outside in ["src=\"http", "<script", "@import", "url("] {
        assert!(!page.contains(outside), "{outside} reaches out of the page");
    }
    for link in page
        .split("href=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
    {
        let target = link.strip_prefix('#').map_or_else(
            || out.join(link).exists(),
            |id| page.contains(&format!("id=\"{id}\"")),
        );
        assert!(target, "the link to {link} leads nowhere");
    }
    assert!(out.join("shaders/manifest.json").exists());
    assert!(out.join("scene/brick_wall.toml").exists());
    page
}

/// Right size, and something is to be seen: it holds many colours.
fn assert_is_a_picture(path: &Path, width: u32, height: u32) {
    let picture = image::open(path).unwrap().to_rgb8();
    assert_eq!(picture.dimensions(), (width, height));
    let colours: std::collections::BTreeSet<[u8; 3]> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(colours.len() > 1000, "only {} colours", colours.len());
    assert!(
        !colours.contains(&[255, 0, 255]),
        "there are pixels that are not numbers"
    );
}

#[test]
fn render_draws_in_the_size_asked_for_and_compares() {
    if !has_adapter() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let scene = repository("examples/brick_wall.toml");
    let (plain, compared) = (
        folder.path().join("plain.png"),
        folder.path().join("compared.png"),
    );
    bossage(&["render", text(&scene), "-o", text(&plain), "--size", "160x120"]).exits(0);
    assert_is_a_picture(&plain, 160, 120);
    let call = [
        "render",
        text(&scene),
        "-o",
        text(&compared),
        "--size",
        "160x120",
        "--compare",
        "none,parallax_offset_limited",
    ];
    bossage(&call).exits(0).says(&["max 0.", "mean 0."]);
    // Three pictures and two gaps of four pixels.
    assert_is_a_picture(&compared, 3 * 160 + 2 * 4, 120);
    let same = [
        "render",
        text(&scene),
        "-o",
        text(&compared),
        "--size",
        "160x120",
        "--compare",
        "none,none",
    ];
    bossage(&same).exits(0).says(&["max 0.000000, mean 0.000000"]);
}

#[test]
fn conform_lists_runs_and_reports() {
    let list = bossage(&["conform", "--list", "dot3/"]).exits(0).stdout;
    assert!(
        list.lines().count() >= 3 && list.lines().all(|line| line.starts_with("dot3/")),
        "{list}"
    );
    if !has_adapter() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let (json, junit, html) = (
        folder.path().join("r.json"),
        folder.path().join("r.xml"),
        folder.path().join("deep/r.html"),
    );
    let call = [
        "conform",
        "dot3/",
        "--json",
        text(&json),
        "--junit",
        text(&junit),
        "--html",
        text(&html),
        "--adapter",
        "lavapipe",
    ];
    bossage(&call).exits(0);
    let report = parsed(&fs::read_to_string(&json).unwrap());
    assert_eq!(report["totals"]["fail"], 0);
    let case = &report["cases"][0];
    for key in [
        "id", "route", "adapter", "basis", "outputs", "verdict", "worst", "rerun",
    ] {
        assert!(case.get(key).is_some(), "{key} is missing in {case}");
    }
    assert!(fs::read_to_string(&junit).unwrap().contains("<testsuite"));
    assert!(fs::read_to_string(&html).unwrap().starts_with("<!DOCTYPE html>"));

    // The command that a report gives for running a case again is one that works.
    let rerun = case["rerun"].as_str().unwrap().strip_prefix("bossage ").unwrap();
    let script = format!("\"$0\" {rerun} --json -");
    let output = std::process::Command::new("sh")
        .args(["-c", &script, env!("CARGO_BIN_EXE_bossage")])
        .output()
        .unwrap();
    let again = parsed(&Run::from(output).exits(0).stdout);
    let again = again["cases"].as_array().unwrap();
    assert!(
        again
            .iter()
            .any(|again| again["id"] == case["id"] && again["verdict"] == case["verdict"])
    );
}

#[test]
fn a_report_that_cannot_be_written_is_found_before_the_work_is_done() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let report = file.join("r.json");
    bossage(&["conform", "dot3", "--json", text(&report)])
        .exits(2)
        .says(&["r.json"]);
}
