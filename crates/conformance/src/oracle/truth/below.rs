//! The functions of `lib/`, written out from their definitions where no technique's reference has them.

use bossage_assets::EdgeMode;
use bossage_reference::vector::{SMALLEST_NORMAL_F32, normalize, normalize_or_zero, saturate, sign_not_zero};
use bossage_reference::{frame_mikktspace, normal_transform, parallax_offset};
use glam::{DMat3, DVec2, DVec3};

use super::{A, Rows, m3, m4, out2, out3, out9, v2, v3, v4};

pub(super) const ROWS: Rows = &[
    ("bilinear", |a| {
        let (corners, f) = (a.array(), v2(a));
        vec![bilinear(corners, f)]
    }),
    ("bilinear_gradient", |a| {
        let (corners, f) = (a.array(), v2(a));
        out2(bilinear_gradient(corners, f))
    }),
    ("resolve_edge", resolve_edge),
    ("euclidean_remainder", |a| {
        vec![(a.scalar() as i64).rem_euclid(a.scalar() as i64) as f64]
    }),
    ("bitangent", |a| out3(frame_mikktspace::bitangent(v3(a), v4(a)))),
    ("linear_part", |a| out9(DMat3::from_mat4(m4(a)))),
    ("column_factors", |a| out3(column_factors(m3(a)))),
    ("cofactor_direction", |a| {
        let (linear, v) = (m3(a), v3(a));
        out3(scaled_cofactor(linear, v))
    }),
    ("mirror_sign", |a| vec![sign_not_zero(m3(a).determinant())]),
    ("largest_component", |a| vec![v3(a).abs().max_element()]),
    ("size_factor", |a| vec![size_factor(a.scalar())]),
    ("sized", |a| {
        let (v, factor) = (v3(a), a.scalar());
        out3((v * factor).clamp(DVec3::splat(-4.0), DVec3::splat(4.0)))
    }),
    ("to_size", |a| {
        let v = v3(a);
        out3(v * size_factor(v.abs().max_element()))
    }),
    ("normalise", |a| out3(normalize_or_zero(v3(a)))),
    ("length_of", |a| vec![length_of(v3(a))]),
    ("normalise_published", |a| out3(normalize(v3(a)))),
    ("elevation", |a| {
        vec![parallax_offset::elevation(a.scalar(), a.scalar(), a.scalar())]
    }),
    ("lambert", |a| vec![saturate(v3(a).dot(v3(a)))]),
];

/// Corners h00, h10, h01, h11, weighted by the areas opposite to them.
fn bilinear([h00, h10, h01, h11]: [f64; 4], f: DVec2) -> f64 {
    let g = DVec2::ONE - f;
    h00 * g.x * g.y + h10 * f.x * g.y + h01 * g.x * f.y + h11 * f.x * f.y
}

/// Its partial derivatives.
fn bilinear_gradient([h00, h10, h01, h11]: [f64; 4], f: DVec2) -> DVec2 {
    let g = DVec2::ONE - f;
    DVec2::new(
        (h10 - h00) * g.y + (h11 - h01) * f.y,
        (h01 - h00) * g.x + (h11 - h10) * f.x,
    )
}

fn resolve_edge(a: A<'_, '_>) -> Vec<f64> {
    let (index, size, mode) = (a.scalar() as i64, a.scalar() as u32, a.scalar() as u32);
    let edge = [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp][mode.min(2) as usize];
    vec![f64::from(edge.resolve(index, size))]
}

/// |v|, and 0 where no component reaches the smallest normal f32.
pub(super) fn length_of(v: DVec3) -> f64 {
    if v.abs().max_element() < SMALLEST_NORMAL_F32 {
        0.0
    } else {
        v.length()
    }
}

/// The power of two by which a size comes to [½, 1). What is no normal f32 counts as the least exponent, what is above 2¹²⁵ as the greatest.
fn size_factor(size: f64) -> f64 {
    if size < SMALLEST_NORMAL_F32 {
        return 126f64.exp2();
    }
    let exponent = size.log2().floor();
    // log2 rounds: a number next to a power of two may come out on it.
    let exponent = if exponent.exp2() > size {
        exponent - 1.0
    } else {
        exponent
    };
    (-1.0 - exponent.min(125.0)).exp2()
}

/// That of the largest component of each column, which counts as 2⁻¹²² at least.
fn column_factors(linear: DMat3) -> DVec3 {
    let factor = |column: [f64; 3]| {
        let largest = DVec3::from_array(column).abs().max_element();
        size_factor(largest.max(16.0 * SMALLEST_NORMAL_F32))
    };
    DVec3::from_array(linear.to_cols_array_2d().map(factor))
}

/// cof(M) v times f₀ f₁ f₂ with f the columns' factors: how the library brings its direction to size.
fn scaled_cofactor(linear: DMat3, v: DVec3) -> DVec3 {
    normal_transform::cofactor(linear) * v * column_factors(linear).element_product()
}
