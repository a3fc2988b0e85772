//! What goes with what: the combinations of pinned techniques, maps, lights and alpha that can be honoured.
//!
//! Each technique of the founding articles goes with what its article has beside it (see `bossage_shaders`' canonical sets). A
//! scene that asks for another combination is wrong, and is told so at the field that asks.

use bossage_shaders::{Form, Relief, Shading};
use glam::DVec3;

use crate::fields::Table;
use crate::model::{AlphaMode, Light, Material, ReflectionPin, Scene, Shadow, TechniquePin};

/// What a material is seen by.
pub(crate) struct Surroundings<'a> {
    pub(crate) lights: &'a [Light],
    pub(crate) ambient: DVec3,
    pub(crate) has_environment: bool,
}

/// What cannot be honoured: the material's key that asks for it, why, and what to do.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Refusal {
    key: &'static str,
    message: String,
    hint: String,
}

impl Refusal {
    fn new(key: &'static str, message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self {
            key,
            message: message.into(),
            hint: hint.into(),
        }
    }
}

/// Notes what is wrong with any material, at its place in the file.
pub(crate) fn check(root: &Table<'_>, materials: &[Material], surroundings: &Surroundings<'_>) {
    let tables = root
        .get("materials")
        .and_then(|list| list.items())
        .unwrap_or_default();
    for (material, value) in materials.iter().zip(tables) {
        let Some(table) = value.table() else { continue };
        let at = |key: &str| table.path_of(key);
        let refusals = [
            relief(material, &at),
            shading(material, &at),
            shadow(material, &at),
            pixel_depth(material, &at),
            lights(material, surroundings),
            reflection(material, surroundings),
        ];
        for refusal in refusals.into_iter().flatten() {
            match table.get(refusal.key) {
                Some(place) => place.note(refusal.message, refusal.hint),
                None => table.note(refusal.message, refusal.hint),
            }
        }
    }
    if let (Some(material), Some(place)) = (tinted_ambient(materials, surroundings), root.get("ambient")) {
        place.note(
            format!(
                "`wrap_lambert` (material `{}`) has one ambient value for all channels",
                material.name
            ),
            "give `ambient` three equal numbers",
        );
    }
}

/// A key as messages call it.
type Field<'a> = &'a dyn Fn(&str) -> String;

/// Why a material cannot have its pinned relief technique.
fn relief(material: &Material, at: Field<'_>) -> Option<Refusal> {
    let technique = material.technique;
    let no = |message: String, hint: String| Some(Refusal::new("technique", message, hint));
    let word = technique.as_str();
    let wanted = technique.relief().filter(|relief| *relief != Relief::None)?;
    let (albedo, normal, height) = (at("albedo.map"), at("normal"), at("height"));
    if material.height.is_none() {
        return no(
            format!("`{word}` needs `{height}`"),
            format!("add `{height}` with a map, or set technique to `auto`"),
        );
    }
    if (wanted.is_offset() || wanted.is_search())
        && material.albedo.map.is_none()
        && material.normal.is_none()
    {
        return no(
            format!("`{word}` has nothing to displace: there is neither `{albedo}` nor `{normal}`"),
            format!("add `{albedo}` or `{normal}`, or set technique to `auto`"),
        );
    }
    if wanted.is_slope() && material.normal.is_none() {
        return no(
            format!("`{word}` reads slopes from `{normal}`, which is missing"),
            format!("add `{normal}` with a map, or `bake` one from the heights"),
        );
    }
    if !goes_with(material.shading, wanted) {
        return no(
            format!(
                "`{word}` does not go with shading `{}`",
                material.shading.as_str()
            ),
            reliefs_of(material.shading).to_owned(),
        );
    }
    if wanted.is_search() && material.form == Form::Published {
        return no(
            format!("`{word}` has one form"),
            "set form to `hardened`, or technique to another".to_owned(),
        );
    }
    if technique == TechniquePin::ParallaxSlopeAoDirected && material.form == Form::Published {
        return no(
            format!("`{word}` is the cure of a published technique and has no published form"),
            "set form to `hardened`, or technique to `parallax_slope_ao`".to_owned(),
        );
    }
    None
}

