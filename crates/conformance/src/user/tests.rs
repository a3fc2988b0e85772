//! User's shaders on the evaluator alone, and executors that lie: what must be caught is put in on purpose.

use bossage_bounds::ranges::Declared;
use bossage_translate::{Shader, Source};

use super::{Execution, Executor, InProcess, OPERATIONS, Options, Request, Stop, run};
use crate::error::Error;
use crate::heat::Wanted;
use crate::report::{CaseResult, Report};
use crate::route::Route;
use crate::run::{Selection, Silent};
use crate::verdict::Verdict;

const SCALE: &str = "
    struct Settings { factor: f32, offset: vec2f, steps: u32 }
    @group(0) @binding(0) var<uniform> settings: Settings;
    @group(0) @binding(1) var<storage, read> source: array<vec3f>;
    @group(0) @binding(2) var<storage, read_write> result: array<vec2f>;
    @group(0) @binding(3) var<storage, read_write> steps: array<u32>;
    @compute @workgroup_size(8) fn scale(@builtin(global_invocation_id) id: vec3u) {
        if id.x >= arrayLength(&source) { return; }
        let v = source[id.x];
        result[id.x] = v.xy * settings.factor + settings.offset * v.z;
        steps[id.x] = id.x * settings.steps;
    }";

const RANGES: &str = "
schema = 1
[ranges]
\"settings.factor\" = { lo = 1, hi = 2 }
\"settings.offset\" = { lo = -1, hi = 1 }
source = { size = 20 }
\"source[]\" = { lo = -10, hi = 10 }
result = { size = 20 }
";

fn shader(text: &str) -> Shader {
    Shader::parse("folder/scale.wgsl", &Source::Wgsl(text.to_owned())).unwrap()
}

fn options() -> Options {
    Options {
        entry: None,
        filter: None,
        seed: 3,
        inputs: 6,
        workgroups: None,
        operations: OPERATIONS,
        attribute: Wanted::Widest,
        corpus: None,
        original: None,
        arguments: vec!["--shader".to_owned(), "folder/scale.wgsl".to_owned()],
    }
}

fn embedded() -> Selection {
    Selection {
        routes: vec![Route::Embedded],
        ..Selection::default()
    }
}

fn run_with(text: &str, ranges: Option<&str>, executor: &dyn Executor) -> Result<Report, Error> {
    let declared = ranges.map(|text| Declared::parse("scale.ranges.toml", text).unwrap());
    run(
        &shader(text),
        declared.as_ref(),
        &options(),
        &embedded(),
        executor,
        &mut Silent,
    )
}

fn ranges_case(report: &Report) -> &CaseResult {
    report
        .cases
        .iter()
        .find(|case| case.id.generator == "ranges")
        .unwrap()
}

/// Changes a word of what came back.
struct Lying {
    job: usize,
    buffer: usize,
    word: usize,
    change: fn(u32) -> u32,
}

impl Executor for Lying {
    fn execute(&self, request: &Request) -> Execution {
        let mut execution = InProcess.execute(request);
        let bytes = &mut execution.done[self.job][self.buffer];
        let (words, _) = bytes.as_chunks_mut::<4>();
        words[self.word] = (self.change)(u32::from_le_bytes(words[self.word])).to_le_bytes();
        execution
    }
}

#[test]
fn a_shader_is_judged_over_its_own_ir() {
    let report = run_with(SCALE, Some(RANGES), &InProcess).unwrap();
    let case = ranges_case(&report);
    assert_eq!(case.verdict, Verdict::Pass, "{case:?}");
    assert_eq!(case.id.to_string(), "scale/ranges:entry=scale;n=6;seed=3");
    // 20 pairs of floats and 20 integers; enough workgroups of 8 for all of them.
    assert_eq!((case.inputs, case.outputs, case.undecided), (6, 6 * 60, 0));
    assert!(case.rerun().contains("--shader folder/scale.wgsl"));
}

