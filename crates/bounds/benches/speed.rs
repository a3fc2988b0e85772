//! How fast the evaluator is: a 32-layer parallax occlusion loop over 65,536 fragments, in every domain.
//!
//! Goals on two cores: at most 1 s in `f32` and 10 s in `accept`, in at most 1 GB. The harness is a plain clock: runs take seconds.
//! `cargo bench --profile dev -p bossage-bounds`.

use bossage_bounds::{
    Accept, AddressMode, Bindings, Domain, F32, F64, Interval, Limits, Program, Range, Sampler, StageInputs,
    Texture, run_fragment,
};
use std::io::Write;
use std::time::Instant;

const SHADER: &str = include_str!("parallax_occlusion.wgsl");
const SIDE: usize = 256;

fn height_map(n: u32) -> Texture {
    let height = |x: u32, y: u32| {
        0.5 + 0.25 * (x as f32 * 0.2).sin() + 0.25 * (y as f32 * 0.13 + x as f32 * 0.05).cos()
    };
    let texels: Vec<f32> = (0..n * n).map(|k| height(k % n, k / n)).collect();
    Texture::d2_floats(n, n, 1, &texels).unwrap_or_else(|e| panic!("{e}"))
}

fn run<D: Domain>(
    program: &Program,
    float: impl Fn(f64) -> D::Float,
    undecided: impl Fn(D::Float) -> bool,
) -> String {
    let mut uv = Vec::new();
    let mut view = Vec::new();
    for k in 0..SIDE * SIDE {
        let (x, y) = ((k % SIDE) as f64 / SIDE as f64, (k / SIDE) as f64 / SIDE as f64);
        uv.extend([float(f64::from(x as f32)), float(f64::from(y as f32))]);
        view.extend([float(0.8 * x - 0.4), float(0.5), float(0.6)]);
    }
    let inputs = StageInputs::<D>::new(SIDE * SIDE)
        .location(0, 2, &uv)
        .location(1, 3, &view);
    let mut bindings =
        Bindings::new()
            .texture(0, 0, height_map(256))
            .sampler(0, 1, Sampler::linear(AddressMode::Repeat));
    let start = Instant::now();
    let limits = Limits::default();
    let (out, outcome) =
        run_fragment(program, &mut bindings, &inputs, &limits).unwrap_or_else(|e| panic!("{e}"));
    let seconds = start.elapsed().as_secs_f64();
    let open = (0..SIDE * SIDE)
        .filter(|&k| out.location(0, k).is_some_and(|v| v.into_iter().any(&undecided)))
        .count();
    let counters = outcome.counters;
    format!(
        "{:8} {seconds:7.3} s  {:10} operations  {:8} fetches  {:8} forks  {open:6} open",
        D::NAME,
        counters.operations,
        counters.fetches,
        counters.forks
    )
}

fn peak_memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    status
        .lines()
        .find(|l| l.starts_with("VmHWM"))
        .unwrap_or("VmHWM unknown")
        .to_string()
}

fn main() {
    let module =
        naga::front::wgsl::parse_str(SHADER).unwrap_or_else(|e| panic!("{}", e.emit_to_string(SHADER)));
    let mut validator = naga::valid::Validator::new(
        naga::valid::ValidationFlags::all(),
        naga::valid::Capabilities::all(),
    );
    let info = validator
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(SHADER)));
    let program = Program::new(&module, &info, "main").unwrap_or_else(|e| panic!("{e}"));
    let is_open = |x: Interval| !x.flags.is_none();
    let mut out = std::io::stdout().lock();
    let lines = [
        run::<F32>(&program, |x| x, f64::is_nan),
        run::<F64>(&program, |x| x, f64::is_nan),
        run::<Accept>(&program, Interval::point, is_open),
        run::<Range>(&program, Interval::point, is_open),
        peak_memory(),
    ];
    for line in lines {
        writeln!(out, "{line}").unwrap_or_else(|e| panic!("{e}"));
    }
}
