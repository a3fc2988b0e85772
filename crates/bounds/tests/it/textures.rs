//! Textures: every built-in in point domains by hand, and the filter's allowance in acceptance intervals.

use crate::common::{program, source};
use bossage_bounds::{
    Accept, AddressMode, Bindings, CompareFunction, Dimension, Domain, F32, Filter, Interval, Limits,
    Sampler, StageInputs, TexelFormat, Texture, run_fragment,
};
use proptest::prelude::*;

fn floats(list: &[f32]) -> Vec<u8> {
    list.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// A 4×4 ramp `x + 4 y`, with a 2×2 level of tens and a 1×1 level of a hundred.
fn ramp() -> Texture {
    let base: Vec<f32> = (0..16).map(|k| k as f32).collect();
    let t = Texture::d2_floats(4, 4, 1, &base).unwrap();
    t.with_level(floats(&[10.0, 20.0, 30.0, 40.0]))
        .unwrap()
        .with_level(floats(&[100.0]))
        .unwrap()
}

fn faces(layers: u32) -> Texture {
    let texels: Vec<f32> = (0..layers).map(|k| (k + 1) as f32).collect();
    Texture::new(
        Dimension::Cube,
        TexelFormat::R32Float,
        [1, 1, 1],
        layers,
        floats(&texels),
    )
    .unwrap()
}

fn bindings<D: Domain>() -> Bindings<D> {
    let depth = |n: u32| {
        let texels: Vec<f32> = (0..n * 4).map(|k| [0.2, 0.4, 0.6, 0.8][k as usize % 4]).collect();
        Texture::new(
            Dimension::D2,
            TexelFormat::Depth32Float,
            [2, 2, 1],
            n,
            floats(&texels),
        )
        .unwrap()
    };
    let words = |list: &[u32]| list.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>();
    let three: Vec<f32> = (0..8).map(|k| k as f32).collect();
    let cube_depth = Texture::new(
        Dimension::Cube,
        TexelFormat::Depth32Float,
        [1, 1, 1],
        6,
        floats(&[0.9, 0.1, 0.1, 0.1, 0.1, 0.1]),
    );
    Bindings::new()
        .texture(0, 0, ramp())
        .sampler(0, 1, Sampler::nearest(AddressMode::Repeat))
        .texture(
            0,
            2,
            Texture::new(
                Dimension::D1,
                TexelFormat::Rg32Float,
                [3, 1, 1],
                1,
                floats(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
            )
            .unwrap(),
        )
        .texture(
            0,
            3,
            Texture::new(Dimension::D3, TexelFormat::R32Float, [2, 2, 2], 1, floats(&three)).unwrap(),
        )
        .texture(
            0,
            4,
            Texture::new(
                Dimension::D2,
                TexelFormat::R32Float,
                [1, 1, 1],
                3,
                floats(&[1.0, 2.0, 3.0]),
            )
            .unwrap(),
        )
        .texture(0, 5, faces(6))
        .texture(0, 6, depth(1))
        .sampler(
            0,
            7,
            Sampler::linear(AddressMode::ClampToEdge).comparing(CompareFunction::LessEqual),
        )
        .texture(
            0,
            8,
            Texture::d2(TexelFormat::R32Uint, 2, 1, words(&[5, 4_000_000_000])).unwrap(),
        )
        .texture(0, 9, multisampled())
        .texture(
            0,
            10,
            Texture::d2(TexelFormat::Rgba8Unorm, 2, 1, vec![0; 8]).unwrap(),
        )
        .texture(
            0,
            11,
            Texture::d2(TexelFormat::R32Uint, 1, 2, words(&[0, 1])).unwrap(),
        )
        .texture(0, 12, faces(12))
        .texture(0, 13, depth(2))
        .texture(0, 14, cube_depth.unwrap())
        .texture(
            0,
            15,
            Texture::d2(TexelFormat::R32Uint, 2, 2, words(&[0, 0, 3, 5])).unwrap(),
        )
        .floats(0, 16, &[0.0; 23])
}

fn multisampled() -> Texture {
    let texels: Vec<f32> = (0..8).map(|k| k as f32).collect();
    let t = Texture::new(
        Dimension::D2,
        TexelFormat::R32Float,
        [2, 1, 1],
        4,
        floats(&texels),
    )
    .unwrap();
    t.multisampled(4).unwrap()
}

/// Four fragments at one place, so that derivatives are zero and the base level is read.
fn inputs<D: Domain>(u: D::Float, v: D::Float) -> StageInputs<D> {
    StageInputs::new(4).location(0, 2, &[u, v, u, v, u, v, u, v])
}

#[test]
fn every_built_in_by_hand() {
    let mut b = bindings::<F32>();
    run_fragment(
        &program(&source("textures")),
        &mut b,
        &inputs(0.3, 0.6),
        &Limits::default(),
    )
    .unwrap();
    // Texel (1, 2) of the ramp is 9.
    let want = [
        9.0,
        30.0,
        // Derivatives are zero: λ = −∞, and no bias helps.
        9.0,
        // Footprint 1 × 2 texels: level 1, texel (0, 1).
        30.0,
        10.0,
        9.0,
        // (1,2) = 9, (2,2) = 10, (2,1) = 6, (1,1) = 5.
        9.0 + 100.0 + 600.0 + 5000.0,
        5.0 + 2.0,
        // The nearest texel of 0.5 in two is the second: (1,1,1) = 7, and (1,0,1) = 5.
        7.0 + 5.0,
        // Layer 1, and layer 7, which does not exist.
        2.0 + 0.0,
        // −y is the fourth face.
        4.0,
        // 0.5 ≤ texel holds for 0.6 and 0.8, each with weight ¼.
        0.5,
        1.0,
        0.2f32 as f64 + 0.8f32 as f64,
        // (0,1) = 0.6 yes, (1,1) = 0.8 yes, (1,0) = 0.4 no, (0,0) = 0.2 no.
        11.0,
        4e9,
        // Sample 2 of texel 1: 2 * 2 + 1.
        5.0,
        4.0 + 20.0 + 300.0 + 3000.0 + 40000.0,
        // Clamped to the first column, row 0.
        0.0,
        // +z of the second cube is face 10 of 12: value 11.
        11.0,
        1.0,
        1.0,
        13.0 + 1.0 + 1.0,
    ];
    let got = b.read_floats(0, 16).unwrap();
    // Values o[18] is not in the shader order: textureSampleBaseClampToEdge comes after the stores.
    for (k, (g, w)) in got.iter().zip(want).enumerate() {
        assert!(
            (g - w).abs() <= f64::from(f32::EPSILON) * w.abs(),
            "o[{k}] = {g}, want {w}"
        );
    }
    let written: Vec<f64> = b.written_textures[&(0, 10)]
        .iter()
        .map(|s| s.float().unwrap())
        .collect();
    // 0.5 · 255 = 127.5, to even 128.
    assert_eq!(
        written[4..],
        [f64::from((128.0f64 / 255.0) as f32), 1.0, 0.0, 1.0]
    );
    // In lockstep the four fragments load before any of them stores.
    assert_eq!(b.written_textures[&(0, 11)][4].int(), Some(1 + 41));
    assert_eq!(b.written_textures[&(0, 15)][12].int(), Some(9));
    assert_eq!(b.written_textures[&(0, 15)][8].int(), Some(3 + 4 * 2));
}

#[test]
fn acceptance_contains_the_point_results() {
    let mut points = bindings::<F32>();
    let mut wide = bindings::<Accept>();
    let p = program(&source("textures"));
    run_fragment(&p, &mut points, &inputs(0.3, 0.6), &Limits::default()).unwrap();
    let (u, v) = (
        Interval::point(f64::from(0.3f32)),
        Interval::point(f64::from(0.6f32)),
    );
    run_fragment(&p, &mut wide, &inputs(u, v), &Limits::default()).unwrap();
    for (k, (x, w)) in points
        .read_floats(0, 16)
        .unwrap()
        .iter()
        .zip(wide.read_floats(0, 16).unwrap())
        .enumerate()
    {
        assert!(w.contains(*x), "o[{k}]: {x} not in {w:?}");
    }
}

const LOOKUP: &str = "
    @group(0) @binding(0) var t: texture_2d<f32>;
    @group(0) @binding(1) var s: sampler;
    @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f { return textureSampleLevel(t, s, uv, 0.0); }";

fn height(x: i64, y: i64) -> f32 {
    ((x * 7 + y * 13).rem_euclid(11)) as f32 / 10.0
}

fn lookup<D: Domain>(mode: AddressMode, filter: Filter, u: D::Float, v: D::Float) -> D::Float {
    let texels: Vec<f32> = (0..64).map(|k| height(k % 8, k / 8)).collect();
    let sampler = Sampler {
        mag: filter,
        min: filter,
        ..Sampler::linear(mode)
    };
    let mut b = Bindings::<D>::new()
        .texture(0, 0, Texture::d2_floats(8, 8, 1, &texels).unwrap())
        .sampler(0, 1, sampler);
    let input = StageInputs::new(1).location(0, 2, &[u, v]);
    run_fragment(&program(LOOKUP), &mut b, &input, &Limits::default())
        .unwrap()
        .0
        .location(0, 0)
        .unwrap()[0]
}

proptest! {
    #![proptest_config(crate::common::cases(200))]

    /// The interval contains filtering at every coordinate that 8 sub-texel bits allow, and is not wider than that asks for.
    #[test]
    fn filtering_covers_the_sub_texel_bits(u in -1.5f32..2.5, v in -1.5f32..2.5, du in -1i32..=1, dv in -1i32..=1, linear in any::<bool>()) {
        let filter = if linear { Filter::Linear } else { Filter::Nearest };
        for mode in [AddressMode::ClampToEdge, AddressMode::Repeat, AddressMode::MirrorRepeat, AddressMode::ClampToBorder] {
            let x = lookup::<Accept>(mode, filter, Interval::point(f64::from(u)), Interval::point(f64::from(v)));
            // Another machine may round the coordinate by up to half of 2^-8 of a texel, either way.
            let moved = |c: f32, d: i32| f64::from(c) + f64::from(d) / (8.0 * 512.0);
            let machine = lookup::<F32>(mode, filter, moved(u, du), moved(v, dv));
            prop_assert!(x.contains(machine), "{mode:?} {filter:?} at {u}, {v}: {machine} not in {x:?}");
            // Two sub-texel steps along each axis on slopes of at most 1, or a jump to a neighbour.
            if linear {
                prop_assert!(x.hi - x.lo <= 4.0 / 256.0 + 1e-5, "{x:?}");
            }
        }
    }
}

#[test]
fn implicit_levels_follow_the_quad() {
    let shader = "
        @group(0) @binding(0) var t: texture_2d<f32>;
        @group(0) @binding(1) var s: sampler;
        @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f { return textureSample(t, s, uv); }";
    let p = program(shader);
    let sample = |step: f64| {
        let mut b =
            Bindings::<F32>::new()
                .texture(0, 0, ramp())
                .sampler(0, 1, Sampler::nearest(AddressMode::Repeat));
        let uv = [0.1, 0.1, 0.1 + step, 0.1, 0.1, 0.1 + step, 0.1 + step, 0.1 + step];
        run_fragment(
            &p,
            &mut b,
            &StageInputs::new(4).location(0, 2, &uv),
            &Limits::default(),
        )
        .unwrap()
        .0
        .location(0, 0)
        .unwrap()[0]
    };
    // One texel a pixel: level 0; two: level 1; four: level 2.
    assert_eq!([sample(0.25), sample(0.5), sample(1.0)], [0.0, 10.0, 100.0]);
}

#[test]
fn an_uncertain_texel_index_gives_the_hull_of_the_texels() {
    let shader = "
        @group(0) @binding(0) var t: texture_2d<f32>;
        @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f { return textureLoad(t, vec2i(uv * 4.0), 0); }";
    let mut b = Bindings::<Accept>::new().texture(0, 0, ramp());
    let input = StageInputs::new(1).location(0, 2, &[Interval::new(0.3, 0.6), Interval::point(0.5)]);
    let x = run_fragment(&program(shader), &mut b, &input, &Limits::default())
        .unwrap()
        .0
        .location(0, 0)
        .unwrap()[0];
    // Columns 1 and 2 of row 2.
    assert_eq!((x.lo, x.hi), (9.0, 10.0));
}
