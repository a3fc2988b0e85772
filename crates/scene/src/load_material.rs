//! Materials of a scene file.

use std::path::PathBuf;
use std::sync::Arc;

use bossage_assets::normalisation_cube_map::Depth;
use bossage_assets::{Channel, ColorMap, EdgeMode, HeightField, NormalisationCubeMap};
use bossage_shaders::{Form, LightingSpace, Shading};
use glam::{DVec2, DVec4};

use crate::fields::{ANY, Bound, NOT_NEGATIVE, POSITIVE, Table, UNIT, UNIT_NOT_ZERO, Value};
use crate::files::{Files, chain};
use crate::load::{Named, refuse};
use crate::load_normal::{self, Heights};
use crate::load_search;
use crate::load_shadow;
use crate::model::{
    AlbedoSource, AlphaMode, Elevation, HeightSource, Material, Normaliser, ReflectionPin, Tangents,
    TechniquePin,
};
use crate::schema;

const SHININESS: Bound = Bound {
    allows: |x| x > 0.0 && x <= schema::MAX_SHININESS,
    words: "greater than 0, at most 65536",
};
const ADDRESS: [(&str, EdgeMode); 3] = [
    ("wrap", EdgeMode::Wrap),
    ("mirror", EdgeMode::Mirror),
    ("clamp", EdgeMode::Clamp),
];
const FORM: [(&str, Form); 2] = [("hardened", Form::Hardened), ("published", Form::Published)];
const SPACE: [(&str, LightingSpace); 2] =
    [("world", LightingSpace::World), ("object", LightingSpace::Object)];
const TANGENTS: [(&str, Tangents); 3] = [
    ("mikktspace", Tangents::MikkTSpace),
    ("from_uv", Tangents::FromUv),
    ("from_normal", Tangents::FromNormal),
];
const REFLECTION: [(&str, ReflectionPin); 3] = [
    ("auto", ReflectionPin::Auto),
    ("none", ReflectionPin::None),
    ("environment_bump", ReflectionPin::EnvironmentBump),
];
const CHANNEL: [(&str, Channel); 5] = [
    ("red", Channel::Red),
    ("green", Channel::Green),
    ("blue", Channel::Blue),
    ("alpha", Channel::Alpha),
    ("luminance", Channel::Luminance),
];

impl Named for Material {
    fn name(&self) -> &str {
        &self.name
    }
}

