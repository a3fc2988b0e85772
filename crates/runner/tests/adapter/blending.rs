//! Several draws into one target: blending, targets of bytes, the depth test of a second pass, passes in their order.
//!
//! Every answer is known on paper. A product of bytes may be either byte around a·b/255, and must be the byte itself where it is
//! one: an adapter need not round to nearest. lavapipe takes (a·b + ⌊a·b/256⌋ + 128)/256, so that 229·152 = 136.502·255 is 136.

use bossage_runner::{
    Blend, Clear, Depth, Draw, Error, Mesh, Picture, RenderJob, RenderOutput, RenderTarget, Resources,
    is_unwritten,
};

use crate::flat::{SURFACE, WHOLE, draw, job, plain, rectangle};
use crate::support::{compile, device};

/// The pictures of two draws of the whole target, the second blended with the first.
fn blended(targets: RenderTarget, first: [f32; 4], second: [f32; 4], blend: Blend) -> Option<Picture> {
    let device = device("blended")?;
    let surface = compile(SURFACE);
    let mesh = rectangle(WHOLE, 0.5);
    let draws = vec![
        plain(&surface, &mesh, first),
        Draw {
            blend,
            depth: Depth::Equal,
            ..plain(&surface, &mesh, second)
        },
    ];
    let mut job = job(draws);
    job.targets[0] = targets;
    Some(job.run(device).unwrap().targets.remove(0))
}

const FLOATS: RenderTarget = RenderTarget {
    format: bossage_runner::TargetFormat::Rgba32Float,
    clear: Clear::Sentinel,
};

fn bytes() -> RenderTarget {
    RenderTarget::bytes([1.0; 4])
}

/// A colour whose components are these bytes.
fn codes(codes: [u8; 4]) -> [f32; 4] {
    codes.map(|code| f32::from(code) / 255.0)
}

#[test]
fn floats_are_multiplied_added_and_replaced_exactly() {
    let run = |blend| blended(FLOATS, [0.5, 0.25, 2.0, 1.0], [0.5, 8.0, 4.0, 1.0], blend);
    let Some(product) = run(Blend::Multiply) else {
        return;
    };
    assert_eq!(product.pixels, [[0.25, 2.0, 8.0, 1.0]; 64]);
    assert_eq!(run(Blend::Add).unwrap().pixels, [[1.0, 8.25, 6.0, 2.0]; 64]);
    assert_eq!(run(Blend::Replace).unwrap().pixels, [[0.5, 8.0, 4.0, 1.0]; 64]);
    assert_eq!(product.codes(), None);
}

#[test]
fn bytes_are_multiplied_added_and_replaced_exactly() {
    let run = |blend| {
        blended(
            bytes(),
            codes([255, 200, 100, 3]),
            codes([7, 100, 200, 254]),
            blend,
        )
    };
    let Some(product) = run(Blend::Multiply) else {
        return;
    };
    // 200·100/255 = 78.4; 3·254/255 = 2.99.
    assert_eq!(product.codes().unwrap(), [[7, 78, 78, 3]; 64]);
    // Sums beyond 255 are clamped.
    let sum = run(Blend::Add).unwrap().codes().unwrap();
    assert_eq!(sum, [[255, 255, 255, 255]; 64]);
    let replaced = run(Blend::Replace).unwrap().codes().unwrap();
    assert_eq!(replaced, [[7, 100, 200, 254]; 64]);
}

#[test]
fn small_sums_of_bytes_are_exact() {
    let sum = blended(
        bytes(),
        codes([1, 2, 100, 0]),
        codes([3, 0, 100, 255]),
        Blend::Add,
    );
    let Some(sum) = sum else { return };
    assert_eq!(sum.codes().unwrap(), [[4, 2, 200, 255]; 64]);
}

#[test]
fn what_bytes_keep_is_clamped_and_rounded_to_nearest() {
    let kept = |colour| {
        let picture = blended(bytes(), colour, [1.0; 4], Blend::Multiply)?;
        Some(picture.codes().unwrap()[0])
    };
    let Some(clamped) = kept([-1.0, 2.0, -0.0, 1e30]) else {
        return;
    };
    assert_eq!(clamped, [0, 255, 0, 255]);
    // A tenth of a code on either side of the half: 10.4, 10.6, 254.4, 254.6.
    let near_half = [10.4, 10.6, 254.4, 254.6].map(|code: f32| code / 255.0);
    assert_eq!(kept(near_half).unwrap(), [10, 11, 254, 255]);
}

/// One pixel a pair of bytes: the first draw writes the column's byte, the second the row's.
const PAIRS: &str = "
@vertex fn vertex(@location(0) position: vec3f) -> @builtin(position) vec4f { return vec4f(position, 1.0); }
@fragment fn column(@builtin(position) clip: vec4f) -> @location(0) vec4f { return vec4f(floor(clip.x) / 255.0); }
@fragment fn row(@builtin(position) clip: vec4f) -> @location(0) vec4f { return vec4f(floor(clip.y) / 255.0); }
";

