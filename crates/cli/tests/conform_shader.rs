//! `bossage conform --shader`: a user's shader on all routes, and everything that can be wrong with it.

mod tool;

use std::fs;
use std::time::{Duration, Instant};

use tempfile::TempDir;
use tool::{Run, bossage, bossage_without_adapter, has_adapter, parsed, repository, text};

/// A folder with files in it.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn conform(folder: &TempDir, file: &str, more: &[&str]) -> Run {
    let path = folder.path().join(file);
    bossage(&[&["conform", "--shader", text(&path)], more].concat())
}

const SUM: &str = "
@group(0) @binding(0) var<storage, read> source: array<vec2f>;
@group(0) @binding(1) var<storage, read_write> result: array<f32>;
@compute @workgroup_size(16) fn sum(@builtin(global_invocation_id) id: vec3u) {
    result[id.x] = source[id.x].x + source[id.x].y;
}";

#[test]
fn the_example_passes_on_every_route_and_is_reported() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let example = repository("examples/shaders/tone_map.wgsl");
    let (json, junit, html) = (path("a.json"), path("a.xml"), path("a.html"));
    let run = bossage(&[
        "conform",
        "--shader",
        text(&example),
        "--inputs",
        "8",
        "--json",
        text(&json),
        "--junit",
        text(&junit),
        "--html",
        text(&html),
    ])
    .exits(0);
    assert!(run.stdout.contains("tone_map"), "{}", run.stdout);
    let report = parsed(&fs::read_to_string(json).unwrap());
    let cases = report["cases"].as_array().unwrap();
    let ran: Vec<_> = cases.iter().filter(|case| case["verdict"] != "skip").collect();
    let of = |route: &str| ran.iter().any(|case| case["route"] == route);
    assert!(of("embedded"), "{report}");
    assert!(!has_adapter() || (of("wgsl") && of("spirv")), "{report}");
    assert_eq!(report["environment"]["seed"], 1);
    let first = ran.iter().find(|case| case["route"] == "embedded").unwrap();
    assert_eq!(first["outputs"], 8 * 400);
    assert!(first["worst"]["place"].as_str().unwrap().starts_with("mapped["));
    assert!(
        fs::read_to_string(junit)
            .unwrap()
            .contains("tone_map/ranges:entry=tone_map;n=8;seed=1")
    );
    assert!(fs::read_to_string(html).unwrap().contains("tone_map"));
}

/// A file with a vertex and a fragment stage, which marches through a texture with derivatives: both are run by themselves.
#[test]
fn stages_that_are_drawn_pass_on_every_route() {
    let example = repository("examples/user_shader.wgsl");
    let run = bossage(&[
        "conform",
        "--shader",
        text(&example),
        "--inputs",
        "8",
        "--json",
        "-",
    ])
    .exits(0);
    let report = parsed(&run.stdout);
    let cases = report["cases"].as_array().unwrap();
    for entry in ["vertex_main", "fragment_main"] {
        let of = |route: &str| {
            let id = format!("ranges:entry={entry};");
            let is_it = |case: &&serde_json::Value| {
                case["route"] == route && case["id"].as_str().unwrap().contains(&id)
            };
            cases.iter().find(is_it)
        };
        let routes: &[&str] = if has_adapter() {
            &["embedded", "wgsl", "spirv"]
        } else {
            &["embedded"]
        };
        for route in routes {
            let case = of(route).unwrap_or_else(|| panic!("{entry} on {route}: {report}"));
            assert_eq!(case["verdict"], "pass", "{case}");
            assert!(
                case["undecided"].as_u64().unwrap() * 2 < case["outputs"].as_u64().unwrap(),
                "{case}"
            );
        }
    }
}

