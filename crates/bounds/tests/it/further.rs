//! The rarer parts of the IR, against numbers worked out by hand: built-ins, 16-bit integers, arrays of bindings, every format of
//! storage textures, and what only other languages than WGSL can say.

use crate::common::{dispatch, glsl, program, source};
use bossage_bounds::{
    Accept, AddressMode, Bindings, Domain, F32, Limits, Program, Sampler, Scalar, Slot, StageInputs,
    TexelFormat, Texture, run_compute, run_fragment, run_vertex,
};
use naga::StorageFormat;

#[test]
fn fragment_built_ins_and_interpolations() {
    let inputs = StageInputs::<F32>::new(4)
        .index(Slot::PrimitiveIndex, &[7; 4])
        .index(Slot::ViewIndex, &[1, 1, 1, 1])
        .set(
            Slot::Barycentric,
            3,
            [0.25, 0.5, 0.25]
                .repeat(4)
                .into_iter()
                .map(Scalar::Float)
                .collect(),
        )
        .location(0, 1, &[1.0; 4])
        .location(1, 1, &[2.0; 4])
        .location(2, 1, &[3.0; 4])
        .set(Slot::Location(3, 0), 1, vec![Scalar::Int(-4, -4); 4])
        .location(4, 1, &[0.5, 1.5, 2.5, 3.5]);
    let program = program(&source("built_ins"));
    let (out, _) = run_fragment(&program, &mut Bindings::new(), &inputs, &Limits::default()).unwrap();
    for k in 0..4 {
        assert_eq!(out.location(0, k).unwrap(), [17.0, 0.5, 2.0, k as f64 + 0.5]);
    }
}

#[test]
fn clip_distances_leave_the_vertex_stage() {
    let inputs = StageInputs::<F32>::new(2).location(0, 1, &[0.5, 3.0]);
    let program = program(&source("clipped"));
    let (out, _) = run_vertex(&program, &mut Bindings::new(), &inputs, &Limits::default()).unwrap();
    let planes = |k| out.columns[&Slot::ClipDistances].floats(k).unwrap();
    assert_eq!([planes(0), planes(1)], [vec![-0.5, 1.5], vec![2.0, -1.0]]);
}

#[test]
fn short_integers_wrap_at_sixteen_bits() {
    let (x, y) = (-7000i32, 30000i32);
    let b = Bindings::<F32>::new()
        .words(0, 0, &[x as u32, y as u32])
        .words(0, 1, &[0; 4]);
    let got = dispatch(&source("narrow"), b).0.read_ints(0, 1).unwrap();
    let (short, word) = (x as i16, y as u16);
    let want = [
        i128::from(short.wrapping_mul(7)),
        i128::from(word.wrapping_add(40000)),
        i128::from(short / 3) + i128::from(short % 3),
        -5 + 1,
    ];
    assert_eq!(got, want);
}

fn array_bindings<D: Domain>() -> Bindings<D> {
    let mut b = Bindings::<D>::new().floats(0, 2, &[0.0; 4]);
    let picture = |x: f32| Texture::d2_floats(1, 1, 1, &[x]).unwrap();
    b.textures.insert((0, 0), vec![picture(3.0), picture(5.0)]);
    let nearest = Sampler::nearest(AddressMode::Repeat);
    b.samplers.insert((0, 1), vec![nearest.clone(), nearest]);
    b
}

#[test]
fn arrays_of_bindings_are_indexed() {
    let (b, _) = dispatch::<F32>(&source("arrays"), array_bindings());
    assert_eq!(b.read_floats(0, 2).unwrap(), [3.0, 5.0, 3.0, 5.0]);
    let (b, _) = dispatch::<Accept>(&source("arrays"), array_bindings());
    for (x, want) in b.read_floats(0, 2).unwrap().iter().zip([3.0, 5.0, 3.0, 5.0]) {
        assert!(x.contains(want) && !x.is_indeterminate(), "{x:?}");
    }
}

