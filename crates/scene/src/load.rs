//! From a TOML file to a checked [`Scene`]: the whole file is read and every problem reported, not only the first.
//!
//! Sections are read independently, so that a mistake in one does not hide mistakes in another. Only when nothing at all is
//! wrong is a scene built.

use std::collections::BTreeMap;
use std::path::Path;

use glam::DVec3;
use toml::de::DeTable;

use crate::error::{Error, Report};
use crate::fields::{ANY, Bound, NOT_NEGATIVE, POSITIVE, Sink, Table, Value};
use crate::files::Files;
use crate::model::{Camera, Light, LightKind, Scene};
use crate::schema;
use crate::settings::Setting;
use crate::sheet::Sheet;
use crate::{load_budget, load_environment, load_material, load_object, rules};

const FOV: Bound = Bound {
    allows: |x| x > 0.0 && x < 180.0,
    words: "in (0, 180) degrees",
};

/// Reads a scene and every file it names.
///
/// # Errors
/// When the file cannot be read, or anything in it or in a file it names is wrong; all problems are in the error.
pub fn load(path: &Path) -> Result<Scene, Error> {
    load_with(path, &[])
}

/// Reads a scene with some keys of all its materials set to other values than the file's.
///
/// # Errors
/// As [`load`]; what is wrong with a setting is shown in the setting.
pub fn load_with(path: &Path, settings: &[Setting]) -> Result<Scene, Error> {
    let text = read_text("scene file", path, schema::MAX_SCENE_BYTES)?;
    load_text(path, &text, settings)
}

/// The text of a file of some kind that is not larger than any of its kind.
pub(crate) fn read_text(what: &'static str, path: &Path, most: u64) -> Result<String, Error> {
    let path_of = || path.to_owned();
    let read = |source| Error::Read {
        what,
        path: path_of(),
        source,
    };
    let bytes = std::fs::metadata(path).map_err(read)?.len();
    if bytes > most {
        return Err(Error::TooLarge {
            what,
            path: path_of(),
            bytes,
            most,
        });
    }
    std::fs::read_to_string(path).map_err(read)
}

/// Reads a scene from its text; `path` names it in messages, and its folder is where files are looked for.
///
/// # Errors
/// As [`load`], but for reading the scene file.
pub fn load_str(path: impl AsRef<Path>, text: &str) -> Result<Scene, Error> {
    load_text(path.as_ref(), text, &[])
}

fn load_text(path: &Path, text: &str, settings: &[Setting]) -> Result<Scene, Error> {
    let (mut document, syntax) = DeTable::parse_recoverable(text);
    let sheet = Sheet::new(text, settings);
    for (setting, start) in settings.iter().zip(sheet.starts()) {
        setting.apply(document.get_mut(), start);
    }
    let sink = Sink::new(&sheet);
    sink.note_syntax(&syntax);
    // A text that is not TOML recovers into fragments: judging those would bury the real mistake.
    let scene = if syntax.is_empty() {
        scene(path, &Table::root(&document, "a scene", &sink))
    } else {
        None
    };
    match (sink.into_report(path, text), scene) {
        (Some(report), _) => Err(Error::Invalid(report)),
        (None, Some(scene)) => Ok(scene),
        (None, None) => Err(Error::Invalid(Box::new(Report::unexplained(path, text)))),
    }
}

