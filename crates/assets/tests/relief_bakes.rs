//! Maps for tracing relief: what makes each right, against brute force on small fields, with the classic forms as controls.

use bossage_assets::max_mip::codes::MaxCodes;
use bossage_assets::{ConeMap, EdgeMode, HeightField, cone_map, max_mip, relaxed_cone_map};

const EDGES: [EdgeMode; 3] = [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp];

fn noise(w: u32, h: u32, seed: u32) -> HeightField {
    HeightField::from_fn(w, h, |x, y| {
        let n = (x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ seed).wrapping_mul(0xC2B2_AE3D);
        ((n ^ (n >> 15)) % 256) as f32 / 255.0
    })
}

fn waves(w: u32, h: u32) -> HeightField {
    HeightField::from_fn(w, h, |x, y| {
        0.5 + 0.4 * (0.9 * x as f32).sin() * (0.7 * y as f32).cos()
    })
}

fn spike(w: u32, h: u32) -> HeightField {
    HeightField::from_fn(w, h, |x, y| if (x, y) == (w / 2, h / 2) { 1.0 } else { 0.25 })
}

/// Ground, and a block with a flat top.
fn block(w: u32, h: u32) -> HeightField {
    HeightField::from_fn(w, h, |x, y| {
        if (4..8).contains(&x) && (3..7).contains(&y) {
            0.9
        } else {
            0.1
        }
    })
}

fn fields() -> Vec<HeightField> {
    vec![
        noise(1, 1, 1),
        noise(1, 6, 2),
        noise(7, 5, 3),
        waves(12, 9),
        spike(8, 8),
        block(12, 10),
    ]
}

/// One value a texel, filtered at a place in texels (texel centres at whole numbers).
fn filtered(field: &HeightField, values: &[f32], edge: EdgeMode, x: f64, y: f64) -> f64 {
    let (i, j) = (x.floor(), y.floor());
    let (fx, fy) = (x - i, y - j);
    let value = |di: f64, dj: f64| {
        let column = edge.resolve((i + di) as i64, field.width) as usize;
        let row = edge.resolve((j + dj) as i64, field.height) as usize;
        f64::from(values[row * field.width as usize + column])
    };
    (1.0 - fx) * (1.0 - fy) * value(0.0, 0.0)
        + fx * (1.0 - fy) * value(1.0, 0.0)
        + (1.0 - fx) * fy * value(0.0, 1.0)
        + fx * fy * value(1.0, 1.0)
}

fn height(field: &HeightField, edge: EdgeMode, x: f64, y: f64) -> f64 {
    filtered(field, &field.texels, edge, x, y)
}

/// Places from `from` to `to`, `parts` a texel: whole numbers and places between.
fn places(from: i32, to: i32, parts: i32) -> impl Iterator<Item = f64> + Clone {
    (from * parts..to * parts).map(move |k| f64::from(k) / f64::from(parts))
}

fn grid(field: &HeightField, parts: i32) -> Vec<(f64, f64)> {
    let (w, h) = (field.width as i32, field.height as i32);
    places(0, h, parts)
        .flat_map(|y| places(0, w, parts).map(move |x| (x, y)))
        .collect()
}

/// Places on the tile and the tiles around, with their heights.
fn surroundings(field: &HeightField, edge: EdgeMode) -> Vec<(f64, f64, f64)> {
    let (w, h) = (field.width as i32, field.height as i32);
    places(-h, 2 * h, 3)
        .flat_map(|y| places(-w, 2 * w, 3).map(move |x| (x, y)))
        .map(|(x, y)| (x, y, height(field, edge, x, y)))
        .collect()
}

/// The first place where a cone of the map, filtered, holds a point of the surface.
fn cut_cone(field: &HeightField, edge: EdgeMode, map: &ConeMap) -> Option<String> {
    let longer = f64::from(field.width.max(field.height));
    let others = surroundings(field, edge);
    grid(field, 3).into_iter().find_map(|(x, y)| {
        let (ratio, h) = (
            filtered(field, &map.ratios, edge, x, y),
            height(field, edge, x, y),
        );
        let cut = others
            .iter()
            .find(|(qx, qy, qh)| (qx - x).hypot(qy - y) < ratio * longer * (qh - h) - 1e-12)?;
        Some(format!(
            "{}x{} {edge:?}: over ({x}, {y}), ratio {ratio}: {cut:?}",
            field.width, field.height
        ))
    })
}

/// The widest cone over a place that holds none of the surface, and is not wider than a longer side a height.
fn widest(field: &HeightField, others: &[(f64, f64, f64)], edge: EdgeMode, x: f64, y: f64) -> f64 {
    let longer = f64::from(field.width.max(field.height));
    let h = height(field, edge, x, y);
    let free = others
        .iter()
        .filter(|(_, _, qh)| *qh > h)
        .map(|(qx, qy, qh)| (qx - x).hypot(qy - y) / (qh - h));
    free.fold(longer, f64::min) / longer
}