const TEXTURES: &str = "
@group(0) @binding(0) var layers: texture_2d_array<f32>;
@group(0) @binding(1) var shadow: texture_depth_2d;
@group(0) @binding(2) var compare: sampler_comparison;
@group(0) @binding(3) var ids: texture_2d<u32>;
@group(0) @binding(4) var signs: texture_2d<i32>;
@group(0) @binding(5) var sky: texture_cube_array<f32>;
@group(0) @binding(6) var linear: sampler;
@group(0) @binding(7) var volume: texture_3d<f32>;
@group(0) @binding(8) var kept: texture_storage_2d<rgba8unorm, write>;
@group(0) @binding(9) var counted: texture_storage_2d<r32uint, read_write>;
@group(0) @binding(10) var<storage, read> uvs: array<vec2f>;
@group(0) @binding(11) var<storage, read_write> result: array<vec4f>;
@compute @workgroup_size(16) fn main(@builtin(local_invocation_index) i: u32) {
    let uv = uvs[i];
    let at = vec2u(i % 4u, i / 4u);
    let lit = textureSampleCompareLevel(shadow, compare, uv, 0.5);
    let id = textureLoad(ids, at, 0).x;
    let sign = textureLoad(signs, at, 0).y;
    let light = textureSampleLevel(sky, linear, vec3f(uv, 1.0), i32(i & 1u), 0.0);
    let fog = textureSampleLevel(volume, linear, vec3f(uv, 0.25), 0.0);
    let colour = textureSampleLevel(layers, linear, uv, 1, 0.0);
    result[i] = colour + light + fog + vec4f(lit, f32(id), f32(sign), 0.0);
    textureStore(kept, at, vec4f(uv, 0.25, 1.0));
    textureStore(counted, at, vec4u(textureLoad(counted, at).x + id));
}";

/// Directions stay within a face, and more than half a texel of 4 away from its edges.
const WITHIN_A_FACE: &str = "schema = 1\n[ranges]\n\"uvs[]\" = { lo = -0.7, hi = 0.7 }\n";

#[test]
fn textures_of_every_kind_are_bound_and_read_back() {
    let folder = folder(&[
        ("textures.wgsl", TEXTURES),
        ("textures.ranges.toml", WITHIN_A_FACE),
    ]);
    let run = conform(&folder, "textures.wgsl", &["--inputs", "6", "--json", "-"]).exits(0);
    let report = parsed(&run.stdout);
    let cases = report["cases"].as_array().unwrap();
    let routes: &[&str] = if has_adapter() {
        &["embedded", "wgsl", "spirv"]
    } else {
        &["embedded"]
    };
    for route in routes {
        let is_it = |case: &&serde_json::Value| {
            case["route"] == *route && case["id"].as_str().unwrap().contains("ranges:")
        };
        let case = cases.iter().find(is_it).unwrap();
        assert_eq!(case["verdict"], "pass", "{case}");
        // Sixteen colours, sixteen texels of four channels, sixteen of one.
        assert_eq!(case["outputs"], 6 * (64 + 64 + 16), "{case}");
        assert_eq!(case["undecided"], 0, "{case}");
    }
}

/// What SwiftShader is known to get wrong, as a user's shader meets it: filtered across an edge or a corner, a cube map gives other
/// colours than the texels around the place. Where this passes there, the library's list has to lose its entry too.
#[test]
fn cube_maps_across_their_edges_are_refused_on_swiftshader_alone() {
    let cube = "
        @group(0) @binding(0) var sky: texture_cube<f32>;
        @group(0) @binding(1) var linear: sampler;
        @group(0) @binding(2) var<storage, read> uvs: array<vec2f>;
        @group(0) @binding(3) var<storage, read_write> result: array<vec4f>;
        @compute @workgroup_size(16) fn main(@builtin(local_invocation_index) i: u32) {
            result[i] = textureSampleLevel(sky, linear, vec3f(uvs[i], 1.0), 0.0);
        }";
    let folder = folder(&[("cube.wgsl", cube)]);
    let run = conform(&folder, "cube.wgsl", &["--inputs", "6", "--json", "-"]);
    let report = parsed(&run.stdout);
    let cases = report["cases"].as_array().unwrap().iter();
    let mut seen = 0;
    for case in cases.filter(|case| case["id"].as_str().unwrap().contains("ranges:")) {
        let deviates = case["adapter"].as_str().unwrap().contains("SwiftShader");
        if case["verdict"] != "skip" {
            assert_eq!(case["verdict"] == "fail", deviates, "{case}");
            assert_eq!(case["refused"].as_u64().unwrap() > 0, deviates, "{case}");
            seen += usize::from(deviates);
        }
    }
    assert_eq!(run.code, i32::from(seen > 0));
}

