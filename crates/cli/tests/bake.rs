//! `bossage bake`, run as a user runs it: CPU and GPU write the same maps, in every codec.

mod tool;

use std::collections::BTreeMap;
use std::path::Path;

use tool::{bossage, entries, has_adapter, repository, text};

/// Both sides do the same operations in the same order, and multiply and add alike. WGSL lets `sqrt` be off by 4.5 ulp
/// (2 of `inverseSqrt`, 2.5 of the division) and `/` by 2.5; the processor's are off by 0.5 each: together 8 ulp at most, or
/// 8 · 2⁻²³ of a component of at most 1. A byte is 127.5 times that component, truncated, so it can differ, by one, only
/// within 127.5 · 8 · 2⁻²³ of an integer: for 2.5e-4 of all values, if they are spread evenly.
#[test]
fn bakes_are_the_same_on_both_sides() {
    const SHARE: f64 = 2.0 * 127.5 * 8.0 / 8_388_608.0;
    let folder = tempfile::tempdir().unwrap();
    let height = repository("examples/textures/bricks_height.png");
    let variants: &[&[&str]] = &[
        &["--normal", "central"],
        &[
            "--normal", "central", "--codec", "biased", "--edge", "mirror", "--scale", "0.1",
        ],
        &["--normal", "central", "--edge", "clamp"],
        &["--normal", "forward"],
    ];
    let adapter = has_adapter();
    for (index, variant) in variants.iter().enumerate() {
        let bake = |name: &str, more: &[&str]| {
            let out = folder.path().join(format!("{index}{name}"));
            let call = [&["bake", text(&height), "-o", text(&out)], *variant, more].concat();
            bossage(&call).exits(0);
            image::open(out.join("bricks_height_normal.png"))
                .unwrap()
                .to_rgba8()
                .into_raw()
        };
        let cpu = bake("cpu", &[]);
        assert!(
            cpu.chunks(4).any(|texel| texel[0] != texel[1]),
            "{variant:?}: red and green are the same"
        );
        if adapter {
            let gpu = bake("gpu", &["--gpu"]);
            assert_eq!(gpu.len(), cpu.len());
            let apart: Vec<u8> = gpu
                .iter()
                .zip(&cpu)
                .map(|(a, b)| a.abs_diff(*b))
                .filter(|step| *step > 0)
                .collect();
            let share = apart.len() as f64 / cpu.len() as f64;
            assert!(
                apart.iter().all(|step| *step == 1),
                "{variant:?}: bytes differ by more than one"
            );
            assert!(
                share <= SHARE,
                "{variant:?}: {share} of all bytes differ, not {SHARE}"
            );
        }
    }
}

/// The samples of every PNG in a folder, by name.
fn pictures(folder: &Path) -> BTreeMap<String, image::DynamicImage> {
    let names = entries(folder);
    names
        .into_iter()
        .map(|name| {
            let picture = image::open(folder.join(&name)).unwrap();
            (name, picture)
        })
        .collect()
}

/// Where codes of both sides differ, they differ by one, and no larger a share of them does than f32 can make.
fn same_codes(
    cpu: &BTreeMap<String, image::DynamicImage>,
    gpu: &BTreeMap<String, image::DynamicImage>,
    share: f64,
) {
    assert_eq!(cpu.keys().collect::<Vec<_>>(), gpu.keys().collect::<Vec<_>>());
    let codes = |pictures: &BTreeMap<String, image::DynamicImage>| -> Vec<u16> {
        let samples = |picture: &image::DynamicImage| match picture {
            image::DynamicImage::ImageRgb16(picture) => picture.as_raw().clone(),
            other => other.to_rgba8().into_raw().into_iter().map(u16::from).collect(),
        };
        pictures.values().flat_map(samples).collect()
    };
    let (cpu, gpu) = (codes(cpu), codes(gpu));
    let apart: Vec<u16> = cpu
        .iter()
        .zip(&gpu)
        .map(|(a, b)| a.abs_diff(*b))
        .filter(|step| *step > 0)
        .collect();
    assert!(
        apart.iter().all(|step| *step == 1),
        "codes differ by more than one"
    );
    let found = apart.len() as f64 / cpu.len() as f64;
    assert!(found <= share, "{found} of all codes differ, not {share}");
}

