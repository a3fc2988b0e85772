//! A scene's whole picture, as a machine draws it and as the f64 surface has it: for those who judge techniques by what is seen.
//!
//! The truth is shaded at the very interpolants that the rasteriser chose, its relief the first hit of each view ray. Both pictures read
//! the first level of each texture alone, which is what the reference models; so they differ in what a technique does and in
//! roundings, and in nothing else. Colours are linear.

use bossage_reference::relief_ray::Layer;
use bossage_reference::relief_search::Search;
use bossage_reference::surface::{Fragment, Material, Relief, depth, shade};
use bossage_runner::{Blend, Clear, Depth, Filter, RenderTarget};
use bossage_scene::{Draw, Plan, Scene, TechniquePin, draws, plan};
use bossage_shaders::{Relief as Feature, Stage};
use rayon::prelude::*;

use super::interpolants::Interpolants;
use super::pixels::{passes, uncut};
use super::rig::{Rig, job, render};
use super::truth;
use crate::bench::Bench;
use crate::case::with_causes;

/// What is seen where nothing is.
const BACKGROUND: [f32; 3] = [0.01; 3];

/// A picture in linear light.
#[derive(Clone, Debug, PartialEq)]
pub struct Whole {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green and blue, row by row from the top.
    pub pixels: Vec<[f64; 3]>,
    /// Whether a surface is seen there.
    pub covered: Vec<bool>,
}

/// The scene as planned, drawn by the bench's machine in the camera's size.
///
/// # Errors
/// What the library, the translator or the machine says.
pub fn drawn(bench: &Bench<'_>, scene: &Scene) -> Result<Whole, String> {
    let draws = draws(scene, &plan(scene));
    let rig = |draw| Ok(Rig::new(bench, draw, &draw.features, &passes(draw))?.filtered(Filter::Linear));
    let rigs: Vec<Rig<'_>> = draws.iter().map(rig).collect::<Result<_, String>>()?;
    let mut all = Vec::new();
    for (draw, rig) in draws.iter().zip(&rigs) {
        for pass in draw.passes() {
            let (blend, depth) = match pass.multiplies {
                true => (Blend::Multiply, Depth::Equal),
                false => (Blend::Replace, Depth::TestAndWrite),
            };
            all.push(rig.with(pass.fragment, blend, depth)?);
        }
    }
    let [width, height] = scene.camera.size;
    let target = RenderTarget::floats(Clear::Sentinel);
    let picture = render(bench, &job("picture", [width, height], vec![target], vec![all]))?
        .into_iter()
        .next()
        .ok_or("a picture has a target")?;
    let covered = picture.covered();
    let seen = picture.pixels.iter().zip(&covered);
    let colour =
        |([r, g, b, _], covered): (&[f32; 4], &bool)| if *covered { [*r, *g, *b] } else { BACKGROUND };
    Ok(Whole {
        width,
        height,
        pixels: seen.map(|pixel| colour(pixel).map(f64::from)).collect(),
        covered,
    })
}

/// The scene with every relief that a search could draw at its first hit in f64. The machine rasterises; it shades nothing.
///
/// # Errors
/// When no material has such a relief; what the library, the translator or the machine says.
pub fn exact(bench: &Bench<'_>, scene: &Scene) -> Result<Whole, String> {
    let scene = searched(scene)?;
    let planned: Plan = plan(&scene);
    let [width, height] = scene.camera.size;
    let pixels = width as usize * height as usize;
    let mut whole = Whole {
        width,
        height,
        pixels: vec![BACKGROUND.map(f64::from); pixels],
        covered: vec![false; pixels],
    };
    let mut nearest = vec![f32::INFINITY; pixels];
    for draw in draws(&scene, &planned) {
        for (at, depth, colour) in shaded(bench, &draw, [width, height])? {
            if depth < nearest[at] {
                nearest[at] = depth;
                whole.pixels[at] = colour;
                whole.covered[at] = true;
            }
        }
    }
    Ok(whole)
}

/// Whether [`exact`] has something to find: whether any material can be drawn by a search along the view ray.
///
/// # Errors
/// Why none can.
pub fn has_first_hits(scene: &Scene) -> Result<(), String> {
    searched(scene).map(drop)
}

/// The scene drawn by any search that reads the heights themselves: its draws hold what the reference needs.
fn searched(scene: &Scene) -> Result<Scene, String> {
    let mut scene = scene.clone();
    scene.pin_technique(TechniquePin::ParallaxOcclusion)?;
    Ok(scene)
}