const PUSHED: &str = "
struct Pushed { scale: f32, offset: vec2f, weights: array<vec4f, 2>, count: u32 }
var<immediate> pushed: Pushed;
@group(0) @binding(0) var<storage, read_write> result: array<vec2f>;
@compute @workgroup_size(16) fn main(@builtin(local_invocation_index) i: u32) {
    let weight = pushed.weights[i & 1u].z + f32(pushed.count);
    result[i] = pushed.offset * pushed.scale + weight;
}
@fragment fn shade(@location(0) uv: vec2f) -> @location(0) vec4f {
    return vec4f(uv * pushed.scale, pushed.offset);
}";

/// GLSL for Vulkan has no words for what naga writes, and says so; a layout of which a member were elsewhere would be refused.
#[test]
fn push_constants_are_given_on_every_route_that_has_them() {
    let ranges = "schema = 1\n[ranges]\n\"pushed.count\" = { lo = 1, hi = 9 }\n";
    let folder = folder(&[("pushed.wgsl", PUSHED), ("pushed.ranges.toml", ranges)]);
    let run = conform(&folder, "pushed.wgsl", &["--inputs", "6", "--json", "-"]).exits(0);
    let report = parsed(&run.stdout);
    let ran = |entry: &str, route: &str| {
        let id = format!("ranges:entry={entry};");
        let cases = report["cases"].as_array().unwrap();
        let is_it =
            |case: &&serde_json::Value| case["route"] == route && case["id"].as_str().unwrap().contains(&id);
        cases
            .iter()
            .find(is_it)
            .map(|case| (case["verdict"].clone(), case.clone()))
    };
    let routes: &[&str] = if has_adapter() {
        &["embedded", "wgsl", "spirv"]
    } else {
        &["embedded"]
    };
    for entry in ["main", "shade"] {
        for route in routes {
            let (verdict, case) = ran(entry, route).unwrap_or_else(|| panic!("{entry} on {route}"));
            assert_eq!(verdict, "pass", "{case}");
            assert_eq!(case["undecided"], 0, "{case}");
        }
        if let Some((verdict, case)) = ran(entry, "glsl") {
            assert_eq!(verdict, "skip", "{case}");
        }
        if let Some((verdict, case)) = ran(entry, "hlsl") {
            assert!(verdict == "pass" || verdict == "skip", "{case}");
        }
    }
}

#[test]
fn the_command_that_a_report_names_runs_the_same_again() {
    let folder = folder(&[("sum.wgsl", SUM)]);
    let run = conform(
        &folder,
        "sum.wgsl",
        &["--inputs", "4", "--seed", "9", "--json", "-"],
    )
    .exits(0);
    let report = parsed(&run.stdout);
    let find = |report: &serde_json::Value| {
        let cases = report["cases"].as_array().unwrap().clone();
        cases
            .into_iter()
            .find(|case| case["route"] == "embedded")
            .unwrap()
    };
    let case = find(&report);
    let rerun = case["rerun"].as_str().unwrap();
    let words: Vec<String> = rerun.split(' ').map(|word| word.replace('\'', "")).collect();
    let mut words: Vec<&str> = words.iter().map(String::as_str).collect();
    assert_eq!(words.remove(0), "bossage");
    words.extend(["--json", "-"]);
    let again = parsed(&bossage(&words).exits(0).stdout);
    assert_eq!(again["cases"].as_array().unwrap().len(), 1);
    assert_eq!(find(&again), case);
}

#[test]
fn other_languages_take_the_same_road() {
    let glsl = "#version 450
        layout(local_size_x = 16) in;
        layout(set = 0, binding = 0) readonly buffer Source { vec4 values[]; } source;
        layout(set = 0, binding = 1) buffer Result { float values[]; } result;
        void main() {
            uint i = gl_GlobalInvocationID.x;
            result.values[i] = dot(source.values[i], vec4(1.0, 2.0, 3.0, 4.0));
        }";
    let folder = folder(&[("weigh.comp", glsl), ("sum.wgsl", SUM)]);
    conform(&folder, "weigh.comp", &["--inputs", "4"]).exits(0);
    let (shader, out) = (folder.path().join("sum.wgsl"), folder.path().join("out"));
    bossage(&["emit", text(&shader), "-t", "spirv", "-o", text(&out)]).exits(0);
    let emitted = tool::entries(&out)
        .into_iter()
        .find(|name| name.ends_with(".spv"))
        .unwrap();
    bossage(&["conform", "--shader", text(&out.join(emitted)), "--inputs", "4"]).exits(0);
}

