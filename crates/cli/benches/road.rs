//! What the road costs, with the goals beside the numbers.
//!
//! `cargo bench --profile dev -p bossage-cli` prints one table. Everything that is compared is measured in one run, turn and
//! turn about, so that a machine's mood hits both sides: times are medians with the smallest and the largest sample, ratios
//! are medians of the ratios of neighbouring samples.
//! Memory is the high-water mark of this process (`VmHWM`), which does all the work but the re-runs of the binary.

use std::collections::BTreeMap;
use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use bossage_assets::height_to_normal::{self, Bake};
use bossage_assets::{EdgeMode, HeightField, NormalCodec};
use bossage_shaders::{FeatureSet, Library, Lights, Stage, Transform};
use bossage_translate::{EmitOptions, Shader, Source, Target, emit, manifest};
use rayon::prelude::*;

#[expect(clippy::print_stdout, reason = "a benchmark's result is what it prints")]
fn main() {
    let library = Library::embedded().expect("the embedded library is whole");
    let mut table = Table::default();
    one_permutation(&library, &mut table);
    whole_index(&library, &mut table);
    no_op(&mut table);
    bake(&mut table);
    quick_study(&mut table);
    table.row("peak memory", peak_memory());
    println!("{}", table.0);
}

/// Samples of one thing.
struct Samples(Vec<Duration>);

impl Samples {
    fn sorted(&self) -> Vec<Duration> {
        let mut sorted = self.0.clone();
        sorted.sort();
        sorted
    }

    fn median(&self) -> Duration {
        self.sorted()[self.0.len() / 2]
    }

    fn spread(&self) -> String {
        let sorted = self.sorted();
        let ms = |time: &Duration| format!("{:.2}", time.as_secs_f64() * 1e3);
        format!(
            "{} ms ({}–{}, {} runs)",
            ms(&self.median()),
            ms(&sorted[0]),
            ms(&sorted[sorted.len() - 1]),
            sorted.len()
        )
    }
}

/// Measures several things turn and turn about, after one round that does not count.
fn measure<const N: usize>(runs: usize, mut things: [&mut dyn FnMut(); N]) -> [Samples; N] {
    let mut samples = [const { Samples(Vec::new()) }; N];
    for run in 0..=runs {
        for (thing, samples) in things.iter_mut().zip(&mut samples) {
            let start = Instant::now();
            thing();
            if run > 0 {
                samples.0.push(start.elapsed());
            }
        }
    }
    samples
}

/// The median over the rounds of one sample over the other of the same round.
fn ratio(a: &Samples, b: &Samples) -> f64 {
    let pairs = a.0.iter().zip(&b.0);
    let mut ratios: Vec<f64> = pairs.map(|(a, b)| a.as_secs_f64() / b.as_secs_f64()).collect();
    ratios.sort_by(f64::total_cmp);
    ratios[ratios.len() / 2]
}

/// The printed table.
#[derive(Default)]
struct Table(String);

impl Table {
    fn row(&mut self, what: &str, value: impl std::fmt::Display) {
        self.0.push_str(&format!("{what:46} {value}\n"));
    }

    fn goal(&mut self, what: &str, value: f64, limit: f64, unit: &str) {
        let verdict = if value <= limit { "met" } else { "MISSED" };
        self.row(what, format!("{value:.2}{unit}, goal ≤ {limit}{unit}: {verdict}"));
    }
}

/// The permutation with every effect on.
fn richest() -> FeatureSet {
    FeatureSet {
        lights: Lights::Many,
        specular: true,
        transform: Transform::General,
        ..FeatureSet::default()
    }
    .all_effects()
}

