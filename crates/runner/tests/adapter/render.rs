//! Rendering: exact coverage, orientation, interpolation, depth, culling, samplers.
//!
//! Sizes, positions and values are dyadic: edge functions, plane equations and their products are exact in f32, and w = 1,
//! so pictures are compared without tolerance.

use bossage_runner::{
    AddressMode, Clear, Cull, Error, Filter, Picture, RenderJob, RenderOutput, RenderTarget, SamplerSettings,
    TextureData, is_unwritten,
};

use crate::flat::{SIZE, SURFACE, WHOLE, draw, job, plain, rectangle};
use crate::support::{compile, device};

/// Which pixels a draw wrote, as text.
fn coverage(picture: &Picture) -> Vec<String> {
    let row = |row: &[bool]| {
        row.iter()
            .map(|covered| if *covered { '#' } else { '.' })
            .collect()
    };
    picture
        .covered()
        .chunks(picture.width as usize)
        .map(row)
        .collect()
}

#[test]
fn captured_interpolants_are_exact_and_the_first_row_is_the_top() {
    let Some(device) = device("captured_interpolants_are_exact_and_the_first_row_is_the_top") else {
        return;
    };
    let surface = compile(SURFACE);
    let mesh = rectangle(WHOLE, 0.25);
    let output = job(vec![plain(&surface, &mesh, [1.0, 2.0, 3.0, 4.0])])
        .run(device)
        .unwrap();
    for (y, x) in (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| (y, x))) {
        assert_eq!(output.targets[0].pixel(x, y), Some([1.0, 2.0, 3.0, 4.0]));
        let uv = [(x as f32 + 0.5) / 8.0, (y as f32 + 0.5) / 8.0];
        assert_eq!(
            output.targets[2].pixel(x, y),
            Some([uv[0], uv[1], 0.0, 1.0]),
            "at {x}, {y}"
        );
    }
    assert_eq!(output.depth.as_deref(), Some(&[0.25; 64][..]));
    assert_eq!(output.targets[0].pixel(SIZE, 0), None);
}

#[test]
fn a_target_that_no_draw_writes_keeps_its_sentinel() {
    let Some(device) = device("a_target_that_no_draw_writes_keeps_its_sentinel") else {
        return;
    };
    let surface = compile(SURFACE);
    let mesh = rectangle(WHOLE, 0.5);
    let output = job(vec![plain(&surface, &mesh, [0.0; 4])]).run(device).unwrap();
    let untouched = output.targets[1]
        .pixels
        .iter()
        .flatten()
        .all(|value| is_unwritten(*value));
    assert!(untouched, "location 1 is not an output of this shader");
    assert!(!output.targets[1].covered().contains(&true));
}

#[test]
fn coverage_is_exact_for_rectangles_on_pixel_borders() {
    let Some(device) = device("coverage_is_exact_for_rectangles_on_pixel_borders") else {
        return;
    };
    let surface = compile(SURFACE);
    // Columns 2 to 4, rows 0 and 1: clip x from -0.5 to 0.25, y from 0.5 to 1.
    let mesh = rectangle([-0.5, 0.5, 0.25, 1.0], 0.5);
    let output = job(vec![plain(&surface, &mesh, [0.0; 4])]).run(device).unwrap();
    let mut expected = vec!["..###...", "..###..."];
    expected.extend(["........"; 6]);
    assert_eq!(coverage(&output.targets[0]), expected);
    let depth = output.depth.unwrap();
    assert_eq!(depth.iter().filter(|depth| **depth == 0.5).count(), 6);
    assert_eq!(depth.iter().filter(|depth| **depth == 1.0).count(), 58);
}