#[test]
fn no_safe_cone_holds_any_of_the_surface_at_any_place() {
    for edge in EDGES {
        for field in fields() {
            let map = cone_map::bake(&field, edge);
            assert_eq!(map.ratios.len(), field.texels.len());
            assert!(map.ratios.iter().all(|ratio| *ratio > 0.0 && *ratio < 1.0));
            assert_eq!(cut_cone(&field, edge, &map), None);
        }
    }
}

#[test]
fn cones_between_texel_centres_only_are_cut() {
    // The control, and the classic form: for each texel the widest cone that holds no other texel.
    let field = spike(8, 8);
    let longer = f64::from(field.width);
    let centres: Vec<_> = (-8..16)
        .flat_map(|y| (-8..16).map(move |x| (f64::from(x), f64::from(y))))
        .map(|(x, y)| (x, y, height(&field, EdgeMode::Wrap, x, y)))
        .collect();
    let ratio = |texel: usize| {
        let (x, y) = ((texel % 8) as f64, (texel / 8) as f64);
        widest(&field, &centres, EdgeMode::Wrap, x, y).min(longer) as f32
    };
    let classic = ConeMap {
        width: 8,
        height: 8,
        ratios: (0..64).map(ratio).collect(),
    };
    assert!(cut_cone(&field, EdgeMode::Wrap, &classic).is_some());
}

#[test]
fn cones_four_times_as_wide_are_cut() {
    // The control of the comparison: our own maps, four times as wide.
    let mut cut = 0;
    for field in fields() {
        let mut map = cone_map::bake(&field, EdgeMode::Wrap);
        map.ratios.iter_mut().for_each(|ratio| *ratio *= 4.0);
        cut += u32::from(cut_cone(&field, EdgeMode::Wrap, &map).is_some());
    }
    assert!(cut >= 4, "{cut}");
}

#[test]
fn cones_are_nearly_as_wide_as_they_may_be() {
    // An even slope that ends in a cliff: away from the cliff the widest cone is the slope's inverse, and no more is lost than the
    // search lets go, a 16th.
    let ramp = HeightField::from_fn(64, 8, |x, _| x as f32 / 64.0);
    let map = cone_map::bake(&ramp, EdgeMode::Clamp);
    for x in 2..60 {
        let ratio = map.ratios[4 * 64 + x];
        assert!((16.0 / 17.0 - 1e-5..=1.0).contains(&ratio), "{x}: {ratio}");
    }
    // A spike far away: the cone reaches it but for the texels that cells take and the search lets go.
    let field = HeightField::from_fn(64, 64, |x, y| if (x, y) == (32, 32) { 1.0 } else { 0.0 });
    let map = cone_map::bake(&field, EdgeMode::Clamp);
    for x in 0..20u32 {
        let (reach, distance) = (64.0 * map.ratios[(32 * 64 + x) as usize], (32 - x) as f32);
        assert!(
            reach <= distance && reach >= (distance - 4.0) * 16.0 / 17.0,
            "{x}: {reach} of {distance}"
        );
    }
    let flat = HeightField::from_fn(9, 4, |_, _| 0.5);
    assert!(
        cone_map::bake(&flat, EdgeMode::Wrap)
            .ratios
            .iter()
            .all(|ratio| *ratio > 0.9999)
    );
}

/// The first ray from a cone's axis that comes out of the surface again inside the cone.
fn crossed_twice(field: &HeightField, edge: EdgeMode, map: &ConeMap) -> Option<String> {
    const STEPS: i32 = 96;
    let longer = f64::from(field.width.max(field.height));
    grid(field, 2).into_iter().find_map(|(x, y)| {
        let (ratio, h) = (longer * filtered(field, &map.ratios, edge, x, y), height(field, edge, x, y));
        for turn in 0..16 {
            let (sin, cos) = (f64::from(turn) * std::f64::consts::TAU / 16.0 + 0.1).sin_cos();
            // Texels a unit of height, up to nearly level; starts between the tip and the layer's top.
            for reach in [0.5, 3.0, 20.0, 1e4] {
                for start in [0.02, 0.2, 0.6, 1.0].map(|share| h + share * (1.0 - h)) {
                    let fall = ratio * (start - h) / (ratio + reach);
                    let over = |step: i32| {
                        let down = fall * f64::from(step) / f64::from(STEPS);
                        let away = reach * down;
                        height(field, edge, x + away * cos, y + away * sin) - (start - down)
                    };
                    let entered = (0..=STEPS).find(|step| over(*step) > 1e-6);
                    let out = entered.and_then(|entered| (entered..=STEPS).find(|step| over(*step) < -1e-6));
                    if out.is_some() {
                        return Some(format!(
                            "{}x{} {edge:?}: over ({x}, {y}) ratio {ratio}, turn {turn}, reach {reach}, from {start}",
                            field.width, field.height
                        ));
                    }
                }
            }
        }
        None
    })
}