fn one_permutation(library: &Library, table: &mut Table) {
    let modules = [Stage::Vertex, Stage::Fragment].map(|stage| {
        let assembled = library
            .assemble_surface(&richest(), stage)
            .expect("every permutation assembles");
        (assembled.name, assembled.wgsl)
    });
    let ours = |with_manifest: bool| {
        for (name, wgsl) in &modules {
            let shader = Shader::parse(name, &Source::Wgsl(wgsl.clone())).expect("the library is valid");
            let options = EmitOptions::default();
            let emitted: Vec<_> = Target::ALL
                .iter()
                .map(|target| emit(&shader, *target, &options).expect("every target takes it"))
                .collect();
            if with_manifest {
                black_box(manifest(&shader, &options, &emitted));
            }
            black_box(emitted);
        }
    };
    let [emitted, with_manifest, naga] = measure(
        101,
        [&mut || ours(false), &mut || ours(true), &mut || {
            modules.iter().for_each(|(_, wgsl)| plain_naga::all(wgsl))
        }],
    );
    table.row("one permutation, two stages, five targets", emitted.spread());
    table.row("  the same with its manifest", with_manifest.spread());
    table.row("  naga: parse + validate + write", naga.spread());
    table.goal("  ratio to naga", ratio(&emitted, &naga), 1.15, "");
    table.row(
        "  ratio to naga, with the manifest",
        format!("{:.2}", ratio(&with_manifest, &naga)),
    );
}

/// What naga does by itself with its own defaults.
mod plain_naga {
    use std::hint::black_box;

    use naga::back::{glsl, hlsl, msl, spv, wgsl};
    use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
    use naga::{Module, ShaderStage};

    pub(super) fn all(text: &str) {
        let module = naga::front::wgsl::parse_str(text).expect("the library parses");
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
        let info = validator.validate(&module).expect("the library is valid");
        black_box(spv::write_vec(&module, &info, &spv::Options::default(), None).expect("SPIR-V"));
        black_box(hlsl(&module, &info));
        black_box(msl(&module, &info));
        black_box(glsl(&module, &info));
        black_box(wgsl::write_string(&module, &info, wgsl::WriterFlags::empty()).expect("WGSL"));
    }

    fn hlsl(module: &Module, info: &ModuleInfo) -> String {
        let options = hlsl::Options {
            fake_missing_bindings: true,
            ..hlsl::Options::default()
        };
        let pipeline = hlsl::PipelineOptions::default();
        let mut text = String::new();
        hlsl::Writer::new(&mut text, &options, &pipeline)
            .write(module, info, None)
            .expect("HLSL");
        text
    }

    fn msl(module: &Module, info: &ModuleInfo) -> String {
        let options = msl::Options {
            fake_missing_bindings: true,
            lang_version: (2, 0),
            ..msl::Options::default()
        };
        msl::write_string(module, info, &options, &msl::PipelineOptions::default())
            .expect("MSL")
            .0
    }

    fn glsl(module: &Module, info: &ModuleInfo) -> String {
        let options = glsl::Options {
            version: glsl::Version::Desktop(450),
            ..glsl::Options::default()
        };
        let entry = &module.entry_points[0];
        assert!(matches!(entry.stage, ShaderStage::Vertex | ShaderStage::Fragment));
        let pipeline = glsl::PipelineOptions {
            shader_stage: entry.stage,
            entry_point: entry.name.clone(),
            multiview: None,
        };
        let mut text = String::new();
        let policies = naga::proc::BoundsCheckPolicies::default();
        glsl::Writer::new(&mut text, module, info, &options, &pipeline, policies)
            .expect("GLSL")
            .write()
            .expect("GLSL");
        text
    }
}

