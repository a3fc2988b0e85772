//! What techniques make of a scene's picture: the colour error and FLIP of every point of its camera, and pairs of pictures for the report.
//!
//! Every material that can have the technique is drawn by it, with the point's settings, by the emitted shaders of the whole surface. Truth is
//! [`whole::exact`]: the same pixels, shaded in f64 at the first hit of their view rays.

use std::collections::BTreeMap;

use bossage_conformance::bench::Bench;
use bossage_conformance::suite::scene::whole::{self, Whole};
use bossage_reference::relief_search::Search;
use bossage_reference::srgb;
use bossage_scene::{Scene, TechniquePin};
use image::{Rgb, RgbImage};

use crate::error::Error;
use crate::flip::{PIXELS_PER_DEGREE, flip};
use crate::record::{Point, SceneError, Spread, Study};
use crate::report::{Pair, Shot};
use crate::sweep::ladder;
use crate::sweep::statistics::spread;

/// A scene of a study.
#[derive(Clone, Debug)]
pub struct Pictured {
    /// What [`SceneError::scene`] calls it.
    pub name: String,
    /// The scene.
    pub scene: Scene,
}

impl Pictured {
    /// The same in a size for a page, its proportions kept.
    #[must_use]
    pub fn at_most(mut self, width: u32) -> Self {
        let [columns, rows] = self.scene.camera.size;
        if columns > width {
            self.scene.camera.size = [width, (rows * width).div_ceil(columns).max(1)];
        }
        self
    }
}

/// Fills the colour errors of the study's points of these scenes. The pairs are one a scene and technique, with the settings of a quick study
/// where those were measured.
///
/// # Errors
/// What the library, the translator or the machine says.
pub fn compare(
    scenes: &[Pictured],
    study: &mut Study,
    bench: &Bench<'_>,
    watch: &mut dyn FnMut(&str),
) -> Result<Vec<Pair>, Error> {
    let mut pairs = Vec::new();
    for pictured in scenes {
        if let Err(why) = whole::has_first_hits(&pictured.scene) {
            let points = study.points.iter_mut();
            for (_, error) in points.filter_map(|point| of_scene(point, &pictured.name)) {
                error.not_drawn = Some(why.clone());
            }
            continue;
        }
        let truth = whole::exact(bench, &pictured.scene).map_err(Error::Shader)?;
        let truth = Shown::new(&truth, TRUTH);
        let mut shown: BTreeMap<String, Pair> = BTreeMap::new();
        let mut judged: BTreeMap<(String, String), Judged> = BTreeMap::new();
        let points = study.points.iter_mut();
        for (point, error) in points.filter_map(|point| of_scene(point, &pictured.name)) {
            let key = (point.technique.clone(), point.settings.clone());
            if !judged.contains_key(&key) {
                watch(&format!("{}, {} {}", pictured.name, key.0, key.1));
                let (found, test) = judge(pictured, &truth, &point, bench)?;
                if let Some(test) = test
                    && (point.is_usual || !shown.contains_key(&key.0))
                {
                    shown.insert(key.0.clone(), pair(pictured, &truth, test, &point));
                }
                judged.insert(key.clone(), found);
            }
            judged[&key].write(error);
        }
        pairs.extend(shown.into_values());
    }
    Ok(pairs)
}

/// What truth is called.
const TRUTH: &str = "the first hit in f64";

/// What a point is of.
struct Drawing {
    technique: String,
    settings: String,
    search: Option<Search>,
    /// Whether a quick study has these settings.
    is_usual: bool,
    rerun: String,
}

/// A point of that scene's camera, with the error that is to be filled.
fn of_scene<'a>(point: &'a mut Point, name: &str) -> Option<(Drawing, &'a mut SceneError)> {
    let chosen = ladder::find_settings(&point.technique, &point.settings);
    let drawing = Drawing {
        technique: point.technique.clone(),
        settings: point.settings.to_string(),
        search: chosen.as_ref().and_then(ladder::Chosen::search),
        is_usual: chosen.is_some_and(|chosen| ladder::default_choice(true).contains(&chosen)),
        rerun: point.rerun.clone(),
    };
    let error = point.scene.as_mut().filter(|error| error.scene == name)?;
    Some((drawing, error))
}

