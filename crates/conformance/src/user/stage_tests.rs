//! Vertex and fragment stages on the evaluator alone, and executors that lie.

use bossage_bounds::ranges::Declared;
use bossage_translate::{Shader, Source};

use super::{Execution, Executor, InProcess, Kept, OPERATIONS, Options, Request, run};
use crate::heat::Wanted;
use crate::report::{CaseResult, Report};
use crate::route::Route;
use crate::run::{Selection, Silent};
use crate::verdict::Verdict;

const SURFACE: &str = "
    struct Scene { clip: mat4x4f, tint: vec4f }
    @group(0) @binding(0) var<uniform> scene: Scene;
    @group(0) @binding(1) var map: texture_2d<f32>;
    @group(0) @binding(2) var linear: sampler;
    struct Varyings {
        @builtin(position) position: vec4f,
        @location(0) normal: vec3f,
        @location(1) uv: vec2f,
        @location(3) @interpolate(flat) joint: vec2u,
    }
    @vertex fn place(
        @location(0) at: vec3f, @location(1) normal: vec3f, @location(2) joint: vec2u, @builtin(vertex_index) index: u32,
    ) -> Varyings {
        return Varyings(scene.clip * vec4f(at, 1.0), normalize(normal), at.xy * 0.5, joint + vec2u(index));
    }
    @fragment fn shade(in: Varyings, @builtin(front_facing) front: bool) -> @location(0) vec4f {
        let slope = vec2f(dpdx(in.uv.x), dpdyFine(in.uv.y)) + fwidth(in.uv);
        let side = select(-1.0, 1.0, front);
        return textureSample(map, linear, in.uv) * scene.tint * (side * in.normal.z) + vec4f(slope, f32(in.joint.x), 0.0);
    }";

fn options() -> Options {
    Options {
        entry: None,
        filter: None,
        seed: 3,
        inputs: 8,
        workgroups: None,
        operations: OPERATIONS,
        attribute: Wanted::Nothing,
        corpus: None,
        original: None,
        arguments: Vec::new(),
    }
}

fn run_with(text: &str, ranges: Option<&str>, executor: &dyn Executor) -> Report {
    let shader = Shader::parse("surface.wgsl", &Source::Wgsl(text.to_owned())).unwrap();
    let declared = ranges.map(|text| Declared::parse("surface.ranges.toml", text).unwrap());
    let selection = Selection {
        routes: vec![Route::Embedded],
        ..Selection::default()
    };
    run(
        &shader,
        declared.as_ref(),
        &options(),
        &selection,
        executor,
        &mut Silent,
    )
    .unwrap()
}

fn case<'a>(report: &'a Report, entry: &str) -> &'a CaseResult {
    let wanted = |case: &&CaseResult| case.id.to_string().contains(&format!("ranges:entry={entry};"));
    report.cases.iter().find(wanted).unwrap()
}

/// Changes a word of a picture.
struct Lying {
    job: usize,
    picture: usize,
    word: usize,
    change: fn(u32) -> u32,
}

impl Executor for Lying {
    fn execute(&self, request: &Request) -> Execution {
        let mut execution = InProcess.execute(request);
        let Some(picture) = execution.done[self.job].get_mut(self.picture) else {
            return execution;
        };
        let (words, _) = picture.as_chunks_mut::<4>();
        words[self.word] = (self.change)(u32::from_le_bytes(words[self.word])).to_le_bytes();
        execution
    }
}

#[test]
fn both_stages_of_a_file_are_judged_each_by_itself() {
    let report = run_with(SURFACE, None, &InProcess);
    let (vertex, fragment) = (case(&report, "place"), case(&report, "shade"));
    assert_eq!(vertex.verdict, Verdict::Pass, "{vertex:?}");
    // Four vertices an input: a place, a normal, coordinates, two joints.
    assert_eq!((vertex.outputs, vertex.undecided), (8 * 4 * 11, 0));
    assert_eq!(fragment.verdict, Verdict::Pass, "{fragment:?}");
    // Four pixels an input: kept or not, and a colour.
    assert_eq!(fragment.outputs, 8 * 4 * 5);
    assert_eq!(fragment.undecided, 0, "{fragment:?}");
}

