//! A whole sweep on the machine without a driver: right and wrong techniques told apart, the same numbers in every run, and what is finished
//! kept when it is interrupted.

use std::sync::Arc;

use bossage_assets::EdgeMode;
use bossage_conformance::Route;
use bossage_embedded::Embedded;
use bossage_runner::TimingOptions;
use bossage_shaders::Library;
use bossage_study::record::Point;
use bossage_study::sweep::journal::{Journal, NAME};
use bossage_study::sweep::map::Map;
use bossage_study::sweep::subject::Subject;
use bossage_study::sweep::{Cell, Options, Sweep, Unwatched, Watch, ladder, rays};

/// Courses of stones, ground at a quarter.
fn stones() -> Map {
    let at = |x: u32, y: u32| if x % 16 < 3 || y % 8 < 2 { 0.25 } else { 0.9 };
    Map::of("stones", 64, 32, at, EdgeMode::Wrap)
}

fn cells(map: &Arc<Map>, count: usize) -> Vec<Cell> {
    let cell = |view_deg: f64| Cell {
        map: Arc::clone(map),
        view_deg,
        rays: rays::seeded(view_deg, count, 1),
        screen: None,
        flags: format!("--view-deg {view_deg}"),
    };
    [0.0, 60.0].map(cell).into()
}

fn library(techniques: &[&str]) -> Vec<Subject> {
    let chosen: Vec<_> = techniques
        .iter()
        .flat_map(|text| ladder::parse(text).unwrap())
        .collect();
    Subject::of_library(&Library::embedded().unwrap(), &chosen, Route::Embedded).unwrap()
}

fn options() -> Options {
    Options {
        counted: 64,
        timing: TimingOptions::default(),
    }
}

fn run(subjects: &[Subject], cells: &[Cell], folder: &std::path::Path) -> Vec<Point> {
    let machine = Embedded::new();
    let sweep = Sweep {
        machine: &machine,
        subjects,
        cells,
        options: options(),
    };
    sweep
        .run(&mut Journal::open(folder).unwrap(), &mut Unwatched)
        .unwrap()
}

#[test]
fn more_layers_are_nearer_and_dearer_and_no_driver_means_no_times() {
    let folder = tempfile::tempdir().unwrap();
    let subjects = library(&[
        "parallax_offset",
        "parallax_occlusion:layers=8",
        "parallax_occlusion:layers=256",
    ]);
    let points = run(&subjects, &cells(&Arc::new(stones()), 512), folder.path());
    assert_eq!(points.len(), 6);
    let at = |technique: &str, settings: &str, view_deg: f64| {
        let is = |point: &&Point| {
            point.technique == technique
                && point.settings.to_string() == settings
                && point.view_deg == view_deg
        };
        points.iter().find(is).unwrap()
    };
    let (few, many) = (
        at("parallax_occlusion", "layers=8", 60.0),
        at("parallax_occlusion", "layers=256", 60.0),
    );
    assert!(
        many.error_texels.mean < 0.25 * few.error_texels.mean,
        "{many:?} {few:?}"
    );
    assert!(many.fetches > 8.0 * few.fetches && many.ops > 8.0 * few.ops);
    assert!(at("parallax_offset", "", 60.0).error_texels.mean > few.error_texels.mean);
    assert_eq!(at("parallax_offset", "", 60.0).fetches, 1.0);
    for point in &points {
        assert_eq!(point.rays, 512);
        assert!(
            point.time_ms.is_none()
                && point
                    .no_time
                    .as_deref()
                    .is_some_and(|why| why.contains("embedded"))
        );
        assert!(point.rerun.starts_with("bossage study --technique ") && point.rerun.contains("--view-deg"));
        assert_eq!(point.disagreement.status, 0.0, "{point:?}");
        // Seen from straight above there is nothing to find.
        if point.view_deg == 0.0 {
            assert!(point.error_texels.max < 1e-3, "{point:?}");
        }
    }
}

/// A relief shader with the library's bindings, that answers so: an expression of `view`, `search` and `height`.
fn users(name: &str, uv: &str, status: &str) -> Subject {
    let text = format!(
        "struct Search {{ scale: f32, bias: f32, v_factor: f32, level: f32, steps: u32, refinements: u32, edge_mode: u32 }}
        struct View {{ uv: vec2f, dir_ts: vec3f }}
        struct HitRecord {{ uv: vec2f, t: f32, status: u32 }}
        @group(0) @binding(0) var height_map: texture_2d<f32>;
        @group(0) @binding(1) var surface_sampler: sampler;
        @group(0) @binding(3) var<uniform> search: Search;
        @group(0) @binding(4) var<storage, read> rays: array<View>;
        @group(0) @binding(5) var<storage, read_write> hits: array<HitRecord>;
        @compute @workgroup_size(64) fn mine(@builtin(global_invocation_id) id: vec3u) {{
            if (id.x >= arrayLength(&hits)) {{ return; }}
            let view = rays[id.x];
            let height = textureSampleLevel(height_map, surface_sampler, view.uv, 0.0).r;
            let slope = vec2f(1.0, search.v_factor) * view.dir_ts.xy / view.dir_ts.z;
            hits[id.x] = HitRecord({uv}, 0.0, {status});
        }}"
    );
    Subject::of_user(name, "mine.wgsl", text, Route::Embedded).unwrap()
}

