//! All tolerances. Nothing outside of this file decides how far a result may be from the truth.
//!
//! A tolerance here is a **computed bound**: the technique's documented algorithm carried out over [`Bounded`] numbers at the very
//! input that is judged, so that every operation adds what the accuracy rules of WGSL allow it and cancellation shows. Where
//! a row needs more than the rules, its `derivation` says what and why. No number was chosen by looking at outputs.
//!
//! The rows are written from the algorithm stated in the technique's documentation. `bounds`, which derives the same from the
//! shader's own code, is meant to replace this table.

use crate::bounded::Bounded;
use crate::bounded::vector::{Vec3, add, dot, normalize, scale, subtract, transform};
use crate::oracle::Args;

/// The largest share of outputs of one random case that may be undecided before the case is a warning. Inputs of random cases
/// are drawn from the documented domain, where a hardened function leaves nothing open but isolated ties.
pub const UNDECIDED_LIMIT: f64 = 0.01;

/// The same for pixels whose textures the driver filters: an alpha test near its cutoff is undecided within the filter's
/// allowance, which is much wider than rounding, so more pixels may be.
pub const UNDECIDED_LIMIT_FILTERED: f64 = 0.05;

/// Bits that a sampler keeps of a filter weight: what Vulkan's `subTexelPrecisionBits` is on the software drivers, and the
/// least that Direct3D allows.
pub const SUBTEXEL_BITS: i32 = 8;

/// The smallest normal f32, which the hardened forms compare with.
const SMALLEST_NORMAL: Bounded = Bounded::exact(f32::MIN_POSITIVE);
const ZERO: Bounded = Bounded::exact(0.0);
const ONE: Bounded = Bounded::exact(1.0);

/// One row.
pub struct Tolerance {
    /// The function, by its name in the library.
    pub function: &'static str,
    /// Where the bound comes from.
    pub derivation: &'static str,
    /// Arguments in, bounded outputs in order.
    pub bound: fn(&mut Args<'_, Bounded>) -> Vec<Bounded>,
}

/// The row of the function of that name.
#[must_use]
pub fn find(function: &str) -> Option<&'static Tolerance> {
    TABLE.iter().find(|row| row.function == function)
}

/// The functions that have a row.
pub fn names() -> impl Iterator<Item = &'static str> {
    TABLE.iter().map(|row| row.function)
}

macro_rules! row {
    ($function:literal, $derivation:literal, $bound:expr) => {
        Tolerance {
            function: $function,
            derivation: $derivation,
            bound: $bound,
        }
    };
}