#[test]
fn all_products_of_two_bytes_are_one_of_the_bytes_around_them_on_both_routes() {
    let Some(device) = device("all_products_of_two_bytes_are_one_of_the_bytes_around_them_on_both_routes")
    else {
        return;
    };
    let pairs = compile(PAIRS);
    let mesh = rectangle(WHOLE, 0.5);
    for route in 0..pairs.both("vertex").len() {
        let stage = |entry: &str| pairs.both(entry)[route];
        let one = |fragment: &str, blend: Blend| Draw {
            blend,
            depth: Depth::Ignore,
            ..draw(stage("vertex"), stage(fragment), &mesh, [0.0; 4])
        };
        let job = RenderJob {
            name: "products",
            width: 256,
            height: 256,
            targets: vec![bytes()],
            read_depth: false,
            passes: vec![
                vec![one("column", Blend::Replace)],
                vec![one("row", Blend::Multiply)],
            ],
        };
        let found = job.run(device).unwrap().targets[0].codes().unwrap();
        let wrong = found.iter().enumerate().find(|(at, pixel)| {
            let product = at % 256 * (at / 256);
            let around = product / 255..=product.div_ceil(255);
            !pixel.iter().all(|code| around.contains(&usize::from(*code)))
        });
        assert_eq!(wrong, None);
    }
}

