//! Maps and rays of a scene: every material with a height map, from its camera's place.
//!
//! The rays are those of the picture, equally dense on screen, so an error can be told in pixels there: the way between two places on the
//! polygon, carried to the screen by the projection's derivative. It is right for small ways and only roughly so for large ones.

use std::sync::Arc;

use bossage_reference::relief_ray::Layer;
use bossage_scene::{HeightSource, Material, Scene, SeenRay, seen_rays};

use super::map::Map;
use super::rays::ViewRay;
use super::statistics::{Answer, spread};
use super::textures::Textures;
use super::truth::Truth;
use crate::record::SceneError;

/// What the rays of a camera are on its screen.
#[derive(Clone, Debug)]
pub struct Screen {
    /// The scene's name.
    pub scene: String,
    /// One for each ray of the cell.
    pub rays: Vec<SeenRay>,
}

impl Screen {
    /// Errors in pixels. Answers that are no numbers have none.
    pub(super) fn error(&self, truths: &[Truth], answers: &[Answer]) -> SceneError {
        let all = self.rays.iter().zip(truths).zip(answers);
        let finite = all.filter(|(_, answer)| answer.uv.is_finite());
        let px = finite.map(|((ray, truth), answer)| {
            let hits = std::iter::once(&truth.answers.truth).chain(&truth.answers.others);
            hits.map(|hit| ray.px(answer.uv - hit.uv))
                .fold(f64::INFINITY, f64::min)
        });
        SceneError {
            scene: self.scene.clone(),
            error_px: spread(&mut px.collect::<Vec<f64>>()),
            ..SceneError::default()
        }
    }
}

/// A material's map with the rays that see it.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The map, called `SCENE/MATERIAL`.
    pub map: Arc<Map>,
    /// The rays, rounded to f32.
    pub rays: Vec<ViewRay>,
    /// The median of their angles from the normal, degrees, to a tenth.
    pub view_deg: f64,
    /// On screen.
    pub screen: Screen,
}

/// Every material with a height map of which the camera sees something; about `count` rays each.
#[must_use]
pub fn materials(scene: &Scene, name: &str, origin: &str, count: u32) -> Vec<Seen> {
    let with_heights = scene.materials.iter().enumerate();
    let seen = with_heights.filter_map(|(index, material)| {
        let height = material.height.as_ref()?;
        let on_screen = seen_rays(scene, index, count);
        let rays: Vec<ViewRay> = on_screen.iter().map(rounded).collect();
        let mut angles: Vec<f64> = rays.iter().map(ViewRay::view_deg).collect();
        angles.sort_by(f64::total_cmp);
        let median = *angles.get(angles.len().checked_sub(1)? / 2)?;
        Some(Seen {
            map: Arc::new(map(material, height, name, origin)),
            rays,
            view_deg: (10.0 * median).round() / 10.0,
            screen: Screen {
                scene: name.to_owned(),
                rays: on_screen,
            },
        })
    });
    seen.collect()
}

fn rounded(ray: &SeenRay) -> ViewRay {
    ViewRay {
        uv: ray.uv.as_vec2(),
        view_ts: ray.view_ts.as_vec3(),
    }
}

fn map(material: &Material, height: &HeightSource, scene: &str, origin: &str) -> Map {
    let (scale, bias) = (height.elevation.scale, height.elevation.bias);
    Map {
        name: format!("{scene}/{}", material.name),
        origin: origin.to_owned(),
        field: Arc::clone(&height.field),
        edge: material.address,
        layer: Layer {
            scale: scale.x,
            bias: bias.x,
            v_factor: scale.y / scale.x,
        },
        textures: Textures::default(),
    }
}

#[cfg(test)]
mod tests {
    use bossage_reference::relief_ray::Status;

    use super::super::statistics::Answer;
    use super::super::truth::trace;
    use super::materials;

    /// A wall of 2 units, its tile 64 pixels wide, over heights of a file beside the repository's examples.
    fn scene() -> bossage_scene::Scene {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/brick_wall.toml");
        bossage_scene::load(path.as_ref()).unwrap()
    }

    #[test]
    fn a_scenes_rays_have_pixels() {
        let scene = scene();
        let seen = materials(&scene, "brick_wall", "brick_wall.toml", 500);
        let [bricks] = seen.as_slice() else {
            panic!("{}", seen.len())
        };
        assert_eq!(bricks.map.name, "brick_wall/bricks");
        assert!((490..=510).contains(&bricks.rays.len()));
        assert_eq!(bricks.rays.len(), bricks.screen.rays.len());
        assert!(bricks.view_deg > 0.0 && bricks.view_deg < 90.0);
        let truths = trace(&bricks.map, &bricks.rays);
        let right: Vec<Answer> = truths
            .iter()
            .map(|truth| Answer {
                uv: truth.answers.truth.uv,
                status: Some(Status::Hit),
            })
            .collect();
        assert_eq!(bricks.screen.error(&truths, &right).error_px.max, 0.0);
        // A hundredth of a tile off along u: so many pixels as the projection says.
        let off: Vec<Answer> = right
            .iter()
            .map(|answer| Answer {
                uv: answer.uv + glam::DVec2::new(0.01, 0.0),
                ..*answer
            })
            .collect();
        let error = bricks.screen.error(&truths, &off).error_px;
        let widest = bricks
            .screen
            .rays
            .iter()
            .map(|ray| 0.01 * ray.px_per_uv[0].length())
            .fold(0.0, f64::max);
        assert!(
            error.max > 0.0 && error.max <= widest * (1.0 + 1e-9),
            "{error:?} {widest}"
        );
    }
}
