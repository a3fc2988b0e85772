//! The bakes: exact expectations where there are any, derived bounds elsewhere, and a witness for each published fault.

use bossage_assets::height_to_normal::{self, Bake, MAX_SLOPE};
use bossage_assets::height_to_normal_forward as forward;
use bossage_assets::{EdgeMode, HeightField, NormalCodec, NormalMap, codec_biased, height_byte};
use glam::{DVec3, Vec3};
use proptest::prelude::*;

const EDGES: [EdgeMode; 3] = [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp];
const CODECS: [NormalCodec; 2] = [NormalCodec::Unorm, NormalCodec::Biased];

fn central(field: &HeightField, scale: f32, edge: EdgeMode, codec: NormalCodec) -> NormalMap {
    let bake = Bake::central(field, [scale; 2], edge, codec).unwrap();
    height_to_normal::bake(field, &bake)
}

/// One texel straight from the formula, in f64, for any position: no rows, no interior, no order of operations.
fn truth(field: &HeightField, x: u32, y: u32, scale: f64, edge: EdgeMode) -> DVec3 {
    let h = |dx: i64, dy: i64| {
        let (cx, cy) = (
            edge.resolve(i64::from(x) + dx, field.width),
            edge.resolve(i64::from(y) + dy, field.height),
        );
        f64::from(field.texel(cx, cy))
    };
    let gx = (h(1, 0) - h(-1, 0)) * scale * f64::from(field.width) / 2.0;
    let gy = (h(0, 1) - h(0, -1)) * scale * f64::from(field.height) / 2.0;
    DVec3::new(-gx, -gy, 1.0).normalize()
}

/// Half a step of the code, plus what f32 may add: components are off by at most 8 roundings of 2⁻²⁴ (difference, two for the
/// slope, two products and sums under the root, root, division, product), the byte sum by two of 2⁻¹⁷ over 127 steps, and the
/// decode by 2⁻²³.
fn bound(codec: NormalCodec) -> f64 {
    let half_step = match codec {
        NormalCodec::Unorm => 1.0 / 255.0,
        NormalCodec::Biased => 0.5 / 127.0,
    };
    half_step + 8.0 * 2f64.powi(-24) + 2.0 * 2f64.powi(-17) / 127.0 + 2f64.powi(-23)
}

fn fields() -> impl Strategy<Value = HeightField> {
    (1u32..12, 1u32..12).prop_flat_map(|(w, h)| {
        let texels = proptest::collection::vec(0.0f32..=1.0, (w * h) as usize);
        texels.prop_map(move |t| HeightField::new(w, h, t).unwrap())
    })
}

