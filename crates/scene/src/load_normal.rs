//! The normal map of a material: from a file in one of the codecs, or baked from the material's heights.

use std::sync::Arc;

use bossage_assets::height_to_normal::{self, Bake};
use bossage_assets::normal_mips::NormalMips;
use bossage_assets::{EdgeMode, NormalCodec, NormalEncoding, NormalMap, height_to_normal_forward};
use bossage_shaders::Form;

use crate::fields::Value;
use crate::files::Files;
use crate::load::refuse;
use crate::load_material::asset;
use crate::model::{HeightSource, NormalSource};

const CODEC: [(&str, NormalEncoding); 5] = [
    ("unorm", NormalEncoding::Linear(NormalCodec::Unorm)),
    ("biased", NormalEncoding::Linear(NormalCodec::Biased)),
    ("snorm", NormalEncoding::Snorm),
    ("two_channel", NormalEncoding::TwoChannel),
    ("octahedral", NormalEncoding::Octahedral),
];
const MIPS: [(&str, NormalMips); 2] = [
    ("normalised", NormalMips::Naive),
    ("averaged", NormalMips::Averaged),
];

/// The code of a texture whose file has none that a shader can decode linearly: it holds the flat normal exactly.
const DECODED: NormalCodec = NormalCodec::Biased;

#[derive(Clone, Copy)]
enum Kernel {
    Central,
    Forward,
}

/// The material's heights, for baking normals from them.
pub(crate) struct Heights<'a> {
    pub(crate) field: String,
    pub(crate) given: bool,
    pub(crate) read: Option<(&'a HeightSource, EdgeMode)>,
}

/// A map from a file, or baked from the material's heights, which then must be there.
pub(crate) fn normal(
    value: &Value<'_>,
    files: &Files,
    heights: &Heights<'_>,
    form: Option<Form>,
) -> Option<NormalSource> {
    let table = value.table()?;
    let codec = table.need(
        "codec",
        "`codec`: `unorm`, `biased`, `snorm`, `two_channel` or `octahedral`, as the map is written",
    );
    let encoding = codec.as_ref().and_then(|v| v.word(&CODEC));
    let mips = table.or("mips", NormalMips::default(), |v| v.word(&MIPS));
    let bake = table.get("bake");
    let made = match &bake {
        Some(bake) => {
            refuse(
                &table,
                "map",
                "`map` does not go with `bake`",
                "give a `map`, or `bake` one from the heights",
            );
            let kernel = bake.word(&[("central", Kernel::Central), ("forward", Kernel::Forward)]);
            let codec = codec
                .zip(encoding)
                .and_then(|(place, encoding)| baked_codec(&place, encoding));
            baked(bake, kernel?, codec, heights, form?)
        }
        None => table
            .need("map", "`map`, the normal map's file, or `bake = \"central\"`")
            .and_then(|v| {
                let (path, image) = files.image(&v)?;
                let map = asset(
                    &v,
                    encoding?.load(&image, DECODED),
                    "use an image with the channels of its codec, or name the codec it is written in",
                )?;
                Some((path, map))
            }),
    };
    table.finish();
    let ((path, map), mips) = (made?, mips?);
    Some(NormalSource {
        path,
        map: Arc::new(map),
        mips,
    })
}

/// A bake writes what the shader reads.
fn baked_codec(place: &Value<'_>, encoding: NormalEncoding) -> Option<NormalCodec> {
    match encoding {
        NormalEncoding::Linear(codec) => Some(codec),
        NormalEncoding::Snorm | NormalEncoding::TwoChannel | NormalEncoding::Octahedral => {
            place.note(
                format!("a bake cannot write `{}`", encoding.name()),
                "use `unorm` or `biased` with `bake`",
            );
            None
        }
    }
}

fn baked(
    value: &Value<'_>,
    kernel: Kernel,
    codec: Option<NormalCodec>,
    heights: &Heights<'_>,
    form: Form,
) -> Option<(std::path::PathBuf, NormalMap)> {
    if !heights.given {
        let field = &heights.field;
        value.note(
            format!("there are no heights to bake from: `{field}` is missing"),
            format!("add `{field}`"),
        );
        return None;
    }
    let ((height, edge), codec) = (heights.read?, codec?);
    let scale = height.elevation.scale.as_vec2().to_array();
    let bake = match (kernel, form) {
        (Kernel::Forward, Form::Published) => return published(value, codec, height),
        (Kernel::Forward, Form::Hardened) => Bake::forward(&height.field, scale, edge, codec),
        (Kernel::Central, _) => Bake::central(&height.field, scale, edge, codec),
    };
    let bake = asset(value, bake, "make the relief less steep")?;
    Some((height.path.clone(), height_to_normal::bake(&height.field, &bake)))
}

/// The bake as published: one scale for both axes, in texels of elevation a step of the height's byte, and `codec_biased`.
fn published(
    value: &Value<'_>,
    codec: NormalCodec,
    height: &HeightSource,
) -> Option<(std::path::PathBuf, NormalMap)> {
    if codec != NormalCodec::Biased {
        value.note(
            "the published bake writes `biased` and nothing else",
            "set codec to `biased`, or form to `hardened`",
        );
        return None;
    }
    let texels = height.elevation.scale.x * f64::from(height.field.width);
    let map = height_to_normal_forward::bake(&height.field, (texels / 255.0) as f32);
    Some((height.path.clone(), map))
}