#[test]
fn overrides_take_their_values_from_the_sidecar() {
    let shader = "
        override scale: f32;
        override count: u32 = 4u;
        @group(0) @binding(0) var<storage, read_write> result: array<f32>;
        @compute @workgroup_size(16) fn main(@builtin(local_invocation_index) i: u32) {
            result[i] = scale * f32(i % count);
        }";
    let ranges = "schema = 1\n[overrides]\nscale = 2.5\ncount = 3\n";
    let folder = folder(&[
        ("with.wgsl", shader),
        ("with.ranges.toml", ranges),
        ("without.wgsl", shader),
        ("other.wgsl", shader),
        (
            "other.ranges.toml",
            "schema = 1\n[overrides]\nscale = 1\nscal = 2\n",
        ),
        ("word.wgsl", shader),
        ("word.ranges.toml", "schema = 1\n[overrides]\nscale = \"much\"\n"),
    ]);
    let run = conform(&folder, "with.wgsl", &["--inputs", "2", "--json", "-"]).exits(0);
    let report = parsed(&run.stdout);
    let first = &report["cases"].as_array().unwrap()[0];
    assert_eq!(first["verdict"], "pass", "{report}");
    conform(&folder, "without.wgsl", &[])
        .exits(2)
        .says(&["without.wgsl:2:", "`scale`", "^", "overrides"]);
    conform(&folder, "other.wgsl", &[])
        .exits(2)
        .says(&["no override `scal`"]);
    conform(&folder, "word.wgsl", &[])
        .exits(2)
        .says(&["word.ranges.toml:3:"]);
}

#[test]
fn without_a_driver_the_evaluator_runs_it() {
    let folder = folder(&[("sum.wgsl", SUM)]);
    let shader = folder.path().join("sum.wgsl");
    bossage_without_adapter(&["conform", "--shader", text(&shader), "--inputs", "4"]).exits(0);
}

/// Some minutes of work for a software driver, whose loops end by themselves after 65,536 rounds: hence so many of them. The time limit
/// ends the process, and the other routes have their turn.
#[test]
fn a_hang_is_a_verdict_and_the_rest_goes_on() {
    if !has_adapter() {
        return;
    }
    let spin = "for (var i = 0u; i < 60000u; i++) { x = x * 1664525u + 1013904223u + (x >> 3u); }";
    let endless = format!(
        "@group(0) @binding(0) var<storage, read_write> result: array<u32>;
        @compute @workgroup_size(64) fn spin(@builtin(global_invocation_id) id: vec3u) {{
            var x = id.x;
            {}
            result[id.x] = x;
        }}",
        spin.repeat(60)
    );
    let folder = folder(&[("spin.wgsl", &endless)]);
    let start = Instant::now();
    let more = [
        "--inputs",
        "2",
        "--time-limit",
        "1",
        "--workgroups",
        "2048",
        "--operations",
        "1000",
    ];
    let run = conform(
        &folder,
        "spin.wgsl",
        &[more.as_slice(), &["--json", "-"]].concat(),
    )
    .exits(1);
    assert!(start.elapsed() < Duration::from_secs(120), "it was not ended");
    let report = parsed(&run.stdout);
    let cases = report["cases"].as_array().unwrap();
    let of = |route: &str| {
        let case = cases
            .iter()
            .find(|case| case["route"] == route && case["id"].as_str().unwrap().contains("/ranges"));
        case.unwrap_or_else(|| panic!("no result of {route} in {report}"))
    };
    for route in ["wgsl", "spirv"] {
        let case = of(route);
        assert_eq!(case["verdict"], "fail", "{case}");
        let reason = case["reason"].as_str().unwrap();
        assert!(reason.contains("did not end within 1 s"), "{reason}");
    }
    assert_ne!(
        of("embedded")["verdict"],
        "pass",
        "our evaluator gives up, or is ended"
    );
}