proptest! {
    #[test]
    fn every_texel_is_the_nearest_code_of_the_formula(field in fields(), scale in 0.0f32..0.5) {
        for (edge, codec) in EDGES.into_iter().flat_map(|e| CODECS.map(|c| (e, c))) {
            let map = central(&field, scale, edge, codec);
            for (x, y) in (0..field.height).flat_map(|y| (0..field.width).map(move |x| (x, y))) {
                let error = map.decode(x, y).as_dvec3() - truth(&field, x, y, f64::from(scale), edge);
                prop_assert!(error.abs().max_element() <= bound(codec), "({x}, {y}) {edge:?} {codec:?}: {error}");
                let texel = map.texels[(y * field.width + x) as usize];
                prop_assert_eq!(texel[3], height_byte(field.texel(x, y)));
            }
        }
    }

    #[test]
    fn a_shifted_tile_bakes_to_the_shifted_map(field in fields(), dx in 0u32..12, dy in 0u32..12) {
        let (w, h) = (field.width, field.height);
        let shifted = HeightField::from_fn(w, h, |x, y| field.texel((x + dx) % w, (y + dy) % h));
        let [a, b] = [&field, &shifted].map(|f| central(f, 0.1, EdgeMode::Wrap, NormalCodec::Unorm));
        for (x, y) in (0..h).flat_map(|y| (0..w).map(move |x| (x, y))) {
            prop_assert_eq!(b.decode(x, y), a.decode((x + dx) % w, (y + dy) % h));
        }
    }

    #[test]
    fn a_transposed_field_bakes_to_the_transposed_map(field in fields()) {
        // The scale is a power of two and the slope factors swap with the sides, so the arithmetic is the same.
        let transposed = HeightField::from_fn(field.height, field.width, |x, y| field.texel(y, x));
        for edge in EDGES {
            let [a, b] = [&field, &transposed].map(|f| central(f, 0.125, edge, NormalCodec::Biased));
            for (x, y) in (0..field.height).flat_map(|y| (0..field.width).map(move |x| (x, y))) {
                let [red, green, ..] = a.texels[(y * field.width + x) as usize];
                let turned = b.texels[(x * field.height + y) as usize];
                // q sums its squares in the other order, which is the same sum.
                prop_assert_eq!([green, red], [turned[0], turned[1]]);
            }
        }
    }

    #[test]
    fn published_interior_follows_the_cross_product(field in fields(), s in 0.0f32..0.1) {
        let map = forward::bake(&field, s);
        let byte = |x: u32, y: u32| f64::from(height_byte(field.texel(x, y)));
        for (x, y) in (1..field.height.max(2) - 1).flat_map(|y| (1..field.width.max(2) - 1).map(move |x| (x, y))) {
            let down = DVec3::new(1.0, 0.0, f64::from(s) * (byte(x, y + 1) - byte(x, y)));
            let right = DVec3::new(0.0, 1.0, f64::from(s) * (byte(x + 1, y) - byte(x, y)));
            let exact = down.cross(right).normalize();
            let [r, g, b, a] = map.texels[(y * field.width + x) as usize];
            let decoded = DVec3::from([r, g, b].map(|v| f64::from(codec_biased::decode_published(v))));
            // Truncation: at most one step below, never above, but for f32 rounding. The difference of two products up to 25.5
            // is off by 3·2⁻²⁰ absolute; the rest as in `bound`.
            let rounding = 3.0 * 2f64.powi(-20) + bound(NormalCodec::Biased) - 0.5 / 127.0;
            let error = decoded - exact;
            prop_assert!(error.max_element() <= rounding && error.min_element() >= -1.0 / 127.0 - rounding, "{error}");
            prop_assert_eq!(a, height_byte(field.texel(x, y)));
        }
    }
}

#[test]
fn a_flat_field_bakes_to_straight_normals() {
    let flat = HeightField::from_fn(9, 4, |_, _| 0.5);
    for edge in EDGES {
        let biased = central(&flat, 0.3, edge, NormalCodec::Biased);
        assert!(biased.texels.iter().all(|t| *t == [128, 128, 255, 128]));
        let unorm = central(&flat, 0.3, edge, NormalCodec::Unorm);
        assert!(unorm.texels.iter().all(|t| *t == [128, 128, 255, 128]));
    }
    assert!(
        forward::bake(&flat, 0.3)
            .texels
            .iter()
            .all(|t| *t == [128, 128, 255, 128])
    );
}

#[test]
fn red_is_the_slope_along_columns_and_green_along_rows() {
    let along_u = HeightField::from_fn(8, 8, |x, _| x as f32 / 8.0);
    let along_v = HeightField::from_fn(8, 8, |_, y| y as f32 / 8.0);
    let [a, b] =
        [&along_u, &along_v].map(|f| central(f, 1.0, EdgeMode::Clamp, NormalCodec::Biased).decode(4, 4));
    assert!(a.x < -0.6 && a.y == 0.0, "{a}");
    assert!(b.y < -0.6 && b.x == 0.0, "{b}");
}

#[test]
fn witness_the_published_bake_swaps_the_axes() {
    let along_u = HeightField::from_fn(8, 8, |x, _| x as f32 / 8.0);
    let n = forward::bake(&along_u, 0.05).decode(4, 4);
    assert!(
        n.x == 0.0 && n.y < -0.5,
        "a slope along columns must show in green, as published: {n}"
    );
}