#[test]
fn discarded_pixels_are_not_covered() {
    let Some(device) = device("discarded_pixels_are_not_covered") else {
        return;
    };
    let surface = compile(SURFACE);
    let mesh = rectangle(WHOLE, 0.5);
    let holes = draw(surface.wgsl("vertex"), surface.wgsl("holes"), &mesh, [1.0; 4]);
    let output = job(vec![holes]).run(device).unwrap();
    let rows = [".#.#.#.#", "#.#.#.#."];
    assert_eq!(coverage(&output.targets[0]), rows.repeat(4));
}

#[test]
fn the_nearer_of_two_wins_in_either_order() {
    let Some(device) = device("the_nearer_of_two_wins_in_either_order") else {
        return;
    };
    let surface = compile(SURFACE);
    let (near, far) = (rectangle([-1.0, -1.0, 0.0, 1.0], 0.25), rectangle(WHOLE, 0.75));
    let near = plain(&surface, &near, [1.0; 4]);
    let far = plain(&surface, &far, [2.0; 4]);
    let forward = job(vec![near.clone(), far.clone()]).run(device).unwrap();
    let backward = job(vec![far, near]).run(device).unwrap();
    assert_eq!(forward.targets[0], backward.targets[0]);
    assert_eq!(forward.depth, backward.depth);
    let row: Vec<f32> = (0..SIZE)
        .map(|x| forward.targets[0].pixel(x, 3).unwrap()[0])
        .collect();
    assert_eq!(row, [1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0]);
}

#[test]
fn culling_leaves_out_the_side_it_names() {
    let Some(device) = device("culling_leaves_out_the_side_it_names") else {
        return;
    };
    let surface = compile(SURFACE);
    let mesh = rectangle(WHOLE, 0.5);
    let pixels = |cull: Cull| {
        let draw = bossage_runner::Draw {
            cull,
            ..plain(&surface, &mesh, [1.0; 4])
        };
        let output = job(vec![draw]).run(device).unwrap();
        output.targets[0]
            .covered()
            .iter()
            .filter(|covered| **covered)
            .count()
    };
    assert_eq!(
        [pixels(Cull::None), pixels(Cull::Back), pixels(Cull::Front)],
        [64, 64, 0]
    );
}

#[test]
fn the_background_keeps_its_colour() {
    let Some(device) = device("the_background_keeps_its_colour") else {
        return;
    };
    let background = [0.125, 0.25, 0.5, 1.0];
    let job = RenderJob {
        targets: vec![RenderTarget::floats(Clear::Colour(background))],
        ..job(Vec::new())
    };
    let output = job.run(device).unwrap();
    assert_eq!(output.targets[0].pixels, vec![background; 64]);
}

/// A picture of one row of eight pixels whose uv runs over −0.5 … 1.5, sampled from the two texels 1 and 3.
fn sampled(device: &dyn bossage_runner::Machine, address: AddressMode, filter: Filter) -> Vec<f32> {
    let surface = compile(SURFACE);
    let mut mesh = rectangle(WHOLE, 0.5);
    let uv = [[-0.5, 0.5], [1.5, 0.5], [1.5, 0.5], [-0.5, 0.5]];
    mesh = mesh.with("uv", &uv);
    let texture = TextureData::rgba32f(2, 1, &[[1.0; 4], [3.0; 4]]);
    let mut draw = draw(surface.wgsl("vertex"), surface.wgsl("textured"), &mesh, [0.0; 4]);
    draw.resources.textures.insert("picture".into(), &texture);
    let settings = SamplerSettings {
        address,
        filter,
        mip_filter: Filter::Nearest,
        anisotropy: 1,
    };
    draw.resources.samplers.insert("picture_sampler".into(), settings);
    let RenderOutput { targets, .. } = job(vec![draw]).run(device).unwrap();
    (0..SIZE).map(|x| targets[0].pixel(x, 0).unwrap()[0]).collect()
}