fn scene(path: &Path, root: &Table<'_>) -> Option<Scene> {
    let files = Files::new(path);
    let version = root
        .need("schema", "`schema = 1` as the first line")
        .and_then(|value| value.version(schema::SCHEMA));
    let camera = root
        .need("camera", "a `[camera]` section")
        .and_then(|value| camera(&value));
    let ambient = root.or("ambient", schema::AMBIENT, |value| value.vec3(NOT_NEGATIVE));
    let budget = load_budget::budget(root, &files);
    let lights = lights(root);
    let environment = root.or("environment", None, |value| {
        load_environment::environment(value, &files).map(Some)
    });
    let materials = named_list(root, "materials", |table| load_material::material(table, &files));
    let objects = load_object::objects(root, materials.as_deref(), &files);
    if let (Some(materials), Some(lights), Some(ambient)) = (&materials, &lights, ambient) {
        let surroundings = rules::Surroundings {
            lights,
            ambient,
            has_environment: root.get("environment").is_some(),
        };
        rules::check(root, materials, &surroundings);
    }
    root.finish();
    let (materials, objects) = (materials?, objects?);
    version?;
    Some(Scene {
        path: path.to_owned(),
        camera: camera?,
        ambient: ambient?,
        lights: lights?,
        environment: environment?,
        materials,
        objects,
        budget: budget?,
    })
}

fn camera(value: &Value<'_>) -> Option<Camera> {
    let table = value.table()?;
    let position = table
        .need("position", "`position = [x, y, z]`")
        .and_then(|v| v.vec3(ANY));
    let target = table
        .need("target", "`target = [x, y, z]`")
        .and_then(|v| v.vec3(ANY));
    let up = table.or("up", schema::UP, |v| v.vec3(ANY));
    let fov_deg = table
        .need("fov_deg", "`fov_deg`, the vertical field of view")
        .and_then(|v| v.number(FOV));
    let near = table
        .need("near", "`near`, the distance of the near plane")
        .and_then(|v| v.number(POSITIVE));
    let far = table
        .need("far", "`far`, the distance of the far plane")
        .and_then(|v| v.number(POSITIVE));
    let size = table
        .need("size", "`size = [width, height]` in pixels")
        .and_then(|v| size(&v));
    table.finish();
    let (position, target, up) = (position?, target?, up?);
    let (near, far) = (near?, far?);
    let looks = check_direction(&table, position, target, up);
    if near >= far {
        let place = table.get("near")?;
        place.note(
            format!("near ({near}) is not less than far ({far})"),
            "make `near` smaller or `far` larger",
        );
        return None;
    }
    looks.then_some(())?;
    Some(Camera {
        position,
        target,
        up,
        fov_deg: fov_deg?,
        near,
        far,
        size: size?,
    })
}

/// Whether there is a viewing direction, and an up that is not along it.
fn check_direction(table: &Table<'_>, position: DVec3, target: DVec3, up: DVec3) -> bool {
    let forward = target - position;
    // Both are written as decimals; a direction that f32 cannot tell from another is as bad as an equal one.
    let usable = |v: DVec3| v.length() > f64::from(f32::MIN_POSITIVE);
    let place = |key| table.get(key);
    if !usable(forward) {
        if let Some(value) = place("target") {
            value.note(
                "the target is the camera's own position",
                "move `target` to a point that the camera looks at",
            );
        }
        return false;
    }
    let sine = up.normalize_or_zero().cross(forward.normalize()).length();
    if !usable(up) || sine < f64::from(f32::EPSILON) {
        let hint = "choose an `up` that is not 0 and not along the line from `position` to `target`";
        match place("up") {
            Some(value) => value.note("up is parallel to the viewing direction, or 0", hint),
            None => table.note(
                "the default up, [0, 1, 0], is parallel to the viewing direction",
                "add an `up`",
            ),
        }
        return false;
    }
    true
}

fn size(value: &Value<'_>) -> Option<[u32; 2]> {
    let items = value.items()?;
    let [width, height] = items.as_slice() else {
        value.note(
            format!("expected 2 numbers, found {}", items.len()),
            "write `size = [width, height]`",
        );
        return None;
    };
    let side = 1..=schema::MAX_CAMERA_SIDE;
    let (width, height) = (width.whole(side.clone()), height.whole(side));
    Some([width?, height?])
}

