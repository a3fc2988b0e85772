//! `pixel_depth`: the depth of the place that is seen on the relief, instead of the polygon's.
//!
//! From the hit record: the place lies at the elevation z = scale·(1 − t) + bias over the polygon, and on the view ray through the
//! polygon's point P, so it is P + V · z / V.z. Its depth is that of any vertex: clip.z / clip.w of clip_from_world · (place, 1).
//!
//! Space: P and V in the space that `clip` maps from, V unit toward the eye; `view_z_ts` is V's component along the polygon's normal;
//! lengths in that space, `tile_width` being the length of one tile along u. A view that the ray counted as steeper
//! ([`MIN_VIEW_Z`]) counts so here, so that depth and colour are of one place.

use glam::{DMat4, DVec3, DVec4};

use crate::relief_ray::{HitRecord, Layer, MIN_VIEW_Z, Status};

/// The place on the view ray that the hit record stands for. What is not finite does not move.
#[must_use]
pub fn place(
    position: DVec3,
    view: DVec3,
    view_z_ts: f64,
    hit: &HitRecord,
    layer: &Layer,
    tile_width: f64,
) -> DVec3 {
    if hit.status == Status::NonFinite {
        return position;
    }
    let elevation = tile_width * (layer.scale * (1.0 - hit.t) + layer.bias);
    position + view * (elevation / view_z_ts.max(MIN_VIEW_Z))
}

/// Depth of a place, 0 at the near plane and 1 at the far one.
#[must_use]
pub fn depth(place: DVec3, clip_from_world: &DMat4) -> f64 {
    let clip: DVec4 = *clip_from_world * place.extend(1.0);
    clip.z / clip.w
}

#[cfg(test)]
mod tests {
    use glam::{DMat4, DVec2, DVec3, DVec4};

    use super::{depth, place};
    use crate::relief_ray::{HitRecord, Layer, Status};

    fn record(t: f64) -> HitRecord {
        HitRecord {
            uv: DVec2::ZERO,
            t,
            status: Status::Hit,
        }
    }

    #[test]
    fn the_place_is_on_the_view_ray_at_its_elevation() {
        let (position, view) = (DVec3::new(1.0, 2.0, 0.0), DVec3::new(0.6, 0.0, 0.8));
        let layer = Layer::below(0.05);
        // Half-way down, on tiles two units wide: 0.05 below the polygon, 0.0375 against the eye.
        let seen = place(position, view, view.z, &record(0.5), &layer, 2.0);
        assert!((seen - DVec3::new(1.0 - 0.0375, 2.0, -0.05)).length() < 1e-15);
        assert_eq!(place(position, view, view.z, &record(0.0), &layer, 2.0), position);
        let lost = HitRecord {
            status: Status::NonFinite,
            ..record(0.5)
        };
        assert_eq!(place(position, view, view.z, &lost, &layer, 2.0), position);
    }

    #[test]
    fn depth_grows_with_depth_into_the_relief() {
        // An eye at (0, 0, 3) that looks along −z, near plane 0.1, far plane 10: clip.w = 3 − z, clip.z = 10·(3 − z − 0.1)/9.9.
        let clip = DMat4::from_rows(
            DVec4::X,
            DVec4::Y,
            DVec4::new(0.0, 0.0, -10.0 / 9.9, 29.0 / 9.9),
            DVec4::new(0.0, 0.0, -1.0, 3.0),
        );
        let layer = Layer::below(0.2);
        let at = |t: f64| depth(place(DVec3::ZERO, DVec3::Z, 1.0, &record(t), &layer, 1.0), &clip);
        // far·(z − near)/(z·(far − near)) at the distance z = 3 + 0.2 t.
        for t in [0.0, 0.25, 1.0] {
            let z = 3.0 + 0.2 * t;
            assert!((at(t) - 10.0 * (z - 0.1) / (z * 9.9)).abs() < 1e-15, "{t}");
        }
    }
}
