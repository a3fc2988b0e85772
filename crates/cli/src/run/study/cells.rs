//! Which maps are seen by which rays.

use std::path::Path;
use std::sync::Arc;

use bossage_assets::EdgeMode;
use bossage_scene::Scene;
use bossage_study::pictures::Pictured;
use bossage_study::sweep::map::Map;
use bossage_study::sweep::{Cell, rays, seen};

use crate::args::bake::EdgeName;
use crate::args::study::{RouteName, Seen, Study};
use crate::bundle::SCENES;
use crate::error::{Error, Result};

/// Angles from the normal, degrees.
const VIEWS_DEG: [f64; 5] = [0.0, 30.0, 60.0, 75.0, 85.0];
/// Those of a quick study.
const QUICK_VIEWS_DEG: [f64; 2] = [30.0, 75.0];
/// Rays at each angle of each map.
const RAYS: u32 = 65_536;
/// Those of a quick study.
const QUICK_RAYS: u32 = 16_384;
/// Width of scenes' pictures at most, pixels: the page holds each as text.
const WIDTH: u32 = 400;
/// Those of a quick study.
const QUICK_WIDTH: u32 = 200;

/// What a study looks at.
pub(super) struct Views {
    /// Every map at every angle; every material of the scenes at every angle and as its camera sees it.
    pub(super) cells: Vec<Cell>,
    /// The scenes, in the size of the page's pictures.
    pub(super) scenes: Vec<Pictured>,
}

pub(super) fn of(args: &Study) -> Result<Views> {
    let usual: &[f64] = if args.measured.quick {
        &QUICK_VIEWS_DEG
    } else {
        &VIEWS_DEG
    };
    let mut views_deg: Vec<f64> = Vec::new();
    for view_deg in if args.seen.view_deg.is_empty() {
        usual
    } else {
        &args.seen.view_deg
    } {
        if !views_deg.contains(view_deg) {
            views_deg.push(*view_deg);
        }
    }
    let mut cells = Vec::new();
    for map in maps(&args.seen)? {
        cells.extend(views_deg.iter().map(|view_deg| from_angle(args, &map, *view_deg)));
    }
    let given = args
        .seen
        .scene
        .iter()
        .map(|path| (path.display().to_string(), views_deg.as_slice()));
    let bundled = SCENES.iter().map(|scene| (scene.name.to_owned(), [].as_slice()));
    let scenes: Vec<(String, &[f64])> = if is_default(&args.seen) {
        bundled.collect()
    } else {
        given.collect()
    };
    let mut pictured = Vec::new();
    for (origin, views_deg) in scenes {
        let scene = load(&origin)?;
        let name = Path::new(&origin).file_stem().unwrap_or_default();
        let name = name.to_string_lossy().into_owned();
        cells.extend(of_scene(args, &scene, &name, &origin, views_deg)?);
        pictured.push(Pictured { name, scene }.at_most(width(args)));
    }
    distinct(&cells)?;
    Ok(Views {
        cells,
        scenes: pictured,
    })
}

/// Whether nothing is asked for: then the bundled maps are seen from the angles, and the bundled scenes, which have the same maps, by their
/// cameras alone.
fn is_default(seen: &Seen) -> bool {
    seen.map.is_empty() && seen.scene.is_empty() && seen.view_deg.is_empty()
}

/// A scene of a file, or a bundled one.
fn load(origin: &str) -> Result<Scene> {
    let path = Path::new(origin);
    match SCENES.iter().find(|scene| scene.name == origin && !path.exists()) {
        Some(bundled) => bundled.load(),
        None => Ok(bossage_scene::load(path)?),
    }
}

fn count(args: &Study) -> u32 {
    args.measured
        .rays
        .unwrap_or(if args.measured.quick { QUICK_RAYS } else { RAYS })
}

fn width(args: &Study) -> u32 {
    if args.measured.quick { QUICK_WIDTH } else { WIDTH }
}