/// A picture with what is said of it.
struct Shown<'a> {
    whole: &'a Whole,
    shot: Shot,
}

impl<'a> Shown<'a> {
    fn new(whole: &'a Whole, label: &str) -> Self {
        let image = RgbImage::from_fn(whole.width, whole.height, |x, y| {
            Rgb(whole.pixels[(y * whole.width + x) as usize].map(srgb::encode_byte))
        });
        let label = label.to_owned();
        Self {
            whole,
            shot: Shot { label, image },
        }
    }
}

/// What a technique's picture is like.
enum Judged {
    Drawn { colour: Spread, flip: f64 },
    Not(String),
}

impl Judged {
    fn write(&self, error: &mut SceneError) {
        match self {
            Self::Drawn { colour, flip } => {
                error.colour = Some(*colour);
                error.flip = Some(*flip);
                error.not_drawn = None;
            }
            Self::Not(why) => error.not_drawn = Some(why.clone()),
        }
    }
}

fn judge(
    pictured: &Pictured,
    truth: &Shown<'_>,
    drawing: &Drawing,
    bench: &Bench<'_>,
) -> Result<(Judged, Option<Shot>), Error> {
    let scene = match pinned(&pictured.scene, drawing) {
        Ok(scene) => scene,
        Err(why) => return Ok((Judged::Not(why), None)),
    };
    let picture = whole::drawn(bench, &scene).map_err(Error::Shader)?;
    let wrong = picture
        .pixels
        .as_flattened()
        .iter()
        .filter(|value| !value.is_finite());
    let wrong = wrong.count();
    if wrong > 0 {
        let why = format!("its picture has {wrong} values that are no numbers");
        return Ok((Judged::Not(why), None));
    }
    let label = format!("{} {}", drawing.technique, drawing.settings);
    let shown = Shown::new(&picture, label.trim_end());
    let difference = flip(&truth.shot.image, &shown.shot.image, PIXELS_PER_DEGREE)
        .map_err(|error| Error::Shader(format!("{}: {error}", pictured.name)))?;
    let judged = Judged::Drawn {
        colour: colour_error(truth.whole, &picture),
        flip: difference.mean,
    };
    Ok((judged, Some(shown.shot)))
}

/// The scene with that technique and those settings in every material that can have it, or why there is none.
fn pinned(scene: &Scene, drawing: &Drawing) -> Result<Scene, String> {
    let name = &drawing.technique;
    let known = TechniquePin::NAMES.iter().find(|(known, _)| known == name);
    let (Some((_, pin)), Some(search)) = (known, drawing.search) else {
        return Err(format!("the surface cannot draw {name}"));
    };
    let mut scene = scene.clone();
    scene.pin_technique(*pin)?;
    for material in scene
        .materials
        .iter_mut()
        .filter(|material| material.technique == *pin)
    {
        material.search = Some(search);
    }
    Ok(scene)
}

/// Over the pixels where either shows a surface.
fn colour_error(truth: &Whole, picture: &Whole) -> Spread {
    let covered = truth.covered.iter().zip(&picture.covered);
    let both = truth.pixels.iter().zip(&picture.pixels).zip(covered);
    let seen = both.filter(|(_, (a, b))| **a || **b);
    let farthest = |(a, b): (&[f64; 3], &[f64; 3])| {
        let channels = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        channels.fold(0.0, f64::max)
    };
    spread(&mut seen.map(|(pixel, _)| farthest(pixel)).collect::<Vec<f64>>())
}

