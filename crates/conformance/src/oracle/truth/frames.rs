//! Tangent frames: made, combined, transformed.

use bossage_reference::frame_from_uv::{self, Tangents};
use bossage_reference::vector::{normalize, normalize_or_zero, sign_not_zero};
use bossage_reference::{frame_from_normal, frame_mikktspace, light_to_tangent, normal_transform};
use glam::{DVec2, DVec3, DVec4};

use super::{A, Rows, m3, m4, out3, out4, v2, v3, v4};

pub(super) const ROWS: Rows = &[
    ("frame_from_normal", |a| {
        tangents(frame_from_normal::hardened(v3(a)))
    }),
    ("frame_from_normal_published", |a| {
        tangents(frame_from_normal::published(v3(a)))
    }),
    ("frame_from_normal_unit_published", |a| {
        tangents(frame_from_normal::published_unit(v3(a)))
    }),
    ("frame_hughes_moller_published", |a| {
        tangents(frame_from_normal::hughes_moller(v3(a)))
    }),
    ("frame_frisvad_published", |a| {
        tangents(frame_from_normal::frisvad(v3(a)))
    }),
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
    ("combine_frame", |a| {
        let (tangent, bitangent, normal, v) = (v3(a), v3(a), v3(a), v3(a));
        out3(v.x * tangent + v.y * bitangent + v.z * normal)
    }),
    ("frame_mikktspace", |a| {
        out3(frame_mikktspace::combine(v3(a), v4(a), v3(a)))
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
    ("bitangent_transform", |a| {
        let (linear, normal, tangent) = (m3(a), v3(a), v4(a));
        let frame = normal_transform::hardened(linear, normal, tangent);
        // Of unit vectors, so that it is known below which length there is no direction.
        let along = normalize_or_zero(linear * tangent.truncate());
        let across = normalize(frame.normal).cross(along);
        out3(normalize_or_zero(
            across * tangent.w * sign_not_zero(linear.determinant()),
        ))
    }),
    ("bitangent_transform_published", |a| {
        out3(normal_transform::published(m3(a), v3(a), v4(a)).bitangent)
    }),
    ("tangent_transform", |a| out3(normalize_or_zero(m3(a) * v3(a)))),
    ("tangent_transform_published", |a| out3(m3(a) * v3(a))),
];

fn tangents(frame: Tangents) -> Vec<f64> {
    [out3(frame.tangent), out3(frame.bitangent)].concat()
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