fn whole_index(library: &Library, table: &mut Table) {
    let sets = FeatureSet::reachable();
    let mut stages = BTreeMap::new();
    for set in &sets {
        stages.entry(set.vertex().name()).or_insert((*set, Stage::Vertex));
        stages
            .entry(set.fragment().name())
            .or_insert((*set, Stage::Fragment));
    }
    let stages: Vec<(FeatureSet, Stage)> = stages.into_values().collect();
    let one = |(set, stage): &(FeatureSet, Stage)| {
        let assembled = library
            .assemble_surface(set, *stage)
            .expect("every permutation assembles");
        let shader =
            Shader::parse(&assembled.name, &Source::Wgsl(assembled.wgsl)).expect("the library is valid");
        let options = EmitOptions::default();
        let emitted: Vec<_> = Target::ALL
            .iter()
            .map(|target| emit(&shader, *target, &options).expect("every target takes it"))
            .collect();
        manifest(&shader, &options, &emitted).entries.len()
    };
    let [single, parallel] = measure(
        5,
        [
            &mut || {
                black_box(stages.iter().map(one).sum::<usize>());
            },
            &mut || {
                black_box(stages.par_iter().map(one).sum::<usize>());
            },
        ],
    );
    table.row(
        &format!(
            "index: {} permutations, {} stages, one core",
            sets.len(),
            stages.len()
        ),
        single.spread(),
    );
    table.row(
        &format!("  {} cores", rayon::current_num_threads()),
        parallel.spread(),
    );
    table.row("  speed-up", format!("{:.2}", ratio(&single, &parallel)));
}

fn no_op(table: &mut Table) {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/brick_wall.toml");
    let out = tempfile::tempdir().expect("a temporary folder");
    let mut call = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_bossage"));
        let output = command
            .arg("emit")
            .arg(&scene)
            .arg("-o")
            .arg(out.path())
            .output()
            .expect("the binary starts");
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
    };
    let [samples] = measure(31, [&mut call]);
    table.row("emit again, nothing changed (process included)", samples.spread());
    table.goal("  median", samples.median().as_secs_f64() * 1e3, 50.0, " ms");
}

/// The first look at what accuracy costs, with the driver that is there.
fn quick_study(table: &mut Table) {
    let out = tempfile::tempdir().expect("a temporary folder");
    let start = Instant::now();
    let mut command = Command::new(env!("CARGO_BIN_EXE_bossage"));
    command
        .args(["study", "--quick", "--quiet", "-o"])
        .arg(out.path());
    let output = command.output().expect("the binary starts");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    table.goal(
        "study --quick, once (process included)",
        start.elapsed().as_secs_f64(),
        60.0,
        " s",
    );
}

fn bake(table: &mut Table) {
    const SIDE: u32 = 2048;
    let field = HeightField::from_fn(SIDE, SIDE, |x, y| ((x * 31) ^ (y * 17)) as f32 % 256.0 / 255.0);
    let bake =
        Bake::central(&field, [0.04; 2], EdgeMode::Wrap, NormalCodec::Unorm).expect("an ordinary scale");
    let mut copy = vec![0.0_f32; field.texels.len()];
    let [baked, copied] = measure(
        21,
        [
            &mut || {
                black_box(height_to_normal::bake(&field, &bake));
            },
            &mut || {
                copy.copy_from_slice(black_box(&field.texels));
                black_box(&copy);
            },
        ],
    );
    let texels = f64::from(SIDE) * f64::from(SIDE);
    let rate = |samples: &Samples| texels / samples.median().as_secs_f64() / 1e6;
    table.row(&format!("height_to_normal, {SIDE} x {SIDE}"), baked.spread());
    table.row("  million texels a second", format!("{:.0}", rate(&baked)));
    table.row("  a plain copy of the same bytes", copied.spread());
    table.row("  ratio to the copy", format!("{:.2}", ratio(&baked, &copied)));
}

/// The most memory this process ever held, in MB, where the system tells.
fn peak_memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line
        .and_then(|rest| rest.trim().strip_suffix(" kB"))
        .and_then(|number| number.parse::<f64>().ok());
    match kilobytes.map(|kilobytes| kilobytes / 1024.0) {
        Some(megabytes) if megabytes <= 500.0 => format!("{megabytes:.0} MB, goal ≤ 500 MB: met"),
        Some(megabytes) => format!("{megabytes:.0} MB, goal ≤ 500 MB: MISSED"),
        None => "not told by this system".to_owned(),
    }
}
