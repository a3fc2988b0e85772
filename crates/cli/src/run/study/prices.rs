//! The charts of other prices: which are wanted, and their measurement.

use bossage_runner::Machine;
use bossage_shaders::Library;
use bossage_study::prices::{self, CHARTS, Context};
use bossage_study::record::Price;

use crate::args::study::Study;
use crate::console::{Bar, Console};
use crate::error::{Error, Result};
use crate::nearest::suggestion;

/// Those that are named; all where nothing is chosen at all.
pub(super) fn charts(args: &Study) -> Result<Vec<&'static str>> {
    let find = |given: &String| {
        let found = CHARTS.into_iter().find(|chart| chart == given);
        found.ok_or_else(|| Error::Call(format!("unknown chart `{given}`; {}", suggestion(given, &CHARTS))))
    };
    if args.price.is_empty() && args.is_whole() {
        return Ok(CHARTS.to_vec());
    }
    let mut wanted = args.price.iter().map(find).collect::<Result<Vec<_>>>()?;
    wanted.sort_unstable();
    // What is named twice is measured once.
    wanted.dedup();
    Ok(wanted)
}

pub(super) fn measure(
    charts: &[&'static str],
    args: &Study,
    machine: &dyn Machine,
    library: &Library,
    console: Console,
) -> Result<Vec<Price>> {
    let context = Context {
        machine,
        library,
        quick: args.measured.quick,
        seed: args.measured.seed,
    };
    let Bar(bar) = &console.bar(charts.len() as u64, "prices");
    let mut all = Vec::new();
    for chart in charts {
        bar.set_message(*chart);
        all.extend(prices::chart(chart, &context)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(all)
}
