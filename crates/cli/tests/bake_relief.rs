//! `bossage bake --max-mip --cone --relaxed-cone --window-maxima`, run as a user runs it: what the files hold, on which side they are
//! rounded, and what is refused.

mod tool;

use std::path::Path;

use bossage_assets::{
    Channel, EdgeMode, HeightField, cone_map, load_image, max_mip, relaxed_cone_map, window_maxima,
};
use bossage_reference::cone_map as reference;
use tool::{bossage, entries, text};

const ALL: [&str; 4] = ["--max-mip", "--cone", "--relaxed-cone", "--window-maxima"];

const EDGES: [(&str, EdgeMode); 3] = [
    ("wrap", EdgeMode::Wrap),
    ("mirror", EdgeMode::Mirror),
    ("clamp", EdgeMode::Clamp),
];

/// Bumps that fit no grid of codes.
fn height(x: u32, y: u32) -> f32 {
    0.5 + 0.45 * (0.9 * x as f32 + 1.7 * y as f32).sin() * (0.4 * x as f32).cos()
}

/// A height image of 8 bits, 16 bits or floats, by the extension and `bits`.
fn draw(path: &Path, width: u32, height_px: u32, bits: u32) {
    let red = |x, y| height(x, y);
    match bits {
        8 => image::GrayImage::from_fn(width, height_px, |x, y| image::Luma([(red(x, y) * 255.0) as u8]))
            .save(path)
            .unwrap(),
        16 => image::ImageBuffer::<image::Luma<u16>, Vec<u16>>::from_fn(width, height_px, |x, y| {
            image::Luma([(red(x, y) * 65535.0) as u16])
        })
        .save(path)
        .unwrap(),
        _ => image::Rgb32FImage::from_fn(width, height_px, |x, y| image::Rgb([red(x, y); 3]))
            .save(path)
            .unwrap(),
    }
}

/// The samples of a file, `channels` a texel, and its sides.
fn samples(path: &Path, channels: usize) -> ([u32; 2], Vec<Vec<u16>>) {
    let picture = image::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let sides = [picture.width(), picture.height()];
    let flat = match picture {
        image::DynamicImage::ImageLuma16(p) => p.into_raw(),
        image::DynamicImage::ImageRgb16(p) => p.into_raw(),
        image::DynamicImage::ImageRgba8(p) => p.into_raw().into_iter().map(u16::from).collect(),
        other => panic!("{}: {:?}", path.display(), other.color()),
    };
    assert_eq!(flat.len(), channels * (sides[0] * sides[1]) as usize);
    (sides, flat.chunks(channels).map(<[u16]>::to_vec).collect())
}

/// The first texel whose stored cone is not the baked one, raised and narrowed by less than a code each.
fn not_inside(stored: &[Vec<u16>], heights: &[f32], ratios: &[f32]) -> Option<String> {
    let value = |code: u16| f64::from(code) / 65535.0;
    stored
        .iter()
        .zip(heights.iter().zip(ratios))
        .find_map(|(texel, (height, ratio))| {
            // A code stands for the f32 next to it: heights of 16-bit images are kept.
            let raised = f64::from(value(texel[0]) as f32) - f64::from(*height);
            let narrowed = f64::from(*ratio) - value(texel[1]);
            let inside = [raised, narrowed]
                .iter()
                .all(|by| (0.0..1.0 / 65535.0).contains(by));
            (!inside || texel[1] == 0 || texel[2] != 0)
                .then(|| format!("{texel:?} of {height} and {ratio}: by {raised}, {narrowed}"))
        })
}

