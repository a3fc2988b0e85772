//! Cube maps, and the normalisation cube map.

use bossage_reference::cube::{face_and_st, point, texel_centre};
use bossage_reference::vector::{SMALLEST_NORMAL_F32, normalize};
use bossage_reference::{codec_unorm, normalisation_cube_map::Depth};
use glam::{DVec2, DVec3};

use super::{Rows, out2, out3, v2, v3};

pub(super) const ROWS: Rows = &[
    ("cube_place", |a| {
        let (face, st) = place(v3(a));
        vec![face as f64, st.x, st.y]
    }),
    ("cube_st", |a| {
        let [s, t, major] = a.array();
        out2((DVec2::new(s, t) / major + 1.0) / 2.0)
    }),
    ("cube_point", |a| {
        // Along the face's own axes: (p + 1) / 2 would lose what is small.
        let (face, p) = (a.scalar() as usize, v2(a));
        let at = |s: f64, t: f64| point(face, DVec2::new(s, t));
        let middle = at(0.5, 0.5);
        out3(middle + p.x * (at(1.0, 0.5) - middle) + p.y * (at(0.5, 1.0) - middle))
    }),
    ("cube_footprint", |a| {
        let (st, size) = (v2(a), a.scalar());
        footprint(st, size)
    }),
    ("upper_bits", |a| out2(upper_bits(v2(a)))),
    ("normalisation_cube_map", |a| {
        let [face, x, y, size] = a.array();
        let centre = texel_centre(face as usize, x as i64, y as i64, size as u32);
        out3(normalize(centre))
    }),
    ("normalisation_cube_map_code", |a| {
        let [face, x, y, size, largest] = a.array();
        let centre = texel_centre(face as usize, x as i64, y as i64, size as u32);
        codes(normalize(centre), largest)
    }),
    ("normalisation_cube_map_encode", |a| codes(v3(a), a.scalar())),
    ("normalisation_cube_map_decode", |a| {
        let [x, y, z, largest] = a.array();
        [x, y, z].map(|code| codec_unorm::decode(code / largest)).to_vec()
    }),
];

/// The face and place of a direction; the middle of +Z where there is none.
fn place(direction: DVec3) -> (usize, DVec2) {
    if direction.abs().max_element() < SMALLEST_NORMAL_F32 {
        (4, DVec2::splat(0.5))
    } else {
        face_and_st(direction)
    }
}

/// First and last texel and the place between them: the texel centres are at whole numbers plus a half.
fn footprint(st: DVec2, size: f64) -> Vec<f64> {
    let p = st * size - 0.5;
    let border = DVec2::splat(size - 1.0);
    let texel = |step: f64| (p.floor() + step).clamp(DVec2::ZERO, border);
    [texel(0.0), texel(1.0), p - p.floor()]
        .into_iter()
        .flat_map(out2)
        .collect()
}

/// Each number cut off behind ten binary digits.
fn upper_bits(v: DVec2) -> DVec2 {
    let cut = |x: f64| {
        // A subnormal number has its first digit lower down: 2⁻¹³⁵ is the place of its tenth.
        let digit = x.abs().max(SMALLEST_NORMAL_F32).log2().floor() - 9.0;
        (x / digit.exp2()).trunc() * digit.exp2()
    };
    DVec2::new(cut(v.x), cut(v.y))
}

/// What a map of that depth keeps of a normal, its components clamped.
fn codes(normal: DVec3, largest: f64) -> Vec<f64> {
    let code = |n: f64| (depth(largest).store(codec_unorm::encode(n.clamp(-1.0, 1.0))) * largest).round();
    normal.to_array().map(code).to_vec()
}

fn depth(largest_code: f64) -> Depth {
    if largest_code == 255.0 {
        Depth::Eight
    } else {
        Depth::Sixteen
    }
}