fn pair(pictured: &Pictured, truth: &Shown<'_>, test: Shot, drawing: &Drawing) -> Pair {
    Pair {
        name: format!("{}-{}", pictured.name, drawing.technique),
        title: format!("{}: {} against {TRUTH}", pictured.name, test.label),
        reference: truth.shot.clone(),
        test,
        rerun: drawing.rerun.clone(),
    }
}

#[cfg(test)]
mod tests {
    use bossage_conformance::Route;
    use bossage_conformance::bench::Bench;
    use bossage_embedded::Embedded;
    use bossage_shaders::Library;

    use super::{Pictured, compare};
    use crate::record::{Point, SceneError, Settings, Study};

    fn wall() -> Pictured {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/brick_wall.toml");
        let pictured = Pictured {
            name: "brick_wall".to_owned(),
            scene: bossage_scene::load(path.as_ref()).unwrap(),
        };
        pictured.at_most(40)
    }

    #[test]
    fn a_scene_that_no_search_can_draw_says_so() {
        let (machine, library) = (Embedded::new(), Library::embedded().unwrap());
        let bench = Bench::new(&machine, Route::Embedded, &library);
        let mut wall = wall();
        wall.scene.materials[0].height = None;
        let mut study = Study {
            points: vec![point("parallax_offset", Settings::default(), Some("brick_wall"))],
            ..Study::default()
        };
        let pairs = compare(&[wall], &mut study, &bench, &mut |_| ()).unwrap();
        assert!(pairs.is_empty());
        let why = study.points[0].scene.clone().unwrap().not_drawn.unwrap();
        assert!(why.contains("no material has a height map"), "{why}");
    }

    fn point(technique: &str, settings: Settings, scene: Option<&str>) -> Point {
        Point {
            technique: technique.to_owned(),
            settings,
            scene: scene.map(|scene| SceneError {
                scene: scene.to_owned(),
                ..SceneError::default()
            }),
            ..Point::default()
        }
    }

    fn layers(layers: f64) -> Settings {
        Settings::of([("layers", layers)])
    }

    #[test]
    fn every_point_of_a_scene_has_its_colours_or_says_why_not() {
        let (machine, library) = (Embedded::new(), Library::embedded().unwrap());
        let bench = Bench::new(&machine, Route::Embedded, &library);
        let here = Some("brick_wall");
        let mut study = Study {
            points: vec![
                point("parallax_occlusion", layers(8.0), here),
                point("parallax_occlusion", layers(256.0), here),
                point("parallax_occlusion", layers(16.0), here),
                point("user:mine", Settings::default(), here),
                point("parallax_occlusion", layers(8.0), Some("another")),
                point("parallax_occlusion", layers(8.0), None),
            ],
            ..Study::default()
        };
        let mut told = 0;
        let pairs = compare(&[wall()], &mut study, &bench, &mut |_| told += 1).unwrap();
        let error = |at: usize| study.points[at].scene.clone().unwrap();
        let flip = |at: usize| error(at).flip.unwrap();
        assert!(flip(0) > flip(1) && flip(1) > 0.0, "{} {}", flip(0), flip(1));
        let colour = |at: usize| error(at).colour.unwrap();
        assert!(colour(0).mean > colour(1).mean && colour(0).max <= 2.0);
        assert_eq!(error(0).not_drawn, None);
        assert_eq!(
            error(3).not_drawn.as_deref(),
            Some("the surface cannot draw user:mine")
        );
        assert!(error(3).colour.is_none() && error(3).flip.is_none());
        assert!(error(4).flip.is_none(), "it is of another scene");
        assert_eq!(told, 4);
        // The settings of a quick study are shown, although others came before and after.
        let titles: Vec<&str> = pairs.iter().map(|pair| pair.title.as_str()).collect();
        assert_eq!(
            titles,
            ["brick_wall: parallax_occlusion layers=16 against the first hit in f64"]
        );
        assert_eq!(pairs[0].reference.image.dimensions(), (40, 30));
    }
}