#[test]
fn witness_the_last_column_looks_into_the_next_row() {
    // One bright texel: the first of row 3. The last texel of row 2 is flat all round, but sees it.
    let field = HeightField::from_fn(6, 6, |x, y| f32::from(x == 0 && y == 3));
    assert!(forward::unmasked_normal(&field, 5, 2, 0.01).y < -0.9);
    assert_eq!(
        forward::unmasked_normal(&field, 5, 1, 0.01),
        Vec3::Z,
        "the control: one row up"
    );
    // And past the end there is texel 0.
    let corner = HeightField::from_fn(6, 6, |x, y| f32::from(x == 0 && y == 0));
    assert!(
        forward::unmasked_normal(&corner, 3, 5, 0.01).x < -0.9,
        "below the last row"
    );
    // Both neighbours of the very last texel: a = b = 2.55, so each component is −2.55/√(1 + 2·2.55²) = −0.68.
    let last = forward::unmasked_normal(&corner, 5, 5, 0.01);
    assert!(
        last.x == last.y && last.y < -0.67,
        "right of and below the last texel: {last}"
    );
    // The hardened bake sees the true neighbours, whatever the edge mode.
    for edge in EDGES {
        assert_eq!(
            central(&field, 1.0, edge, NormalCodec::Biased).decode(5, 1),
            Vec3::Z
        );
    }
    assert!(
        central(&field, 1.0, EdgeMode::Wrap, NormalCodec::Biased)
            .decode(5, 3)
            .x
            < -0.9,
        "wrap: its own row's first texel"
    );
    assert_eq!(
        central(&field, 1.0, EdgeMode::Clamp, NormalCodec::Biased).decode(5, 3),
        Vec3::Z
    );
}

#[test]
fn witness_the_published_border_is_flat_and_the_hardened_one_is_not() {
    let ramp = HeightField::from_fn(8, 8, |x, y| (x + y) as f32 / 16.0);
    let published = forward::bake(&ramp, 0.05);
    let hardened = central(&ramp, 1.0, EdgeMode::Mirror, NormalCodec::Biased);
    for i in 0..8 {
        for (x, y) in [(i, 0), (i, 7), (0, i), (7, i)] {
            assert_eq!(published.decode(x, y), Vec3::Z);
            assert_ne!(hardened.decode(x, y), Vec3::Z);
        }
    }
    assert_ne!(
        published.decode(3, 3),
        Vec3::Z,
        "the control: inside there is a slope"
    );
}

#[test]
fn witness_forward_is_of_first_order_and_central_of_second() {
    // The largest error of the slope of h = (1 + sin)/4 over one period, by sampling density.
    let error = |n: u32, offset: f64| {
        let h = |i: f64| 0.25 * (1.0 + (std::f64::consts::TAU * i / f64::from(n)).sin());
        let slope = |i: f64| 0.25 * std::f64::consts::TAU * (std::f64::consts::TAU * i / f64::from(n)).cos();
        let estimate = |i: f64| (h(i + 1.0) - h(i - offset)) / (1.0 + offset) * f64::from(n);
        (0..n)
            .map(|i| (estimate(f64::from(i)) - slope(f64::from(i))).abs())
            .fold(0.0, f64::max)
    };
    // Taylor: forward π/n·h'', so halving the step halves the error; central (2π/n)²/6·h', so it quarters it. The next terms
    // are smaller by (2π/n)²/10 < 0.02 at n ≥ 16.
    for n in [16, 32] {
        assert!((error(n, 0.0) / error(2 * n, 0.0) - 2.0).abs() < 0.05);
        assert!((error(n, 1.0) / error(2 * n, 1.0) - 4.0).abs() < 0.1);
    }
    // And that is what the two bakes compute: compare on 64 samples, in whole steps of the code.
    let field = HeightField::from_fn(64, 3, |x, _| {
        0.25 * (1.0 + (std::f32::consts::TAU * x as f32 / 64.0).sin())
    });
    let map = central(&field, 0.2, EdgeMode::Wrap, NormalCodec::Biased);
    for x in 0..64 {
        let exact = 0.2 * 0.25 * std::f64::consts::TAU * (std::f64::consts::TAU * f64::from(x) / 64.0).cos();
        let decoded = map.decode(x, 1).as_dvec3();
        // Central differences: relative (2π/64)²/6 = 0.0016 of 0.314; the code: half a step, doubled by the quotient.
        assert!(
            (-decoded.x / decoded.z - exact).abs() <= 0.0016 * 0.315 + 2.0 * bound(NormalCodec::Biased),
            "{x}"
        );
    }
}