#[test]
fn no_ray_crosses_the_surface_twice_in_a_relaxed_cone() {
    for edge in EDGES {
        for field in fields() {
            let map = relaxed_cone_map::bake(&field, edge);
            assert_eq!(crossed_twice(&field, edge, &map), None);
        }
    }
}

#[test]
fn a_wider_relaxed_cone_is_crossed_twice() {
    for field in [spike(8, 8), block(12, 10), noise(7, 5, 3)] {
        let mut map = relaxed_cone_map::bake(&field, EdgeMode::Wrap);
        map.ratios.iter_mut().for_each(|ratio| *ratio *= 4.0);
        assert!(
            crossed_twice(&field, EdgeMode::Wrap, &map).is_some(),
            "{}x{}",
            field.width,
            field.height
        );
    }
}

#[test]
fn relaxed_cones_are_wider_where_flanks_rise() {
    for edge in EDGES {
        for field in fields() {
            let (safe, relaxed) = (cone_map::bake(&field, edge), relaxed_cone_map::bake(&field, edge));
            let pairs = safe.ratios.iter().zip(&relaxed.ratios);
            // Each search lets go a 16th of its own.
            assert!(
                pairs
                    .into_iter()
                    .all(|(safe, relaxed)| *relaxed >= safe * 16.0 / 17.0)
            );
        }
    }
    // On a slope that only rises nothing comes out again: the cap, away from the cliff at the seam.
    let ramp = HeightField::from_fn(64, 8, |x, _| x as f32 / 64.0);
    let map = relaxed_cone_map::bake(&ramp, EdgeMode::Clamp);
    assert!((2..60).all(|x| map.ratios[4 * 64 + x] > 0.9999));
    // Before a block: the safe cone ends at the block's foot, the relaxed one at its far edge.
    let wall = HeightField::from_fn(64, 8, |x, _| if (32..40).contains(&x) { 1.0 } else { 0.0 });
    let [safe, relaxed] = [
        cone_map::bake(&wall, EdgeMode::Clamp),
        relaxed_cone_map::bake(&wall, EdgeMode::Clamp),
    ];
    let reach = |map: &ConeMap, x: usize| 64.0 * map.ratios[4 * 64 + x];
    assert!(
        reach(&safe, 20) <= 12.0 && reach(&relaxed, 20) >= 16.0,
        "{} {}",
        reach(&safe, 20),
        reach(&relaxed, 20)
    );
}

#[test]
fn codes_are_rounded_down() {
    let map = cone_map::bake(&waves(12, 9), EdgeMode::Wrap);
    for (code, ratio) in map.to_unorm16().iter().zip(&map.ratios) {
        let decoded = f64::from(*code) / 65535.0;
        assert!(decoded <= f64::from(*ratio) && f64::from(*ratio) - decoded < 1.0 / 65535.0);
    }
}

#[test]
fn codes_of_heights_are_rounded_up_and_no_more_than_need_be() {
    // Heights of 8 and of 16 bits stay what they are; next to them, and in between, the next code up.
    let value = |code: u16| f32::from(code) / 65535.0;
    let of = |h: f32| HeightField::from_fn(1, 1, |_, _| h).to_unorm16_up()[0];
    for byte in 0..=255u16 {
        assert_eq!(of(f32::from(byte) / 255.0), 257 * byte);
    }
    for code in 0..65535 {
        let next = code + 1;
        assert_eq!(of(value(code)), code);
        for above in [
            value(code).next_up(),
            (value(code) + value(next)) / 2.0,
            value(next),
        ] {
            assert_eq!(of(above), next, "{above:e}");
        }
    }
}