fn from_angle(args: &Study, map: &Arc<Map>, view_deg: f64) -> Cell {
    Cell {
        map: Arc::clone(map),
        view_deg,
        rays: rays::seeded(view_deg, count(args) as usize, args.measured.seed),
        screen: None,
        flags: flags(args, map, Some(view_deg)),
    }
}

/// The materials that have something to study; a scene without any is a mistake.
fn of_scene(args: &Study, scene: &Scene, name: &str, origin: &str, views_deg: &[f64]) -> Result<Vec<Cell>> {
    let materials = seen::materials(scene, name, origin, count(args));
    if materials.is_empty() {
        return Err(Error::Call(format!(
            "{origin}: its camera sees no material with a height map, so there is no relief to study"
        )));
    }
    let mut cells = Vec::new();
    for material in materials {
        cells.extend(
            views_deg
                .iter()
                .map(|view_deg| from_angle(args, &material.map, *view_deg)),
        );
        cells.push(Cell {
            view_deg: material.view_deg,
            rays: material.rays,
            screen: Some(material.screen),
            flags: flags(args, &material.map, views_deg.first().copied()),
            map: material.map,
        });
    }
    Ok(cells)
}

/// Two maps of one name could not be told apart in the report.
fn distinct(cells: &[Cell]) -> Result<()> {
    for (index, cell) in cells.iter().enumerate() {
        let twin = cells[..index]
            .iter()
            .find(|other| other.map.name == cell.map.name && !Arc::ptr_eq(&other.map, &cell.map));
        if let Some(other) = twin {
            return Err(Error::Call(format!(
                "{} and {} would both be called `{}` in the report; rename a file, or name it once",
                other.map.origin, cell.map.origin, cell.map.name
            )));
        }
    }
    Ok(())
}

/// The maps that are asked for; without any, and without a scene, the bundled ones.
fn maps(seen: &Seen) -> Result<Vec<Arc<Map>>> {
    let edge = seen.edge.map(edge_mode);
    let given: Vec<&str> = seen.map.iter().map(String::as_str).collect();
    let origins = if given.is_empty() && seen.scene.is_empty() {
        Map::bundled_names()
    } else {
        given
    };
    let open = |origin| Ok(Arc::new(Map::open(origin, seen.depth, edge)?));
    origins.into_iter().map(open).collect()
}

const fn edge_mode(name: EdgeName) -> EdgeMode {
    match name {
        EdgeName::Wrap => EdgeMode::Wrap,
        EdgeName::Mirror => EdgeMode::Mirror,
        EdgeName::Clamp => EdgeMode::Clamp,
    }
}

const fn edge_word(name: EdgeName) -> &'static str {
    match name {
        EdgeName::Wrap => "wrap",
        EdgeName::Mirror => "mirror",
        EdgeName::Clamp => "clamp",
    }
}

/// What makes a cell's points again. A scene brings its own depth and edges, and its camera's points whatever the angle.
fn flags(args: &Study, map: &Map, view_deg: Option<f64>) -> String {
    let origin = quoted(&map.origin);
    // A scene's maps are called `SCENE/MATERIAL`.
    let is_scene = map.name.contains('/');
    let mut flags = if is_scene {
        format!("--scene {origin}")
    } else {
        format!("--map {origin} --depth {}", args.seen.depth)
    };
    if let Some(edge) = args.seen.edge.filter(|_| !is_scene) {
        flags.push_str(&format!(" --edge {}", edge_word(edge)));
    }
    if let Some(view_deg) = view_deg {
        flags.push_str(&format!(" --view-deg {view_deg}"));
    }
    flags.push_str(&format!(" --rays {} --seed {}", count(args), args.measured.seed));
    if args.measured.route == RouteName::Wgsl {
        flags.push_str(" --route wgsl");
    }
    if let Some(adapter) = &args.measured.adapter {
        flags.push_str(&format!(" --adapter {}", quoted(adapter)));
    }
    format!("{flags} -o DIR")
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./:=,".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn words_survive_a_shell() {
        assert_eq!(quoted("examples/a.png"), "examples/a.png");
        assert_eq!(quoted("a b"), "'a b'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
        assert_eq!(quoted(""), "''");
    }
}