#[test]
fn passes_and_draws_follow_in_their_order() {
    let Some(device) = device("passes_and_draws_follow_in_their_order") else {
        return;
    };
    let surface = compile(SURFACE);
    let mesh = rectangle(WHOLE, 0.5);
    let one = |colour: f32, blend: Blend| Draw {
        blend,
        depth: Depth::Ignore,
        ..plain(&surface, &mesh, [colour; 4])
    };
    let (set, times, plus) = (
        one(4.0, Blend::Replace),
        one(8.0, Blend::Multiply),
        one(1.0, Blend::Add),
    );
    let run = |passes: &[&[&Draw<'_>]]| {
        let passes = passes
            .iter()
            .map(|pass| pass.iter().copied().cloned().collect())
            .collect();
        let job = RenderJob {
            passes,
            ..job(Vec::new())
        };
        job.run(device).unwrap().targets[0].pixels[0][0]
    };
    assert_eq!(run(&[&[&set, &times, &plus]]), 33.0);
    assert_eq!(run(&[&[&set], &[&times], &[&plus]]), 33.0);
    assert_eq!(run(&[&[&set, &plus], &[], &[&times]]), 40.0);
    assert_eq!(run(&[&[&times, &plus], &[&set]]), 4.0);
    assert!(is_unwritten(run(&[&[]])), "nothing was drawn");
    assert!(is_unwritten(run(&[])), "there was no pass");
}

/// A slanted surface, whose depths are no round numbers.
const SLANTED: &str = "
struct Varyings { @builtin(position) clip: vec4f, @location(0) uv: vec2f }
@vertex fn vertex(@location(0) position: vec3f, @location(2) uv: vec2f) -> Varyings {
    let w = 1.0 + 0.3 * position.x + 0.1 * position.y;
    return Varyings(vec4f(position.xy, position.z * w, w), uv);
}
@group(0) @binding(0) var<uniform> colour: vec4f;
@fragment fn fragment(in: Varyings) -> @location(0) vec4f { return colour; }
";

/// The red values of one row, after a first draw of 1 at 0.3 … 0.9, an occluder of 2 over the left half, and a second pass that
/// adds 4 at the given depth test over the given mesh.
fn second_pass(mesh: &Mesh, depth: Depth) -> Option<Vec<f32>> {
    let device = device("second_pass")?;
    let slanted = compile(SLANTED);
    let (first, occluder) = (slope(0.3, 0.9), rectangle([-2.0, -2.0, 0.0, 2.0], 0.1));
    let draws = vec![
        plain(&slanted, &first, [1.0; 4]),
        plain(&slanted, &occluder, [2.0; 4]),
        Draw {
            blend: Blend::Add,
            depth,
            ..plain(&slanted, mesh, [4.0; 4])
        },
    ];
    let RenderOutput { targets, .. } = job(draws).run(device).unwrap();
    Some((0..8).map(|x| targets[0].pixel(x, 5).unwrap()[0]).collect())
}

/// Twice the whole, from one depth at the left to another at the right.
fn slope(left: f32, right: f32) -> Mesh {
    let mut mesh = rectangle([-2.0, -2.0, 2.0, 2.0], left);
    if let Some(position) = mesh.attributes.get_mut("position") {
        for vertex in position.values.as_chunks_mut::<3>().0 {
            vertex[2] = if vertex[0] > 0.0 { right } else { left };
        }
    }
    mesh
}

#[test]
fn depth_equal_meets_each_visible_pixel_of_the_same_mesh_once() {
    let Some(row) = second_pass(&slope(0.3, 0.9), Depth::Equal) else {
        return;
    };
    assert_eq!(row, [2.0, 2.0, 2.0, 2.0, 5.0, 5.0, 5.0, 5.0]);
    let row = |mesh: &Mesh, depth| second_pass(mesh, depth).unwrap();
    // A mesh that is nearer or farther by a thousandth is not equal; as near or nearer is another test, and the first draw's
    // test does not let a second pass through.
    let unchanged = [2.0, 2.0, 2.0, 2.0, 1.0, 1.0, 1.0, 1.0];
    assert_eq!(row(&slope(0.299, 0.899), Depth::Equal), unchanged);
    assert_eq!(row(&slope(0.301, 0.901), Depth::Equal), unchanged);
    assert_eq!(row(&slope(0.3, 0.9), Depth::TestAndWrite), unchanged);
    let blended = [2.0, 2.0, 2.0, 2.0, 5.0, 5.0, 5.0, 5.0];
    assert_eq!(row(&slope(0.299, 0.899), Depth::TestOnly), blended);
    let everywhere = [6.0, 6.0, 6.0, 6.0, 5.0, 5.0, 5.0, 5.0];
    assert_eq!(row(&slope(0.3, 0.9), Depth::Ignore), everywhere);
}

#[test]
fn bytes_and_floats_stand_beside_each_other() {
    let Some(device) = device("bytes_and_floats_stand_beside_each_other") else {
        return;
    };
    let surface = compile(SURFACE);
    // Columns 2 to 5, rows 0 and 1.
    let mesh = rectangle([-0.5, 0.5, 0.5, 1.0], 0.5);
    let mut job = job(vec![
        plain(&surface, &mesh, codes([200, 10, 0, 255])),
        Draw {
            blend: Blend::Multiply,
            depth: Depth::Equal,
            ..plain(&surface, &mesh, codes([100, 255, 255, 51]))
        },
    ]);
    job.targets[0] = RenderTarget::bytes(codes([1, 2, 3, 4]));
    let output = job.run(device).unwrap();
    let covered = output.targets[2].covered();
    assert_eq!(covered.iter().filter(|covered| **covered).count(), 8);
    let found = output.targets[0].codes().unwrap();
    for (at, covered) in covered.iter().enumerate() {
        let expected = if *covered { [78, 10, 0, 51] } else { [1, 2, 3, 4] };
        assert_eq!(found[at], expected, "pixel {at}");
    }
    // Only location 0 is blended: the uv of the second draw replaces that of the first.
    assert_eq!(output.targets[2].pixel(2, 0), Some([0.125, 0.25, 0.0, 1.0]));
}

#[test]
fn targets_that_do_not_fit_are_refused() {
    let Some(device) = device("targets_that_do_not_fit_are_refused") else {
        return;
    };
    let surface = compile(SURFACE);
    let mesh = rectangle(WHOLE, 0.5);
    let fine = job(vec![plain(&surface, &mesh, [0.0; 4])]);
    let with = |target: RenderTarget| {
        let mut job = fine.clone();
        job.targets[1] = target;
        job.run(device).map(drop)
    };
    let sentinel = RenderTarget {
        clear: Clear::Sentinel,
        ..bytes()
    };
    for (target, word) in [
        (sentinel, "sentinel"),
        (RenderTarget::bytes([0.0, 0.0, 1.5, 0.0]), "0 to 1"),
    ] {
        let error = with(target).unwrap_err();
        assert!(
            matches!(&error, Error::Target { location: 1, problem, .. } if problem.contains(word)),
            "{error}"
        );
    }
    with(bytes()).unwrap();
    let mut many = fine.clone();
    many.targets = vec![bytes(); 99];
    assert!(matches!(many.run(device), Err(Error::TooLarge { .. })));
}

#[test]
fn blending_without_a_colour_is_refused() {
    let Some(device) = device("blending_without_a_colour_is_refused") else {
        return;
    };
    let colourless = compile(
        "@vertex fn vertex(@location(0) position: vec3f) -> @builtin(position) vec4f { return vec4f(position, 1.0); }
         @fragment fn fragment() -> @location(1) vec4f { return vec4f(1.0); }",
    );
    let mesh = rectangle(WHOLE, 0.5);
    let job = job(vec![Draw {
        blend: Blend::Multiply,
        resources: Resources::default(),
        ..plain(&colourless, &mesh, [0.0; 4])
    }]);
    let error = job.run(device).unwrap_err().to_string();
    assert!(error.contains("@location(0)"), "{error}");
}