/// Why a material cannot have shadows although it asks for them.
fn shadow(material: &Material, at: Field<'_>) -> Option<Refusal> {
    let words = PlaceWords {
        key: "shadow",
        off: "shadow to `none`",
        heights: "shadows are those of the heights",
        shading: "shadows do not go",
        place: "for a shadow to fall on",
    };
    (material.shadow != Shadow::None)
        .then(|| without_place(material, at, &words))
        .flatten()
}

/// Why a material cannot have the depth of its relief although it asks for it.
fn pixel_depth(material: &Material, at: Field<'_>) -> Option<Refusal> {
    let words = PlaceWords {
        key: "pixel_depth",
        off: "pixel_depth to false",
        heights: "the depth would be that of the heights",
        shading: "the depth of a relief does not go",
        place: "whose depth it would be",
    };
    material
        .pixel_depth
        .then(|| without_place(material, at, &words))
        .flatten()
}

/// What is said of an effect that shows the place on the relief that a search found.
struct PlaceWords {
    key: &'static str,
    /// How to go without it, after "set".
    off: &'static str,
    heights: &'static str,
    shading: &'static str,
    place: &'static str,
}

/// Why a material has no place on its relief that such an effect could show.
fn without_place(material: &Material, at: Field<'_>, words: &PlaceWords) -> Option<Refusal> {
    let PlaceWords {
        key,
        off,
        heights,
        shading,
        place,
    } = words;
    let height = at("height");
    let no = |message: String, hint: String| Some(Refusal::new(key, message, hint));
    let pinned = material.technique.relief();
    if material.height.is_none() {
        no(
            format!("{heights}, and there is no `{height}`"),
            format!("add `{height}` with a map, or set {off}"),
        )
    } else if material.shading != Shading::BlinnPhong {
        no(
            format!("{shading} with shading `{}`", material.shading.as_str()),
            format!("set shading to `blinn_phong`, or {off}"),
        )
    } else if pinned.is_some_and(|relief| !relief.is_search()) {
        let technique = material.technique.as_str();
        no(
            format!("technique `{technique}` finds no place on the relief {place}"),
            format!("set technique to a search such as `relief`, or {off}"),
        )
    } else {
        None
    }
}

fn goes_with(shading: Shading, relief: Relief) -> bool {
    match shading {
        Shading::BlinnPhong => true,
        Shading::WrapLambert => !relief.is_offset() && !relief.is_search(),
        Shading::Emboss | Shading::Dot3SinglePass | Shading::Dot3TwoPass => relief == Relief::None,
    }
}

fn reliefs_of(shading: Shading) -> &'static str {
    match shading {
        Shading::BlinnPhong => "it goes with every technique",
        Shading::WrapLambert => {
            "it goes with `parallax_slope_ao`, `parallax_slope_ao_directed`, `displacement` and `none`; or set shading to `blinn_phong`"
        }
        Shading::Emboss => {
            "embossing stands in for relief: set technique to `none`, or shading to `blinn_phong`"
        }
        Shading::Dot3SinglePass | Shading::Dot3TwoPass => {
            "it shifts no texture: set technique to `none`, or shading to `blinn_phong`"
        }
    }
}

/// Why a material cannot have its shading, by its own maps and alpha.
fn shading(material: &Material, at: Field<'_>) -> Option<Refusal> {
    let word = material.shading.as_str();
    let missing = |key: &str| {
        let field = at(key);
        let hint = format!("add `{field}` with a map, or set shading to `blinn_phong`");
        Some(Refusal::new("shading", format!("`{word}` needs `{field}`"), hint))
    };
    match material.shading {
        Shading::BlinnPhong => None,
        Shading::Emboss if material.height.is_none() => missing("height"),
        Shading::Dot3SinglePass | Shading::Dot3TwoPass if material.normal.is_none() => missing("normal"),
        Shading::Emboss | Shading::Dot3SinglePass => None,
        Shading::Dot3TwoPass => match material.alpha {
            AlphaMode::Opaque => None,
            AlphaMode::Mask { .. } => Some(Refusal::new(
                "alpha",
                "`dot3_two_pass` cannot cut out: its first pass has lit the target before the second reads any alpha",
                "set alpha.mode to `opaque`, or shading to `dot3_single_pass`",
            )),
        },
        Shading::WrapLambert => match material.alpha {
            AlphaMode::Mask { cutoff } if cutoff == crate::schema::WRAP_ALPHA_CUTOFF => None,
            AlphaMode::Mask { .. } | AlphaMode::Opaque => Some(Refusal::new(
                "alpha",
                "`wrap_lambert` cuts out where alpha is below 0.01, and nowhere else",
                "leave `alpha` out, or write { mode = \"mask\", cutoff = 0.01 }",
            )),
        },
    }
}

