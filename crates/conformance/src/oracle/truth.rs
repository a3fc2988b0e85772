//! Truth for every probe: the f64 reference, called with the probe's arguments.
//!
//! Nothing is computed here that `bossage-reference` does not define, but for the few functions of the library that are
//! below the techniques: those are written out from their definition.

use bossage_assets::EdgeMode;
use bossage_reference::frame_from_uv::{self, Tangents};
use bossage_reference::vector::{SMALLEST_NORMAL_F32, normalize, normalize_or_zero, saturate, sign_not_zero};
use bossage_reference::{
    blinn_phong, codec_biased, codec_unorm, dot3, frame_mikktspace, height_to_normal,
    height_to_normal_forward, light_to_tangent, normal_transform, parallax_offset, parallax_offset_limited,
};
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};

use super::Args;

type A<'a, 'b> = &'a mut Args<'b, f64>;

/// The truth of one function: arguments in, outputs in order.
pub type Truth = fn(&mut Args<'_, f64>) -> Vec<f64>;

/// The truth of the function of that name.
#[must_use]
pub fn find(function: &str) -> Option<Truth> {
    TABLE
        .iter()
        .find(|(name, _)| *name == function)
        .map(|(_, truth)| *truth)
}

/// The functions that have one.
pub fn names() -> impl Iterator<Item = &'static str> {
    TABLE.iter().map(|(name, _)| *name)
}

const TABLE: &[(&str, Truth)] = &[
    // lib
    ("resolve_edge", resolve_edge),
    ("euclidean_remainder", |a| {
        vec![(a.scalar() as i64).rem_euclid(a.scalar() as i64) as f64]
    }),
    ("bitangent", |a| out3(frame_mikktspace::bitangent(v3(a), v4(a)))),
    ("tangent_from_normal", |a| {
        out3(frame_from_uv::frame_from_normal(v3(a)).tangent)
    }),
    ("linear_part", |a| out9(DMat3::from_mat4(m4(a)))),
    ("column_scales", |a| out3(column_scales(m3(a)))),
    ("cofactor_direction", |a| {
        let (linear, v) = (m3(a), v3(a));
        out3(scaled_cofactor(linear, v))
    }),
    ("mirror_sign", |a| vec![sign_not_zero(m3(a).determinant())]),
    ("normalise", |a| out3(normalize_or_zero(v3(a)))),
    ("normalise_published", |a| out3(normalize(v3(a)))),
    ("largest_component", |a| vec![v3(a).abs().max_element()]),
    ("elevation", |a| {
        vec![parallax_offset::elevation(a.scalar(), a.scalar(), a.scalar())]
    }),
    // techniques
    ("lambert", |a| vec![saturate(v3(a).dot(v3(a)))]),
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
    ("codec_biased_encode", |a| {
        each3(a, |n| f64::from(codec_biased::encode_hardened(n)))
    }),
    ("codec_biased_encode_published", |a| {
        each3(a, |n| f64::from(codec_biased::encode_published(n)))
    }),
    ("codec_biased_decode", |a| each3(a, codec_biased::decode_hardened)),
    ("codec_biased_decode_published", |a| {
        each3(a, codec_biased::decode_published)
    }),
    ("codec_unorm_encode", |a| each3(a, codec_unorm::encode)),
    ("codec_unorm_decode", |a| each3(a, codec_unorm::decode)),
    ("codec_unorm_encode_byte", |a| {
        each3(a, |n| f64::from(codec_unorm::encode_byte(n)))
    }),
    ("dot3", |a| out3(dot3::hardened(v3(a), v3(a), v3(a)))),
    ("dot3_published", |a| out3(dot3::published(v3(a), v3(a), v3(a)))),
    ("dot3_combiner", |a| vec![dot3::combiner(v3(a), v3(a))]),
    ("frame_from_uv_triangle", frame_from_uv_triangle),
    (
        "frame_from_uv_triangle_published",
        frame_from_uv_triangle_published,
    ),
    ("frame_from_uv_vertex", |a| {
        let (normal, sum) = (
            v3(a),
            Tangents {
                tangent: v3(a),
                bitangent: v3(a),
            },
        );
        out4(frame_from_uv::hardened_vertex(normal, sum, a.scalar()))
    }),
    ("frame_from_uv_vertex_published", |a| {
        out4(frame_from_uv::orthogonalise(
            v3(a),
            Tangents {
                tangent: v3(a),
                bitangent: v3(a),
            },
        ))
    }),
    ("handedness_of", |a| {
        vec![frame_from_uv::handedness(
            v3(a),
            Tangents {
                tangent: v3(a),
                bitangent: v3(a),
            },
        )]
    }),
    ("length_of", |a| vec![length_of(v3(a))]),
    ("combine_frame", |a| {
        let (tangent, bitangent, normal, v) = (v3(a), v3(a), v3(a), v3(a));
        out3(v.x * tangent + v.y * bitangent + v.z * normal)
    }),
    ("frame_mikktspace", |a| {
        out3(frame_mikktspace::combine(v3(a), v4(a), v3(a)))
    }),
    ("height_to_normal", |a| {
        out3(height_to_normal::normal(
            a.scalar(),
            a.scalar(),
            a.scalar(),
            a.scalar(),
            v2(a),
        ))
    }),
    ("height_to_normal_forward", |a| {
        out3(height_to_normal_forward::normal_hardened(
            a.scalar(),
            a.scalar(),
            a.scalar(),
            v2(a),
        ))
    }),
    ("height_to_normal_forward_published", |a| {
        out3(height_to_normal_forward::normal_published(
            a.scalar(),
            a.scalar(),
            a.scalar(),
            a.scalar(),
        ))
    }),
    ("light_to_tangent", |a| {
        out3(light_to_tangent::to_tangent(v3(a), v3(a), v3(a), v3(a)))
    }),
    ("light_to_tangent_world_space", |a| {
        out3(light_to_tangent::world(v3(a), v4(a), v3(a)))
    }),
    ("light_to_tangent_object_space", |a| {
        out3(light_to_tangent::object(v3(a), v4(a), v3(a), v3(a), m4(a)))
    }),
    ("normal_transform", |a| {
        out3(normalize(
            normal_transform::hardened(m3(a), v3(a), DVec4::X).normal,
        ))
    }),
    ("normal_transform_by_cofactor", |a| {
        let (cofactor, mirror) = (m3(a), a.scalar());
        out3(normalize_or_zero(mirror * (cofactor * v3(a))))
    }),
    ("normal_transform_published", |a| {
        out3(normal_transform::published(m3(a), v3(a), DVec4::X).normal)
    }),
    ("tangent_transform", |a| out3(normalize_or_zero(m3(a) * v3(a)))),
    ("tangent_transform_published", |a| out3(m3(a) * v3(a))),
    ("parallax_offset", |a| {
        let (uv, z) = (v2(a), a.scalar());
        out2(parallax_offset::hardened(uv, v3(a), z, 1.0, 0.0))
    }),
    ("parallax_offset_published", |a| {
        let (uv, z) = (v2(a), a.scalar());
        out2(parallax_offset::published(uv, v3(a), z, 1.0, 0.0))
    }),
    ("parallax_offset_limited", |a| {
        let (uv, z) = (v2(a), a.scalar());
        out2(parallax_offset_limited::offset(uv, v3(a), z, 1.0, 0.0))
    }),
];