#[test]
fn address_modes_are_told_apart() {
    let Some(device) = device("address_modes_are_told_apart") else {
        return;
    };
    // Pixels sample u = -0.375, -0.125, 0.125, … 1.375: texels -1, -1, 0, 0, 1, 1, 2, 2.
    let nearest = |address| sampled(device, address, Filter::Nearest);
    assert_eq!(
        nearest(AddressMode::Wrap),
        [3.0, 3.0, 1.0, 1.0, 3.0, 3.0, 1.0, 1.0]
    );
    assert_eq!(
        nearest(AddressMode::Mirror),
        [1.0, 1.0, 1.0, 1.0, 3.0, 3.0, 3.0, 3.0]
    );
    assert_eq!(
        nearest(AddressMode::Clamp),
        [1.0, 1.0, 1.0, 1.0, 3.0, 3.0, 3.0, 3.0]
    );
}

#[test]
fn linear_filtering_mixes_at_dyadic_weights() {
    let Some(device) = device("linear_filtering_mixes_at_dyadic_weights") else {
        return;
    };
    // In texels from the first centre: -1.25, -0.75, -0.25, 0.25, 0.75, 1.25, 1.75, 2.25. Quarters are exact in eight bits of
    // sub-texel precision, and so are the mixes of 1 and 3.
    let clamped = sampled(device, AddressMode::Clamp, Filter::Linear);
    assert_eq!(clamped, [1.0, 1.0, 1.0, 1.5, 2.5, 3.0, 3.0, 3.0]);
    let wrapped = sampled(device, AddressMode::Wrap, Filter::Linear);
    assert_eq!(wrapped, [2.5, 2.5, 1.5, 1.5, 2.5, 2.5, 1.5, 1.5]);
}

#[test]
fn a_mesh_that_does_not_fit_is_refused() {
    let Some(device) = device("a_mesh_that_does_not_fit_is_refused") else {
        return;
    };
    let surface = compile(SURFACE);
    let fits = rectangle(WHOLE, 0.5);
    let mut cases = vec![
        ("uv", fits.clone()),
        ("position", fits.clone()),
        ("indices", fits.clone()),
    ];
    cases[0].1.attributes.remove("uv");
    cases[1].1.indices[4] = 4;
    cases[2].1.indices.pop();
    cases.push(("uv", fits.with("uv", &[[0.0; 3]; 4])));
    for (wrong, mesh) in &cases {
        let error = job(vec![plain(&surface, mesh, [0.0; 4])])
            .run(device)
            .unwrap_err();
        assert!(
            matches!(&error, Error::Mesh { attribute, .. } if attribute == wrong),
            "{wrong}: {error}"
        );
    }
}

#[test]
fn jobs_beyond_the_limits_are_refused() {
    let Some(device) = device("jobs_beyond_the_limits_are_refused") else {
        return;
    };
    let surface = compile(SURFACE);
    let mesh = rectangle(WHOLE, 0.5);
    let draws = vec![plain(&surface, &mesh, [0.0; 4])];
    let wide = RenderJob {
        width: u32::MAX,
        ..job(draws.clone())
    };
    assert!(matches!(wide.run(device), Err(Error::TooLarge { .. })));
    let empty = RenderJob {
        height: 0,
        ..job(draws.clone())
    };
    assert!(matches!(empty.run(device), Err(Error::Texture { .. })));
    let few = RenderJob {
        targets: vec![RenderTarget::floats(Clear::Sentinel); 2],
        ..job(draws.clone())
    };
    assert!(
        matches!(few.run(device), Err(Error::Interface { .. })),
        "location 2 has no target"
    );
    let many = RenderJob {
        targets: vec![RenderTarget::floats(Clear::Sentinel); 99],
        ..job(draws)
    };
    assert!(matches!(many.run(device), Err(Error::TooLarge { .. })));
    let swapped = draw(surface.wgsl("fragment"), surface.wgsl("vertex"), &mesh, [0.0; 4]);
    assert!(matches!(
        job(vec![swapped]).run(device),
        Err(Error::Interface { .. })
    ));
}
