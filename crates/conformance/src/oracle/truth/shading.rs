//! Shading the perturbed normal.

use bossage_reference::vector::{normalize, normalize_or_zero};
use bossage_reference::{
    blinn_phong, dot3, dot3_single_pass, dot3_two_pass, emboss, environment_bump, wrap_lambert,
};
use dot3_single_pass::Normaliser;
use dot3_two_pass::{Blender, Target};
use glam::DVec3;

use super::{A, Rows, out2, out3, out4, v2, v3, v4};

pub(super) const ROWS: Rows = &[
    ("half_vector", |a| out3(normalize_or_zero(v3(a) + v3(a)))),
    ("half_vector_published", |a| out3(normalize(v3(a) + v3(a)))),
    ("highlight_power", |a| {
        vec![blinn_phong::highlight_power(a.scalar(), a.scalar())]
    }),
    ("highlight_power_published", |a| {
        vec![blinn_phong::highlight_power_published(a.scalar(), a.scalar())]
    }),
    ("blinn_phong", |a| blinn(a, blinn_phong::hardened)),
    ("blinn_phong_published", |a| blinn(a, blinn_phong::published)),
    ("dot3", |a| out3(dot3::hardened(v3(a), v3(a), v3(a)))),
    ("dot3_published", |a| out3(dot3::published(v3(a), v3(a), v3(a)))),
    ("dot3_combiner", |a| vec![dot3::combiner(v3(a), v3(a))]),
    ("dot3_cube", |a| out3(dot3::through_cube(v3(a), v3(a), v3(a)))),
    ("dot3_single_pass", |a| {
        out3(dot3_single_pass::shade(v3(a), v3(a), v3(a)))
    }),
    ("light_to_colour", |a| out3(Normaliser::Guarded.color(v3(a)))),
    ("light_to_colour_published", |a| {
        out3(Normaliser::Arithmetic.color(v3(a)))
    }),
    ("dot3_first_pass", |a| {
        let intensity = dot3_single_pass::intensity(v3(a), v3(a));
        out3(dot3_two_pass::first_pass(intensity, Target::Float))
    }),
    ("dot3_second_pass", |a| {
        out3(dot3_two_pass::second_pass(
            v3(a),
            v3(a),
            Target::Float,
            Blender::TakesSource,
        ))
    }),
    ("quantise_unorm8", |a| out3(Target::Unorm8.store(v3(a)))),
    ("dot3_two_pass", |a| {
        let intensity = dot3_single_pass::intensity(v3(a), v3(a));
        out3(dot3_two_pass::shade(
            intensity,
            v3(a),
            Target::Unorm8,
            Blender::TakesSource,
        ))
    }),
    ("emboss_uv", |a| {
        out2(emboss::shifted_uv(v2(a), v3(a), a.scalar()))
    }),
    ("emboss_difference", |a| {
        vec![emboss::difference(a.scalar(), a.scalar())]
    }),
    ("emboss", |a| {
        vec![emboss::lit(a.scalar(), a.scalar(), a.scalar())]
    }),
    ("environment_bump", |a| {
        out3(environment_bump::reflected_hardened(v3(a), v3(a)))
    }),
    ("environment_bump_published", |a| {
        out3(environment_bump::reflected_published(v3(a), v3(a)))
    }),
    ("wrap_lambert_factor", |a| {
        vec![wrap_lambert::factor_hardened(
            a.scalar(),
            a.scalar(),
            v3(a),
            v3(a),
        )]
    }),
    ("wrap_lambert_factor_published", |a| {
        vec![wrap_lambert::factor_published(
            a.scalar(),
            a.scalar(),
            v3(a),
            v3(a),
        )]
    }),
    ("wrap_lambert", |a| {
        out4(wrap_lambert::color_hardened(a.scalar(), v3(a), v4(a)))
    }),
    ("wrap_lambert_published", |a| {
        out4(wrap_lambert::color_published(a.scalar(), v4(a), v4(a)))
    }),
    ("wrap_lambert_is_hole", |a| {
        vec![f64::from(u8::from(wrap_lambert::is_hole(a.scalar())))]
    }),
];

fn blinn(a: A<'_, '_>, form: fn(DVec3, DVec3, DVec3, &blinn_phong::Reflectance) -> DVec3) -> Vec<f64> {
    let (normal, light, view) = (v3(a), v3(a), v3(a));
    let surface = blinn_phong::Reflectance {
        diffuse: v3(a),
        specular: v3(a),
        shininess: a.scalar(),
    };
    out3(form(normal, light, view, &surface))
}
