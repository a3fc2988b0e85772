//! Causes: sums that cancel to nothing, and products that vanish, where an output is no number because of it.
//!
//! A sum of opposite terms is right when it is zero; it is what comes behind, a division or a direction, that fails. To the one who looks for the
//! fault the sum is the place. So where an output of a perfect machine is not finite, the sums and products that gave zero of what is not zero
//! are suspects, and each is tried: given a little back ([`crate::exec::nudge`]), is that output a number? Then the sum is the cause.

use super::prove::Site;
use super::rule::Rule;
use super::search::{self, Run, Search};
use crate::domain::point::F32;
use crate::exec::watch::{Event, Suspicion};
use crate::limits::{Move, Nudge};
use crate::ranges::Point;
use std::time::Instant;

/// Points at which one suspect is tried in vain.
const TRIALS: u32 = 64;

/// Suspects of one point that are still to be tried.
pub(super) struct Suspects {
    failed: Vec<bool>,
    sites: Vec<(Site, Event)>,
}

/// The sums and products of a run without which an output may be a number.
pub(super) fn suspects(run: &Run<F32>) -> Suspects {
    let failed: Vec<bool> = run.outputs.iter().map(|x| !x.is_finite()).collect();
    let rule = |suspicion| match suspicion {
        Suspicion::Cancelled => Some(Rule::VanishingSum),
        Suspicion::Underflowed => Some(Rule::Underflow),
        Suspicion::NearConstant => None,
    };
    let sites = run.suspects.iter().filter(|_| failed.contains(&true));
    Suspects {
        sites: sites
            .filter_map(|(&(span, suspicion), &event)| Some(((span, rule(suspicion)?), event)))
            .collect(),
        failed,
    }
}

impl Search<'_> {
    /// Tries suspects that are not found yet; what turns out to be a cause.
    pub(super) fn causes(
        &mut self,
        point: &Point,
        suspects: &Suspects,
        until: Instant,
    ) -> Vec<(Site, Event)> {
        let mut found = Vec::new();
        for &(site, event) in &suspects.sites {
            let trials = self.trials.entry(site).or_insert(0);
            if self.found.contains_key(&site) || *trials >= TRIALS || Instant::now() > until {
                continue;
            }
            *trials += 1;
            if self.is_cause(point, site.0, &suspects.failed) {
                found.push((site, event));
            }
        }
        found
    }

    /// Whether an output that is no number at a point is one where the results of a place do not vanish.
    fn is_cause(&self, point: &Point, span: u32, failed: &[bool]) -> bool {
        let nudge = Nudge {
            span,
            how: Move::Restore,
        };
        let run = search::run_nudged::<F32>(self.program, self.inputs, point, self.seed, Some(nudge));
        run.is_ok_and(|run| {
            let mut outputs = failed.iter().zip(&run.outputs);
            outputs.any(|(failed, x)| *failed && x.is_finite())
        })
    }

    /// Whether a point shows such a site.
    pub(super) fn shows_cause(&self, point: &Point, (span, rule): Site) -> Option<Event> {
        let run = search::run::<F32>(self.program, self.inputs, point, self.seed).ok()?;
        let suspects = suspects(&run);
        let (_, event) = suspects.sites.iter().find(|(site, _)| *site == (span, rule))?;
        self.is_cause(point, span, &suspects.failed).then_some(*event)
    }
}