#[test]
fn a_wrong_result_is_named_with_the_inputs_that_lead_to_it() {
    let lying = Lying {
        job: 4,
        buffer: 0,
        word: 2 * 13 + 1,
        change: |bits| (f32::from_bits(bits) * 1.001 + 0.001).to_bits(),
    };
    let report = run_with(SCALE, Some(RANGES), &lying).unwrap();
    let case = ranges_case(&report);
    assert_eq!((case.verdict, case.refused), (Verdict::Fail, 1), "{case:?}");
    let text = case.worst.as_ref().unwrap().to_string();
    for word in ["result[13].y at input 4", "source[13] = (", "formula", "allowed"] {
        assert!(text.contains(word), "{word} is not in\n{text}");
    }
    assert!(
        text.find("source[13]") < text.find("settings.factor"),
        "what belongs to the output comes first:\n{text}"
    );
}

#[test]
fn integers_are_exact() {
    let lying = Lying {
        job: 1,
        buffer: 1,
        word: 7,
        change: |bits| bits.wrapping_add(1),
    };
    let report = run_with(SCALE, Some(RANGES), &lying).unwrap();
    let case = ranges_case(&report);
    assert_eq!((case.verdict, case.refused), (Verdict::Fail, 1), "{case:?}");
    assert!(case.worst.as_ref().unwrap().to_string().contains("steps[7]"));
}

#[test]
fn an_output_that_was_never_written_is_found() {
    let lying = Lying {
        job: 2,
        buffer: 0,
        word: 0,
        change: |_| 23136f32.to_bits(),
    };
    let report = run_with(SCALE, Some(RANGES), &lying).unwrap();
    let reason = ranges_case(&report).reason.clone().unwrap();
    assert!(reason.contains("did not write"), "{reason}");
    // What the shader itself leaves alone is no mistake.
    let sparse = SCALE.replace("result[id.x] =", "if id.x == 3 { return; } result[id.x] =");
    let report = run_with(&sparse, Some(RANGES), &InProcess).unwrap();
    assert_eq!(ranges_case(&report).verdict, Verdict::Pass);
}

/// Routes against each other, by an executor that answers as another machine would.
#[test]
fn routes_that_disagree_are_named() {
    struct Other;
    impl Executor for Other {
        fn execute(&self, request: &Request) -> Execution {
            let lies = request.route == "wgsl";
            let here = Request {
                route: "embedded".to_owned(),
                adapter: bossage_embedded::NAME.to_owned(),
                ..request.clone()
            };
            let mut execution = InProcess.execute(&here);
            if lies {
                execution.done[0][1][0] ^= 1;
            }
            execution
        }
    }
    let shader = shader(SCALE);
    let declared = Declared::parse("scale.ranges.toml", RANGES).unwrap();
    let cells = [Route::Wgsl, Route::Spirv, Route::Embedded].map(|route| (route, "one".to_owned()));
    let plan = &super::plan::plans(&shader, Some(&declared), &options()).unwrap()[0];
    let (results, _) = super::results_of(plan, &shader, &cells, &options(), &Other).unwrap();
    let verdict = |generator: &str, route: Route| {
        results
            .iter()
            .find(|case| case.id.generator == generator && case.route == route)
            .map(|case| case.verdict)
    };
    assert_eq!(verdict("agreement", Route::Wgsl), Some(Verdict::Fail));
    assert_eq!(verdict("agreement", Route::Spirv), Some(Verdict::Pass));
    assert_eq!(
        verdict("agreement", Route::Embedded),
        None,
        "the others are compared with it"
    );
    assert_eq!(verdict("ranges", Route::Wgsl), Some(Verdict::Fail));
    let case = results
        .iter()
        .find(|case| case.id.generator == "agreement" && case.route == Route::Wgsl)
        .unwrap();
    let text = case.worst.as_ref().unwrap().to_string();
    for word in [
        "steps[0] at input 0",
        "against",
        "from embedded on one",
        "allowed",
    ] {
        assert!(text.contains(word), "{word} is not in\n{text}");
    }
}

