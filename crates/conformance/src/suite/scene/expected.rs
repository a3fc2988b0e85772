//! What the pixels of a draw should be: truth and acceptance interval at each captured point.
//!
//! Truth is the reference's surface in f64, of the draw's numbers; the interval comes from the fragment stage's own IR. They know nothing
//! of each other. Both are computed once for a module's text, a draw and its points: routes that rasterise alike share them.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use bossage_bounds::Slot;
use bossage_reference::surface::{Fragment as Truth, depth, shade};
use bossage_scene::Draw;
use bossage_shaders::{FeatureSet, Stage};
use rayon::prelude::*;

use super::interpolants::Interpolants;
use super::rig::Rig;
use super::truth;
use crate::bound::Bound;

/// What one fragment should be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fragment {
    /// The colour; `None` where the reference discards.
    pub(super) truth: Option<[f64; 4]>,
    /// What an implementation may return, if it keeps the fragment.
    pub(super) color: [Bound; 4],
    /// Whether it may keep it: 1, 0, or either.
    pub(super) kept: Bound,
    /// The depth by the reference and its interval, both in [0, 1], where the shader writes it.
    pub(super) depth: Option<(f64, Bound)>,
}

/// Whose points a draw is judged at: its own picture's, or those of another picture of the same object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Points {
    Own,
    Others,
}

/// A draw by its place among a case's draws, since a name may occur twice.
pub(super) type Place = (usize, Points);

/// A draw's stage, and whether the filter between texels is ideal.
type Key = (Place, FeatureSet, Stage, bool);

#[derive(Debug)]
struct Made {
    text: String,
    points: Vec<Interpolants>,
    fragments: Arc<Vec<Fragment>>,
}

/// The expectations of a case's draws, each as last asked for.
#[derive(Debug, Default)]
pub(super) struct Expectations(Mutex<BTreeMap<Key, Made>>);

impl Expectations {
    /// What the fragments of a draw should be, point by point.
    ///
    /// # Errors
    /// What the evaluator says.
    pub(super) fn of(
        &self,
        place: Place,
        rig: &Rig<'_>,
        stage: Stage,
        points: &[Interpolants],
    ) -> Result<Arc<Vec<Fragment>>, String> {
        let key = (place, rig.draw().features, stage, rig.filters_ideally());
        let text = rig.text(stage)?;
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(made) = lock().get(&key)
            && made.text == text
            && made.points == points
        {
            return Ok(Arc::clone(&made.fragments));
        }
        let fragments = Arc::new(fragments(rig, stage, points)?);
        let made = Made {
            text: text.to_owned(),
            points: points.to_vec(),
            fragments: Arc::clone(&fragments),
        };
        lock().insert(key, made);
        Ok(fragments)
    }
}

/// Both oracles at each point.
pub(super) fn fragments(
    rig: &Rig<'_>,
    stage: Stage,
    points: &[Interpolants],
) -> Result<Vec<Fragment>, String> {
    let (intervals, joined) = rig.intervals(stage, &Interpolants::inputs(points))?;
    let (truths, depths) = (
        truths(rig.draw(), stage, points),
        depths(rig.draw(), stage, points),
    );
    let both = truths
        .into_iter()
        .zip(depths)
        .enumerate()
        .map(|(at, (truth, depth))| {
            let written = intervals.component(Slot::FragDepth, at, 0);
            Ok(Fragment {
                depth: match (depth, written) {
                    (Some(depth), Some(bound)) => {
                        let [bound] = either([within_range(bound)], joined[at]);
                        Some((depth, bound))
                    }
                    (None, None) => None,
                    _ => {
                        return Err(
                            "the shader and the reference do not agree whether a depth is written".to_owned(),
                        );
                    }
                },
                truth,
                color: either(intervals.location(0, at)?, joined[at]),
                kept: intervals.kept(at),
            })
        });
    both.collect()
}

/// The same numbers, joined from several results where that is said.
fn either<const N: usize>(color: [Bound; N], joined: bool) -> [Bound; N] {
    color.map(|channel| if joined { channel.forked() } else { channel })
}

/// A depth as it is kept: the machine cuts it to [0, 1].
fn within_range(depth: Bound) -> Bound {
    if !depth.is_decided() {
        return depth;
    }
    let [low, high] = [depth.low(), depth.high()].map(|end| end.clamp(0.0, 1.0));
    let cut = Bound::between(low, high);
    if depth.is_forked() { cut.forked() } else { cut }
}

/// The reference's depths; `None` where the polygon's is written.
fn depths(draw: &Draw, stage: Stage, points: &[Interpolants]) -> Vec<Option<f64>> {
    if !draw.features.canonical().pixel_depth {
        return vec![None; points.len()];
    }
    let material = truth::material(draw, stage);
    let (viewer, _, form) = truth::view(draw);
    points
        .par_iter()
        .map(|at| depth(&material, &viewer, &at.exact(), form))
        .collect()
}

/// The reference's colours; `None` where it discards.
fn truths(draw: &Draw, stage: Stage, points: &[Interpolants]) -> Vec<Option<[f64; 4]>> {
    let material = truth::material(draw, stage);
    let (viewer, lights, form) = truth::view(draw);
    let shaded = |at: &Interpolants| match shade(&material, &lights, &viewer, &at.exact(), form) {
        Truth::Color(color) => Some(color.to_array()),
        Truth::Discarded => None,
    };
    points.par_iter().map(shaded).collect()
}
