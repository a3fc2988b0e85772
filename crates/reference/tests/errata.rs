//! Witnesses for `docs/errata.md`: faults of the articles that no single technique's tests show. Each test computes what the
//! article's text or listing does and what is true, and asserts that they differ by the stated amount.

use std::f64::consts::FRAC_PI_2;

use bossage_assets::{EdgeMode, HeightField};
use bossage_reference::blinn_phong::{self, Reflectance};
use bossage_reference::cube::Seams;
use bossage_reference::frame_from_uv::{Tangents, orthogonalise};
use bossage_reference::normalisation_cube_map::{Depth, Map};
use bossage_reference::parallax_slope_ao::{OCCLUSION_SCALE, OFFSET_SCALE, delta_published, published};
use bossage_reference::relief_ray::Ray;
use bossage_reference::relief_truth::first_hit;
use bossage_reference::sphere::angle_deg;
use bossage_reference::{
    displacement, light_to_tangent, normal_mips, normal_transform, parallax_offset, parallax_offset_limited,
};
use glam::{DMat3, DMat4, DVec2, DVec3};

/// A few roundings of numbers near 1.
const ROUNDING: f64 = 1e-14;

// Parallax Bump Mapping

#[test]
fn vertices_move_along_the_normal_not_across_it() {
    let moved = displacement::position(DVec3::ZERO, DVec3::Z, 1.0, 0.04, 0.0, 1.0);
    assert_eq!(moved, 0.04 * DVec3::Z);
    // What the text says, "senkrecht zur Oberflächennormale", leaves the surface as flat as it was.
    assert_eq!((0.04 * DVec3::X).dot(DVec3::Z), 0.0);
}

#[test]
fn filtered_normals_dim_the_highlight() {
    // Two texels leaning ±0.5 rad, filtered: straight up, but cos 0.5 long.
    let (sin, cos) = 0.5_f64.sin_cos();
    let filtered = (DVec3::new(sin, 0.0, cos) + DVec3::new(-sin, 0.0, cos)) / 2.0;
    let shine = Reflectance {
        diffuse: DVec3::ZERO,
        specular: DVec3::ONE,
        shininess: 16.0,
    };
    let dim = blinn_phong::published(filtered, DVec3::Z, DVec3::Z, &shine).x;
    assert!((dim - cos.powi(16)).abs() < ROUNDING && dim < 0.124);
    let full = blinn_phong::published(normal_mips::naive(filtered), DVec3::Z, DVec3::Z, &shine).x;
    assert!((full - 1.0).abs() < ROUNDING);
}

#[test]
fn highlights_shine_from_below_the_horizon() {
    let light = DVec3::new(0.99_f64.sqrt(), 0.0, -0.1);
    let view = DVec3::new(-(0.96_f64.sqrt()), 0.0, 0.2);
    let white = Reflectance {
        diffuse: DVec3::X,
        specular: DVec3::Y,
        shininess: 16.0,
    };
    for form in [blinn_phong::published, blinn_phong::hardened] {
        let color = form(DVec3::Z, light, view, &white);
        // Kept in both forms: the formula has no term for it.
        assert!(color.x == 0.0 && color.y > 0.8, "{color}");
    }
}

#[test]
fn gram_schmidt_needs_a_unit_normal() {
    // Two triangles' unit normals summed, as the article says, and not made a unit vector again.
    let sum = Tangents {
        tangent: DVec3::new(1.0, 0.0, 1.0),
        bitangent: DVec3::Y,
    };
    let across = |n: DVec3| n.dot(orthogonalise(n, sum).truncate());
    assert_eq!((across(2.0 * DVec3::Z), across(DVec3::Z)), (-6.0, 0.0));
}