/// One `[[materials]]` table.
pub(crate) fn material(table: &Table<'_>, files: &Files) -> Option<Material> {
    let name = table
        .need("name", "`name`, unique among materials")
        .and_then(|v| v.name());
    let white = AlbedoSource {
        color: schema::ALBEDO_COLOR,
        map: None,
    };
    let albedo = table.or("albedo", white, |v| albedo(v, files));
    let address = table.or("address", EdgeMode::Wrap, |v| v.word(&ADDRESS));
    let height = table.or("height", None, |v| height(v, files).map(Some));
    let heights = Heights {
        field: table.path_of("height"),
        given: table.get("height").is_some(),
        read: height.as_ref().and_then(Option::as_ref).zip(address),
    };
    let form = table.or("form", Form::Hardened, |v| v.word(&FORM));
    let normal = table.or("normal", None, |v| {
        load_normal::normal(v, files, &heights, form).map(Some)
    });
    let specular = table.or("specular", schema::SPECULAR, |v| v.vec3(NOT_NEGATIVE));
    let shininess = table.or("shininess", schema::SHININESS, |v| v.number(SHININESS));
    let shading = table.or("shading", Shading::BlinnPhong, |v| {
        v.word(&Shading::ALL.map(|shading| (shading.as_str(), shading)))
    });
    let uncut = match shading {
        Some(Shading::WrapLambert) => AlphaMode::Mask {
            cutoff: schema::WRAP_ALPHA_CUTOFF,
        },
        Some(Shading::BlinnPhong | Shading::Emboss | Shading::Dot3SinglePass | Shading::Dot3TwoPass)
        | None => AlphaMode::Opaque,
    };
    let alpha = table.or("alpha", uncut, alpha);
    let technique = table.or("technique", TechniquePin::Auto, |v| v.word(&TechniquePin::NAMES));
    let search = technique.and_then(|pin| load_search::settings(table, pin));
    let shadow = load_shadow::shadow(table);
    let pixel_depth = table.or("pixel_depth", false, Value::truth);
    let occlusion = table.or("occlusion", schema::OCCLUSION, |v| v.number(NOT_NEGATIVE));
    let normaliser = table.or("normaliser", Normaliser::Arithmetic, |v| normaliser(v, shading));
    let emboss_texels = table.or("emboss_texels", schema::EMBOSS_TEXELS, |v| v.number(POSITIVE));
    let reflection = table.or("reflection", ReflectionPin::Auto, |v| v.word(&REFLECTION));
    let lighting_space = table.or("lighting_space", LightingSpace::World, |v| v.word(&SPACE));
    let tangents = table.or("tangents", Tangents::MikkTSpace, |v| v.word(&TANGENTS));
    table.finish();
    Some(Material {
        name: name?.to_owned(),
        albedo: albedo?,
        normal: normal?,
        height: height?,
        specular: specular?,
        shininess: shininess?,
        alpha: alpha?,
        address: address?,
        technique: technique?,
        search: search?,
        shadow: shadow?,
        pixel_depth: pixel_depth?,
        occlusion: occlusion?,
        shading: shading?,
        normaliser: normaliser?,
        emboss_texels: emboss_texels?,
        reflection: reflection?,
        form: form?,
        lighting_space: lighting_space?,
        tangents: tangents?,
    })
}

/// What `dot3` normalises with; no other shading normalises anything.
fn normaliser(value: &Value<'_>, shading: Option<Shading>) -> Option<Normaliser> {
    let table = value.table()?;
    let kind = table
        .need("kind", "`kind`: `arithmetic` or `cube`")
        .and_then(|v| v.word(&[("arithmetic", false), ("cube", true)]));
    let made = match kind {
        Some(true) => cube_map(&table),
        Some(false) => {
            let hint = "remove it, or set kind to `cube`";
            refuse(&table, "size", "the arithmetic normaliser has no size", hint);
            refuse(&table, "bits", "the arithmetic normaliser has no bits", hint);
            Some(Normaliser::Arithmetic)
        }
        None => {
            let _ = (table.get("size"), table.get("bits"));
            None
        }
    };
    table.finish();
    if let Some(shading) = shading.filter(|shading| !shading.is_dot3()) {
        value.note(
            format!("shading `{}` has no normaliser", shading.as_str()),
            "remove it, or set shading to `dot3_single_pass` or `dot3_two_pass`",
        );
        return None;
    }
    made
}

fn cube_map(table: &Table<'_>) -> Option<Normaliser> {
    let size = table
        .need("size", "`size`, the texels along an edge of the cube map")
        .and_then(|v| v.whole(schema::NORMALISER_SIZE));
    let depth = table.or("bits", Depth::Eight, |v| match v.whole(8..=16)? {
        8 => Some(Depth::Eight),
        16 => Some(Depth::Sixteen),
        other => {
            v.note(
                format!("{other} bits a component cannot be had"),
                "must be 8 or 16",
            );
            None
        }
    });
    let (size, depth) = (size?, depth?);
    let map = NormalisationCubeMap::generate(size, depth)
        .map_err(|error| table.note(chain(&error), "make it smaller"))
        .ok()?;
    Some(Normaliser::Cube(Arc::new(map)))
}

fn albedo(value: &Value<'_>, files: &Files) -> Option<AlbedoSource> {
    let table = value.table()?;
    let color = table.or("color", schema::ALBEDO_COLOR, color);
    let map = table.or("map", None, |v| color_map(v, files).map(Some));
    table.finish();
    Some(AlbedoSource {
        color: color?,
        map: map?,
    })
}

