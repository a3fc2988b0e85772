//! What may stay undecided, and the tolerances that are still written by hand.
//!
//! The tolerance of a probe is no number of ours: it is the acceptance interval that `bossage-bounds` evaluates from the shader's
//! own IR ([`crate::oracle::bounds`]), and so is that of a whole surface. The rows below serve the bakes and the meshes, which read
//! buffers: each is the technique's documented algorithm carried out over [`Bounded`] numbers at the very input that is judged.
//! No number was chosen by looking at outputs.

use crate::bounded::Bounded;
use crate::bounded::vector::{Vec3, dot};
use crate::oracle::Args;

/// The largest share of outputs of one random case that may be undecided before the case is a warning. Inputs of random cases
/// are drawn from the documented domain, where a hardened function leaves nothing open but isolated ties.
pub const UNDECIDED_LIMIT: f64 = 0.01;

/// The same for codes of up to 16 bits. They are steps, and fork where the interval of what is rounded holds one: a component of a
/// normalised vector is known to about 25 ULP of 2⁻²⁴, which at 32767.5 codes a unit is 0.05 of a code.
pub const UNDECIDED_LIMIT_CODES: f64 = 0.05;

/// The largest share of undecided outputs of a function on random inputs.
#[must_use]
pub fn undecided_limit(function: &str) -> f64 {
    match function {
        "normalisation_cube_map_code" => UNDECIDED_LIMIT_CODES,
        _ => UNDECIDED_LIMIT,
    }
}

/// The same for pixels whose textures the driver filters: an alpha test near its cutoff, or a highlight near its end, is undecided
/// within the filter's allowance, which is much wider than rounding, so more pixels may be.
pub const UNDECIDED_LIMIT_FILTERED: f64 = 0.03;

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
];

/// The algorithms of the rows.
mod formula;

use formula::*;
