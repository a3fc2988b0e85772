//! The hits that count for each ray, in f64, made once for a map and its rays and shared by all techniques.

use bossage_reference::relief_grazing::{Answers, Surface};
use bossage_reference::relief_ray::{Entry, Status};
use glam::DVec2;
use rayon::prelude::*;

use super::map::Map;
use super::rays::ViewRay;

/// What is true of one ray.
#[derive(Clone, Debug)]
pub struct Truth {
    /// The hits that count.
    pub answers: Answers,
    /// The status that goes with them.
    pub status: Status,
    /// The way that the ray goes across the map, in texels while it crosses the layer.
    pub travel_texels: DVec2,
}

/// The truth of all rays over a map, in their order.
#[must_use]
pub fn trace(map: &Map, rays: &[ViewRay]) -> Vec<Truth> {
    let surface = Surface::new(&map.field, map.edge);
    let sides = map.sides();
    rays.par_iter()
        .map(|ray| {
            let (uv, view_ts) = ray.exact();
            let entry = Entry::new(uv, view_ts, &map.layer);
            Truth {
                answers: surface.answers(&entry.ray),
                status: entry.status,
                travel_texels: entry.ray.delta * sides,
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use bossage_assets::EdgeMode;
    use bossage_reference::relief_ray::Status;

    use super::super::map::Map;
    use super::super::rays::seeded;
    use super::trace;

    #[test]
    fn level_ground_is_met_where_its_plane_is() {
        // Constant height ¼ in a layer of 0.05 below the polygon: the ray is 0.75·0.05 below it.
        let map = Map::of("level", 8, 4, |_, _| 0.25, EdgeMode::Wrap);
        let rays = seeded(60.0, 256, 1);
        for (ray, truth) in rays.iter().zip(trace(&map, &rays)) {
            let (uv, view) = ray.exact();
            let along = view.truncate() / view.z;
            let expected = uv - 0.75 * 0.05 * along * glam::DVec2::new(1.0, 2.0);
            // Rounding of f64 alone.
            assert!((truth.answers.truth.uv - expected).length() < 1e-13);
            assert_eq!(truth.status, Status::Hit);
            assert!(!truth.answers.is_grazing());
        }
    }

    #[test]
    fn views_flatter_than_are_traced_say_so() {
        let map = Map::of("level", 8, 8, |_, _| 0.25, EdgeMode::Wrap);
        let rays = seeded(89.0, 16, 1);
        assert!(
            trace(&map, &rays)
                .iter()
                .all(|truth| truth.status == Status::Clamped)
        );
    }
}