#[test]
fn exact_is_exact_and_every_technique_has_its_steps() {
    let folder = tempfile::tempdir().unwrap();
    let all: Vec<String> = ladder::default_choice(true)
        .iter()
        .map(ToString::to_string)
        .collect();
    let subjects = library(&all.iter().map(String::as_str).collect::<Vec<_>>());
    let cells = cells(&Arc::new(stones()), 512);
    for point in run(&subjects, &cells[1..], folder.path()) {
        let steps = point.steps.unwrap();
        match point.technique.as_str() {
            "exact" => assert!(point.error_texels.max <= 0.01, "{point:?}"),
            "parallax_offset" | "parallax_offset_limited" => assert_eq!(steps, 0.0),
            "parallax_occlusion" | "steep_parallax" | "relief" => assert!(steps > 1.0, "{point:?}"),
            _ => assert!(steps > 0.0, "{point:?}"),
        }
    }
}

#[test]
fn a_users_shader_takes_part_and_a_wrong_one_is_seen() {
    let folder = tempfile::tempdir().unwrap();
    // Level ground: the offset by its height is the very hit.
    let level = Arc::new(Map::of("level", 16, 16, |_, _| 0.5, EdgeMode::Clamp));
    let offset = "view.uv + (search.scale * height + search.bias) * slope";
    let subjects = [
        users("right", offset, "0u"),
        users(
            "turned",
            "view.uv - (search.scale * height + search.bias) * slope",
            "0u",
        ),
        users(
            "off_by_a_tenth",
            "view.uv + 0.9 * (search.scale * height + search.bias) * slope",
            "0u",
        ),
        users("nowhere", "view.uv / 0.0", "0u"),
        users("gives_up", offset, "2u"),
    ];
    let points = run(&subjects, &cells(&level, 256), folder.path());
    let [right, turned, off, nowhere, gives_up] = &points[5..] else {
        panic!("{points:?}")
    };
    assert_eq!(right.technique, "user:right");
    // Half of the layer at 60°: 0.025·√3 tiles of 16 texels, 0.69; f32 rounds at 16·2⁻²³ texels a few times.
    assert!(
        right.error_texels.max < 1e-4 && right.disagreement.status == 0.0,
        "{right:?}"
    );
    let shift = 0.025 * 3f64.sqrt() * 16.0;
    assert!((turned.error_texels.p50 - 2.0 * shift).abs() < 1e-3, "{turned:?}");
    assert_eq!(
        (turned.error_texels.over_1, turned.disagreement.early),
        (1.0, 1.0)
    );
    assert!((off.error_texels.p50 - 0.1 * shift).abs() < 1e-3, "{off:?}");
    assert_eq!(nowhere.disagreement.lost, 1.0);
    assert_eq!(
        (gives_up.disagreement.status, gives_up.error_texels.max < 1e-4),
        (1.0, true)
    );
}

/// Stops at the beginning of a cell, as a process that is killed does.
struct StopAt {
    cell: usize,
}

impl Watch for StopAt {
    fn start(&mut self, _cells: usize) {}
    fn begin(&mut self, _cell: &Cell) {
        self.cell = self
            .cell
            .checked_sub(1)
            .unwrap_or_else(|| std::panic::panic_any("stopped"));
    }
    fn done(&mut self, _measured: usize) {}
}

/// Counts what is measured.
struct Count {
    measured: usize,
}

impl Watch for Count {
    fn start(&mut self, _cells: usize) {}
    fn begin(&mut self, _cell: &Cell) {}
    fn done(&mut self, measured: usize) {
        self.measured += measured;
    }
}

#[test]
fn an_interrupted_sweep_goes_on_and_comes_out_the_same() {
    let subjects = library(&["parallax_offset", "relief:layers=8,refinements=4"]);
    let cells = cells(&Arc::new(stones()), 256);
    let machine = Embedded::new();
    let sweep = Sweep {
        machine: &machine,
        subjects: &subjects,
        cells: &cells,
        options: options(),
    };
    let folder = tempfile::tempdir().unwrap();
    let stopped = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        sweep.run(
            &mut Journal::open(folder.path()).unwrap(),
            &mut StopAt { cell: 1 },
        )
    }));
    assert!(stopped.is_err());
    // Half of a line more, as a kill in the middle of a write leaves it.
    let path = folder.path().join(NAME);
    let mut bytes = std::fs::read(&path).unwrap();
    bytes.extend_from_slice(b"{\"key\":\"0123");
    std::fs::write(&path, bytes).unwrap();
    let mut count = Count { measured: 0 };
    let resumed = sweep
        .run(&mut Journal::open(folder.path()).unwrap(), &mut count)
        .unwrap();
    assert_eq!(count.measured, 2, "the first cell's two points are kept");
    let other = tempfile::tempdir().unwrap();
    assert_eq!(
        resumed,
        run(&subjects, &cells, other.path()),
        "without times all is the same in every run"
    );
    // Again: nothing is measured.
    let mut count = Count { measured: 0 };
    assert_eq!(
        sweep
            .run(&mut Journal::open(folder.path()).unwrap(), &mut count)
            .unwrap(),
        resumed
    );
    assert_eq!(count.measured, 0);
}