#[test]
fn the_second_equation_is_for_q() {
    // P = x, Q = y with their own texture edges (1, 0) and (0, 1): the printed second line asks for P = B.
    let frame = bossage_reference::frame_from_uv::triangle(
        [DVec3::ZERO, DVec3::X, DVec3::Y],
        [DVec2::ZERO, DVec2::X, DVec2::Y],
    );
    assert_eq!((frame.bitangent, frame.tangent), (DVec3::Y, DVec3::X));
}

#[test]
fn a_bitangent_from_untransformed_vectors_stays_behind() {
    let quarter = DMat3::from_rotation_x(FRAC_PI_2);
    let (n, t) = (DVec3::Z, DVec3::X);
    let as_listed = n.cross(t);
    let meant = (quarter * n).cross(quarter * t);
    assert!(
        as_listed.dot(meant).abs() < ROUNDING,
        "at right angles to what was meant"
    );
}

#[test]
fn uniform_scale_bends_the_light_vector() {
    // N and T twice as long make B = N × T four times as long.
    let frame = normal_transform::published(
        DMat3::from_diagonal(DVec3::splat(2.0)),
        DVec3::Z,
        DVec3::X.extend(1.0),
    );
    let light = light_to_tangent::to_tangent(frame.tangent, frame.bitangent, frame.normal, DVec3::ONE);
    assert_eq!(light, DVec3::new(2.0, 4.0, 2.0));
    // acos(8/√72) = 19.47°.
    assert!((angle_deg(light, DVec3::ONE) - 19.471_220_634).abs() < 1e-8);
}

#[test]
fn a_world_view_matrix_leaves_no_world_position() {
    // Taken by its name, `matWV` brings the vertex to the camera's space, where the camera is at the origin and not at (0, 0, 5).
    let (camera_ws, view) = (5.0 * DVec3::Z, DMat4::from_translation(-5.0 * DVec3::Z));
    let named = camera_ws - view.transform_point3(DVec3::ZERO);
    assert_eq!(
        (named, camera_ws - DVec3::ZERO),
        (10.0 * DVec3::Z, 5.0 * DVec3::Z)
    );
}

#[test]
fn normalising_at_the_vertices_bends_directions_between_them() {
    let eye = DVec3::Z;
    let (a, b) = (DVec3::new(-1.0, 0.0, 0.0), DVec3::new(9.0, 0.0, 0.0));
    let middle = (a + b) / 2.0;
    let interpolated = ((eye - a).normalize() + (eye - b).normalize()) / 2.0;
    assert!((angle_deg(interpolated, eye - middle) - 56.7).abs() < 0.1);
    // Interpolating the vectors themselves is exact, and so is any normaliser applied to that: the cube map too.
    let vectors = ((eye - a) + (eye - b)) / 2.0;
    assert!(angle_deg(vectors, eye - middle) < 1e-9);
    let cube = Map {
        seams: Seams::Seamless,
        ..Map::new(64, Depth::Eight)
    };
    assert!(angle_deg(cube.lookup(vectors), eye - middle) < 1.0);
}

#[test]
fn the_limited_offset_scales_and_does_not_limit() {
    let shift = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let view = DVec3::new(sin, 0.0, cos);
        let full = parallax_offset::published(DVec2::ZERO, view, 1.0, 0.04, -0.02).x;
        parallax_offset_limited::offset(DVec2::ZERO, view, 1.0, 0.04, -0.02).x / full
    };
    // cos θ at every angle, where a limit would leave small angles alone.
    assert!((shift(30.0) - 0.75_f64.sqrt()).abs() < ROUNDING && (shift(60.0) - 0.5).abs() < ROUNDING);
}

// Parallax Mapping + Ambient Occlusion