/// x = 2, y = 4 in `corpus/glsl.comp`.
const GLSL: [f64; 9] = [1.0, 1.0, 10.0, 4.0 / 7.0, -0.125, -0.25, 0.0, 0.0, 2.0];

#[test]
fn what_only_glsl_can_say() {
    let (module, info) = glsl(&source("glsl"));
    let program = Program::new(&module, &info, "main").unwrap();
    let run = |inputs: &[f32]| {
        let mut b = Bindings::<F32>::new()
            .floats(0, 0, inputs)
            .floats(0, 1, &[9.0; 9]);
        run_compute(&program, &mut b, [1, 1, 1], &Limits::default()).unwrap();
        b.read_floats(0, 1).unwrap()
    };
    let got = run(&[2.0, 4.0]);
    for (k, (got, want)) in got.iter().zip(GLSL).enumerate() {
        assert!((got - want).abs() <= 1e-6, "o[{k}] = {got}, want {want}");
    }
    // One of two holds; a NaN is one, an infinity is one.
    let odd = run(&[2.0, 1.0]);
    assert_eq!(odd[..2], [0.0, 1.0]);
    assert_eq!(run(&[f32::NAN, f32::INFINITY])[6..8], [1.0, 1.0]);
    let mut wide = Bindings::<Accept>::new()
        .floats(0, 0, &[2.0, 4.0])
        .floats(0, 1, &[9.0; 9]);
    run_compute(&program, &mut wide, [1, 1, 1], &Limits::default()).unwrap();
    for (x, want) in wide.read_floats(0, 1).unwrap().iter().zip(GLSL) {
        assert!(x.contains(f64::from(want as f32)), "{want} not in {x:?}");
    }
}

/// How a channel of a storage format keeps a number, worked out here by itself.
enum Keeps {
    Unorm(u32),
    Snorm(u32),
    Half,
    Float,
    Int,
    /// Bits of fraction of an unsigned float with five bits of exponent.
    Short(u32),
}

/// The fraction of a normal number cut to so many bits, to nearest.
fn shortened(x: f64, bits: u32) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let step = x.log2().floor().exp2() / f64::from(1u32 << bits);
    (x / step).round_ties_even() * step
}

fn kept(keeps: &Keeps, x: f64) -> f64 {
    let norm = |bits: u32, x: f64| {
        let most = f64::from((1u32 << bits) - 1);
        (x * most).round() / most
    };
    match keeps {
        Keeps::Unorm(bits) => norm(*bits, x.clamp(0.0, 1.0)),
        Keeps::Snorm(bits) => norm(bits - 1, x.clamp(-1.0, 1.0)),
        Keeps::Half => f64::from(half::f16::from_f64(x)),
        Keeps::Float | Keeps::Int => x,
        Keeps::Short(bits) => shortened(x, *bits),
    }
}

macro_rules! formats {
    ($($name:ident $channels:literal [$($keeps:expr),*];)*) => {
        /// Every storage format, its channels and how it keeps each.
        fn formats() -> Vec<(StorageFormat, TexelFormat, &'static str, usize, Vec<Keeps>)> {
            use Keeps::{Float, Half, Int, Short, Snorm, Unorm};
            vec![$((StorageFormat::$name, TexelFormat::$name, stringify!($name), $channels, vec![$($keeps),*]),)*]
        }
    };
}