#[test]
fn a_point_is_found_again_only_where_nothing_changed() {
    let folder = tempfile::tempdir().unwrap();
    let machine = Embedded::new();
    let measured = |subjects: &[Subject], cells: &[Cell], options: Options| {
        let sweep = Sweep {
            machine: &machine,
            subjects,
            cells,
            options,
        };
        let mut count = Count { measured: 0 };
        sweep
            .run(&mut Journal::open(folder.path()).unwrap(), &mut count)
            .unwrap();
        count.measured
    };
    let subjects = library(&["parallax_occlusion:layers=8"]);
    let map = Arc::new(stones());
    let one = |cells: Vec<Cell>| vec![cells[1].clone()];
    let base = one(cells(&map, 64));
    assert_eq!(measured(&subjects, &base, options()), 1);
    assert_eq!(measured(&subjects, &base, options()), 0);
    let mut other = (*map).clone();
    other.edge = EdgeMode::Mirror;
    assert_eq!(
        measured(&subjects, &one(cells(&Arc::new(other), 64)), options()),
        1,
        "edge"
    );
    let mut other = (*map).clone();
    other.layer.scale = 0.06;
    assert_eq!(
        measured(&subjects, &one(cells(&Arc::new(other), 64)), options()),
        1,
        "depth"
    );
    assert_eq!(measured(&subjects, &one(cells(&map, 65)), options()), 1, "rays");
    assert_eq!(
        measured(&library(&["parallax_occlusion:layers=9"]), &base, options()),
        1,
        "settings"
    );
    let more = Options {
        counted: 65,
        ..options()
    };
    assert_eq!(measured(&subjects, &base, more), 1, "counted rays");
    let (a, b) = (users("a", "view.uv", "0u"), users("a", "view.uv + 0.001", "0u"));
    assert_eq!(measured(&[a], &base, options()), 1);
    assert_eq!(measured(&[b], &base, options()), 1, "code");
}

#[test]
fn odd_maps_work() {
    let folder = tempfile::tempdir().unwrap();
    let all: Vec<String> = ladder::default_choice(true)
        .iter()
        .map(ToString::to_string)
        .collect();
    let subjects = library(&all.iter().map(String::as_str).collect::<Vec<_>>());
    for (name, width, height) in [("one", 1, 1), ("column", 1, 7), ("odd", 13, 5)] {
        for edge in [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp] {
            let at = |x: u32, y: u32| ((x * 7 + y * 3) % 5) as f32 / 4.0;
            let map = Arc::new(Map::of(name, width, height, at, edge));
            for point in run(&subjects, &cells(&map, 64), folder.path()) {
                // Cones may stop before the hit, and say so.
                let cones = point.technique.contains("cone_step");
                assert!(
                    point.disagreement.lost == 0.0 && (cones || point.disagreement.status == 0.0),
                    "{point:?}"
                );
                if point.technique == "exact" {
                    // What the library promises of it.
                    assert!(point.error_texels.max <= 0.01, "{point:?}");
                }
            }
        }
    }
}

#[test]
fn nothing_to_measure_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let machine = Embedded::new();
    let say = |subjects: &[Subject], cells: &[Cell]| {
        let sweep = Sweep {
            machine: &machine,
            subjects,
            cells,
            options: options(),
        };
        let mut journal = Journal::open(folder.path()).unwrap();
        sweep.run(&mut journal, &mut Unwatched).unwrap_err().to_string()
    };
    let map = Arc::new(stones());
    assert!(say(&[], &cells(&map, 8)).contains("no technique"));
    assert!(say(&library(&["parallax_offset"]), &[]).contains("no ray"));
}

#[test]
fn a_shader_that_cannot_take_part_says_why() {
    let of = |text: &str| {
        Subject::of_user("a", "a.wgsl", text.to_owned(), Route::Embedded)
            .unwrap_err()
            .to_string()
    };
    let nothing = of("@compute @workgroup_size(1) fn main() {}");
    assert!(
        nothing.contains("no `rays`") && nothing.contains("docs/study.md"),
        "{nothing}"
    );
    let two = of("@compute @workgroup_size(1) fn a() {} @compute @workgroup_size(1) fn b() {}");
    assert!(two.contains("several compute entry points (a, b)"), "{two}");
    assert!(of("@fragment fn a() {}").contains("no compute entry point"));
    let broken = of("fn a( {}");
    assert!(broken.contains("a.wgsl"), "{broken}");
}