#[test]
fn a_wrong_pixel_and_a_wrong_vertex_are_refused_by_name() {
    // Pictures of the fragment stage: four inputs that arrived in the first pass, one in the second, then the colour.
    let off = Lying {
        job: 5,
        picture: 5,
        word: 13,
        change: |bits| (f32::from_bits(bits) + 0.01 * (1.0 + f32::from_bits(bits).abs())).to_bits(),
    };
    let report = run_with(SURFACE, None, &off);
    let fragment = case(&report, "shade");
    assert_eq!(
        (fragment.verdict, fragment.refused),
        (Verdict::Fail, 1),
        "{fragment:?}"
    );
    let worst = fragment.worst.as_ref().unwrap().to_string();
    for word in ["location(0).y at pixel (1, 1) at input 5", "normal = (", "uv = ("] {
        assert!(worst.contains(word), "{word} is not in\n{worst}");
    }
    let one_more = Lying {
        job: 2,
        picture: 3,
        word: 5,
        change: |bits| bits.wrapping_add(1),
    };
    let report = run_with(SURFACE, None, &one_more);
    let vertex = case(&report, "place");
    assert_eq!((vertex.verdict, vertex.refused), (Verdict::Fail, 1), "{vertex:?}");
    let worst = vertex.worst.as_ref().unwrap().to_string();
    assert!(worst.contains("joint.y of vertex 1 at input 2"), "{worst}");
}

/// An input that is said to have arrived otherwise makes an output wrong that was right.
#[test]
fn fragments_are_judged_at_the_inputs_that_arrived() {
    let moved = Lying {
        job: 1,
        picture: 1,
        word: 2,
        change: |bits| (1.0 - f32::from_bits(bits)).to_bits(),
    };
    let report = run_with(SURFACE, None, &moved);
    assert_eq!(case(&report, "shade").verdict, Verdict::Fail);
}

const MASKED: &str = "
    struct Kept { @location(1) colour: vec2f, @location(0) id: u32, @builtin(frag_depth) depth: f32 }
    @fragment fn cut(@location(0) height: f32, @builtin(position) at: vec4f) -> Kept {
        if height < 0.5 { discard; }
        return Kept(vec2f(height, at.x), u32(at.y) + 7u, height * 0.5);
    }";

#[test]
fn discards_depths_and_outputs_of_any_width_are_seen() {
    let report = run_with(MASKED, None, &InProcess);
    let cut = case(&report, "cut");
    assert_eq!(cut.verdict, Verdict::Pass, "{cut:?}");
    assert_eq!((cut.outputs, cut.undecided), (8 * 4 * 5, 0));
    // A fragment that should have been discarded, and one that should not.
    let targets = |request: &Request| {
        let passes = &request.companion.as_ref().unwrap().passes;
        passes.iter().map(|pass| pass.targets.len()).collect::<Vec<_>>()
    };
    struct Discards(bool, fn(&Request) -> Vec<usize>);
    impl Executor for Discards {
        fn execute(&self, request: &Request) -> Execution {
            assert_eq!((self.1)(request), [2, 3]);
            let mut execution = InProcess.execute(request);
            let sentinel = bossage_runner::SENTINEL_BITS.to_le_bytes();
            let is_cut = |job: &Vec<Vec<u8>>| job[2][..4] == sentinel;
            let (keep, throw) = (self.0, !self.0);
            let job = execution.done.iter_mut().find(|job| is_cut(job) == keep).unwrap();
            for picture in &mut job[2..] {
                if throw {
                    picture[..16].copy_from_slice(&sentinel.repeat(4));
                } else {
                    picture[..16].fill(0);
                }
            }
            execution
        }
    }
    for keep in [true, false] {
        let report = run_with(MASKED, None, &Discards(keep, targets));
        let cut = case(&report, "cut");
        assert_eq!(cut.verdict, Verdict::Fail, "{cut:?}");
        assert!(cut.refused >= 5, "{cut:?}");
    }
}