#[test]
fn the_smallest_fields_bake() {
    for (w, h) in [(1, 1), (1, 5), (5, 1), (2, 2), (3, 3)] {
        let field = HeightField::from_fn(w, h, |x, y| ((x + 2 * y) % 3) as f32 / 2.0);
        for edge in EDGES {
            assert_eq!(
                central(&field, 0.1, edge, NormalCodec::Unorm).texels.len(),
                (w * h) as usize
            );
        }
        assert_eq!(forward::bake(&field, 0.1).texels.len(), (w * h) as usize);
    }
    // One texel is its own neighbour in every mode.
    let one = HeightField::from_fn(1, 1, |_, _| 1.0);
    assert!(
        EDGES
            .iter()
            .all(|&e| central(&one, 9.0, e, NormalCodec::Biased).decode(0, 0) == Vec3::Z)
    );
}

#[test]
fn the_steepest_slope_stays_a_normal_and_steeper_is_refused() {
    let field = HeightField::from_fn(4, 4, |x, _| f32::from(x % 4 > 1));
    let map = central(&field, MAX_SLOPE / 2.0, EdgeMode::Clamp, NormalCodec::Biased);
    assert_eq!(map.decode(1, 1), Vec3::new(-1.0, 0.0, 0.0));
    for scale in [f32::NAN, f32::INFINITY, -MAX_SLOPE, MAX_SLOPE] {
        let refused = Bake::central(&field, [scale, 0.1], EdgeMode::Wrap, NormalCodec::Unorm);
        assert!(
            refused.unwrap_err().to_string().contains("height scale"),
            "{scale}"
        );
    }
}

#[test]
fn the_result_does_not_depend_on_threads() {
    let field = HeightField::from_fn(257, 131, |x, y| ((x * 7919 + y * 104_729) % 1009) as f32 / 1008.0);
    let bake = || central(&field, 0.03, EdgeMode::Mirror, NormalCodec::Unorm);
    let single = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap()
        .install(bake);
    let several = rayon::ThreadPoolBuilder::new()
        .num_threads(5)
        .build()
        .unwrap()
        .install(bake);
    assert_eq!(single, several);
}

#[test]
fn baking_into_the_wrong_number_of_texels_is_refused() {
    let field = HeightField::from_fn(4, 3, |x, _| x as f32 / 4.0);
    let bake = Bake::central(&field, [0.1; 2], EdgeMode::Wrap, NormalCodec::Unorm).unwrap();
    let mut texels = vec![[9; 4]; 12];
    assert!(height_to_normal::bake_into(&field, &bake, &mut texels[..11]).is_err());
    assert_eq!(texels, vec![[9; 4]; 12], "untouched");
    height_to_normal::bake_into(&field, &bake, &mut texels).unwrap();
    assert_eq!(texels, height_to_normal::bake(&field, &bake).texels);
}

proptest! {
    #[test]
    fn hardened_forward_differences_follow_their_formula(field in fields(), scale in 0.0f32..0.5) {
        for (edge, codec) in EDGES.into_iter().flat_map(|e| CODECS.map(|c| (e, c))) {
            let bake = Bake::forward(&field, [scale; 2], edge, codec).unwrap();
            let map = height_to_normal::bake(&field, &bake);
            for (x, y) in (0..field.height).flat_map(|y| (0..field.width).map(move |x| (x, y))) {
                let h = |dx: i64, dy: i64| {
                    let (i, j) = (i64::from(x) + dx, i64::from(y) + dy);
                    f64::from(field.texel(edge.resolve(i, field.width), edge.resolve(j, field.height)))
                };
                let gx = (h(1, 0) - h(0, 0)) * f64::from(scale) * f64::from(field.width);
                let gy = (h(0, 1) - h(0, 0)) * f64::from(scale) * f64::from(field.height);
                let error = map.decode(x, y).as_dvec3() - DVec3::new(-gx, -gy, 1.0).normalize();
                prop_assert!(error.abs().max_element() <= bound(codec), "({x}, {y}) {edge:?} {codec:?}: {error}");
            }
        }
    }
}
