//! The scenes of a study as techniques draw them.

use bossage_conformance::bench::Bench;
use bossage_study::pictures::{Pictured, compare};
use bossage_study::record::Study;
use bossage_study::report::Pair;

use crate::console::{Bar, Console};
use crate::error::Result;

/// Fills the points' colour errors, with a bar. They are made anew in each run, since they take seconds and are the same in each.
pub(super) fn pairs(
    scenes: &[Pictured],
    study: &mut Study,
    bench: &Bench<'_>,
    console: Console,
) -> Result<Vec<Pair>> {
    let on_screen = study.points.iter().filter(|point| point.scene.is_some()).count();
    if on_screen == 0 {
        return Ok(Vec::new());
    }
    let Bar(bar) = &console.bar(on_screen as u64, "pictures");
    let pairs = compare(scenes, study, bench, &mut |what| {
        bar.set_message(what.to_owned());
        bar.inc(1);
    })?;
    bar.finish_and_clear();
    Ok(pairs)
}
