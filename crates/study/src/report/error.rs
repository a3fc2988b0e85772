//! Why a report could not be made.

use crate::{chart, flip};

/// What is wrong with a study or its pictures.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A figure that no chart has a place for.
    #[error(
        "{subject}: {field} is {value}; it must be a finite number from zero up (the point is made again by: {rerun})"
    )]
    Figure {
        /// The point or price.
        subject: String,
        /// Name of the figure, as in `study.json`.
        field: &'static str,
        /// What it is.
        value: f64,
        /// The command of the point.
        rerun: String,
    },
    /// Two charts or pictures want one file.
    #[error(
        "two parts of the report want the file {0}; give maps and pictures names that differ in letters and digits"
    )]
    Collision(String),
    /// A pair of pictures that can't be compared.
    #[error("the pictures {name} can't be compared")]
    Pair {
        /// The pair's name.
        name: String,
        /// What is wrong.
        source: flip::Error,
    },
    /// A picture could not be encoded.
    #[error("cannot encode the picture {name}")]
    Encode {
        /// Its name.
        name: String,
        /// What the encoder says.
        source: image::ImageError,
    },
    /// A chart could not be drawn.
    #[error(transparent)]
    Chart(#[from] chart::Error),
}
