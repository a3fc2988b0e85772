//! What `window_maxima` promises, against brute force: the surface read at all places where a bilinear function over a block can be
//! greatest, by a walk that knows no windows.

use bossage_assets::window_maxima::{self, BLOCK, REACHES, SLACK, WindowMaxima};
use bossage_assets::{EdgeMode, HeightField};
use proptest::prelude::*;

const EDGES: [EdgeMode; 3] = [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp];

/// The surface at a place in half texels from the tile's corner: there are all corners of the bilinear pieces of every texel.
fn height(field: &HeightField, edge: EdgeMode, x: i64, y: i64) -> f64 {
    let texel =
        |i: i64, j: i64| f64::from(field.texel(edge.resolve(i, field.width), edge.resolve(j, field.height)));
    // Half texel 2k + 1 is the centre of texel k; an even one lies between two.
    let beside = |x: i64| [(x - 1).div_euclid(2), x.div_euclid(2)];
    let (columns, rows) = (beside(x), beside(y));
    let sum: f64 = rows.into_iter().flat_map(|j| columns.map(|i| texel(i, j))).sum();
    sum / 4.0
}

/// The greatest height over a window, its border included.
fn greatest(field: &HeightField, edge: EdgeMode, block: [u32; 2], reach: u32, forward: [bool; 2]) -> f64 {
    let span = |axis: usize| {
        let (side, first) = (2 * i64::from(BLOCK), i64::from(block[axis]));
        let reach = i64::from(reach);
        let from = if forward[axis] { first } else { first + 1 - reach };
        from * side..=(from + reach) * side
    };
    let places = span(1).flat_map(|y| span(0).map(move |x| (x, y)));
    places.map(|(x, y)| height(field, edge, x, y)).fold(0.0, f64::max)
}

/// The first window whose depth is too great (the surface stands in it) or less than need be.
fn fault(field: &HeightField, edge: EdgeMode, map: &WindowMaxima) -> Option<String> {
    let blocks = (0..map.rows).flat_map(|row| (0..map.columns).map(move |column| [column, row]));
    let ways = [[false, false], [true, false], [false, true], [true, true]];
    let windows = blocks.flat_map(|block| ways.map(|forward| (block, forward)));
    windows
        .flat_map(|(block, forward)| [0, 1, 2, 3].map(|level| (block, forward, level)))
        .find_map(|(block, forward, level)| {
            let top = greatest(field, edge, block, REACHES[level], forward);
            let depth = f64::from(map.texel(block[0], block[1], forward)[level]) / 255.0;
            // Rounded down to 255ths, but not below 0; the maxima are rounded up to f32.
            let least = (1.0 - top - SLACK - 1.0 / 255.0 - 1e-6).max(0.0);
            let most = (1.0 - top - SLACK + 1e-9).max(0.0);
            let sides = (field.width, field.height);
            let said = format!(
                "{sides:?} {edge:?} block {block:?} {forward:?} reach {}",
                REACHES[level]
            );
            (depth > most || depth < least).then(|| format!("{said}: depth {depth}, surface up to {top}"))
        })
}

fn noise(width: u32, height: u32, seed: u32) -> HeightField {
    HeightField::from_fn(width, height, |x, y| {
        let n = (x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ seed).wrapping_mul(0xC2B2_AE3D);
        ((n ^ (n >> 15)) % 4096) as f32 / 4095.0
    })
}

fn spike(width: u32, height: u32) -> HeightField {
    HeightField::from_fn(width, height, |x, y| {
        if (x, y) == (width / 2, height / 3) {
            1.0
        } else {
            0.125
        }
    })
}

#[test]
fn no_window_holds_more_of_the_surface_than_it_says_nor_much_less() {
    let sides = [(1, 1), (1, 7), (5, 3), (4, 8), (13, 9), (16, 16), (33, 21)];
    for (width, height) in sides {
        for edge in EDGES {
            for field in [noise(width, height, 3), spike(width, height)] {
                let map = window_maxima::bake(&field, edge);
                assert_eq!(fault(&field, edge, &map), None);
            }
        }
    }
}

#[test]
fn levels_are_free_down_to_their_height() {
    for h in [0.0f32, 0.25, 1.0] {
        let map = window_maxima::bake(&HeightField::from_fn(9, 6, |_, _| h), EdgeMode::Clamp);
        assert_eq!(
            (map.columns, map.rows),
            (9u32.div_ceil(BLOCK), 6u32.div_ceil(BLOCK))
        );
        assert_eq!(map.texels.len() as u32, 4 * map.columns * map.rows);
        let depth = ((1.0 - f64::from(h) - SLACK) * 255.0).floor().max(0.0) as u8;
        assert!(map.texels.iter().all(|texel| *texel == [depth; 4]), "{h}");
    }
}

#[test]
fn a_window_that_is_deeper_or_of_another_quadrant_is_seen() {
    let field = spike(24, 24);
    let good = window_maxima::bake(&field, EdgeMode::Clamp);
    assert_eq!(fault(&field, EdgeMode::Clamp, &good), None);
    let deeper = |change: &dyn Fn(&mut WindowMaxima)| {
        let mut map = good.clone();
        change(&mut map);
        fault(&field, EdgeMode::Clamp, &map)
    };
    let one_more = deeper(&|map| {
        map.texels
            .iter_mut()
            .for_each(|texel| texel[2] = texel[2].saturating_add(1))
    });
    assert!(one_more.is_some());
    assert!(deeper(&|map| map.texels.iter_mut().for_each(|texel| texel[0] = 0)).is_some());
    let row = 2 * good.columns as usize;
    let turned = deeper(&|map| {
        map.texels
            .chunks_mut(row)
            .for_each(|row| row.rotate_left(row.len() / 2))
    });
    assert!(turned.is_some());
}

#[test]
fn maxima_of_texels_alone_are_refused() {
    // The classic bake knows the window's own texels; the surface over it reaches to its neighbours.
    let field = spike(16, 16);
    let mut map = window_maxima::bake(&field, EdgeMode::Wrap);
    let alone = |column: u32, row: u32| {
        let places = (0..BLOCK * BLOCK).map(|k| (BLOCK * column + k % BLOCK, BLOCK * row + k / BLOCK));
        places.map(|(x, y)| field.texel(x, y)).fold(0.0, f32::max)
    };
    let (columns, rows) = (map.columns, map.rows);
    for (place, texel) in (0..).zip(&mut map.texels) {
        let (x, y) = (place % (2 * columns) % columns, place / (2 * columns) % rows);
        texel[0] = ((1.0 - f64::from(alone(x, y)) - SLACK) * 255.0).floor().max(0.0) as u8;
    }
    assert!(fault(&field, EdgeMode::Wrap, &map).is_some());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn any_field(width in 1u32..20, height in 1u32..20, seed in any::<u32>(), edge in 0usize..3) {
        let field = noise(width, height, seed);
        let map = window_maxima::bake(&field, EDGES[edge]);
        prop_assert_eq!(fault(&field, EDGES[edge], &map), None);
    }
}