#[test]
fn flat_ground_above_the_polygon_has_parallax() {
    let (plateau, view) = (HeightField::from_fn(4, 4, |_, _| 1.0), DVec3::new(0.6, 0.0, 0.8));
    let uv = DVec2::splat(0.5);
    let delta = delta_published(DVec3::Z, DVec3::Z, view, 1.0, OFFSET_SCALE);
    assert_eq!(delta, 0.0);
    let exact = parallax_offset::published(uv, view, 1.0, OFFSET_SCALE, 0.0);
    // 0.04·0.6/0.8.
    assert!((exact - (uv + DVec2::new(0.03, 0.0))).length() < ROUNDING);
    // And the traversal finds the same: with the top of the relief at +scale the ray starts where it enters it.
    let ray = Ray::through(uv, view, OFFSET_SCALE, 0.0).expect("the view looks down on the surface");
    assert!((first_hit(&plateau, EdgeMode::Wrap, &ray).uv - exact).length() < ROUNDING);
}

#[test]
fn slopes_move_even_from_straight_above() {
    let delta = delta_published(DVec3::new(0.6, 0.0, 0.8), DVec3::Z, DVec3::Z, 1.0, OFFSET_SCALE);
    // 0.36·0.8·0.04 along u and v, where the truth does not move at all.
    assert!((delta - 0.01152).abs() < 1e-16);
    assert_eq!(
        parallax_offset::published(DVec2::ZERO, DVec3::Z, 1.0, OFFSET_SCALE, 0.0),
        DVec2::ZERO
    );
}

#[test]
fn the_occlusion_spares_the_crevices_and_follows_the_eye() {
    let n = DVec3::new(0.6, 0.0, 0.8);
    let ao = |height: f64, view: DVec3| {
        published(
            DVec2::ZERO,
            delta_published(n, DVec3::Z, view, height, OFFSET_SCALE),
            OCCLUSION_SCALE,
        )
        .ambient_occlusion
    };
    // The same slope: at the bottom in full light, at the top in half of it.
    assert_eq!(ao(0.0, DVec3::Z), 1.0);
    assert!((ao(1.0, DVec3::Z) - 0.5392).abs() < ROUNDING);
    // The same place: darker or lighter as the camera turns.
    assert!((ao(1.0, n) - 0.424).abs() < ROUNDING);
    assert_eq!(ao(1.0, DVec3::new(-0.8, 0.0, 0.6)), 1.0);
}

#[test]
fn interpolated_normals_make_flat_maps_slope() {
    // Vertex normals 60° apart: in the middle of the edge N is cos 30° long, and so is the flat map's normal.
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let middle = (DVec3::new(sin, 0.0, cos) + DVec3::new(-sin, 0.0, cos)) / 2.0;
    let along = middle.dot(middle);
    assert!((1.0 - along * along - 0.4375).abs() < ROUNDING);
}

// Bumpmapping with DOT3

#[test]
fn the_listed_inverse_is_the_inverse() {
    let axis = DVec3::new(0.1, 0.3, 0.0).normalize();
    let model_view = DMat4::from_translation(-6.0 * DVec3::Z) * DMat4::from_axis_angle(axis, 0.7);
    let listed = DMat4::from_axis_angle(axis, -0.7) * DMat4::from_translation(6.0 * DVec3::Z);
    assert!((listed * model_view).abs_diff_eq(DMat4::IDENTITY, ROUNDING));
    // The control: inverted, but not reversed.
    let unreversed = DMat4::from_translation(6.0 * DVec3::Z) * DMat4::from_axis_angle(axis, -0.7);
    assert!(!(unreversed * model_view).abs_diff_eq(DMat4::IDENTITY, 0.1));
}

#[test]
fn the_inverse_of_model_view_starts_in_eye_space() {
    // The camera six units back, the object where the world's origin is, a light at (0, 0, 10) in the world.
    let (world_from_object, eye_from_world) = (DMat4::IDENTITY, DMat4::from_translation(-6.0 * DVec3::Z));
    let light_ws = DVec3::new(0.0, 0.0, 10.0);
    let as_told = (eye_from_world * world_from_object)
        .inverse()
        .transform_point3(light_ws);
    let meant = world_from_object.inverse().transform_point3(light_ws);
    assert_eq!((as_told, meant), (DVec3::new(0.0, 0.0, 16.0), light_ws));
}

