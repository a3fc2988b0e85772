//! Materials of a scene file.

use std::path::PathBuf;
use std::sync::Arc;

use bossage_assets::height_to_normal::{self, Bake};
use bossage_assets::{Channel, ColorMap, EdgeMode, HeightField, NormalCodec, NormalMap};
use bossage_shaders::{Form, LightingSpace};
use glam::{DVec2, DVec4};

use crate::fields::{ANY, Bound, NOT_NEGATIVE, POSITIVE, Table, UNIT, UNIT_NOT_ZERO, Value};
use crate::files::{Files, chain};
use crate::load::{Named, refuse};
use crate::model::{
    AlbedoSource, AlphaMode, Elevation, HeightSource, Material, NormalSource, Tangents, TechniquePin,
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
const TANGENTS: [(&str, Tangents); 2] = [
    ("mikktspace", Tangents::MikkTSpace),
    ("from_uv", Tangents::FromUv),
];
const CODEC: [(&str, NormalCodec); 2] = [("unorm", NormalCodec::Unorm), ("biased", NormalCodec::Biased)];
const CHANNEL: [(&str, Channel); 5] = [
    ("red", Channel::Red),
    ("green", Channel::Green),
    ("blue", Channel::Blue),
    ("alpha", Channel::Alpha),
    ("luminance", Channel::Luminance),
];

/// The words of `technique`, also those of the command line's `--technique`.
pub(crate) const TECHNIQUE: [(&str, TechniquePin); 4] = [
    ("auto", TechniquePin::Auto),
    ("none", TechniquePin::None),
    ("parallax_offset", TechniquePin::ParallaxOffset),
    ("parallax_offset_limited", TechniquePin::ParallaxOffsetLimited),
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
    let normal = table.or("normal", None, |v| normal(v, files, &heights).map(Some));
    let specular = table.or("specular", schema::SPECULAR, |v| v.vec3(NOT_NEGATIVE));
    let shininess = table.or("shininess", schema::SHININESS, |v| v.number(SHININESS));
    let alpha = table.or("alpha", AlphaMode::Opaque, alpha);
    let technique = table.or("technique", TechniquePin::Auto, |v| v.word(&TECHNIQUE));
    let form = table.or("form", Form::Hardened, |v| v.word(&FORM));
    let lighting_space = table.or("lighting_space", LightingSpace::World, |v| v.word(&SPACE));
    let tangents = table.or("tangents", Tangents::MikkTSpace, |v| v.word(&TANGENTS));
    table.finish();
    let technique = technique?;
    check_pin(table, technique);
    Some(Material {
        name: name?.to_owned(),
        albedo: albedo?,
        normal: normal?,
        height: height?,
        specular: specular?,
        shininess: shininess?,
        alpha: alpha?,
        address: address?,
        technique,
        form: form?,
        lighting_space: lighting_space?,
        tangents: tangents?,
    })
}

/// A pinned relief technique needs heights to follow and a map to displace.
fn check_pin(table: &Table<'_>, technique: TechniquePin) {
    let pinned = match technique {
        TechniquePin::Auto | TechniquePin::None => return,
        TechniquePin::ParallaxOffset => "parallax_offset",
        TechniquePin::ParallaxOffsetLimited => "parallax_offset_limited",
    };
    let Some(place) = table.get("technique") else {
        return;
    };
    if table.get("height").is_none() {
        let height = table.path_of("height");
        place.note(
            format!("`{pinned}` needs `{height}`"),
            format!("add `{height}` with a map, or set technique to `auto`"),
        );
    }
    let has_albedo_map = table.get("albedo").and_then(|value| value.peek("map")).is_some();
    if !has_albedo_map && table.get("normal").is_none() {
        let (albedo, normal) = (table.path_of("albedo.map"), table.path_of("normal"));
        place.note(
            format!("`{pinned}` has nothing to displace: there is neither `{albedo}` nor `{normal}`"),
            format!("add `{albedo}` or `{normal}`, or set technique to `auto`"),
        );
    }
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
fn asset<T>(value: &Value<'_>, made: Result<T, bossage_assets::Error>, hint: &str) -> Option<T> {
    made.map_err(|error| value.note(chain(&error), hint)).ok()
}

/// The material's heights, for baking normals from them.
struct Heights<'a> {
    field: String,
    given: bool,
    read: Option<(&'a HeightSource, EdgeMode)>,
}

/// A map from a file, or baked from the material's heights, which then must be there.
fn normal(value: &Value<'_>, files: &Files, heights: &Heights<'_>) -> Option<NormalSource> {
    let table = value.table()?;
    let codec = table
        .need("codec", "`codec`: `unorm` or `biased`, as the map is written")
        .and_then(|v| v.word(&CODEC));
    let bake = table.get("bake");
    let made = match &bake {
        Some(bake) => {
            refuse(
                &table,
                "map",
                "`map` does not go with `bake`",
                "give a `map`, or `bake` one from the heights",
            );
            baked(bake, codec, heights)
        }
        None => table
            .need("map", "`map`, the normal map's file, or `bake = \"central\"`")
            .and_then(|v| normal_map(&v, codec, files)),
    };
    table.finish();
    made
}

fn normal_map(value: &Value<'_>, codec: Option<NormalCodec>, files: &Files) -> Option<NormalSource> {
    let (path, image) = files.image(value)?;
    let map = asset(
        value,
        NormalMap::from_image(&image, codec?),
        "use an image with red, green and blue",
    )?;
    Some(NormalSource {
        path,
        map: Arc::new(map),
    })
}

fn baked(value: &Value<'_>, codec: Option<NormalCodec>, heights: &Heights<'_>) -> Option<NormalSource> {
    value.word(&[("central", ())])?;
    if !heights.given {
        let field = &heights.field;
        value.note(
            format!("there are no heights to bake from: `{field}` is missing"),
            format!("add `{field}`"),
        );
        return None;
    }
    let (height, edge) = heights.read?;
    let scale = height.elevation.scale.as_vec2().to_array();
    let bake = asset(
        value,
        Bake::central(&height.field, scale, edge, codec?),
        "make the relief less steep",
    )?;
    Some(NormalSource {
        path: height.path.clone(),
        map: Arc::new(height_to_normal::bake(&height.field, &bake)),
    })
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
