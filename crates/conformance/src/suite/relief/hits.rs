//! A kernel's run over views: what the machine answers, and the promise about what is not finite.

use bossage_reference::relief_ray::Status;
use bossage_runner::TextureData;
use bossage_shaders::ReliefSearch;

use super::beside::Beside;
use super::setting::{HIT_FLOATS, HITS, Setting, packed};
use super::views::{View, not_finite};
use crate::bench::Bench;

/// One search in one setting on one map.
pub(super) struct Rig<'a> {
    pub(super) name: &'a str,
    pub(super) search: ReliefSearch,
    pub(super) setting: &'a Setting,
    pub(super) texture: &'a TextureData,
    pub(super) beside: Option<&'a Beside>,
}

impl Rig<'_> {
    /// What the machine answers: uv, t, and the status as a float.
    pub(super) fn hits(&self, bench: &Bench<'_>, views: &[View]) -> Result<Vec<[f32; HIT_FLOATS]>, String> {
        let rays = packed(views);
        let dispatch = self
            .setting
            .dispatch(self.name, self.search, self.texture, self.beside, &rays);
        let left = dispatch.run(bench)?;
        let (floats, words) = (left.floats(HITS), left.words(HITS));
        let records = floats
            .as_chunks::<HIT_FLOATS>()
            .0
            .iter()
            .zip(words.as_chunks::<HIT_FLOATS>().0);
        let found: Vec<_> = records
            .map(|([u, v, t, _], [.., status])| [*u, *v, *t, *status as f32])
            .collect();
        if found.len() == views.len() {
            Ok(found)
        } else {
            Err(format!("{} hits of {}", found.len(), views.len()))
        }
    }

    /// What is not finite must come back as it was given, and say so.
    pub(super) fn not_finite(&self, bench: &Bench<'_>) -> Result<(), String> {
        let views = not_finite();
        let same = |a: f32, b: f32| a == b || (a.is_nan() && b.is_nan());
        for (view, [u, v, t, status]) in views.iter().zip(self.hits(bench, &views)?) {
            let promised = same(u, view.uv[0])
                && same(v, view.uv[1])
                && t == 0.0
                && status == Status::NonFinite.number() as f32;
            if !promised {
                return Err(format!(
                    "{view:?} is not finite, and came back as uv ({u}, {v}), t {t}, status {status}"
                ));
            }
        }
        Ok(())
    }
}
