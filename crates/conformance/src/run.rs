//! Runs the selected cases on the selected routes and adapters.

use std::path::PathBuf;

use bossage_shaders::Library;

use crate::case::Case;
use crate::case_id::CaseId;
use crate::environment::Environment;
use crate::error::Error;
use crate::generate::random;
use crate::machines::Pairs;
use crate::report::{CaseResult, Report};
use crate::route::{Fault, Route};
use crate::suite::{self, Scope};

/// What to run. The default is every case on every route and adapter, in the ordinary number of inputs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// Only cases with this in their name.
    pub filter: Option<String>,
    /// Only these routes; all when empty.
    pub routes: Vec<Route>,
    /// Only adapters whose name or driver holds one of these; all when empty.
    pub adapters: Vec<String>,
    /// Part i of n, from 1.
    pub shard: Option<(usize, usize)>,
    /// The full number of inputs (10⁶ a function) instead of the ordinary one (10⁴).
    pub full: bool,
    /// The seed of the random generators; the default when `None`.
    pub seed: Option<u64>,
    /// Scene files to render besides.
    pub scenes: Vec<PathBuf>,
    /// A fault in what one route emits: a negative control.
    pub fault: Option<Fault>,
}

/// Told how far a run is.
pub trait Progress {
    /// So many results will come.
    fn start(&mut self, total: usize);

    /// One result.
    fn done(&mut self, result: &CaseResult);
}

/// Progress that nobody watches.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn start(&mut self, _total: usize) {}

    fn done(&mut self, _result: &CaseResult) {}
}

impl Selection {
    /// The routes that this selects.
    #[must_use]
    pub fn routes(&self) -> Vec<Route> {
        let selected = |route: &Route| self.routes.is_empty() || self.routes.contains(route);
        Route::ALL.into_iter().filter(selected).collect()
    }

    fn scope(&self) -> Scope {
        Scope {
            full: self.full,
            seed: self.seed.unwrap_or(random::SEED),
            scenes: self.scenes.clone(),
        }
    }

    /// The cases that this selects: a filter that is the whole name of a case selects just that one.
    ///
    /// # Errors
    /// [`Error::NoSuchCase`] when the filter finds none, [`Error::BadShard`].
    pub fn cases(&self) -> Result<Vec<Box<dyn Case>>, Error> {
        let all = suite::cases(&self.scope());
        let known = all.len();
        let filter = self.filter.as_deref().unwrap_or_default();
        let exact = all.iter().any(|case| case.id().to_string() == filter);
        let wanted = |id: &CaseId| {
            if exact {
                id.to_string() == filter
            } else {
                id.matches(filter)
            }
        };
        let matching: Vec<_> = all.into_iter().filter(|case| wanted(case.id())).collect();
        if matching.is_empty() {
            return Err(Error::NoSuchCase {
                filter: filter.to_owned(),
                known,
            });
        }
        sharded(matching, self.shard)
    }
}

/// Every n-th case, starting with the i-th: neighbours, which cost about the same, go to different parts.
fn sharded<T>(cases: Vec<T>, shard: Option<(usize, usize)>) -> Result<Vec<T>, Error> {
    let Some((index, count)) = shard else {
        return Ok(cases);
    };
    if index == 0 || index > count {
        return Err(Error::BadShard { index, count });
    }
    Ok(cases.into_iter().skip(index - 1).step_by(count).collect())
}

/// Runs the selection with the shaders of a library.
///
/// # Errors
/// When nothing is selected, or no adapter is there. A shader that fails is a verdict, not an error.
pub fn run(selection: &Selection, library: &Library, progress: &mut dyn Progress) -> Result<Report, Error> {
    run_cases(selection.cases()?, selection, library, progress)
}

/// Runs these cases on the machines of a selection.
///
/// # Errors
/// As [`run`].
pub fn run_cases(
    cases: Vec<Box<dyn Case>>,
    selection: &Selection,
    library: &Library,
    progress: &mut dyn Progress,
) -> Result<Report, Error> {
    let pairs = selection.pairs()?;
    progress.start(cases.len() * pairs.count());
    let machines = pairs.open()?;
    let benches = machines.benches(library).into_iter();
    let benches: Vec<_> = benches
        .map(|bench| bench.planted(selection.fault.as_ref()))
        .collect();
    let mut results = Vec::new();
    // Case by case, not bench by bench: what a case expects is computed once, and then dropped with the case.
    for case in cases {
        for (bench, outcome) in benches.iter().zip(case.run_all(&benches)) {
            let result = outcome.into_result(case.as_ref(), bench);
            progress.done(&result);
            results.push(result);
        }
    }
    Ok(Report::new(environment(selection, &pairs), results))
}

pub(crate) fn environment(selection: &Selection, pairs: &Pairs) -> Environment {
    Environment {
        seed: selection.seed.unwrap_or(random::SEED),
        full: selection.full,
        shard: selection.shard.map(|(index, count)| format!("{index}/{count}")),
        not_run: pairs.not_run.clone(),
        ..Environment::of(&pairs.infos())
    }
}

#[cfg(test)]
mod tests {
    use super::{Selection, sharded};
    use crate::error::Error;
    use crate::route::Route;

    #[test]
    fn shards_are_a_partition() {
        let all: Vec<usize> = (0..10).collect();
        let mut joined: Vec<usize> = (1..=3)
            .flat_map(|i| sharded(all.clone(), Some((i, 3))).unwrap())
            .collect();
        joined.sort_unstable();
        assert_eq!(joined, all);
        assert!(matches!(
            sharded(all.clone(), Some((0, 3))),
            Err(Error::BadShard { .. })
        ));
        assert!(matches!(sharded(all, Some((4, 3))), Err(Error::BadShard { .. })));
    }

    #[test]
    fn a_filter_that_finds_nothing_is_an_error() {
        let selection = Selection {
            filter: Some("dot33".to_owned()),
            ..Selection::default()
        };
        assert!(matches!(selection.cases(), Err(Error::NoSuchCase { .. })));
    }

    #[test]
    fn a_full_name_selects_one_case() {
        let name = "parallax_offset/hardened/edge";
        let selection = Selection {
            filter: Some(name.to_owned()),
            ..Selection::default()
        };
        let names: Vec<String> = selection
            .cases()
            .unwrap()
            .iter()
            .map(|case| case.id().to_string())
            .collect();
        assert_eq!(names, [name]);
    }

    #[test]
    fn no_route_given_means_all() {
        assert_eq!(Selection::default().routes(), Route::ALL);
        assert_eq!(
            Selection {
                routes: vec![Route::Spirv],
                ..Selection::default()
            }
            .routes(),
            [Route::Spirv]
        );
    }
}