/// Why the scene's lights do not go with a material's shading.
fn lights(material: &Material, surroundings: &Surroundings<'_>) -> Option<Refusal> {
    let active = surroundings
        .lights
        .iter()
        .filter(|light| !light.is_black())
        .count();
    if material.shading == Shading::BlinnPhong || active == 1 {
        return None;
    }
    Some(Refusal::new(
        "shading",
        format!(
            "`{}` has exactly one light, and this scene has {active} that are not black",
            material.shading.as_str()
        ),
        "leave one light in the scene, or set shading to `blinn_phong`",
    ))
}

/// Why a material cannot mirror the environment although it is told to.
fn reflection(material: &Material, surroundings: &Surroundings<'_>) -> Option<Refusal> {
    if material.reflection != ReflectionPin::EnvironmentBump {
        return None;
    }
    let no = |message: String, hint: &str| Some(Refusal::new("reflection", message, hint));
    if !surroundings.has_environment {
        no(
            "`environment_bump` needs a cube map, and the scene has no `[environment]`".to_owned(),
            "add `[environment]` with six `faces`, or set reflection to `auto`",
        )
    } else if material.specular.as_vec3() == glam::Vec3::ZERO {
        no(
            "`environment_bump` mirrors by `specular`, which is 0".to_owned(),
            "give `specular` a colour, or set reflection to `auto`",
        )
    } else if material.shading != Shading::BlinnPhong {
        no(
            format!(
                "`environment_bump` does not go with shading `{}`",
                material.shading.as_str()
            ),
            "set shading to `blinn_phong`, or reflection to `auto`",
        )
    } else if material.technique.relief().is_some_and(Relief::is_slope) {
        no(
            format!(
                "`environment_bump` does not go with technique `{}`",
                material.technique.as_str()
            ),
            "set technique to another, or reflection to `auto`",
        )
    } else {
        None
    }
}

fn tinted_ambient<'a>(materials: &'a [Material], surroundings: &Surroundings<'_>) -> Option<&'a Material> {
    let grey = surroundings.ambient == DVec3::splat(surroundings.ambient.x);
    let wraps = |material: &&Material| material.shading == Shading::WrapLambert;
    materials.iter().find(wraps).filter(|_| !grey)
}

impl Scene {
    /// Pins one relief technique for every material that can have it, as `--technique` does on the command line. Other
    /// materials are left alone.
    ///
    /// # Errors
    /// When no material can have it: why not, for the first that has a height map, or else that none has.
    pub fn pin_technique(&mut self, technique: TechniquePin) -> Result<(), String> {
        let mut refused = None;
        let mut pinned = false;
        for material in self
            .materials
            .iter_mut()
            .filter(|material| material.height.is_some())
        {
            let before = std::mem::replace(&mut material.technique, technique);
            match relief(material, &str::to_owned) {
                None => pinned = true,
                Some(refusal) => {
                    material.technique = before;
                    refused.get_or_insert_with(|| {
                        format!(
                            "material `{}`: {}; {}",
                            material.name, refusal.message, refusal.hint
                        )
                    });
                }
            }
        }
        let none = || {
            format!(
                "no material has a height map, so technique `{}` has nothing to work on",
                technique.as_str()
            )
        };
        if pinned {
            Ok(())
        } else {
            Err(refused.unwrap_or_else(none))
        }
    }
}
