//! Mip chains: sizes, weights, and what each kind of map averages.

use bossage_assets::mips::{self, Level, NormalMips};
use bossage_assets::{ColorMap, HeightField, NormalCodec, NormalMap};
use glam::{Vec3, Vec4};
use proptest::prelude::*;

fn level(width: u32, height: u32, at: impl Fn(u32, u32) -> f32) -> Level {
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Level {
        width,
        height,
        texels: texels.map(|(x, y)| Vec4::splat(at(x, y))).collect(),
    }
}

fn mean(level: &Level) -> f64 {
    level.texels.iter().map(|t| f64::from(t.x)).sum::<f64>() / level.texels.len() as f64
}

#[test]
fn sides_halve_and_round_down_to_one() {
    let sides: Vec<_> = mips::chain(level(13, 5, |_, _| 0.0))
        .iter()
        .map(|l| (l.width, l.height))
        .collect();
    assert_eq!(sides, [(13, 5), (6, 2), (3, 1), (1, 1)]);
    assert_eq!(
        [1, 2, 3, 512, 513].map(|n| mips::level_count(n, 1)),
        [1, 2, 2, 10, 10]
    );
}

#[test]
fn even_sides_average_two_by_two() {
    let chain = mips::chain(level(4, 2, |x, y| (x + 4 * y) as f32));
    assert_eq!(
        chain[1].texels.iter().map(|t| t.x).collect::<Vec<_>>(),
        [2.5, 4.5]
    );
    assert_eq!(chain[2].texels, [Vec4::splat(3.5)]);
}

#[test]
fn odd_sides_weigh_by_overlap() {
    // 3 texels over 1: thirds. 5 over 2: (1, 1, 1/2)·2/5 and (1/2, 1, 1)·2/5.
    let three = mips::chain(level(3, 1, |x, _| [3.0, 6.0, 30.0][x as usize]));
    // Thirds are rounded: 3 shares, 3 products, 2 sums of values up to 13.
    assert!((three[1].texels[0].x - 13.0).abs() <= 8.0 * 13.0 * 2f32.powi(-24));
    let five = mips::chain(level(5, 1, |x, _| [10.0, 20.0, 30.0, 40.0, 50.0][x as usize]));
    let expected = [(10.0 + 20.0 + 15.0) * 0.4, (15.0 + 40.0 + 50.0) * 0.4];
    for (texel, exact) in five[1].texels.iter().zip(expected) {
        assert!((texel.x - exact).abs() <= 8.0 * 42.0 * 2f32.powi(-24));
    }
}

#[test]
fn lists_that_do_not_fit_give_no_levels() {
    assert!(
        mips::chain(Level {
            width: 2,
            height: 2,
            texels: vec![Vec4::ZERO; 3]
        })
        .is_empty()
    );
    assert!(
        mips::chain(Level {
            width: 0,
            height: 2,
            texels: vec![]
        })
        .is_empty()
    );
}

proptest! {
    #[test]
    fn the_mean_of_the_image_is_kept(w in 1u32..40, h in 1u32..40, seed in any::<u32>()) {
        let at = |x: u32, y: u32| (x.wrapping_mul(73).wrapping_add(y * 179).wrapping_add(seed) % 256) as f32 / 255.0;
        let chain = mips::chain(level(w, h, at));
        // A texel sums at most 9 products of shares; 20 roundings of values ≤ 1 a level, at most 6 levels.
        for smaller in &chain {
            prop_assert!((mean(smaller) - mean(&chain[0])).abs() <= 120.0 * 2f64.powi(-24));
        }
        prop_assert_eq!(chain.len() as u32, mips::level_count(w, h));
    }

    #[test]
    fn heights_stay_between_their_extremes(w in 1u32..20, h in 1u32..20, seed in any::<u32>()) {
        let at = |x: u32, y: u32| (x.wrapping_mul(31).wrapping_add(y * 17).wrapping_add(seed) % 97) as f32 / 96.0;
        let chain = mips::height_chain(&HeightField::from_fn(w, h, at));
        let (low, high) = chain[0].range();
        for smaller in &chain {
            let (l, h) = smaller.range();
            prop_assert!(l >= low - 1e-6 && h <= high + 1e-6); // shares sum to 1 within 9·2⁻²⁵ a level
        }
    }
}

#[test]
fn colours_are_averaged_in_light_not_in_bytes() {
    let map = ColorMap {
        width: 2,
        height: 1,
        texels: vec![[0, 0, 0, 255], [255, 255, 255, 255]],
    };
    let chain = mips::color_chain(&map);
    // Half the light is sRGB 187.5; byte averaging would give 127 or 128.
    assert_eq!(chain[1].texels, [[188, 188, 188, 255]]);
    assert_eq!(chain[0], map);
}

#[test]
fn invisible_texels_do_not_bleed() {
    let map = ColorMap {
        width: 2,
        height: 1,
        texels: vec![[0, 255, 0, 0], [200, 0, 0, 255]],
    };
    assert_eq!(mips::color_chain(&map)[1].texels, [[200, 0, 0, 128]]);
    // The control: where nothing is visible, the colour survives.
    let clear = ColorMap {
        width: 2,
        height: 1,
        texels: vec![[9, 9, 9, 0]; 2],
    };
    assert_eq!(mips::color_chain(&clear)[1].texels, [[9, 9, 9, 0]]);
}

#[test]
fn normals_are_renormalised_and_the_base_is_left_alone() {
    let codec = NormalCodec::Biased;
    let encode = |n: Vec3| {
        let [r, g, b] = n.to_array().map(|c| codec.encode(c));
        [r, g, b, 77]
    };
    let tilted = [Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8)];
    let map = NormalMap {
        width: 2,
        height: 1,
        codec,
        texels: tilted.map(encode).to_vec(),
    };
    let chain = mips::normal_chain(&map, NormalMips::Naive);
    assert_eq!(chain[1].texels, [[128, 128, 255, 77]]);
    assert_eq!(chain[0], map);
    // Opposite normals cancel: straight up, not NaN.
    let opposite = NormalMap {
        width: 2,
        height: 1,
        codec,
        texels: [Vec3::X, -Vec3::X].map(encode).to_vec(),
    };
    assert_eq!(
        mips::normal_chain(&opposite, NormalMips::Naive)[1].decode(0, 0),
        Vec3::Z
    );
}