#[test]
fn what_is_wrong_with_the_call_exits_with_2() {
    let empty = "fn helper(x: f32) -> f32 { return x; }";
    let silent = "@group(0) @binding(0) var<storage, read> a: array<f32>;
        @compute @workgroup_size(1) fn main() { let x = a[0]; }";
    let folder = folder(&[
        ("sum.wgsl", SUM),
        ("empty.wgsl", empty),
        ("silent.wgsl", silent),
        ("broken.wgsl", "@compute fn main() { let x = ; }"),
        (
            "misfit.toml",
            "schema = 1\n[ranges]\n\"sourse[]\" = { lo = 0, hi = 1 }\n",
        ),
        (
            "upside.toml",
            "schema = 1\n[ranges]\nsource = { lo = 1, hi = 0 }\n",
        ),
        ("scene.toml", "schema = 1\n"),
    ]);
    let ranges = |name: &str| folder.path().join(name).display().to_string();
    let (misfit, upside) = (ranges("misfit.toml"), ranges("upside.toml"));
    let wrong = |file: &str, more: &[&str], words: &[&str]| {
        let run = conform(&folder, file, more).exits(2).says(words);
        assert_eq!(run.stdout, "");
    };
    wrong(
        "sum.wgsl",
        &["--ranges", &misfit],
        &["misfit.toml:3:1", "sourse", "did you mean `source[]`"],
    );
    wrong("sum.wgsl", &["--ranges", &upside], &["upside.toml:3:", "lo"]);
    wrong("sum.wgsl", &["--ranges", "nowhere.toml"], &["nowhere.toml"]);
    wrong(
        "sum.wgsl",
        &["--entry", "some"],
        &["no entry point `some`", "sum (compute)"],
    );
    wrong(
        "sum.wgsl",
        &["--workgroups", "0"],
        &["--workgroups 0", "for example"],
    );
    wrong(
        "sum.wgsl",
        &["--workgroups", "65535,65535"],
        &["invocations", "--workgroups"],
    );
    wrong("sum.wgsl", &["--inputs", "0"], &["--inputs"]);
    wrong("sum.wgsl", &["--time-limit", "0"], &["--time-limit"]);
    wrong("sum.wgsl", &["--scene", "a.toml"], &["--scene"]);
    wrong("sum.wgsl", &["--route", "spriv"], &["did you mean spirv?"]);
    wrong("sum.wgsl", &["nothing"], &["no case", "nothing"]);
    wrong("empty.wgsl", &[], &["empty.wgsl", "entry point"]);
    wrong("broken.wgsl", &[], &["broken.wgsl:1:", "^"]);
    wrong("missing.wgsl", &[], &["missing.wgsl"]);
    wrong("scene.toml", &[], &["is a scene"]);
    bossage(&["conform", "--entry", "main"])
        .exits(2)
        .says(&["--shader"]);
    // Nothing to compare is said, and nothing passed.
    let run = conform(&folder, "silent.wgsl", &[]).exits(1);
    assert!(run.stdout.contains("it writes no buffer"), "{}", run.stdout);
}

#[test]
fn a_page_shows_where_a_bound_comes_from() {
    let folder = folder(&[("sum.wgsl", SUM)]);
    let (page, json) = (folder.path().join("a.html"), folder.path().join("a.json"));
    let more = [
        "--inputs",
        "4",
        "--route",
        "embedded",
        "--attribute",
        "result[3]",
        "--html",
        text(&page),
        "--json",
        text(&json),
    ];
    conform(&folder, "sum.wgsl", &more).exits(0);
    let page = fs::read_to_string(page).unwrap();
    assert!(page.contains("Where the error bound comes from") && page.contains("result[3]"));
    let report = parsed(&fs::read_to_string(json).unwrap());
    let lines = report["heats"][0]["lines"].as_array().unwrap();
    // The only line that rounds is the only one that contributes.
    let shares: Vec<f64> = lines.iter().filter_map(|line| line["share"].as_f64()).collect();
    assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-6, "{lines:?}");
    conform(&folder, "sum.wgsl", &["--attribute", "result[99]"])
        .exits(2)
        .says(&["result[99]", "result[0]"]);
    bossage(&["conform", "normalise/", "--attribute", "x"])
        .exits(2)
        .says(&["numbers"]);
    bossage(&["conform", "--seed", "2"]).exits(2).says(&["--hunt"]);
}