#[test]
fn what_ends_early_is_a_verdict_and_what_a_machine_lacks_a_skip() {
    struct Ends(Stop);
    impl Executor for Ends {
        fn execute(&self, request: &Request) -> Execution {
            let mut execution = InProcess.execute(request);
            execution.done.truncate(2);
            execution.stopped = Some(self.0.clone());
            execution
        }
    }
    let hang = Ends(Stop::Failed("input 2: it did not end".to_owned()));
    let report = run_with(SCALE, Some(RANGES), &hang).unwrap();
    assert_eq!(ranges_case(&report).verdict, Verdict::Fail);
    assert_eq!(ranges_case(&report).inputs, 2, "what came before is counted");
    let lacks = Ends(Stop::Lacks("it has no f16".to_owned()));
    let report = run_with(SCALE, Some(RANGES), &lacks).unwrap();
    assert_eq!(ranges_case(&report).verdict, Verdict::Skip);
    assert!(
        !report.is_ok(),
        "a report of nothing but skips is not one that passed"
    );
}

#[test]
fn a_shader_that_never_ends_fails_with_its_line() {
    let text = "
        @group(0) @binding(0) var<storage, read_write> result: array<f32>;
        @compute @workgroup_size(1) fn main() {
            loop { if result[0] < -1e9 { break; } }
        }";
    let report = run_with(text, None, &InProcess).unwrap();
    let case = ranges_case(&report);
    assert_eq!(case.verdict, Verdict::Skip, "our own evaluator gives up");
    let silent = |request: &Request| Execution {
        done: request
            .jobs
            .iter()
            .map(|job| vec![job.buffers[0].bytes.clone()])
            .collect(),
        stopped: None,
    };
    struct Fn<F>(F);
    impl<F: std::ops::Fn(&Request) -> Execution> Executor for Fn<F> {
        fn execute(&self, request: &Request) -> Execution {
            (self.0)(request)
        }
    }
    let report = run_with(text, None, &Fn(silent)).unwrap();
    let case = ranges_case(&report);
    let reason = case.reason.as_deref().unwrap();
    assert_eq!(case.verdict, Verdict::Fail);
    for word in ["folder/scale.wgsl:4:", "1048576 operations", "--operations"] {
        assert!(reason.contains(word), "{word} is not in\n{reason}");
    }
}

#[test]
fn outputs_that_the_rules_leave_open_are_counted_and_a_warning_where_none_is_left() {
    let text = "
        @group(0) @binding(0) var<storage, read> a: array<f32>;
        @group(0) @binding(1) var<storage, read_write> result: array<f32>;
        @compute @workgroup_size(16) fn main(@builtin(local_invocation_index) i: u32) {
            result[i] = a[i] / (a[i] - a[i]);
        }";
    let report = run_with(text, None, &InProcess).unwrap();
    let case = ranges_case(&report);
    assert_eq!(case.undecided, case.outputs);
    assert_eq!(case.verdict, Verdict::Warn);
}

#[test]
fn what_is_wrong_with_the_call_is_said() {
    let error = |text: &str, ranges: Option<&str>, entry: Option<&str>| {
        let declared = ranges.map(|text| Declared::parse("scale.ranges.toml", text).unwrap());
        let options = Options {
            entry: entry.map(str::to_owned),
            ..options()
        };
        run(
            &shader(text),
            declared.as_ref(),
            &options,
            &embedded(),
            &InProcess,
            &mut Silent,
        )
        .unwrap_err()
        .to_string()
    };
    let misfit = error(
        SCALE,
        Some("schema = 1\n[ranges]\n\"setings.factor\" = { lo = 0, hi = 1 }\n"),
        None,
    );
    for word in ["scale.ranges.toml:3:", "setings.factor", "did you mean"] {
        assert!(misfit.contains(word), "{word} is not in\n{misfit}");
    }
    let unit = error(
        SCALE,
        Some("schema = 1\n[ranges]\n\"settings.factor\" = { unit = true }\n"),
        None,
    );
    assert!(unit.contains("scale.ranges.toml:3:"), "{unit}");
    let unknown = error(SCALE, None, Some("scala"));
    assert!(
        unknown.contains("no entry point `scala`") && unknown.contains("scale (compute)"),
        "{unknown}"
    );
}