/// Three or four numbers; alpha is 1 where it is not given.
fn color(value: &Value<'_>) -> Option<DVec4> {
    if value.items()?.len() == 3 {
        return Some(value.vec3(UNIT)?.extend(1.0));
    }
    value.numbers::<4>(UNIT).map(DVec4::from_array)
}

fn color_map(value: &Value<'_>, files: &Files) -> Option<(PathBuf, Arc<ColorMap>)> {
    let (path, image) = files.image(value)?;
    let map = asset(
        value,
        ColorMap::from_image(&image),
        "use an image with colours from 0 to 1",
    )?;
    Some((path, Arc::new(map)))
}

/// The asset, or its error noted at the field.
pub(crate) fn asset<T>(value: &Value<'_>, made: Result<T, bossage_assets::Error>, hint: &str) -> Option<T> {
    made.map_err(|error| value.note(chain(&error), hint)).ok()
}

fn height(value: &Value<'_>, files: &Files) -> Option<HeightSource> {
    let table = value.table()?;
    let channel = table.or("channel", Channel::Red, |v| v.word(&CHANNEL));
    let map = table.need("map", "`map`, the height map's file");
    let image = map.as_ref().and_then(|v| files.image(v));
    let elevation = elevation(&table);
    table.finish();
    let (path, image) = image?;
    let made = asset(
        &map?,
        HeightField::from_image(&image, channel?),
        "use an image with heights from 0 to 1 in that channel",
    )?;
    Some(HeightSource {
        path,
        field: Arc::new(made),
        elevation: elevation?,
    })
}

/// Scale and bias in UV units, or depth and tile size in world units: one pair, whole.
fn elevation(table: &Table<'_>) -> Option<Elevation> {
    let world = table.get("depth").is_some() || table.get("tile").is_some();
    if !world {
        let scale = table.need(
            "scale",
            "`scale` and `bias` in UV units, or `depth` and `tile` in world units",
        );
        let scale = scale.and_then(|v| v.number(POSITIVE));
        let bias = table
            .need("bias", "`bias`: `-scale` for a surface below the polygon")
            .and_then(|v| v.number(ANY));
        return Some(Elevation {
            scale: DVec2::splat(scale?),
            bias: DVec2::splat(bias?),
        });
    }
    let hint = "give either `scale` and `bias` in UV units, or `depth` and `tile` in world units";
    refuse(
        table,
        "scale",
        "`scale` does not go with world `depth` and `tile`",
        hint,
    );
    refuse(
        table,
        "bias",
        "`bias` does not go with world `depth` and `tile`",
        hint,
    );
    let depth = table
        .need("depth", "`depth`, the height of the relief in world units")
        .and_then(|v| v.number(POSITIVE));
    let tile = table.need(
        "tile",
        "`tile = [width, height]` of one texture tile in world units",
    );
    let tile = tile.and_then(|v| v.numbers::<2>(POSITIVE)).map(DVec2::from_array);
    let scale = DVec2::splat(depth?) / tile?;
    Some(Elevation { scale, bias: -scale })
}

fn alpha(value: &Value<'_>) -> Option<AlphaMode> {
    let table = value.table()?;
    let mode = table
        .need("mode", "`mode`: `opaque` or `mask`")
        .and_then(|v| v.word(&[("opaque", false), ("mask", true)]));
    let alpha = match mode {
        Some(true) => {
            let cutoff = table.need(
                "cutoff",
                "`cutoff`, the alpha below which fragments are discarded",
            );
            cutoff
                .and_then(|v| v.number(UNIT_NOT_ZERO))
                .map(|cutoff| AlphaMode::Mask { cutoff })
        }
        Some(false) => {
            refuse(
                &table,
                "cutoff",
                "an opaque material has no cutoff",
                "remove it, or set mode to `mask`",
            );
            Some(AlphaMode::Opaque)
        }
        None => {
            let _ = table.get("cutoff");
            None
        }
    };
    table.finish();
    alpha
}
