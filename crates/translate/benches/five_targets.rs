//! One shader to five languages, as a ratio to naga's own work on the same text: parse, validate, and one call of each
//! writer, told as we tell them not to add checks of indices and loops. Goal: at most 1.15.
//!
//! Both sides run alternately, so that drift of the machine hits both; the ratio is of medians, and the spread is printed.
//! Run: `cargo bench -p bossage-translate --profile dev --bench five_targets`.

#![allow(clippy::print_stdout, reason = "a benchmark prints its result")]

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use bossage_translate::{EmitOptions, Shader, Source, Target, emit};
use naga::back::{glsl, hlsl, msl, spv, wgsl};
use naga::proc::BoundsCheckPolicies;
use naga::valid::{Capabilities, ValidationFlags, Validator};

const RUNS: usize = 201;

/// The fragment stage of the surface fixture alone, as permutations are.
fn permutation() -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/good/surface.wgsl");
    let text = std::fs::read_to_string(path).expect("the fixture is there");
    let start = text.find("@vertex").expect("a vertex stage");
    let end = text.find("fn relief").expect("the function behind it");
    format!("{}{}", &text[..start], &text[end..])
        .replace("@group(1) @binding(0) var<uniform> object: Object;", "")
}

fn ours(text: &str, options: &EmitOptions) -> usize {
    let shader = Shader::parse("bench.wgsl", &Source::Wgsl(text.to_owned())).expect("valid");
    Target::ALL
        .iter()
        .map(|target| emit(&shader, *target, options).expect("expressible"))
        .map(|emitted| emitted.files[0].contents.bytes().len())
        .sum()
}

fn naga_alone(text: &str) -> usize {
    let module = naga::front::wgsl::parse_str(text).expect("valid");
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .expect("valid");
    let spirv_options = spv::Options {
        flags: spv::WriterFlags::DEBUG,
        force_loop_bounding: false,
        ..spv::Options::default()
    };
    let words = spv::write_vec(&module, &info, &spirv_options, None).expect("spirv");
    let hlsl_options = hlsl::Options {
        restrict_indexing: false,
        force_loop_bounding: false,
        ..hlsl::Options::default()
    };
    let mut hlsl_text = String::new();
    hlsl::Writer::new(&mut hlsl_text, &hlsl_options, &hlsl::PipelineOptions::default())
        .write(&module, &info, None)
        .expect("hlsl");
    let options = msl::Options {
        lang_version: (2, 0),
        force_loop_bounding: false,
        per_entry_point_map: BTreeMap::new(),
        ..msl::Options::default()
    };
    let (msl_text, _) =
        msl::write_string(&module, &info, &options, &msl::PipelineOptions::default()).expect("msl");
    let glsl_text = naga_glsl(&module, &info);
    let wgsl_text = wgsl::write_string(&module, &info, wgsl::WriterFlags::empty()).expect("wgsl");
    words.len() * 4 + hlsl_text.len() + msl_text.len() + glsl_text.len() + wgsl_text.len()
}

fn naga_glsl(module: &naga::Module, info: &naga::valid::ModuleInfo) -> String {
    let options = glsl::Options {
        version: glsl::Version::Desktop(450),
        ..glsl::Options::default()
    };
    let pipeline = glsl::PipelineOptions {
        shader_stage: module.entry_points[0].stage,
        entry_point: module.entry_points[0].name.clone(),
        multiview: None,
    };
    let mut text = String::new();
    glsl::Writer::new(
        &mut text,
        module,
        info,
        &options,
        &pipeline,
        BoundsCheckPolicies::default(),
    )
    .expect("glsl")
    .write()
    .expect("glsl");
    text
}

fn timed(work: impl FnOnce() -> usize) -> Duration {
    let start = Instant::now();
    std::hint::black_box(work());
    start.elapsed()
}

fn quartiles(mut times: Vec<Duration>) -> [Duration; 3] {
    times.sort();
    [times[RUNS / 4], times[RUNS / 2], times[RUNS * 3 / 4]]
}

fn main() {
    let text = permutation();
    let options = EmitOptions::default();
    let (mut our_times, mut naga_times) = (Vec::new(), Vec::new());
    for _ in 0..RUNS {
        naga_times.push(timed(|| naga_alone(&text)));
        our_times.push(timed(|| ours(&text, &options)));
    }
    let (ours, naga) = (quartiles(our_times), quartiles(naga_times));
    println!(
        "naga alone: {:?} (quartiles {:?} to {:?})",
        naga[1], naga[0], naga[2]
    );
    println!(
        "ours:       {:?} (quartiles {:?} to {:?})",
        ours[1], ours[0], ours[2]
    );
    println!(
        "ratio:      {:.3} (goal: at most 1.15)",
        ours[1].as_secs_f64() / naga[1].as_secs_f64()
    );
}