#[test]
fn files_hold_the_maps_on_the_safe_side() {
    let folder = tempfile::tempdir().unwrap();
    for (name, width, rows, bits) in [
        ("bytes.png", 13, 6, 8),
        ("words.png", 5, 9, 16),
        ("floats.exr", 8, 3, 32),
        ("one.png", 1, 1, 8),
    ] {
        let source = folder.path().join(name);
        draw(&source, width, rows, bits);
        let field = HeightField::from_image(&load_image(&source).unwrap(), Channel::Red).unwrap();
        for (word, edge) in EDGES {
            let out = folder.path().join(format!("{name}_{word}"));
            let call = ["bake", text(&source), "-o", text(&out), "--edge", word];
            let run = bossage(&[&call[..], &ALL].concat()).exits(0);
            let levels = max_mip::codes::bake(&field, edge);
            // The normal map, the levels, two maps of cones and the windows, each of them named on standard output.
            assert_eq!(run.stdout.lines().count(), levels.len() + 4, "{}", run.stdout);
            assert_eq!(entries(&out).len(), levels.len() + 4);
            let stem = name.split('.').next().unwrap();
            let file = |map: &str| out.join(format!("{stem}_{map}.png"));
            for (index, level) in levels.iter().enumerate() {
                let (sides, codes) = samples(&file(&format!("max_mip{index}")), 1);
                assert_eq!(sides, [level.width, level.height]);
                assert_eq!(codes.concat(), level.codes);
            }
            for (map, cones) in [
                ("cone", cone_map::bake(&field, edge)),
                ("relaxed_cone", relaxed_cone_map::bake(&field, edge)),
            ] {
                let (sides, stored) = samples(&file(map), 3);
                assert_eq!(sides, [width, rows]);
                assert_eq!(
                    not_inside(&stored, &field.texels, &cones.ratios),
                    None,
                    "{name} {word} {map}"
                );
            }
            let windows = window_maxima::bake(&field, edge);
            let (sides, depths) = samples(&file("window_maxima"), 4);
            assert_eq!(sides, [2 * windows.columns, 2 * windows.rows]);
            let baked = windows.texels.as_flattened().iter().map(|byte| u16::from(*byte));
            assert_eq!(depths.concat(), baked.collect::<Vec<_>>());
        }
    }
}

/// Whole numbers only: every adapter, and the evaluator where there is none, gives the same codes.
#[test]
fn maxima_are_the_same_on_both_sides() {
    let folder = tempfile::tempdir().unwrap();
    for (name, width, rows, bits) in [
        ("odd.png", 37, 22, 16),
        ("floats.exr", 9, 16, 32),
        ("one.png", 1, 1, 8),
    ] {
        let source = folder.path().join(name);
        draw(&source, width, rows, bits);
        for (word, _) in EDGES {
            let bake = |side: &str, more: &[&str]| {
                let out = folder.path().join(format!("{name}_{word}_{side}"));
                let call = [
                    "bake",
                    text(&source),
                    "-o",
                    text(&out),
                    "--edge",
                    word,
                    "--max-mip",
                ];
                bossage(&[&call, more].concat()).exits(0);
                let names = entries(&out).into_iter().filter(|name| name.contains("max_mip"));
                names.map(|name| samples(&out.join(&name), 1)).collect::<Vec<_>>()
            };
            let (cpu, gpu) = (bake("cpu", &[]), bake("gpu", &["--gpu"]));
            assert!(cpu.len() == gpu.len() && !cpu.is_empty());
            assert!(cpu == gpu, "{name} {word}");
        }
    }
}

/// The first texel whose stored ratio is below what the boxes of cells allow, less the 16th that a search lets go and a code, or above
/// what the steepest way to another texel leaves.
fn not_between(stored: &[Vec<u16>], field: &HeightField, edge: EdgeMode, free: bool) -> Option<String> {
    let (w, h) = (field.width as usize, field.height as usize);
    let longer = w.max(h) as f64;
    let boxes = reference::boxes(field, edge);
    let texels = reference::surroundings(field, edge, 1, 0.0);
    stored.iter().enumerate().find_map(|(index, texel)| {
        let (x, y) = (index % w, index / w);
        let cells = [(x, y), (x + w - 1, y), (x, y + h - 1), (x + w - 1, y + h - 1)];
        let most = cells
            .map(|(x, y)| boxes[(y % h) * w + x % w])
            .into_iter()
            .fold(1.0 / longer, f64::max);
        let least = 16.0 / 17.0 / (longer * most) * (1.0 - 1.0 / f64::from(1 << 18)) - 1.0 / 65535.0;
        let from = reference::place(field, edge, glam::DVec2::new(x as f64, y as f64));
        let steepest = if free {
            reference::steepest(from, &texels)
        } else {
            0.0
        };
        let widest = 1.0 / (longer * steepest.max(1.0 / longer));
        let ratio = f64::from(texel[1]) / 65535.0;
        (ratio < least || ratio > widest).then(|| format!("({x}, {y}): {ratio}, {least} to {widest}"))
    })
}

