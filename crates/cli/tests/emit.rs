//! `emit` does what it says, does nothing twice, and leaves nothing half-done.

mod tool;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::time::SystemTime;

use serde_json::Value;
use tool::{bossage, command, copy, entries, repository, text};

const COMPUTE: &str = "@group(0) @binding(0) var<storage, read_write> values: array<f32>;
@compute @workgroup_size(64)
fn twice(@builtin(global_invocation_id) id: vec3u) {
    if (id.x < arrayLength(&values)) {
        values[id.x] = 2.0 * values[id.x];
    }
}
";

fn times(folder: &Path) -> BTreeMap<String, SystemTime> {
    let time = |name: &String| fs::metadata(folder.join(name)).unwrap().modified().unwrap();
    entries(folder)
        .into_iter()
        .map(|name| (name.clone(), time(&name)))
        .collect()
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

#[test]
fn every_file_is_in_the_manifest_and_beside_it() {
    let out = tempfile::tempdir().unwrap();
    let scene = repository("examples/brick_wall.toml");
    bossage(&["emit", text(&scene), "-o", text(out.path())]).exits(0);
    let manifest = json(&out.path().join("manifest.json"));
    assert_eq!(manifest["schema"], 1);
    let entries_of_manifest = manifest["entries"].as_array().unwrap();
    assert_eq!(entries_of_manifest.len(), 2, "a vertex and a fragment stage");
    let mut named: Vec<String> = Vec::new();
    for entry in entries_of_manifest {
        let files = entry["files"].as_object().unwrap();
        assert_eq!(
            files.keys().collect::<Vec<_>>(),
            ["glsl", "hlsl", "msl", "spirv", "wgsl"]
        );
        for (target, file) in files {
            let file = file.as_str().unwrap();
            let hash = entry["sha256"][target].as_str().unwrap();
            assert_eq!(sha256(&out.path().join(file)), hash, "{file}");
            named.push(file.to_owned());
        }
    }
    let listings = named
        .iter()
        .filter(|name| name.ends_with(".spv"))
        .map(|name| format!("{name}asm"));
    let mut expected: Vec<String> = named.iter().cloned().chain(listings).collect();
    expected.extend([".bossage-stamp.json".to_owned(), "manifest.json".to_owned()]);
    expected.sort();
    assert_eq!(entries(out.path()), expected);
    let material = &manifest["scenes"][0]["materials"][0];
    assert_eq!(material["name"], "bricks");
    for stage in ["vertex", "fragment"] {
        let shader = material[stage].as_str().unwrap();
        assert!(
            entries_of_manifest.iter().any(|entry| entry["shader"] == shader),
            "{shader}"
        );
    }
}

fn sha256(path: &Path) -> String {
    use sha2::Digest;
    sha2::Sha256::digest(fs::read(path).unwrap())
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

#[test]
fn nothing_changed_means_nothing_done() {
    let folder = tempfile::tempdir().unwrap();
    let (input, out) = (folder.path().join("a.wgsl"), folder.path().join("out"));
    fs::write(&input, COMPUTE).unwrap();
    let call = ["emit", text(&input), "-o", text(&out)];
    bossage(&call).exits(0);
    let first = times(&out);
    bossage(&call).exits(0).says(&["nothing changed"]);
    assert_eq!(times(&out), first);

    // An output that was edited is written again, and only that one.
    let edited = first.keys().find(|name| name.ends_with(".hlsl")).unwrap();
    let right = fs::read(out.join(edited)).unwrap();
    fs::write(out.join(edited), "edited by hand").unwrap();
    bossage(&call).exits(0);
    assert_eq!(fs::read(out.join(edited)).unwrap(), right);
    for (name, time) in times(&out).iter().filter(|(name, _)| *name != edited) {
        assert_eq!(time, &first[name], "{name} was written again");
    }

    // Other options are another call.
    bossage(&["emit", text(&input), "-o", text(&out), "--hlsl", "5_0"])
        .exits(0)
        .says(&["written"]);
}

#[test]
fn what_is_not_emitted_any_more_is_removed_but_nothing_else_is() {
    let folder = tempfile::tempdir().unwrap();
    let (input, out) = (folder.path().join("a.wgsl"), folder.path().join("out"));
    fs::write(&input, COMPUTE).unwrap();
    let call = ["emit", text(&input), "-o", text(&out), "-t", "wgsl"];
    bossage(&call).exits(0);
    fs::write(out.join("mine.txt"), "not the tool's").unwrap();
    fs::write(&input, COMPUTE.replace("twice", "double")).unwrap();
    bossage(&call).exits(0);
    assert_eq!(
        entries(&out),
        [
            ".bossage-stamp.json",
            "a.double.wgsl",
            "manifest.json",
            "mine.txt"
        ]
    );
}

#[test]
fn the_output_is_the_same_every_time() {
    let folder = tempfile::tempdir().unwrap();
    let scene = repository("examples/gallery.toml");
    let contents = |out: &Path| -> BTreeMap<String, Vec<u8>> {
        bossage(&["emit", text(&scene), "-o", text(out)]).exits(0);
        let kept = entries(out)
            .into_iter()
            .filter(|name| name != ".bossage-stamp.json");
        kept.map(|name| (name.clone(), fs::read(out.join(name)).unwrap()))
            .collect()
    };
    assert_eq!(
        contents(&folder.path().join("a")),
        contents(&folder.path().join("b"))
    );
}

#[test]
fn the_depfile_lists_everything_that_was_read() {
    let folder = tempfile::tempdir().unwrap();
    let scene = repository("examples/brick_wall.toml");
    let (out, depfile) = (folder.path().join("out"), folder.path().join("deep/scene.d"));
    let call = [
        "emit",
        text(&scene),
        "-o",
        text(&out),
        "--depfile",
        text(&depfile),
    ];
    bossage(&call).exits(0);
    let rule = fs::read_to_string(&depfile).unwrap();
    let mut words = rule.split_whitespace().filter(|word| *word != "\\");
    assert_eq!(
        words.next(),
        Some(format!("{}:", out.join("manifest.json").display()).as_str())
    );
    let read: Vec<&str> = words.collect();
    for name in [
        "brick_wall.toml",
        "bricks_albedo.png",
        "bricks_height.png",
        "bricks_normal.png",
    ] {
        assert!(
            read.iter().any(|file| file.ends_with(name)),
            "{name} is not in {read:?}"
        );
    }
    assert_eq!(read.len(), 4);
    // A run that does nothing still has a dep-file to give.
    fs::remove_file(&depfile).unwrap();
    bossage(&call).exits(0).says(&["nothing changed"]);
    assert_eq!(fs::read_to_string(&depfile).unwrap(), rule);
}

#[test]
fn a_library_from_a_folder_replaces_the_embedded_one() {
    let folder = tempfile::tempdir().unwrap();
    let (shaders, out) = (folder.path().join("shaders"), folder.path().join("out"));
    copy(&repository("shaders"), &shaders);
    let scene = repository("examples/brick_wall.toml");
    let depfile = folder.path().join("d");
    let call = [
        "emit",
        text(&scene),
        "-o",
        text(&out),
        "--shader-dir",
        text(&shaders),
        "--depfile",
        text(&depfile),
        "-t",
        "wgsl",
    ];
    bossage(&call).exits(0);
    let before: BTreeMap<String, Vec<u8>> = wgsl(&out);
    let entry = shaders.join("entry/surface_fragment.wesl");
    let source = fs::read_to_string(&entry).unwrap();
    assert!(
        fs::read_to_string(&depfile)
            .unwrap()
            .contains("entry/surface_fragment.wesl")
    );
    bossage(&call).exits(0).says(&["nothing changed"]);
    let turned = source.replace(
        "material.ambient.rgb * albedo.rgb",
        "albedo.rgb * material.ambient.rgb",
    );
    assert_ne!(turned, source);
    fs::write(&entry, turned).unwrap();
    bossage(&call).exits(0);
    let after = wgsl(&out);
    assert_eq!(
        after.keys().collect::<Vec<_>>(),
        before.keys().collect::<Vec<_>>()
    );
    let changed: Vec<&String> = after
        .keys()
        .filter(|name| after[*name] != before[*name])
        .collect();
    assert!(
        changed.len() == 1 && changed[0].contains("surface_fragment"),
        "{changed:?}"
    );
}

fn wgsl(out: &Path) -> BTreeMap<String, Vec<u8>> {
    let names = entries(out).into_iter().filter(|name| name.ends_with(".wgsl"));
    names
        .map(|name| (name.clone(), fs::read(out.join(name)).unwrap()))
        .collect()
}

#[test]
fn what_a_target_cannot_express_leaves_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let (input, out) = (folder.path().join("a.wgsl"), folder.path().join("out"));
    fs::write(&input, COMPUTE).unwrap();
    // OpenGL 3.3 has no compute shaders.
    let run = bossage(&["emit", text(&input), "-o", text(&out), "--glsl", "330"]).exits(1);
    run.says(&["glsl", "a.wgsl", "^"]);
    let names = entries(&out);
    for extension in [".spv", ".spvasm", ".hlsl", ".metal", ".wgsl"] {
        assert!(
            names.iter().any(|name| name.ends_with(extension)),
            "{extension} is not in {names:?}"
        );
    }
    assert!(!names.iter().any(|name| name.contains("glsl")), "{names:?}");
    // The next run tries again: an incomplete folder is not up to date.
    bossage(&["emit", text(&input), "-o", text(&out), "--glsl", "330"]).exits(1);
}

#[test]
fn all_kinds_of_shaders_go_in() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("a.wgsl", COMPUTE);
    write(
        "b.wesl",
        "import super::c::scale;\n@fragment fn f() -> @location(0) vec4f { return vec4f(scale()); }\n",
    );
    write("c.wesl", "fn scale() -> f32 { return 0.5; }\n");
    write(
        "d.vert",
        "#version 450\nvoid main() { gl_Position = vec4(0.0); }\n",
    );
    write(
        "d.frag",
        "#version 450\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(1.0); }\n",
    );
    write(
        "e.glsl",
        "#version 450\nlayout(local_size_x = 1) in;\nvoid main() {}\n",
    );
    let out = folder.path().join("out");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let inputs = ["a.wgsl", "b.wesl", "d.vert", "d.frag", "e.glsl"].map(path);
    let mut call = vec!["emit", "-o", text(&out), "--stage", "compute"];
    call.extend(inputs.iter().map(String::as_str));
    bossage(&call).exits(0);
    let manifest = json(&out.join("manifest.json"));
    let shaders: Vec<&str> = manifest["entries"]
        .as_array()
        .unwrap()
        .iter()
        .map(|entry| entry["shader"].as_str().unwrap())
        .collect();
    assert_eq!(shaders, ["a", "b", "d_vert", "d_frag", "e_comp"]);

    // What comes out as SPIR-V goes in again.
    let spirv = entries(&out)
        .into_iter()
        .find(|name| name.ends_with(".spv"))
        .unwrap();
    let again = folder.path().join("again");
    bossage(&["emit", text(&out.join(spirv)), "-o", text(&again)]).exits(0);
    assert!(again.join("manifest.json").exists());
}