#[test]
fn textures_are_sampled_with_seeded_texels() {
    let text = "
        @group(0) @binding(0) var map: texture_2d<f32>;
        @group(0) @binding(1) var linear: sampler;
        @group(0) @binding(2) var sky: texture_cube<f32>;
        @group(0) @binding(3) var<storage, read> uvs: array<vec2f>;
        @group(0) @binding(4) var<storage, read_write> result: array<vec4f>;
        @compute @workgroup_size(16) fn main(@builtin(local_invocation_index) i: u32) {
            result[i] = textureSampleLevel(map, linear, uvs[i], 0.0)
                + textureSampleLevel(sky, linear, vec3f(uvs[i], 1.0), 0.0);
        }";
    let case = run_with(text, None, &InProcess).unwrap();
    let case = ranges_case(&case);
    assert_eq!(case.verdict, Verdict::Pass, "{case:?}");
    assert_eq!(case.undecided, 0);
    let many = text.replace(
        "var map: texture_2d<f32>",
        "var map: texture_multisampled_2d<f32>",
    );
    let many = many.replace(
        "textureSampleLevel(map, linear, uvs[i], 0.0)",
        "textureLoad(map, vec2u(uvs[i]), 0)",
    );
    let skipped = run_with(&many, None, &InProcess).unwrap();
    let reason = ranges_case(&skipped).reason.clone().unwrap();
    assert!(reason.contains("`map` is a multisampled texture"), "{reason}");
}

/// `log2` in [0.5, 2] has an absolute error of 2^-21; the line beside it rounds once.
#[test]
fn the_line_that_dominates_a_bound_is_hot() {
    let text = "
@group(0) @binding(0) var<storage, read> a: array<f32>;
@group(0) @binding(1) var<storage, read_write> result: array<f32>;
@compute @workgroup_size(16) fn main(@builtin(local_invocation_index) i: u32) {
    let rough = log2(a[i]);
    let fine = a[i] * 1.25;
    result[i] = rough + fine;
}";
    let ranges = "schema = 1\n[ranges]\na = { lo = 0.9, hi = 1.1 }\n";
    let report = run_with(text, Some(ranges), &InProcess).unwrap();
    let share = |report: &Report, line: usize| report.heats[0].lines[line - 1].share.unwrap_or(0.0);
    assert!(
        share(&report, 5) > 0.5 && share(&report, 6) < 0.25,
        "{:?}",
        report.heats
    );
    let swapped = text
        .replace("log2(a[i])", "a[i] * 1.25 ")
        .replace("fine = a[i] * 1.25", "fine = log2(a[i])");
    let report = run_with(&swapped, Some(ranges), &InProcess).unwrap();
    assert!(
        share(&report, 6) > 0.5 && share(&report, 5) < 0.25,
        "{:?}",
        report.heats
    );
    let page = crate::report::html::write(&report);
    for word in [
        "Where the error bound comes from",
        "--share:",
        "nothing computed",
        "scope=\"row\"",
    ] {
        assert!(page.contains(word), "{word}");
    }
}