/// Both sides search in their own order: not equal code by code, but each between what it must and may be. `bossage conform cone_map/bake`
/// looks closer; this is about the road to the files.
#[test]
fn cones_of_both_sides_are_right() {
    let folder = tempfile::tempdir().unwrap();
    for (name, width, rows, bits) in [("odd.png", 37, 22, 8), ("one.png", 1, 1, 8)] {
        let source = folder.path().join(name);
        draw(&source, width, rows, bits);
        let field = HeightField::from_image(&load_image(&source).unwrap(), Channel::Red).unwrap();
        for (flag, map) in [("--cone", "cone"), ("--relaxed-cone", "relaxed_cone")] {
            for side in ["cpu", "gpu"] {
                let out = folder.path().join(format!("{name}{flag}{side}"));
                let call = ["bake", text(&source), "-o", text(&out), flag];
                let more: &[&str] = if side == "gpu" { &["--gpu"] } else { &[] };
                bossage(&[&call, more].concat()).exits(0);
                let stem = name.split('.').next().unwrap();
                let stored = samples(&out.join(format!("{stem}_{map}.png")), 3).1;
                let heights: Vec<u16> = stored.iter().map(|texel| texel[0]).collect();
                assert_eq!(heights, field.to_unorm16_up());
                let free = flag == "--cone";
                assert_eq!(
                    not_between(&stored, &field, EdgeMode::Wrap, free),
                    None,
                    "{name} {map} {side}"
                );
                // The control: a quarter and four times of it.
                let scaled = |by: f64| -> Vec<Vec<u16>> {
                    let ratio = |texel: &Vec<u16>| vec![texel[0], (f64::from(texel[1]) * by) as u16, 0];
                    stored.iter().map(ratio).collect()
                };
                assert!(not_between(&scaled(0.25), &field, EdgeMode::Wrap, free).is_some());
                if free && field.texels.len() > 1 {
                    assert!(not_between(&scaled(4.0), &field, EdgeMode::Wrap, free).is_some());
                }
            }
        }
    }
}

#[test]
fn codes_on_the_other_side_are_caught() {
    // The control: rounded to the nearest, as one would by habit; each of the two numbers by itself.
    let (heights, ratios) = ([0.500_01_f32], [0.100_01_f32]);
    let near = |value: f32| (value * 65535.0 + 0.5) as u16;
    let (up, down) = (32769, 6554);
    assert!(near(heights[0]) < up && near(ratios[0]) == down);
    assert_eq!(not_inside(&[vec![up, down, 0]], &heights, &ratios), None);
    for wrong in [
        [near(heights[0]), down, 0],
        [up, down + 1, 0],
        [up, 0, 0],
        [up + 1, down, 0],
        [up, down, 1],
    ] {
        assert!(
            not_inside(&[wrong.to_vec()], &heights, &ratios).is_some(),
            "{wrong:?}"
        );
    }
}

#[test]
fn only_what_is_asked_for_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("h.png");
    draw(&source, 4, 4, 8);
    for (flag, names) in [
        (
            "--max-mip",
            vec!["h_max_mip0.png", "h_max_mip1.png", "h_max_mip2.png"],
        ),
        ("--cone", vec!["h_cone.png"]),
        ("--relaxed-cone", vec!["h_relaxed_cone.png"]),
        ("--window-maxima", vec!["h_window_maxima.png"]),
    ] {
        let out = folder.path().join(flag);
        bossage(&["bake", text(&source), "-o", text(&out), flag]).exits(0);
        let written = entries(&out);
        let mut expected: Vec<String> = names
            .into_iter()
            .chain(["h_normal.png"])
            .map(str::to_owned)
            .collect();
        expected.sort();
        assert_eq!(written, expected, "{flag}");
    }
    // The published normal map has its own border; beside maps that have one, the edge is theirs.
    let out = folder.path().join("forward");
    let call = [
        "bake",
        text(&source),
        "-o",
        text(&out),
        "--normal",
        "forward",
        "--edge",
        "clamp",
        "--cone",
    ];
    bossage(&call).exits(0);
}

#[test]
fn what_cannot_be_baked_is_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    for bad in [f32::NAN, f32::INFINITY, -0.25, 1.5] {
        let source = folder.path().join("bad.exr");
        image::Rgb32FImage::from_fn(3, 2, |x, y| {
            image::Rgb([if (x, y) == (2, 1) { bad } else { 0.5 }; 3])
        })
        .save(&source)
        .unwrap();
        let call = ["bake", text(&source), "-o", text(&out)];
        bossage(&[&call[..], &ALL].concat())
            .exits(2)
            .says(&["bad.exr", "(2, 1)"]);
        assert!(!out.exists(), "{bad}");
    }
    let source = folder.path().join("h.png");
    draw(&source, 4, 4, 8);
    bossage(&[
        "bake",
        text(&source),
        "-o",
        text(&out),
        "--gpu",
        "--window-maxima",
    ])
    .exits(2)
    .says(&["--gpu", "--window-maxima"]);
    for flag in ALL {
        bossage(&["bake", "-o", text(&out), "--normalisation-cube", "4", flag])
            .exits(2)
            .says(&["HEIGHT"]);
    }
    assert!(!out.exists());
}