#[test]
fn a_light_with_a_position_is_not_directional() {
    // Opposite corners of the front of a cube of edge 2, a light three units from its middle.
    let light = DVec3::new(0.0, 0.0, 3.0);
    let [a, b] = [DVec3::ONE, DVec3::new(-1.0, -1.0, 1.0)].map(|corner| light - corner);
    // 2·atan(√2/2).
    assert!((angle_deg(a, b) - 70.528_779_366).abs() < 1e-8);
}

#[test]
fn the_perturbed_normal_is_lit_from_behind_the_polygon() {
    let normal = DVec3::new(0.8, 0.0, 0.6);
    let light = DVec3::new(0.99_f64.sqrt(), 0.0, -0.1);
    let lit = bossage_reference::dot3::published(normal, light, DVec3::ONE).x;
    assert!(
        lit > 0.73 && light.z < 0.0,
        "kept: the article has no self-shadowing term"
    );
}

// Normal Maps and Height Maps

#[test]
fn the_height_scale_depends_on_the_resolution() {
    use bossage_reference::height_to_normal_forward::normal_published;
    // One slope, sampled at two densities: the byte step between neighbours doubles at half of the size.
    let tilt_deg = |step: f64| angle_deg(normal_published(100.0, 100.0, 100.0 + step, 0.1), DVec3::Z);
    assert!((tilt_deg(5.0) - 0.5_f64.atan().to_degrees()).abs() < 1e-12);
    assert!((tilt_deg(10.0) - 45.0).abs() < 1e-12);
}

/// The listing's read of blue, the channel that becomes the height: where in the pixels it looks.
fn blue_index(png: bool, bytes_per_pixel: usize, width: usize, i: usize, j: usize) -> usize {
    bytes_per_pixel * j + i * width * bytes_per_pixel + if png { 2 } else { 0 }
}

#[test]
fn grey_images_are_read_two_pixels_off_and_past_the_end() {
    let (width, height) = (4, 4);
    assert_eq!(
        blue_index(true, 1, width, 1, 1),
        7,
        "pixel (3, 1) in the place of (1, 1)"
    );
    assert_eq!(
        blue_index(true, 1, width, height - 1, width - 1),
        width * height + 1,
        "two bytes past the last"
    );
    // The other branch reads blue right and red (index + 2) past the end.
    assert_eq!(
        blue_index(false, 1, width, height - 1, width - 1) + 2,
        width * height + 1
    );
}

#[test]
fn padded_rows_are_read_askew() {
    // SDL rounds a row up to four bytes: 5 pixels of 3 bytes take 16, the listing counts 15.
    let (width, bytes_per_pixel) = (5_usize, 3);
    let pitch = (width * bytes_per_pixel).next_multiple_of(4);
    let listed = |i: usize| blue_index(false, bytes_per_pixel, width, i, 0);
    assert_eq!((pitch, listed(1), listed(4) + 4), (16, 15, 4 * pitch));
}

#[test]
fn buffers_are_four_times_too_large_and_the_shift_overflows() {
    let (pixels, size_of_gluint) = (512_u64 * 512, 4);
    let allocated = pixels * size_of_gluint * size_of_gluint;
    assert_eq!((allocated, pixels * size_of_gluint), (4 << 20, 1 << 20));
    assert!((255_i64 << 24) > i64::from(i32::MAX));
}

#[test]
fn the_flat_frame_of_a_map_is_wide() {
    // 2·(512 + 512) − 4 texels, and both rules for indices hide behind it.
    let field = HeightField::from_fn(512, 512, |x, y| ((x + y) % 2) as f32);
    let published = |x, y| bossage_reference::height_to_normal_forward::published(&field, x, y, 1.0);
    let flat = (0..512)
        .flat_map(|y| (0..512).map(move |x| (x, y)))
        .filter(|&(x, y)| published(x, y) == DVec3::Z)
        .count();
    assert_eq!(flat, 2044);
}