/// The table, in the order of the library.
pub const TABLE: &[Tolerance] = &[
    row!("resolve_edge", "integers: exact", |a| integers(a, "resolve_edge")),
    row!("euclidean_remainder", "integers: exact", |a| integers(
        a,
        "euclidean_remainder"
    )),
    row!("bitangent", "three differences of products, times w", |a| {
        let (n, t) = (a.array(), a.array());
        bitangent(&n, &t).to_vec()
    }),
    row!("linear_part", "a selection: exact", |a| {
        let m: [[Bounded; 4]; 4] = a.matrix();
        (0..9).map(|i| m[i / 3][i % 3]).collect()
    }),
    row!("column_scales", "a selection: exact", |a| column_scales(
        &a.matrix()
    )
    .to_vec()),
    row!(
        "cofactor_direction",
        "columns scaled by their largest component (a quotient each), three cross products, a weighted sum",
        |a| {
            let (m, v) = (a.matrix(), a.array());
            cofactor_direction(&m, &v).to_vec()
        }
    ),
    row!(
        "mirror_sign",
        "the sign of a scaled determinant; undecided where its interval holds zero",
        |a| vec![mirror_sign(&a.matrix())]
    ),
    row!(
        "normalise",
        "scaled by the largest component, then v / √(v·v) with v·v in [1, 3]",
        |a| normalise(&a.array()).to_vec()
    ),
    row!(
        "normalise_published",
        "v / length(v): open where v·v may overflow or fall below the smallest normal number",
        |a| { normalize(&a.array()).to_vec() }
    ),
    row!("largest_component", "a selection: exact", |a| vec![
        largest_component(&a.array())
    ]),
    row!("elevation", "a product and a sum", |a| {
        let (h, s, b) = (a.scalar(), a.scalar(), a.scalar());
        vec![s * h + b]
    }),
    row!("lambert", "one dot product; the clamp is exact", |a| vec![
        lambert(&a.array(), &a.array())
    ]),
    row!("half_vector", "three sums, then `normalise`", |a| normalise(
        &add(&a.array(), &a.array())
    )
    .to_vec()),
    row!("half_vector_published", "three sums, then v / length(v)", |a| {
        normalize(&add(&a.array(), &a.array())).to_vec()
    }),
    row!(
        "highlight_power",
        "pow inherits exp2(y · log2 x); below the smallest normal number the answer is 0",
        |a| { vec![highlight_power(a.scalar(), a.scalar())] }
    ),
    row!(
        "highlight_power_published",
        "pow inherits exp2(y · log2 x), which is open at x = 0",
        |a| {
            let x = a.scalar();
            vec![x.saturate().pow(a.scalar())]
        }
    ),
    row!(
        "blinn_phong",
        "dot products, `normalise`, `highlight_power`, two products and a sum a channel",
        |a| {
            let (n, l, v, diffuse, specular, p) =
                (a.array(), a.array(), a.array(), a.array(), a.array(), a.scalar());
            blinn_phong(&n, &l, &v, &diffuse, &specular, p).to_vec()
        }
    ),
    row!(
        "blinn_phong_published",
        "dot products, normalize, pow, two products and a sum a channel; open where H or pow is",
        |a| {
            let (n, l, v, diffuse, specular): (Vec3, Vec3, Vec3, Vec3, Vec3) =
                (a.array(), a.array(), a.array(), a.array(), a.array());
            blinn_phong_published(&n, &l, &v, &diffuse, &specular, a.scalar()).to_vec()
        }
    ),
    row!(
        "codec_biased_encode",
        "two operations near 128, then a step: undecided within their error of an integer",
        |a| {
            each3(a, |n| {
                (n.clamp(-1.0, 1.0) * Bounded::exact(127.0) + Bounded::exact(128.5)).trunc()
            })
        }
    ),
    row!(
        "codec_biased_encode_published",
        "two operations near 128, then a step: undecided within their error of an integer",
        |a| {
            each3(a, |n| {
                (Bounded::exact(127.0) * n + Bounded::exact(128.0))
                    .trunc()
                    .clamp(0.0, 255.0)
            })
        }
    ),
    row!("codec_biased_decode", "an exact difference and a quotient", |a| {
        each3(a, |b| {
            ((b - Bounded::exact(128.0)) / Bounded::exact(127.0)).max(Bounded::exact(-1.0))
        })
    }),
    row!(
        "codec_biased_decode_published",
        "an exact difference and a quotient",
        |a| { each3(a, |b| (b - Bounded::exact(128.0)) / Bounded::exact(127.0)) }
    ),
    row!("codec_unorm_encode", "an exact product and a sum", |a| {
        each3(a, |n| Bounded::exact(0.5) * n + Bounded::exact(0.5))
    }),
    row!("codec_unorm_decode", "an exact product and a difference", |a| {
        each3(a, |c| Bounded::exact(2.0) * c - ONE)
    }),
    row!(
        "codec_unorm_encode_byte",
        "two operations near 128, then a step: undecided within their error of an integer",
        |a| {
            each3(a, |n| {
                (n.clamp(-1.0, 1.0) * Bounded::exact(127.5) + Bounded::exact(128.0)).trunc()
            })
        }
    ),
    row!("dot3", "`normalise`, a dot product, a product a channel", |a| {
        let (n, l, diffuse): (Vec3, Vec3, Vec3) = (a.array(), a.array(), a.array());
        scale(lambert(&n, &normalise(&l)), &diffuse).to_vec()
    }),
    row!(
        "dot3_published",
        "normalize, a dot product, a product a channel; open where normalize is",
        |a| {
            let (n, l, diffuse): (Vec3, Vec3, Vec3) = (a.array(), a.array(), a.array());
            scale(lambert(&n, &normalize(&l)), &diffuse).to_vec()
        }
    ),
    row!(
        "dot3_combiner",
        "six differences, a dot product, an exact product",
        |a| {
            let (x, y): (Vec3, Vec3) = (a.array(), a.array());
            let centred = |v: Vec3| v.map(|c| c - Bounded::exact(0.5));
            vec![(Bounded::exact(4.0) * dot(&centred(x), &centred(y))).saturate()]
        }
    ),
    row!(
        "frame_from_uv_triangle",
        "products and differences of edges, `normalise`, times the area; undecided where the texture area is within its noise",
        |a| {
            let (p, q, st1, st2) = (a.array(), a.array(), a.array(), a.array());
            frame_from_uv_triangle(&p, &q, &st1, &st2)
        }
    ),
    row!(
        "frame_from_uv_triangle_published",
        "products and differences of edges times 1 / area; open at area 0",
        |a| {
            let (p, q, st1, st2) = (a.array(), a.array(), a.array(), a.array());
            frame_from_uv_triangle_published(&p, &q, &st1, &st2)
        }
    ),
    row!(
        "frame_from_uv_vertex",
        "Gram–Schmidt, `normalise`, a sign; undecided within the error of a threshold",
        |a| {
            let (n, t, b) = (a.array(), a.array(), a.array());
            frame_from_uv_vertex(&n, &t, &b, a.scalar()).to_vec()
        }
    ),
    row!(
        "frame_from_uv_vertex_published",
        "Gram–Schmidt and a sign",
        |a| {
            let (n, t, b): (Vec3, Vec3, Vec3) = (a.array(), a.array(), a.array());
            let [x, y, z] = gram_schmidt(&n, &t);
            vec![x, y, z, handedness(&n, &t, &b)]
        }
    ),
    row!(
        "handedness_of",
        "the sign of a cross and a dot product; undecided where its interval holds zero",
        |a| { vec![handedness(&a.array(), &a.array(), &a.array())] }
    ),
    row!(
        "length_of",
        "scaled by the largest component, then s · √(v·v)",
        |a| vec![length_of(&a.array())]
    ),
    row!("combine_frame", "three products and two sums a component", |a| {
        let (t, b, n): (Vec3, Vec3, Vec3) = (a.array(), a.array(), a.array());
        combine_frame(&t, &b, &n, &a.array()).to_vec()
    }),
    row!(
        "frame_mikktspace",
        "a cross product times w, three products and two sums a component",
        |a| {
            let (n, t, v) = (a.array(), a.array(), a.array());
            combine_frame(&[t[0], t[1], t[2]], &bitangent(&n, &t), &n, &v).to_vec()
        }
    ),
    row!(
        "height_to_normal",
        "differences times slopes, 1 / √(1 + gx² + gy²), a product a component",
        |a| {
            let [left, right, before, after] = a.array();
            let [su, sv] = a.array();
            normal_of_slopes((right - left) * su, (after - before) * sv)
        }
    ),
    row!(
        "height_to_normal_forward",
        "differences times slopes, 1 / √(1 + gx² + gy²), a product a component",
        |a| {
            let [here, right, after] = a.array();
            let [su, sv] = a.array();
            normal_of_slopes((right - here) * su, (after - here) * sv)
        }
    ),
    row!(
        "height_to_normal_forward_published",
        "differences of products, 1 / √(1 + a² + b²), a product a component",
        |a| {
            let [here, next_row, next_column, s] = a.array();
            let difference = |next: Bounded| dot(&[s, -s], &[next, here]);
            normal_of_slopes(difference(next_row), difference(next_column))
        }
    ),
    row!("light_to_tangent", "three dot products", |a| {
        let (t, b, n): (Vec3, Vec3, Vec3) = (a.array(), a.array(), a.array());
        light_to_tangent(&t, &b, &n, &a.array()).to_vec()
    }),
    row!(
        "light_to_tangent_world_space",
        "a cross product times w, three dot products",
        |a| {
            let (n, t) = (a.array(), a.array());
            light_to_tangent(&[t[0], t[1], t[2]], &bitangent(&n, &t), &n, &a.array()).to_vec()
        }
    ),
    row!(
        "light_to_tangent_object_space",
        "a matrix times a point, three differences, then as in world space",
        |a| {
            let (n, t): (Vec3, [Bounded; 4]) = (a.array(), a.array());
            let (position, light): (Vec3, Vec3) = (a.array(), a.array());
            let m: [[Bounded; 4]; 4] = a.matrix();
            let light_os: Vec3 = std::array::from_fn(|i| {
                dot(
                    &[m[0][i], m[1][i], m[2][i], m[3][i]],
                    &[light[0], light[1], light[2], ONE],
                )
            });
            light_to_tangent(
                &[t[0], t[1], t[2]],
                &bitangent(&n, &t),
                &n,
                &subtract(&light_os, &position),
            )
            .to_vec()
        }
    ),
    row!(
        "normal_transform",
        "`cofactor_direction`, a sign, `normalise`",
        |a| {
            let (m, n) = (a.matrix(), a.array());
            normalise(&scale(mirror_sign(&m), &cofactor_direction(&m, &n))).to_vec()
        }
    ),
    row!(
        "normal_transform_by_cofactor",
        "a matrix times a vector, an exact sign, `normalise`",
        |a| {
            let (m, mirror): ([Vec3; 3], Bounded) = (a.matrix(), a.scalar());
            normalise(&scale(mirror, &transform(&m, &a.array()))).to_vec()
        }
    ),
    row!("normal_transform_published", "a matrix times a vector", |a| {
        transform(&a.matrix(), &a.array()).to_vec()
    }),
    row!("tangent_transform", "a matrix times a vector, `normalise`", |a| {
        normalise(&transform(&a.matrix(), &a.array())).to_vec()
    }),
    row!("tangent_transform_published", "a matrix times a vector", |a| {
        transform(&a.matrix(), &a.array()).to_vec()
    }),
    row!(
        "parallax_offset",
        "a product, a quotient by V.z ≥ 0.05, a sum a component",
        |a| {
            let (uv, z, v) = (a.array(), a.scalar(), a.array());
            parallax_offset(&uv, z, &v).to_vec()
        }
    ),
    row!(
        "parallax_offset_published",
        "a product, a quotient by V.z, a sum a component; open where V.z is zero or subnormal",
        |a| {
            let (uv, z, v) = (a.array(), a.scalar(), a.array());
            parallax_offset_published(&uv, z, &v).to_vec()
        }
    ),
    row!(
        "parallax_offset_limited",
        "a product and a sum a component",
        |a| {
            let (uv, z, v) = (a.array(), a.scalar(), a.array());
            parallax_offset_limited(&uv, z, &v).to_vec()
        }
    ),
];

/// The bounds that the surface's analysis shares with the probes'.
pub(crate) mod formula;
pub(crate) mod surface;
pub(crate) mod texture;

use formula::*;
