//! What hardware may do beyond the ideal filter: arithmetic in the texels' own precision, and derivatives that nobody has seen.

use crate::common::program;
use bossage_bounds::{
    Accept, AddressMode, Bindings, F32, Flags, Interval, Limits, Sampler, StageInputs, TexelFormat, Texture,
    run_fragment,
};

const LOOKUP: &str = "
    @group(0) @binding(0) var t: texture_2d<f32>;
    @group(0) @binding(1) var s: sampler;
    @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
        return textureSampleGrad(t, s, uv, dpdx(uv), dpdy(uv));
    }";

/// Red at (u, 0.5) of a row of two texels, filtered.
fn red(texture: &Texture, u: f64) -> Interval {
    let mut bindings = Bindings::<Accept>::new().texture(0, 0, texture.clone()).sampler(
        0,
        1,
        Sampler::linear(AddressMode::ClampToEdge),
    );
    let input = StageInputs::new(1)
        .location(0, 2, &[Interval::point(u), Interval::point(0.5)])
        .lone();
    let (outputs, _) =
        run_fragment(&program(LOOKUP), &mut bindings, &input, &Limits::default()).expect("the shader runs");
    outputs.location(0, 0).expect("the colour is there")[0]
}

fn row(format: TexelFormat, first: &[u8], second: &[u8]) -> Texture {
    let mut texels = Vec::new();
    for texel in [first, second] {
        (0..format.channels()).for_each(|_| texels.extend_from_slice(texel));
    }
    Texture::d2(format, 2, 1, texels).expect("the bytes fit")
}

#[test]
fn bytes_may_be_filtered_in_bytes() {
    // The middle between 10 and 21 is 15.5: a filter of bytes returns 15 or 16, or what rounding twice makes of it.
    let bytes = row(TexelFormat::Rgba8Unorm, &[10], &[21]);
    let x = red(&bytes, 0.5);
    assert!(x.contains(15.0 / 255.0) && x.contains(16.0 / 255.0), "{x:?}");
    // The second axis blends a texel with itself; only a step along each is allowed, and the slope's share of a sub-texel.
    let most = 2.0 / 255.0 + 11.0 / 255.0 / 256.0 + 1e-6;
    assert!(
        x.hi <= 15.5 / 255.0 + most && x.lo >= 15.5 / 255.0 - most,
        "{x:?}"
    );
}

#[test]
fn equal_bytes_stay_what_they_are() {
    let x = red(&row(TexelFormat::Rgba8Unorm, &[77], &[77]), 0.4);
    assert!(x.contains(77.0 / 255.0) && x.hi - x.lo < 1e-6, "{x:?}");
}

#[test]
fn sixteen_bits_may_be_filtered_in_sixteen_bits_and_floats_in_floats() {
    let codes = [10_000_u16, 10_001].map(u16::to_le_bytes);
    let x = red(&row(TexelFormat::Rgba16Unorm, &codes[0], &codes[1]), 0.5);
    let off = |code: f64| (code - 10_000.5) / 65535.0;
    assert!(
        x.contains(10_000.0 / 65535.0) && x.contains(10_001.0 / 65535.0),
        "{x:?}"
    );
    assert!(x.hi - 10_000.5 / 65535.0 <= off(10_005.0), "{x:?}");
    let floats = [0.25f32, 0.25 + 1.0 / 1024.0].map(f32::to_le_bytes);
    let x = red(&row(TexelFormat::R32Float, &floats[0], &floats[1]), 0.5);
    // Nothing but the sub-texel bits of a slope of 2^-10.
    assert!(x.hi - x.lo <= 2.0 / 256.0 / 1024.0 + 1e-6, "{x:?}");
}

#[test]
fn the_derivatives_of_a_lone_fragment_are_open() {
    let shader = "@fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f { return vec4f(dpdx(uv.x), uv, 1.0); }";
    let input = StageInputs::new(2)
        .location(0, 2, &[0.25, 0.5, 0.75, 0.5].map(Interval::point))
        .lone();
    let program = program(shader);
    let (outputs, _) = run_fragment(
        &program,
        &mut Bindings::<Accept>::new(),
        &input,
        &Limits::default(),
    )
    .expect("it runs");
    let first = outputs.location(0, 0).expect("the colour is there");
    assert!(first[0].flags.has(Flags::INDETERMINATE), "{:?}", first[0]);
    assert_eq!(first[1], Interval::point(0.25));
    // Not said to be lone they are refused, since two are no quad.
    let input = StageInputs::<F32>::new(2).location(0, 2, &[0.25, 0.5, 0.75, 0.5]);
    let refused = run_fragment(&program, &mut Bindings::<F32>::new(), &input, &Limits::default());
    assert!(refused.is_err_and(|error| error.to_string().contains("quads of four")));
}

#[test]
fn a_level_that_follows_from_unknown_derivatives_is_open() {
    let floats = |texels: &[f32]| texels.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let one = Texture::d2_floats(2, 1, 1, &[0.0, 1.0]).expect("two texels");
    let two = one.clone().with_level(floats(&[5.0])).expect("a second level");
    assert!(red(&one, 0.5).flags.is_none());
    assert!(red(&two, 0.5).is_indeterminate());
}

#[test]
fn an_ideal_filter_is_allowed_nothing_but_rounding() {
    let sampler = |ideal| Sampler {
        ideal,
        ..Sampler::linear(AddressMode::ClampToEdge)
    };
    let texture = row(TexelFormat::Rgba8Unorm, &[10], &[210]);
    let red = |ideal, u: f64| {
        let mut bindings =
            Bindings::<Accept>::new()
                .texture(0, 0, texture.clone())
                .sampler(0, 1, sampler(ideal));
        let input = StageInputs::new(1)
            .location(0, 2, &[Interval::point(u), Interval::point(0.5)])
            .lone();
        run_fragment(&program(LOOKUP), &mut bindings, &input, &Limits::default())
            .expect("the shader runs")
            .0
            .location(0, 0)
            .expect("the colour is there")[0]
    };
    for k in 0..40 {
        let u = f64::from(0.27 + 0.0112 * k as f32);
        let mut point = Bindings::<F32>::new()
            .texture(0, 0, texture.clone())
            .sampler(0, 1, sampler(true));
        let input = StageInputs::new(1).location(0, 2, &[u, 0.5]).lone();
        let (machine, _) =
            run_fragment(&program(LOOKUP), &mut point, &input, &Limits::default()).expect("it runs");
        let machine = machine.location(0, 0).expect("the colour is there")[0];
        let (ideal, any) = (red(true, u), red(false, u));
        assert!(
            ideal.contains(machine) && any.contains(machine),
            "{u}: {machine} {ideal:?}"
        );
        assert!(
            ideal.hi - ideal.lo < 1e-6 && any.hi - any.lo > 1e-6,
            "{u}: {ideal:?} {any:?}"
        );
    }
}