#[test]
fn a_folder_that_cannot_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let (input, file) = (folder.path().join("a.wgsl"), folder.path().join("file"));
    fs::write(&input, COMPUTE).unwrap();
    fs::write(&file, "in the way").unwrap();
    let out = file.join("out");
    bossage(&["emit", text(&input), "-o", text(&out)])
        .exits(2)
        .says(&["file/out", "nothing was changed"]);
    assert_eq!(fs::read(&file).unwrap(), b"in the way");
    assert_eq!(entries(folder.path()), ["a.wgsl", "file"]);
}

/// A limit on the size of files acts like a full disk: a write comes back short, then fails.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_nothing_half_written() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, out) = (repository("examples/gallery.toml"), folder.path().join("out"));
    let script = "trap '' XFSZ; ulimit -f 4; exec \"$0\" emit \"$1\" -o \"$2\"";
    let mut shell = std::process::Command::new("sh");
    shell.args([
        "-c",
        script,
        env!("CARGO_BIN_EXE_bossage"),
        text(&scene),
        text(&out),
    ]);
    let run = tool::Run::from(shell.output().unwrap()).exits(2);
    run.says(&["cannot write", "nothing was changed"]);
    assert!(!out.exists(), "{:?}", entries(&out));
}

#[cfg(target_os = "linux")]
#[test]
fn standard_output_that_is_full_is_an_error_and_one_that_is_closed_is_not() {
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let mut help = command(&["completions", "bash"]);
    let run = tool::Run::from(help.stdout(full).output().unwrap());
    run.exits(2).says(&["standard output"]);

    // A pipe whose reader has gone before the first byte.
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let run = tool::Run::from(command(&["completions", "bash"]).stdout(writer).output().unwrap()).exits(0);
    assert_eq!(run.stderr, "");
}