/// The first node of the coded chain that is not over the surface of the coded heights, or is more than a code over it on level 0.
fn not_over_the_codes(field: &HeightField, edge: EdgeMode, levels: &[MaxCodes]) -> Option<String> {
    let heights = field.to_unorm16_up();
    let coded = HeightField::from_fn(field.width, field.height, |x, y| {
        f32::from(heights[(y * field.width + x) as usize]) / 65536.0
    });
    levels.iter().enumerate().find_map(|(index, level)| {
        let shape = HeightField::from_fn(level.width, level.height, |_, _| 0.0);
        let places = (0..level.height).flat_map(|y| (0..level.width).map(move |x| (x, y)));
        places.into_iter().find_map(|(x, y)| {
            let code = f64::from(level.codes[(y * level.width + x) as usize]);
            // Codes over 65536 are exact in f32; the samples of the mirror test below are exact to far less than a code.
            let greatest = 65536.0 * greatest_over(&coded, edge, &shape, x, y);
            let loose = index == 0 && code >= greatest + 1.0;
            (code < greatest - 1e-6 || loose)
                .then(|| format!("{edge:?} level {index} ({x}, {y}): {code} over {greatest}"))
        })
    })
}

#[test]
fn codes_of_maxima_are_over_the_surface() {
    for edge in EDGES {
        for field in fields() {
            let levels = max_mip::codes::bake(&field, edge);
            let sides = max_mip::bake(&field, edge)
                .iter()
                .map(|level| (level.width, level.height))
                .collect::<Vec<_>>();
            assert_eq!(
                levels
                    .iter()
                    .map(|level| (level.width, level.height))
                    .collect::<Vec<_>>(),
                sides
            );
            assert_eq!(not_over_the_codes(&field, edge, &levels), None);
        }
    }
}

#[test]
fn codes_of_texels_alone_are_not_over_the_surface() {
    // The control: the classic chain's level 0, and our own with one code less.
    let field = spike(8, 8);
    let mut levels = max_mip::codes::bake(&field, EdgeMode::Wrap);
    let ours = levels[0].codes.clone();
    levels[0].codes = field.to_unorm16_up();
    assert!(not_over_the_codes(&field, EdgeMode::Wrap, &levels).is_some());
    levels[0].codes = ours.iter().map(|code| code - 1).collect();
    assert!(not_over_the_codes(&field, EdgeMode::Wrap, &levels).is_some());
}

#[test]
fn no_point_of_the_surface_is_over_its_nodes() {
    for edge in EDGES {
        for field in fields() {
            let levels = max_mip::bake(&field, edge);
            assert_eq!(
                levels.last().map(|level| (level.width, level.height)),
                Some((1, 1))
            );
            for level in &levels {
                for (x, y) in (0..level.height).flat_map(|y| (0..level.width).map(move |x| (x, y))) {
                    let top = f64::from(level.texel(x, y));
                    let greatest = greatest_over(&field, edge, level, x, y);
                    assert!(
                        greatest <= top + 1e-12,
                        "{}x{} {edge:?} {x} {y}",
                        level.width,
                        level.height
                    );
                    // Level 0 is exact: samples at the corners of the quarters of cells are among those looked at.
                    if level.width == field.width && level.height == field.height {
                        assert!(
                            top <= f64::from((greatest as f32).next_up()),
                            "{edge:?} {x} {y}: {top} over {greatest}"
                        );
                    }
                }
            }
        }
    }
}

/// The highest of 33 × 33 places on a node's closed rectangle.
fn greatest_over(field: &HeightField, edge: EdgeMode, level: &HeightField, x: u32, y: u32) -> f64 {
    let place = |node: u32, nodes: u32, side: u32, k: u32| {
        (f64::from(node) + f64::from(k) / 32.0) * f64::from(side) / f64::from(nodes) - 0.5
    };
    let samples = (0..=32).flat_map(|j| (0..=32).map(move |i| (i, j)));
    let heights = samples.map(|(i, j)| {
        height(
            field,
            edge,
            place(x, level.width, field.width, i),
            place(y, level.height, field.height, j),
        )
    });
    heights.fold(0.0, f64::max)
}

#[test]
fn texel_maxima_alone_are_not_over_the_surface() {
    // The control: the classic chain, which takes a node's own texels only.
    let field = spike(8, 8);
    let beside = height(&field, EdgeMode::Wrap, 3.5, 4.0);
    assert!(
        beside > f64::from(field.texel(3, 4)),
        "the square of texel 3 reaches to 3.5"
    );
    let ours = max_mip::bake(&field, EdgeMode::Wrap);
    assert!(f64::from(ours[0].texel(3, 4)) >= beside);
}

#[test]
fn edges_differ_where_they_should() {
    // The left column is high: across the seam the last column's squares reach half-way up to it, and only when the tile repeats.
    let field = HeightField::from_fn(8, 4, |x, _| if x == 0 { 1.0 } else { 0.0 });
    let last = |edge| max_mip::bake(&field, edge)[0].texel(7, 2);
    assert_eq!(EDGES.map(last), [0.5, 0.0, 0.0]);
    let wide = |edge| cone_map::bake(&field, edge).ratios[2 * 8 + 6];
    assert!(wide(EdgeMode::Wrap) < wide(EdgeMode::Clamp));
}
