//! Rays of a scene's camera over one of its materials, for those who measure what is seen.

use glam::{DVec2, DVec3};

use crate::model::Scene;
use crate::sequence::Sequence;
use crate::views::View;

/// A view ray where it meets the polygon, and what it is on screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenRay {
    /// UV of the polygon there.
    pub uv: DVec2,
    /// Unit vector to the eye in tangent space, z > 0.
    pub view_ts: DVec3,
    /// Pixels that a UV unit spans along u and along v, on the polygon.
    pub px_per_uv: [DVec2; 2],
}

impl SeenRay {
    /// A small way over the polygon, in UV, as pixels.
    #[must_use]
    pub fn px(&self, way_uv: DVec2) -> f64 {
        (self.px_per_uv[0] * way_uv.x + self.px_per_uv[1] * way_uv.y).length()
    }
}

/// About `count` rays of the camera over all objects of a material (by its index), equally dense on screen, the same in every call; fewer
/// where parts are seen from behind. Objects do not hide each other here.
#[must_use]
pub fn seen_rays(scene: &Scene, material: usize, count: u32) -> Vec<SeenRay> {
    let views: Vec<View> = scene
        .objects_of(material)
        .map(|object| View::new(&scene.camera, object))
        .filter(|view| view.area_px() > 0.0)
        .collect();
    let total: f64 = views.iter().map(View::area_px).sum();
    let share = |view: &View| (f64::from(count) * view.area_px() / total).ceil() as u32;
    let rays = views.iter().flat_map(|view| {
        let mut points = Sequence::even();
        (0..share(view)).filter_map(move |_| view.ray_at(points.draw()))
    });
    rays.map(|ray| SeenRay {
        uv: ray.uv,
        view_ts: ray.view_ts,
        px_per_uv: ray.px_per_uv,
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::seen_rays;

    /// A square of two units, two away from an eye with 90° of view: it spans the whole picture's height.
    fn scene() -> crate::Scene {
        let text = r#"
            schema = 1
            ambient = [1.0, 1.0, 1.0]
            [camera]
            position = [0.0, 0.0, 1.0]
            target = [0.0, 0.0, 0.0]
            fov_deg = 90.0
            near = 0.1
            far = 10.0
            size = [64, 64]
            [[materials]]
            name = "white"
            [[objects]]
            name = "wall"
            shape = "plane"
            material = "white"
            size = [2.0, 2.0]
        "#;
        crate::load_str("inline.toml", text).unwrap()
    }

    #[test]
    fn rays_are_those_of_the_picture() {
        let rays = seen_rays(&scene(), 0, 1000);
        assert!((990..=1001).contains(&rays.len()), "{}", rays.len());
        for ray in &rays {
            // Seen from straight above at distance 1, half of a focal length of 32 pixels a world unit.
            let slope = ray.view_ts.truncate() / ray.view_ts.z;
            assert!(slope.abs().max_element() <= 1.0 + 1e-9, "{ray:?}");
            // The tile is two units or 64 pixels wide.
            assert!((ray.px(DVec2::X) - 64.0).abs() < 1e-6, "{ray:?}");
        }
        assert!(seen_rays(&scene(), 0, 0).is_empty());
    }
}
