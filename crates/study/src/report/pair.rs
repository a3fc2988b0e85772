//! Two pictures of one scene, what FLIP says of them, and a slider that shows more of the one or the other.
//!
//! The slider is a range input over the pictures: it takes drags, touches, arrow keys and a screen reader alike, and tells its place in
//! words. Without the script the pictures meet in the middle.

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use image::{ImageFormat, RgbImage};
use maud::{Markup, html};
use std::io::Cursor;

use super::Error;
use crate::chart::{file_part, short};
use crate::flip::{PIXELS_PER_DEGREE, flip};

/// Two pictures of one scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Beginning of its files' names, as `bricks-parallax_offset`.
    pub name: String,
    /// Heading, as `Brick wall: parallax_offset against exact`.
    pub title: String,
    /// What the other is judged by.
    pub reference: Shot,
    /// What is judged.
    pub test: Shot,
    /// The command that makes both again.
    pub rerun: String,
}

/// One picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// What drew it, in a few words, as `exact`.
    pub label: String,
    /// sRGB.
    pub image: RgbImage,
}

/// A pair with its difference, encoded.
pub(super) struct Compared<'a> {
    pair: &'a Pair,
    reference: Vec<u8>,
    test: Vec<u8>,
    map: Vec<u8>,
    mean: f64,
}

/// Compares and encodes.
pub(super) fn compared(pair: &Pair) -> Result<Compared<'_>, Error> {
    let difference =
        flip(&pair.reference.image, &pair.test.image, PIXELS_PER_DEGREE).map_err(|source| Error::Pair {
            name: pair.name.clone(),
            source,
        })?;
    let png = |image: &RgbImage| png(&pair.name, image);
    Ok(Compared {
        pair,
        reference: png(&pair.reference.image)?,
        test: png(&pair.test.image)?,
        map: png(&difference.map())?,
        mean: difference.mean,
    })
}

fn png(name: &str, image: &RgbImage) -> Result<Vec<u8>, Error> {
    let mut bytes = Cursor::new(Vec::new());
    image
        .write_to(&mut bytes, ImageFormat::Png)
        .map_err(|source| Error::Encode {
            name: name.to_owned(),
            source,
        })?;
    Ok(bytes.into_inner())
}

impl Compared<'_> {
    /// The three pictures as files.
    pub(super) fn files(&self) -> [(String, Vec<u8>); 3] {
        let name = |part: &str| format!("picture-{}-{part}.png", file_part(&self.pair.name));
        [
            (name("reference"), self.reference.clone()),
            (name("test"), self.test.clone()),
            (name("flip"), self.map.clone()),
        ]
    }
}

/// All pairs.
pub(super) fn section(pairs: &[Compared<'_>]) -> Markup {
    html! {
        @if pairs.is_empty() { p { "No pictures were drawn." } }
        @else {
            p { "FLIP (Andersson et al., 2020) says how strongly a viewer sees the difference when one picture follows the other: "
                "0 not at all, 1 as strongly as can be; here for a viewer with " (short(PIXELS_PER_DEGREE)) " pixels a degree. "
                "Its map is black where nothing differs and pale yellow where most does." }
        }
        @for compared in pairs { (one(compared)) }
    }
}

fn one(compared: &Compared<'_>) -> Markup {
    let pair = compared.pair;
    let (reference, test) = (&pair.reference.label, &pair.test.label);
    let mean = short(compared.mean);
    html! {
        h3 { (pair.title) }
        div.pair {
            figure {
                div.slider {
                    img src=(data(&compared.test)) alt={ (pair.title) ": drawn by " (test) };
                    img.over src=(data(&compared.reference)) alt={ (pair.title) ": drawn by " (reference) };
                    input type="range" min="0" max="100" value="50" data-left=(reference) data-right=(test)
                        aria-label={ "Border between " (reference) " on the left and " (test) " on the right" };
                }
                figcaption { "Left of the border " (reference) ", right of it " (test) ". Drag it, or move it by the arrow keys." }
            }
            figure {
                img src=(data(&compared.map)) alt={ "FLIP error map of " (test) " against " (reference) ", mean " (mean) };
                figcaption { "FLIP, mean " (mean) ". Made again by " code { (pair.rerun) } }
            }
        }
    }
}

fn data(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", BASE64.encode(png))
}
