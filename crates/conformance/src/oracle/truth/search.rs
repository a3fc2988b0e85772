//! The parts of searches along a view ray.

use bossage_reference::relief_ray::{Entry, HitRecord, Layer, MIN_VIEW_Z, Ray, Status, step_count};
use bossage_reference::vector::SMALLEST_NORMAL_F32;
use bossage_reference::{cone_step, pixel_depth, soft_shadow};
use glam::{DMat4, DVec2, DVec4};

use super::{A, Rows, out2, out3, v2, v3, v4};

pub(super) const ROWS: Rows = &[
    ("relief_ray", relief_ray),
    ("is_finite", |a| vec![f64::from(u8::from(v3(a).is_finite()))]),
    ("step_count", |a| vec![f64::from(step_count(a.scalar() as u32))]),
    ("relief_level", |a| {
        let (along_x, along_y, size) = (v2(a), v2(a), v2(a));
        let longest = (along_x * size).length().max((along_y * size).length());
        vec![longest.max(1.0).log2()]
    }),
    // Where the line through (0, before) and (1, gap) is 0; the floor's gap counts as 0.
    ("secant_share", |a| {
        let (before, gap) = (a.scalar(), a.scalar().max(0.0));
        vec![before / (before - gap)]
    }),
    ("march_gap", |a| vec![a.scalar() + a.scalar() - 1.0]),
    ("lower_end", |a| {
        let (t, middle, gap) = (a.scalar(), a.scalar(), a.scalar());
        vec![if gap < 0.0 { t } else { middle }]
    }),
    ("cone_reach", |a| {
        let (delta, sides) = (v2(a), v2(a));
        let ray = Ray {
            uv_top: DVec2::ZERO,
            delta,
        };
        vec![cone_step::reach(&ray, sides)]
    }),
    // A cone that opens by `ratio` a height meets a ray that travels `reach` a thickness.
    ("cone_advance", |a| {
        let [gap, ratio, reach] = a.array();
        vec![if reach < SMALLEST_NORMAL_F32 {
            gap
        } else {
            gap * ratio / (ratio + reach)
        }]
    }),
    ("toward_surface", |a| {
        let (half, gap) = (a.scalar(), a.scalar());
        vec![if gap > 0.0 { half } else { -half }]
    }),
    ("iterative_step", |a| {
        let [surface, elevation, normal_z] = a.array();
        vec![(surface - elevation) * normal_z]
    }),
    ("light_rise", |a| {
        let direction = v3(a);
        let [scale, _, v_factor] = a.array();
        let across = DVec2::new(direction.x, v_factor * direction.y);
        out2(scale * across / direction.z.max(MIN_VIEW_Z))
    }),
    ("seen_share", |a| {
        let (horizon, half_width) = (a.scalar(), a.scalar().clamp(2f64.powi(-20), 2f64.powi(20)));
        vec![soft_shadow::seen(horizon, half_width)]
    }),
    ("soft_shadow_sample_published", |a| {
        let [height, ground, share, weight, softening] = a.array();
        vec![soft_shadow::published_sample(
            height,
            ground,
            (share, weight),
            softening,
        )]
    }),
    ("soft_shadow_light_published", |a| {
        vec![soft_shadow::published_light(a.scalar())]
    }),
    ("relief_place", relief_place),
    ("pixel_depth", |a| {
        let (place, z, w) = (v3(a), v4(a), v4(a));
        // Behind the eye, or on its plane.
        let depth = if w.dot(place.extend(1.0)) < 2f64.powi(-100) {
            1.0
        } else {
            pixel_depth::depth(
                place,
                &DMat4::from_cols(DVec4::ZERO, DVec4::ZERO, z, w).transpose(),
            )
        };
        vec![depth]
    }),
    ("patch_along", patch_along),
    ("is_met", |a| {
        let [c, b, a2] = a.array();
        vec![f64::from(u8::from(first_root(c, b, a2, a.scalar()).is_some()))]
    }),
    ("first_root", |a| {
        let [c, b, a2] = a.array();
        let length = a.scalar();
        vec![first_root(c, b, a2, length).unwrap_or(length)]
    }),
];

/// The bilinear patch along place + s · along, over the ray's height 1 − t − s, by the powers of s. The heights are taken over the ray
/// first: where they meet it, f64 would lose what a place near a corner makes of them.
fn patch_along(a: A<'_, '_>) -> Vec<f64> {
    let [h00, h10, h01, h11] = a.array();
    let (f, d, t) = (v2(a), v2(a), a.scalar());
    let g = DVec2::ONE - f;
    let [o00, o10, o01, o11] = [h00, h10, h01, h11].map(|h| h - (1.0 - t));
    let near = o00 + f.x * (o10 - o00);
    let far = o01 + f.x * (o11 - o01);
    let over = near + f.y * (far - near);
    let slope = DVec2::new(
        (h10 - h00) * g.y + (h11 - h01) * f.y,
        (h01 - h00) * g.x + (h11 - h10) * f.x,
    );
    let twist = h00 - h10 - h01 + h11;
    vec![over, slope.dot(d) + 1.0, twist * d.x * d.y]
}

/// The smallest s in [0, length] where c + b s + a s² is not below 0.
fn first_root(c: f64, b: f64, a: f64, length: f64) -> Option<f64> {
    if c >= 0.0 {
        return Some(0.0);
    }
    let discriminant = b * b - 4.0 * a * c;
    // c < 0, so of two roots of one sign, or of the only positive one, the first from 0 on is −2c / (b + √Δ).
    let s = if b >= 0.0 {
        -2.0 * c / (b + discriminant.sqrt())
    } else {
        (discriminant.sqrt() - b) / (2.0 * a)
    };
    (discriminant >= 0.0 && s > 0.0 && s <= length).then_some(s)
}

fn relief_place(a: A<'_, '_>) -> Vec<f64> {
    let (position, view) = (v3(a), v3(a));
    let [view_z_ts, t, status, scale, bias, v_factor, tile_width] = a.array();
    let hit = HitRecord {
        uv: DVec2::ZERO,
        t,
        status: if status == 3.0 {
            Status::NonFinite
        } else {
            Status::Hit
        },
    };
    let layer = Layer {
        scale,
        bias,
        v_factor,
    };
    out3(pixel_depth::place(
        position, view, view_z_ts, &hit, &layer, tile_width,
    ))
}

fn relief_ray(a: A<'_, '_>) -> Vec<f64> {
    let (uv, view) = (v2(a), v3(a));
    let [scale, bias, v_factor] = a.array();
    let entry = Entry::new(
        uv,
        view,
        &Layer {
            scale,
            bias,
            v_factor,
        },
    );
    let DVec2 { x, y } = entry.ray.uv_top;
    let DVec2 { x: dx, y: dy } = entry.ray.delta;
    vec![x, y, dx, dy, f64::from(entry.status.number())]
}
