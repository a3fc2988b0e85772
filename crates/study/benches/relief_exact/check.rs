//! Whether answers are right: by the f64 truth, where a ray that grazes a crest has more than one.

use bossage_reference::relief_grazing::{Answers, Surface, TOLERANCE_TEXELS};
use bossage_reference::relief_ray::{Entry, Layer};
use bossage_runner::ComputeOutput;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::DEPTH;
use crate::maps::Map;
use crate::rays::View;

/// All that counts as an answer, ray by ray.
pub(crate) struct Truth(Vec<Answers>);

/// What a design's answers are worth.
pub(crate) struct Errors {
    /// Of the worst ray, in texels; NaN where an answer is.
    pub(crate) worst_texels: f64,
    /// Rays further off than the tolerance.
    pub(crate) wrong: usize,
    /// Rays whose search gave up.
    pub(crate) capped: usize,
    /// Rays with more than one answer.
    pub(crate) grazing: usize,
}

impl Truth {
    pub(crate) fn new(map: &Map, views: &[View]) -> Self {
        let surface = Surface::new(&map.field, map.edge);
        let layer = Layer::below(f64::from(DEPTH));
        let answers = |view: &View| {
            let dir = DVec3::from_array(view.dir_ts.map(f64::from));
            let entry = Entry::new(DVec2::from_array(view.uv.map(f64::from)), dir, &layer);
            surface.answers(&entry.ray)
        };
        Self(views.par_iter().map(answers).collect())
    }

    pub(crate) fn compare(&self, output: &ComputeOutput) -> Errors {
        let (floats, words) = (output.floats("hits"), output.words("hits"));
        let hits = floats.chunks_exact(4).zip(words.chunks_exact(4));
        let mut errors = Errors {
            worst_texels: 0.0,
            wrong: self.0.len().abs_diff(hits.len()),
            capped: 0,
            grazing: self.0.iter().filter(|answers| answers.is_grazing()).count(),
        };
        for ((hit, words), answers) in hits.zip(&self.0) {
            let error = answers.error_texels(DVec2::new(hit[0].into(), hit[1].into()));
            errors.worst_texels = if error.is_nan() {
                error
            } else {
                errors.worst_texels.max(error)
            };
            errors.wrong += usize::from(error.is_nan() || error > TOLERANCE_TEXELS);
            errors.capped += usize::from(words[3] > 1);
        }
        errors
    }
}