/// The pixels of one object: place, depth and colour. Those that its alpha test cuts out are not among them.
fn shaded(bench: &Bench<'_>, draw: &Draw, size: [u32; 2]) -> Result<Vec<(usize, f32, [f64; 3])>, String> {
    let stage = Stage::FragmentCapture;
    let rig = Rig::new(bench, draw, &uncut(&draw.features), &[stage])?;
    let targets = vec![RenderTarget::floats(Clear::Sentinel); Interpolants::TARGETS];
    let one = rig.with(stage, Blend::Replace, Depth::TestAndWrite)?;
    let mut capture = job(&draw.object, size, targets, vec![vec![one]]);
    capture.read_depth = true;
    let output = capture.run(bench.device).map_err(|error| with_causes(&error))?;
    let polygon = output.depth.ok_or("the depth was asked for")?;
    let covered: Vec<usize> = (0_usize..)
        .zip(output.targets[0].covered())
        .filter_map(|(at, covered)| covered.then_some(at))
        .collect();
    let materials: Vec<Material> = passes(draw)
        .into_iter()
        .map(|pass| at_first_hit(draw, pass))
        .collect();
    let (viewer, lights, form) = truth::view(draw);
    let pixel = |at: usize| {
        let point = Interpolants::captured(&output.targets, at).exact();
        // The second of two passes is multiplied into the first.
        let mut colour = [1.0; 3];
        for material in &materials {
            match shade(material, &lights, &viewer, &point, form) {
                Fragment::Color(seen) => {
                    colour = std::array::from_fn(|channel| colour[channel] * seen.to_array()[channel]);
                }
                Fragment::Discarded => return None,
            }
        }
        // Where the relief has a depth of its own, that of the first hit counts.
        let first = materials
            .first()
            .and_then(|material| depth(material, &viewer, &point, form));
        Some((at, first.map_or(polygon[at], |depth| depth as f32), colour))
    };
    Ok(covered.into_par_iter().filter_map(pixel).collect())
}

/// The f64 material with the first hit in place of the search that was pinned.
fn at_first_hit(draw: &Draw, pass: Stage) -> Material {
    let material = truth::material(draw, pass);
    if draw.features.canonical().relief != Feature::ParallaxOcclusion {
        return material;
    }
    let Relief::Search { layer, .. } = material.relief else {
        return material;
    };
    Material {
        relief: first_hit(layer),
        ..material
    }
}

const fn first_hit(layer: Layer) -> Relief {
    Relief::Search {
        search: Search::Exact,
        layer,
    }
}

#[cfg(test)]
mod tests {
    use bossage_embedded::Embedded;
    use bossage_reference::relief_search::Search;
    use bossage_scene::{Scene, TechniquePin};
    use bossage_shaders::Library;

    use super::{Whole, drawn, exact, has_first_hits};
    use crate::bench::Bench;
    use crate::route::Route;

    /// The bundled wall, small, drawn by so many layers; without relief for none.
    fn wall(layers: Option<u32>) -> Scene {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/brick_wall.toml");
        let mut scene = bossage_scene::load(path.as_ref()).unwrap();
        scene.camera.size = [40, 30];
        let pin = match layers {
            Some(_) => TechniquePin::ParallaxOcclusion,
            None => TechniquePin::None,
        };
        scene.pin_technique(pin).unwrap();
        for material in &mut scene.materials {
            material.search = layers.map(|layers| Search::ParallaxOcclusion { layers });
        }
        scene
    }

    fn mean_difference(a: &Whole, b: &Whole) -> f64 {
        assert_eq!((a.width, a.height), (b.width, b.height));
        let channels = a.pixels.as_flattened().iter().zip(b.pixels.as_flattened());
        channels.map(|(a, b)| (a - b).abs()).sum::<f64>() / a.pixels.len() as f64
    }

    /// The finer the march, the nearer its picture comes to the truth; and a wall without relief is far from it.
    #[test]
    fn a_finer_march_comes_nearer_to_the_truth() {
        let (machine, library) = (Embedded::new(), Library::embedded().unwrap());
        let bench = Bench::new(&machine, Route::Embedded, &library);
        let truth = exact(&bench, &wall(Some(8))).unwrap();
        assert_eq!(
            truth,
            exact(&bench, &wall(None)).unwrap(),
            "whatever the scene pins"
        );
        let off = |layers| mean_difference(&drawn(&bench, &wall(layers)).unwrap(), &truth);
        let (none, coarse, fine) = (off(None), off(Some(8)), off(Some(256)));
        assert!(none > 2.0 * fine && coarse > fine, "{none} {coarse} {fine}");
        assert!(fine < 0.01, "{fine}");
    }

    #[test]
    fn both_see_the_surface_at_the_same_pixels() {
        let (machine, library) = (Embedded::new(), Library::embedded().unwrap());
        let bench = Bench::new(&machine, Route::Embedded, &library);
        let (ours, truth) = (
            drawn(&bench, &wall(Some(8))).unwrap(),
            exact(&bench, &wall(Some(8))).unwrap(),
        );
        assert_eq!(ours.covered, truth.covered);
        assert!(truth.covered.iter().any(|covered| *covered));
    }

    #[test]
    fn a_scene_without_relief_has_no_first_hit() {
        let (machine, library) = (Embedded::new(), Library::embedded().unwrap());
        let bench = Bench::new(&machine, Route::Embedded, &library);
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/dot3_cube.toml");
        let scene = bossage_scene::load(path.as_ref()).unwrap();
        let why = exact(&bench, &scene).unwrap_err();
        assert!(why.contains("no material has a height map"), "{why}");
        assert_eq!(has_first_hits(&scene), Err(why));
        assert_eq!(has_first_hits(&wall(None)), Ok(()));
    }
}