/// What is wrong at a replayed input alone is refused there alone.
#[test]
fn hard_inputs_are_replayed_after_the_chosen_ones() {
    let declared = Declared::parse("scale.ranges.toml", RANGES).unwrap();
    let at = |plan: &super::Plan| {
        let ready = plan.ready.as_ref().unwrap();
        let [inputs, texels] = super::Found::tables(&ready.inputs, &ready.points[2][0]);
        super::Found {
            entry: plan.entry.clone(),
            goal: crate::hunt::Goal::Error,
            output: "result[0].x".to_owned(),
            ulps: 3.0,
            seed: 3,
            inputs,
            texels,
        }
    };
    let plan = &super::plan::plans(&shader(SCALE), Some(&declared), &options()).unwrap()[0];
    let mut corpus = super::Corpus::new("scale.corpus.toml", "scale");
    corpus.merge(vec![at(plan)]);
    let corpus = super::Corpus::parse("scale.corpus.toml", &corpus.text()).unwrap();
    let run_with = |corpus: super::Corpus, ranges: &str, executor: &dyn Executor| {
        let options = Options {
            corpus: Some(corpus),
            ..options()
        };
        let declared = Declared::parse("scale.ranges.toml", ranges).unwrap();
        run(
            &shader(SCALE),
            Some(&declared),
            &options,
            &embedded(),
            executor,
            &mut Silent,
        )
    };
    let verdicts = |report: &Report| {
        let of = |generator: &str| {
            report
                .cases
                .iter()
                .find(|case| case.id.generator == generator)
                .unwrap()
        };
        let (ranges, corpus) = (of("ranges"), of("corpus"));
        assert_eq!(corpus.id.to_string(), "scale/corpus:entry=scale;n=1");
        assert_eq!((ranges.inputs, corpus.inputs), (6, 1));
        (ranges.verdict, corpus.verdict)
    };
    let report = run_with(corpus.clone(), RANGES, &InProcess).unwrap();
    assert_eq!(verdicts(&report), (Verdict::Pass, Verdict::Pass));
    let lying = Lying {
        job: 6,
        buffer: 1,
        word: 0,
        change: |bits| bits.wrapping_add(1),
    };
    let report = run_with(corpus.clone(), RANGES, &lying).unwrap();
    assert_eq!(verdicts(&report), (Verdict::Pass, Verdict::Fail));
    // What fits no longer is said, with the way out.
    for (from, to, word) in [
        (
            "size = 20 }\n\"source[]\"",
            "size = 19 }\n\"source[]\"",
            "source[19]",
        ),
        ("lo = 1, hi = 2", "lo = 5, hi = 6", "settings.factor"),
    ] {
        assert!(RANGES.contains(from), "{from}");
        let error = run_with(corpus.clone(), &RANGES.replace(from, to), &InProcess);
        let error = error.unwrap_err().to_string();
        for word in ["scale.corpus.toml", "found number 1", word, "hunt again"] {
            assert!(error.contains(word), "{word} is not in\n{error}");
        }
    }
}

/// A texel that is stored wrongly is refused by its name. A product may be either neighbour of the exact one, which the last bit tells apart;
/// two units off is neither.
#[test]
fn stored_texels_are_judged() {
    let text = "
        @group(0) @binding(0) var<storage, read> a: array<f32>;
        @group(0) @binding(1) var image: texture_storage_2d<rg32float, write>;
        @compute @workgroup_size(4, 4) fn main(@builtin(local_invocation_id) id: vec3u) {
            textureStore(image, id.xy, vec4f(a[id.x], a[id.y] * 3.0, 0.0, 0.0));
        }";
    let report = run_with(text, None, &InProcess).unwrap();
    assert_eq!(
        (ranges_case(&report).verdict, ranges_case(&report).outputs),
        (Verdict::Pass, 6 * 32)
    );
    let lying = Lying {
        job: 1,
        buffer: 0,
        word: 13,
        change: |bits| bits ^ 2,
    };
    let report = run_with(text, None, &lying).unwrap();
    let case = ranges_case(&report);
    assert_eq!((case.verdict, case.refused), (Verdict::Fail, 1));
    let worst = case.worst.as_ref().unwrap().to_string();
    assert!(worst.contains("image[2, 1].g at input 1"), "{worst}");
}

/// The route `spirv` runs a file of SPIR-V as it is, the others what is written for them.
#[test]
fn a_file_of_spirv_is_passed_through() {
    let emitted = bossage_translate::emit(
        &shader(SCALE),
        bossage_translate::Target::Spirv,
        &bossage_translate::EmitOptions::default(),
    )
    .unwrap();
    let bossage_translate::Contents::Binary(bytes) = &emitted.files[0].contents else {
        panic!("SPIR-V is binary");
    };
    let read = Shader::parse("scale.spv", &Source::Spirv(bytes.clone())).unwrap();
    let options = Options {
        original: Some(bytes.clone()),
        ..options()
    };
    let plan = &super::plan::plans(&read, None, &options).unwrap()[0];
    let ready = plan.ready.as_ref().unwrap();
    let original = |route: Route| ready.request("scale", route, "any").original;
    assert_eq!(original(Route::Spirv).unwrap().bytes, *bytes);
    assert_eq!(original(Route::Wgsl), None);
}