/// A direction in f32 is off by a few roundings: 8·2⁻²⁴ of a component of at most 1. A code is `m`/2 times the component, so it can
/// differ, by one, only within m/2 · 8·2⁻²⁴ of a boundary, on either side: for that share of codes, twice.
#[test]
fn normalisation_cubes_are_the_same_on_both_sides() {
    let folder = tempfile::tempdir().unwrap();
    for (bits, largest, size) in [("8", 255.0, "64"), ("16", 65535.0, "33")] {
        let bake = |name: &str, more: &[&str]| {
            let out = folder.path().join(format!("{bits}{name}"));
            let call = [
                "bake",
                "-o",
                text(&out),
                "--normalisation-cube",
                size,
                "--bits",
                bits,
            ];
            let run = bossage(&[&call, more].concat()).exits(0);
            assert_eq!(run.stdout.lines().count(), 6, "{}", run.stdout);
            pictures(&out)
        };
        let cpu = bake("cpu", &[]);
        assert!(cpu.contains_key(&format!("normalisation_{size}_nz.png")));
        let side: u32 = size.parse().unwrap();
        assert!(
            cpu.values()
                .all(|picture| (picture.width(), picture.height()) == (side, side))
        );
        if has_adapter() {
            same_codes(&cpu, &bake("gpu", &["--gpu"]), largest * 8.0 / f64::from(1 << 24));
        }
    }
}

#[test]
fn mips_of_normal_maps_are_the_same_on_both_sides() {
    let folder = tempfile::tempdir().unwrap();
    let height = repository("examples/textures/bricks_height.png");
    let bake = |name: &str, more: &[&str]| {
        let out = folder.path().join(name);
        let call = [
            "bake",
            text(&height),
            "-o",
            text(&out),
            "--codec",
            "biased",
            "--mips",
        ];
        bossage(&[&call, more].concat()).exits(0);
        pictures(&out)
    };
    let cpu = bake("cpu", &[]);
    let sides: Vec<u32> = cpu.values().map(image::DynamicImage::width).collect();
    assert!(
        sides.contains(&1) && sides.len() > 4,
        "down to one texel: {sides:?}"
    );
    // As for bakes: 8 ULP of a component, and the average of four of them, twice as many at most.
    if has_adapter() {
        same_codes(&cpu, &bake("gpu", &["--gpu"]), 2.0 * 127.5 * 16.0 / 8_388_608.0);
    }
}

#[test]
fn every_codec_says_the_same_normals() {
    use bossage_assets::{NormalCodec, NormalEncoding, load_image};
    let folder = tempfile::tempdir().unwrap();
    let height = repository("examples/textures/bricks_height.png");
    let encodings = [
        NormalEncoding::Linear(NormalCodec::Unorm),
        NormalEncoding::Linear(NormalCodec::Biased),
        NormalEncoding::Snorm,
        NormalEncoding::TwoChannel,
        NormalEncoding::Octahedral,
    ];
    let maps = encodings.map(|encoding| {
        let out = folder.path().join(encoding.name());
        bossage(&[
            "bake",
            text(&height),
            "-o",
            text(&out),
            "--codec",
            encoding.name(),
        ])
        .exits(0);
        let image = load_image(&out.join("bricks_height_normal.png")).unwrap();
        encoding.load(&image, NormalCodec::Unorm).unwrap()
    });
    for (encoding, map) in encodings.iter().zip(&maps) {
        let apart =
            |(a, b): (&[u8; 4], &[u8; 4])| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
        let most = map
            .texels
            .iter()
            .zip(&maps[0].texels)
            .map(apart)
            .max()
            .unwrap_or(0);
        // Half a step in each of three roundings, stretched by at most √3 on the octahedron: below three bytes.
        assert!(most <= 3, "{encoding:?}: {most}");
    }
}