fn lights(root: &Table<'_>) -> Option<Vec<Light>> {
    let lights = named_list(root, "lights", light);
    if let (Some(place), Some(lights)) = (root.get("lights"), &lights)
        && lights.len() > schema::MAX_LIGHTS
    {
        let message = format!(
            "{} lights; the shader's array holds {}",
            lights.len(),
            schema::MAX_LIGHTS
        );
        place.note(message, "remove the least important lights");
    }
    lights
}

fn light(table: &Table<'_>) -> Option<Light> {
    let name = table
        .need("name", "`name`, unique among lights")
        .and_then(|v| v.name());
    let kinds = [("directional", true), ("point", false)];
    let kind = table
        .need("kind", "`kind`: `directional` or `point`")
        .and_then(|v| v.word(&kinds));
    let kind = kind.and_then(|directional| {
        if directional {
            directional_kind(table)
        } else {
            point_kind(table)
        }
    });
    let color = table.or("color", schema::LIGHT_COLOR, |v| v.vec3(NOT_NEGATIVE));
    let intensity = table.or("intensity", schema::INTENSITY, |v| v.number(NOT_NEGATIVE));
    // Only one of these belongs here, and the other is named in its own message rather than as unknown.
    let _ = (table.get("direction"), table.get("position"));
    table.finish();
    let light = Light {
        name: name?.to_owned(),
        kind: kind?,
        color: color?,
        intensity: intensity?,
    };
    if !light.radiance().as_vec3().is_finite() {
        table.note(
            "color times intensity is too large for a 32-bit float",
            "lower `intensity`",
        );
    }
    Some(light)
}

fn directional_kind(table: &Table<'_>) -> Option<LightKind> {
    refuse(
        table,
        "position",
        "a directional light has no position",
        "remove it, or make the light `kind = \"point\"`",
    );
    let value = table.need("direction", "`direction = [x, y, z]`, the way the light travels")?;
    let direction = value.vec3(ANY)?.try_normalize();
    if direction.is_none() {
        value.note(
            "a direction of length 0",
            "give the way the light travels, such as [0, -1, 0] for straight down",
        );
    }
    Some(LightKind::Directional {
        direction: direction?,
    })
}

fn point_kind(table: &Table<'_>) -> Option<LightKind> {
    refuse(
        table,
        "direction",
        "a point light has no direction",
        "remove it, or make the light `kind = \"directional\"`",
    );
    let position = table.need("position", "`position = [x, y, z]`")?.vec3(ANY)?;
    Some(LightKind::Point { position })
}

/// Notes a problem if a key is there that does not belong with the others.
pub(crate) fn refuse(table: &Table<'_>, key: &'static str, message: &str, hint: &str) {
    if let Some(value) = table.get(key) {
        value.note(message, hint);
    }
}

/// Reads an array of tables with unique names. None when any of them is wrong.
pub(crate) fn named_list<'t, T: Named>(
    root: &Table<'t>,
    key: &'static str,
    read: impl Fn(&Table<'t>) -> Option<T>,
) -> Option<Vec<T>> {
    let Some(list) = root.get(key) else {
        return Some(Vec::new());
    };
    let items = list.items()?;
    let read: Vec<Option<T>> = items.iter().map(|item| read(&item.table()?)).collect();
    let mut first: BTreeMap<String, String> = BTreeMap::new();
    let mut unique = true;
    for (item, value) in items.iter().zip(&read) {
        let Some(value) = value else { continue };
        if let Some(earlier) = first.insert(value.name().to_owned(), item.field.clone()) {
            let place = item
                .table()
                .and_then(|table| table.get("name"))
                .unwrap_or_else(|| item.clone());
            place.note(
                format!("the name `{}` is already that of `{earlier}`", value.name()),
                "give each a name of its own",
            );
            unique = false;
        }
    }
    let all: Option<Vec<T>> = read.into_iter().collect();
    all.filter(|_| unique)
}

/// What has a name that must be unique.
pub(crate) trait Named {
    /// The name.
    fn name(&self) -> &str;
}

impl Named for Light {
    fn name(&self) -> &str {
        &self.name
    }
}