#[test]
fn a_hunt_finds_a_planted_defect_and_keeps_what_the_library_has() {
    let planted = "
        @group(0) @binding(0) var<storage, read> source: array<f32>;
        @group(0) @binding(1) var<storage, read_write> result: array<f32>;
        @compute @workgroup_size(4) fn main(@builtin(local_invocation_index) i: u32) {
            result[i] = source[i] * source[i] - 2.345;
        }";
    let ranges = "schema = 1\n[ranges]\nsource = { size = 4, lo = 1, hi = 2 }\n";
    let folder = folder(&[("planted.wgsl", planted), ("planted.ranges.toml", ranges)]);
    let hunt = ["--hunt", "--time", "3", "--threshold", "1000", "--json", "-"];
    let report = parsed(&conform(&folder, "planted.wgsl", &hunt).exits(0).stdout);
    let findings = report["findings"].as_array().unwrap();
    assert!(findings.iter().any(|one| one["goal"] == "error"), "{report}");
    // What is found stands beside the shader, and later runs replay it.
    let beside = folder.path().join("planted.corpus.toml");
    let found = fs::read_to_string(&beside).unwrap();
    assert!(
        found.contains("shader = \"planted\"") && found.contains("0x"),
        "{found}"
    );
    let replayed = |more: &[&str]| {
        let call = [&["--inputs", "2", "--route", "embedded", "--json", "-"], more].concat();
        parsed(&conform(&folder, "planted.wgsl", &call).exits(0).stdout)
    };
    let count = |report: &serde_json::Value| {
        let is_replayed = |case: &&serde_json::Value| case["id"].as_str().unwrap().contains("/corpus:");
        report["cases"]
            .as_array()
            .unwrap()
            .iter()
            .filter(is_replayed)
            .count()
    };
    assert_eq!(count(&replayed(&[])), 1);
    // A number of evaluations is the same hunt everywhere, in whatever time.
    let counted = |name: &str| {
        let kept = folder.path().join(name);
        fs::create_dir(&kept).unwrap();
        let hunt = [
            "--hunt",
            "--evaluations",
            "1500",
            "--threshold",
            "1000",
            "--corpus",
            text(&kept),
        ];
        conform(&folder, "planted.wgsl", &hunt).exits(0);
        assert_eq!(count(&replayed(&["--corpus", text(&kept)])), 1);
        fs::read_to_string(kept.join("planted.corpus.toml")).unwrap()
    };
    assert_eq!(counted("first"), counted("second"));
    assert_eq!(
        count(&replayed(&[
            "--corpus",
            text(folder.path().join("first").parent().unwrap())
        ])),
        1
    );
    // What is there and wrong is never overwritten, nor passed over.
    fs::write(&beside, "schema = 1\nshader = \"planted\"\n[[found]]\n").unwrap();
    for more in [hunt.as_slice(), &["--inputs", "2"]] {
        conform(&folder, "planted.wgsl", more)
            .exits(2)
            .says(&["planted.corpus.toml", "entry"]);
    }
    bossage(&["conform", "--corpus", "somewhere"])
        .exits(2)
        .says(&["--corpus", "--shader"]);
    bossage(&["conform", "--hunt", "--evaluations", "0"])
        .exits(2)
        .says(&["--evaluations"]);
    let corpus = folder.path().join("corpus");
    fs::create_dir(&corpus).unwrap();
    let library = [
        "conform",
        "--hunt",
        "normalise/corpus",
        "--time",
        "2",
        "--threshold",
        "0.4",
        "--corpus",
    ];
    bossage(&[library.as_slice(), &[text(&corpus)]].concat()).exits(0);
    let kept = fs::read_to_string(corpus.join("normalise.toml")).unwrap();
    assert!(
        kept.contains("probe = \"normalise\"") && kept.contains("0x"),
        "{kept}"
    );
    // What is there and wrong is never overwritten.
    fs::write(
        corpus.join("normalise.toml"),
        "schema = 1\nprobe = \"normalize\"\n",
    )
    .unwrap();
    bossage(&[library.as_slice(), &[text(&corpus)]].concat())
        .exits(2)
        .says(&["normalise.toml", "`normalize`"]);
    bossage(&["conform", "--hunt", "dot33"]).exits(2).says(&["dot33"]);
    bossage(&["conform", "--time", "3"]).exits(2).says(&["--hunt"]);
}