fn resolve_edge(a: A<'_, '_>) -> Vec<f64> {
    let (index, size, mode) = (a.scalar() as i64, a.scalar() as u32, a.scalar() as u32);
    let edge = [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp][mode.min(2) as usize];
    vec![f64::from(edge.resolve(index, size))]
}

/// |v|, and 0 where no component reaches the smallest normal f32.
fn length_of(v: DVec3) -> f64 {
    if v.abs().max_element() < SMALLEST_NORMAL_F32 {
        0.0
    } else {
        v.length()
    }
}

/// The largest component of each column, not below the smallest normal f32.
fn column_scales(linear: DMat3) -> DVec3 {
    let largest = linear
        .to_cols_array_2d()
        .map(|c| DVec3::from_array(c).abs().max_element());
    DVec3::from_array(largest).max(DVec3::splat(SMALLEST_NORMAL_F32))
}

/// cof(M) v times the positive factor min(s) / (s₀ s₁ s₂) with s the columns' largest components, as the library defines
/// its direction: the factor keeps the numbers near 1.
fn scaled_cofactor(linear: DMat3, v: DVec3) -> DVec3 {
    let scales = column_scales(linear);
    normal_transform::cofactor(linear) * v * (scales.min_element() / scales.element_product())
}

fn blinn(a: A<'_, '_>, form: fn(DVec3, DVec3, DVec3, &blinn_phong::Reflectance) -> DVec3) -> Vec<f64> {
    let (normal, light, view) = (v3(a), v3(a), v3(a));
    let surface = blinn_phong::Reflectance {
        diffuse: v3(a),
        specular: v3(a),
        shininess: a.scalar(),
    };
    out3(form(normal, light, view, &surface))
}

fn frame_from_uv_triangle(a: A<'_, '_>) -> Vec<f64> {
    let (p, q, st1, st2) = (v3(a), v3(a), v2(a), v2(a));
    let (share, weight) = frame_from_uv::weighted_triangle(p, q, st1, st2);
    triangle_outputs(p.cross(q), share, weight)
}

fn frame_from_uv_triangle_published(a: A<'_, '_>) -> Vec<f64> {
    let (p, q, st1, st2) = (v3(a), v3(a), v2(a), v2(a));
    let share = frame_from_uv::triangle([DVec3::ZERO, p, q], [DVec2::ZERO, st1, st2]);
    triangle_outputs(normalize(p.cross(q)), share, 1.0)
}

fn triangle_outputs(normal: DVec3, share: Tangents, weight: f64) -> Vec<f64> {
    [
        out3(normal),
        out3(share.tangent),
        out3(share.bitangent),
        vec![weight],
    ]
    .concat()
}

fn each3(a: A<'_, '_>, f: fn(f64) -> f64) -> Vec<f64> {
    a.array::<3>().map(f).to_vec()
}

fn v2(a: A<'_, '_>) -> DVec2 {
    DVec2::from_array(a.array())
}

fn v3(a: A<'_, '_>) -> DVec3 {
    DVec3::from_array(a.array())
}

fn v4(a: A<'_, '_>) -> DVec4 {
    DVec4::from_array(a.array())
}

fn m3(a: A<'_, '_>) -> DMat3 {
    DMat3::from_cols_array_2d(&a.matrix())
}

fn m4(a: A<'_, '_>) -> DMat4 {
    DMat4::from_cols_array_2d(&a.matrix())
}

fn out2(v: DVec2) -> Vec<f64> {
    v.to_array().to_vec()
}

fn out3(v: DVec3) -> Vec<f64> {
    v.to_array().to_vec()
}

fn out4(v: DVec4) -> Vec<f64> {
    v.to_array().to_vec()
}

fn out9(m: DMat3) -> Vec<f64> {
    m.to_cols_array().to_vec()
}