#[test]
fn outputs_that_fit_their_targets_are_drawn_as_they_are() {
    let text = "
        struct Kept { @location(2) colour: vec4f, @location(0) id: vec4u, @location(1) sign: vec4i }
        @fragment fn plain(@location(5) @interpolate(flat) n: i32) -> Kept {
            return Kept(vec4f(f32(n)), vec4u(u32(n & 0xff)), vec4i(-n));
        }";
    struct Looks;
    impl Executor for Looks {
        fn execute(&self, request: &Request) -> Execution {
            let passes = &request.companion.as_ref().unwrap().passes;
            assert_eq!(passes[1].targets, [Kept::Unsigned, Kept::Signed, Kept::Floats]);
            assert_eq!(request.entry, "plain");
            assert!(!request.wgsl.contains("bossage"), "the text is run as it is");
            InProcess.execute(request)
        }
    }
    let report = run_with(text, None, &Looks);
    let plain = case(&report, "plain");
    assert_eq!((plain.verdict, plain.undecided), (Verdict::Pass, 0), "{plain:?}");
}

#[test]
fn what_cannot_be_drawn_is_a_skip_with_its_reason() {
    let reason = |text: &str, entry: &str| {
        let report = run_with(text, None, &InProcess);
        let case = case(&report, entry);
        assert_eq!(case.verdict, Verdict::Skip, "{case:?}");
        case.reason.clone().unwrap()
    };
    let writes = "@group(0) @binding(0) var<storage, read_write> seen: array<u32>;
        @fragment fn main() -> @location(0) vec4f { seen[0] = 1u; return vec4f(); }";
    assert!(reason(writes, "main").contains("writes the buffer `seen`"));
    let nothing = "@fragment fn main() { }";
    assert!(reason(nothing, "main").contains("returns nothing"));
    let clips = "enable clip_distances;
        struct Out { @builtin(position) p: vec4f, @builtin(clip_distances) d: array<f32, 2> }
        @vertex fn main() -> Out { return Out(vec4f(), array<f32, 2>(1.0, 2.0)); }";
    assert!(reason(clips, "main").contains('d'));
}

#[test]
fn a_vertex_stage_that_never_ends_fails_with_its_line() {
    let text = "
        @vertex fn main(@location(0) x: f32) -> @builtin(position) vec4f {
            var y = x;
            loop { if y > 1e9 { break; } y = y * 0.5; }
            return vec4f(y);
        }";
    struct Answers;
    impl Executor for Answers {
        fn execute(&self, request: &Request) -> Execution {
            Execution {
                done: request.jobs.iter().map(|_| vec![vec![0; 64]]).collect(),
                stopped: None,
            }
        }
    }
    let report = run_with(text, None, &Answers);
    let reason = case(&report, "main").reason.clone().unwrap();
    assert!(
        reason.contains("surface.wgsl:4:") && reason.contains("--operations"),
        "{reason}"
    );
}

/// A component that one route gets wrong, in the colour of a fragment stage: it is refused there, disagrees there, and nowhere else.
#[test]
fn a_fault_of_one_route_is_named_on_that_route_alone() {
    struct Faulty;
    impl Executor for Faulty {
        fn execute(&self, request: &Request) -> Execution {
            let here = Request {
                route: "embedded".to_owned(),
                adapter: bossage_embedded::NAME.to_owned(),
                original: None,
                ..request.clone()
            };
            let mut execution = InProcess.execute(&here);
            if request.route == "glsl" {
                for job in &mut execution.done {
                    // Green and blue of the last picture, which is the colour, change places.
                    for pixel in job.last_mut().unwrap().as_chunks_mut::<16>().0 {
                        let (green, blue) = pixel.split_at_mut(8);
                        green[4..].swap_with_slice(&mut blue[..4]);
                    }
                }
            }
            execution
        }
    }
    let shader = Shader::parse("surface.wgsl", &Source::Wgsl(SURFACE.to_owned())).unwrap();
    let options = Options {
        entry: Some("shade".to_owned()),
        ..options()
    };
    let routes = [Route::Wgsl, Route::Spirv, Route::Glsl, Route::Embedded];
    let cells = routes.map(|route| (route, "one".to_owned()));
    let plan = &super::plan::plans(&shader, None, &options).unwrap()[0];
    let (results, _) = super::results_of(plan, &shader, &cells, &options, &Faulty).unwrap();
    for case in &results {
        let wanted = match case.route {
            Route::Glsl => Verdict::Fail,
            _ => Verdict::Pass,
        };
        assert_eq!(case.verdict, wanted, "{case:?}");
    }
    let generators = |route: Route| results.iter().filter(|case| case.route == route).count();
    assert_eq!((generators(Route::Glsl), generators(Route::Embedded)), (2, 1));
}