formats! {
    R8Unorm 1 [Unorm(8)]; R8Snorm 1 [Snorm(8)]; R8Uint 1 [Int]; R8Sint 1 [Int];
    R16Uint 1 [Int]; R16Sint 1 [Int]; R16Float 1 [Half]; R16Unorm 1 [Unorm(16)]; R16Snorm 1 [Snorm(16)];
    Rg8Unorm 2 [Unorm(8)]; Rg8Snorm 2 [Snorm(8)]; Rg8Uint 2 [Int]; Rg8Sint 2 [Int];
    R32Uint 1 [Int]; R32Sint 1 [Int]; R32Float 1 [Float]; R64Uint 1 [Int];
    Rg16Uint 2 [Int]; Rg16Sint 2 [Int]; Rg16Float 2 [Half]; Rg16Unorm 2 [Unorm(16)]; Rg16Snorm 2 [Snorm(16)];
    Rgba8Unorm 4 [Unorm(8)]; Rgba8Snorm 4 [Snorm(8)]; Rgba8Uint 4 [Int]; Rgba8Sint 4 [Int]; Bgra8Unorm 4 [Unorm(8)];
    Rgb10a2Uint 4 [Int]; Rgb10a2Unorm 4 [Unorm(10), Unorm(10), Unorm(10), Unorm(2)];
    Rg11b10Ufloat 3 [Short(6), Short(6), Short(5)];
    Rg32Uint 2 [Int]; Rg32Sint 2 [Int]; Rg32Float 2 [Float];
    Rgba16Uint 4 [Int]; Rgba16Sint 4 [Int]; Rgba16Float 4 [Half]; Rgba16Unorm 4 [Unorm(16)]; Rgba16Snorm 4 [Snorm(16)];
    Rgba32Uint 4 [Int]; Rgba32Sint 4 [Int]; Rgba32Float 4 [Float];
}

/// The shader that writes a texel of a format and reads it back.
fn storage_shader(name: &str) -> String {
    let (values, kind) = if name.ends_with("Uint") {
        ("5, 100, 17, 2", if name == "R64Uint" { "u64" } else { "u32" })
    } else if name.ends_with("Sint") {
        ("-5, 100, -17, 2", "i32")
    } else {
        ("0.3, -0.6, 2.25, 0.7", "f32")
    };
    format!(
        "@group(0) @binding(0) var t: texture_storage_2d<{}, read_write>;
         @group(0) @binding(1) var<storage, read_write> o: array<f32>;
         @compute @workgroup_size(1) fn main() {{
             textureStore(t, vec2i(1, 0), vec4<{kind}>({values}));
             let v = textureLoad(t, vec2i(1, 0));
             o[0] = f32(v.x); o[1] = f32(v.y); o[2] = f32(v.z); o[3] = f32(v.w);
         }}",
        name.to_lowercase()
    )
}

/// The shaders of all storage formats.
pub(crate) fn storage_shaders() -> Vec<String> {
    formats()
        .iter()
        .map(|(_, _, name, ..)| storage_shader(name))
        .collect()
}

/// What the shader of a format reads back.
fn stored<D: Domain>(format: TexelFormat, name: &str) -> Vec<D::Float> {
    let texture = Texture::d2(format, 2, 1, vec![0; 2 * format.bytes()]).unwrap();
    let b = Bindings::<D>::new()
        .texture(0, 0, texture)
        .floats(0, 1, &[9.0; 4]);
    dispatch(&storage_shader(name), b).0.read_floats(0, 1).unwrap()
}

#[test]
fn every_storage_format_keeps_what_it_can() {
    for (_, format, name, channels, keeps) in formats() {
        let written: [f64; 4] = match name {
            name if name.ends_with("Uint") => [5.0, 100.0, 17.0, 2.0],
            name if name.ends_with("Sint") => [-5.0, 100.0, -17.0, 2.0],
            _ => [0.3f32, -0.6, 2.25, 0.7].map(f64::from),
        };
        let got = stored::<F32>(format, name);
        let wide = stored::<Accept>(format, name);
        for (channel, got) in got.into_iter().enumerate() {
            let want = match keeps.get(channel.min(keeps.len() - 1)) {
                Some(keeps) if channel < channels => kept(keeps, written[channel]),
                Some(_) | None if channel == 3 => 1.0,
                Some(_) | None => 0.0,
            };
            assert!((got - want).abs() <= 1e-7, "{name}.{channel}: {got}, want {want}");
            // Another machine may take the other neighbour, and nothing beyond: the coarsest step is that of two bits.
            let x = wide[channel];
            assert!(x.contains(got), "{name}.{channel}: {got} not in {x:?}");
            assert!(x.hi - x.lo <= 0.34, "{name}.{channel}: {x:?}");
        }
    }
}
