//! Which machine runs which routes.
//!
//! Route `embedded` is what the adapter `embedded` does, route `msl` what `clang` does, the others go to drivers, `tint` and `opengl` through
//! processes of their own: a pair that makes no sense is not in the list. What a selection names must be in some pair, or the call is
//! wrong; a route that nobody named and that has no adapter, or whose compiler is missing, is left out, and the report says so. So is an
//! adapter that such a process does not take.

use bossage_metal::Metal;
use bossage_runner::{AdapterInfo, AdapterSelector, HOW_TO_GET_AN_ADAPTER, Machine};
use bossage_shaders::Library;
use serde::Serialize;

use crate::bench::Bench;
use crate::error::Error;
use crate::route::{Route, opengl, tint, tools};
use crate::run::Selection;

/// Every adapter of this machine: those that drivers bring, `embedded`, and `clang` where that is.
#[must_use]
pub fn adapters() -> Vec<AdapterInfo> {
    let mut all = bossage_embedded::adapters();
    all.extend(bossage_metal::info(tools::all()));
    all
}

/// A route that no adapter of this machine runs, or that one adapter does not.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NotRun {
    /// The route.
    pub route: Route,
    /// The only adapter that does not run it; `None` where none does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub adapter: Option<String>,
    /// Why not, and how to get what it needs.
    pub reason: String,
}

/// Adapters with the routes that each runs, and the routes that none runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pairs {
    /// Adapters, each with at least one route.
    pub adapters: Vec<(AdapterInfo, Vec<Route>)>,
    /// The other routes.
    pub not_run: Vec<NotRun>,
}

impl Pairs {
    /// The pairs that a selection takes of these adapters. `missing` says why a route cannot run, whatever the adapter, `refused` why it
    /// cannot on that one.
    ///
    /// # Errors
    /// [`Error::Adapter`] when an adapter that is named isn't there, or a route that is named needs one and there is none;
    /// [`Error::NoTool`] when a route that is named lacks its compiler; [`Error::NoPair`] when what is named doesn't go together.
    pub fn of(
        selection: &Selection,
        all: &[AdapterInfo],
        missing: impl Fn(Route) -> Option<String>,
        refused: impl Fn(Route, &AdapterInfo) -> Option<String>,
    ) -> Result<Self, Error> {
        let selectors: Vec<_> = selection
            .adapters
            .iter()
            .map(|name| AdapterSelector::named(name))
            .collect();
        for (name, selector) in selection.adapters.iter().zip(&selectors) {
            if !all.iter().any(|info| selector.matches(info)) {
                let (wanted, found) = (name.clone(), all.iter().map(|info| info.name.clone()).collect());
                return Err(Error::Adapter(bossage_runner::Error::NoSuchAdapter {
                    wanted,
                    found,
                }));
            }
        }
        let named = |info: &AdapterInfo| selectors.iter().any(|selector| selector.matches(info));
        let (routes, without_tool) = usable(selection, missing)?;
        let (mut pairs, mut refusals) = (Vec::new(), Vec::new());
        for info in all.iter().filter(|info| selectors.is_empty() || named(info)) {
            let mut own: Vec<Route> = routes
                .iter()
                .copied()
                .filter(|route| route.runs_on(info))
                .collect();
            let fitting = own.len();
            own.retain(|&route| match refused(route, info) {
                None => true,
                Some(reason) => {
                    let adapter = Some(info.name.clone());
                    refusals.push(NotRun {
                        route,
                        adapter,
                        reason,
                    });
                    false
                }
            });
            if fitting == 0 && named(info) {
                return Err(Error::NoPair {
                    what: format!("adapter `{}` does not run {}", info.name, list(&routes)),
                    runs: list(
                        &Route::ALL
                            .into_iter()
                            .filter(|r| r.runs_on(info))
                            .collect::<Vec<_>>(),
                    ),
                });
            }
            if !own.is_empty() {
                pairs.push((info.clone(), own));
            }
        }
        let mut not_run = left_out(selection, &routes, &pairs, &refusals, all)?;
        not_run.extend(without_tool);
        not_run.extend(refusals);
        not_run.sort_by_key(|left_out| (left_out.route, left_out.adapter.clone()));
        Ok(Self {
            adapters: pairs,
            not_run,
        })
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.adapters.iter().map(|(_, routes)| routes.len()).sum()
    }

    /// The adapters.
    #[must_use]
    pub fn infos(&self) -> Vec<AdapterInfo> {
        self.adapters.iter().map(|(info, _)| info.clone()).collect()
    }

    /// Opens every adapter, once for each kind of machine that its routes need.
    ///
    /// # Errors
    /// [`Error::Adapter`] when one can't be opened.
    pub fn open(&self) -> Result<Machines, Error> {
        let mut machines = Vec::new();
        for (info, routes) in &self.adapters {
            for group in routes.chunk_by(|a, b| a.is_remote() == b.is_remote() && !a.is_remote()) {
                machines.push((open(info, group[0])?, group.to_vec()));
            }
        }
        Ok(Machines(machines))
    }
}

/// Opens what runs a route on an adapter.
///
/// # Errors
/// [`Error::Adapter`] when it can't be opened.
pub fn open(info: &AdapterInfo, route: Route) -> Result<Box<dyn Machine>, Error> {
    let opened = match route {
        Route::Opengl => opengl::open(info),
        Route::Tint => tint::open(info),
        Route::Msl => {
            Metal::new(tools::all(), tools::cache()).map(|machine| Box::new(machine) as Box<dyn Machine>)
        }
        Route::Wgsl | Route::Spirv | Route::Hlsl | Route::Glsl | Route::Embedded => {
            bossage_embedded::open(&AdapterSelector::named(&info.name))
        }
    };
    opened.map_err(Error::Adapter)
}

/// The routes of a selection that have what they need, and those that lack a compiler; none of the latter may be named.
fn usable(
    selection: &Selection,
    missing: impl Fn(Route) -> Option<String>,
) -> Result<(Vec<Route>, Vec<NotRun>), Error> {
    let (mut routes, mut without) = (Vec::new(), Vec::new());
    for route in selection.routes() {
        match missing(route) {
            None => routes.push(route),
            Some(reason) if selection.routes.is_empty() => without.push(NotRun {
                route,
                adapter: None,
                reason,
            }),
            Some(reason) => return Err(Error::NoTool { route, reason }),
        }
    }
    Ok((routes, without))
}

/// The routes without an adapter; those that are named have to have one.
fn left_out(
    selection: &Selection,
    routes: &[Route],
    pairs: &[(AdapterInfo, Vec<Route>)],
    refusals: &[NotRun],
    all: &[AdapterInfo],
) -> Result<Vec<NotRun>, Error> {
    let mut not_run = Vec::new();
    for &route in routes {
        if pairs.iter().any(|(_, own)| own.contains(&route)) {
            continue;
        }
        if let Some(refusal) = refusals.iter().find(|one| one.route == route) {
            if selection.routes.is_empty() {
                continue;
            }
            let reason = refusal.reason.clone();
            return Err(Error::NoTool { route, reason });
        }
        match (selection.routes.is_empty(), selection.adapters.is_empty()) {
            (false, true) => return Err(Error::Adapter(bossage_runner::Error::NoAdapter)),
            (false, false) => {
                return Err(Error::NoPair {
                    what: format!("route `{route}` does not run on the adapters that are named"),
                    runs: runners(route, all),
                });
            }
            // Whoever names adapters knows that others are left out.
            (true, false) => {}
            (true, true) => not_run.push(NotRun {
                route,
                adapter: None,
                reason: format!("no Vulkan adapter; {HOW_TO_GET_AN_ADAPTER}"),
            }),
        }
    }
    Ok(not_run)
}

/// The adapters that run a route, for a message.
fn runners(route: Route, all: &[AdapterInfo]) -> String {
    let names = all
        .iter()
        .filter(|info| route.runs_on(info))
        .map(|info| format!("`{}`", info.name));
    let names: Vec<String> = names.collect();
    if names.is_empty() {
        "only on a driver's adapter, and none is here".to_owned()
    } else {
        names.join(", ")
    }
}

fn list(routes: &[Route]) -> String {
    let names: Vec<String> = routes.iter().map(|route| format!("route `{route}`")).collect();
    names.join(", ")
}

/// Open machines with the routes that each runs.
#[derive(Debug)]
pub struct Machines(Vec<(Box<dyn Machine>, Vec<Route>)>);

impl Machines {
    /// A bench for each pair.
    #[must_use]
    pub fn benches<'a>(&'a self, library: &'a Library) -> Vec<Bench<'a>> {
        let of_machine = |(machine, routes): &'a (Box<dyn Machine>, Vec<Route>)| {
            routes
                .iter()
                .map(move |route| Bench::new(machine.as_ref(), *route, library))
        };
        self.0.iter().flat_map(of_machine).collect()
    }
}

impl Selection {
    /// The adapters and routes that this selects on this machine.
    ///
    /// # Errors
    /// As [`Pairs::of`].
    pub fn pairs(&self) -> Result<Pairs, Error> {
        Pairs::of(self, &adapters(), Route::missing, Route::refused_by)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn driver(name: &str) -> AdapterInfo {
        AdapterInfo {
            name: name.to_owned(),
            backend: "vulkan".to_owned(),
            ..bossage_embedded::info()
        }
    }

    fn clang() -> AdapterInfo {
        AdapterInfo {
            name: bossage_metal::NAME.to_owned(),
            ..bossage_embedded::info()
        }
    }

    fn selection(routes: &[Route], adapters: &[&str]) -> Selection {
        Selection {
            routes: routes.to_vec(),
            adapters: adapters.iter().map(|name| (*name).to_owned()).collect(),
            ..Selection::default()
        }
    }

    /// Every compiler is there.
    fn nothing(_: Route) -> Option<String> {
        None
    }

    /// Every adapter takes everything.
    fn nobody(_: Route, _: &AdapterInfo) -> Option<String> {
        None
    }

    /// Dawn does not take the adapter `one`.
    fn dawn(route: Route, info: &AdapterInfo) -> Option<String> {
        (route == Route::Tint && info.name == "one").then(|| "Dawn needs more".to_owned())
    }

    /// DXC is not there.
    fn dxc(route: Route) -> Option<String> {
        (route == Route::Hlsl).then(|| "`dxc` was not found; get it".to_owned())
    }

    fn pairs(routes: &[Route], adapters: &[&str], all: &[AdapterInfo]) -> Vec<String> {
        let pairs = Pairs::of(&selection(routes, adapters), all, nothing, nobody).unwrap();
        let of = |(info, routes): &(AdapterInfo, Vec<Route>)| {
            routes
                .iter()
                .map(|route| format!("{route} on {}", info.name))
                .collect::<Vec<_>>()
        };
        let listed: Vec<String> = pairs.adapters.iter().flat_map(of).collect();
        assert_eq!(listed.len(), pairs.count());
        listed
    }

    #[test]
    fn drivers_run_the_emitted_code_and_embedded_runs_itself() {
        let all = [driver("one"), driver("two"), bossage_embedded::info(), clang()];
        let expected = [
            "wgsl on one",
            "spirv on one",
            "hlsl on one",
            "glsl on one",
            "opengl on one",
            "tint on one",
            "wgsl on two",
            "spirv on two",
            "hlsl on two",
            "glsl on two",
            "opengl on two",
            "tint on two",
            "embedded on embedded",
            "msl on clang",
        ];
        assert_eq!(pairs(&[], &[], &all), expected);
        assert_eq!(pairs(&[Route::Embedded], &[], &all), ["embedded on embedded"]);
        assert_eq!(pairs(&[], &["embedded"], &all), ["embedded on embedded"]);
        assert_eq!(pairs(&[Route::Msl], &[], &all), ["msl on clang"]);
        assert_eq!(
            pairs(&[Route::Spirv], &[], &all),
            ["spirv on one", "spirv on two"]
        );
        assert_eq!(
            pairs(&[], &["two"], &all),
            [
                "wgsl on two",
                "spirv on two",
                "hlsl on two",
                "glsl on two",
                "opengl on two",
                "tint on two"
            ]
        );
        assert_eq!(
            pairs(&[Route::Wgsl, Route::Embedded], &["one", "embedded"], &all),
            ["wgsl on one", "embedded on embedded"]
        );
    }

    #[test]
    fn without_a_driver_embedded_runs_and_the_rest_is_said_to_be_left_out() {
        let all = [bossage_embedded::info(), clang()];
        assert_eq!(pairs(&[], &[], &all), ["embedded on embedded", "msl on clang"]);
        let left_out = Pairs::of(&selection(&[], &[]), &all, nothing, nobody)
            .unwrap()
            .not_run;
        let routes: Vec<Route> = left_out.iter().map(|one| one.route).collect();
        assert_eq!(
            routes,
            [
                Route::Wgsl,
                Route::Spirv,
                Route::Hlsl,
                Route::Glsl,
                Route::Opengl,
                Route::Tint
            ]
        );
        assert!(left_out[0].reason.contains("mesa-vulkan-drivers"));
        let with = [driver("one"), bossage_embedded::info(), clang()];
        assert_eq!(
            Pairs::of(&selection(&[], &[]), &with, nothing, nobody)
                .unwrap()
                .not_run,
            []
        );
    }

    #[test]
    fn a_route_without_its_compiler_is_left_out_with_the_reason_and_refused_by_name() {
        let all = [driver("one"), bossage_embedded::info(), clang()];
        let pairs = Pairs::of(&selection(&[], &[]), &all, dxc, nobody).unwrap();
        let [left_out] = &pairs.not_run[..] else {
            panic!("{:?}", pairs.not_run)
        };
        assert_eq!(
            (left_out.route, left_out.reason.as_str()),
            (Route::Hlsl, "`dxc` was not found; get it")
        );
        assert_eq!(pairs.count(), 7);
        let error = Pairs::of(&selection(&[Route::Hlsl], &[]), &all, dxc, nobody).unwrap_err();
        assert!(error.is_missing_environment() && matches!(error, Error::NoTool { .. }));
        assert!(error.to_string().contains("get it"), "{error}");
    }

    #[test]
    fn an_adapter_that_refuses_a_route_is_left_out_of_it_alone_with_the_reason() {
        let all = [driver("one"), driver("two"), bossage_embedded::info()];
        let pairs = Pairs::of(&selection(&[Route::Tint], &[]), &all, nothing, dawn).unwrap();
        assert_eq!(pairs.count(), 1);
        let expected = NotRun {
            route: Route::Tint,
            adapter: Some("one".to_owned()),
            reason: "Dawn needs more".to_owned(),
        };
        assert_eq!(pairs.not_run, std::slice::from_ref(&expected));
        // Where it was not named, the others of that adapter go on.
        let pairs = Pairs::of(&selection(&[], &["one"]), &all, nothing, dawn).unwrap();
        assert_eq!((pairs.count(), &pairs.not_run[..]), (5, &[expected][..]));
        // Where it was named and nothing is left, that is the environment's lack.
        let error = Pairs::of(&selection(&[Route::Tint], &["one"]), &all, nothing, dawn).unwrap_err();
        assert!(error.is_missing_environment() && error.to_string().contains("Dawn needs more"));
    }

    #[test]
    fn what_is_named_and_does_not_go_together_is_a_wrong_call() {
        let all = [driver("one"), bossage_embedded::info()];
        let wrong = |routes: &[Route], adapters: &[&str]| {
            Pairs::of(&selection(routes, adapters), &all, nothing, nobody).unwrap_err()
        };
        let error = wrong(&[Route::Spirv], &["embedded"]);
        assert!(matches!(error, Error::NoPair { .. }) && !error.is_missing_environment());
        let text = error.to_string();
        assert!(text.contains("`embedded`") && text.contains("`spirv`"), "{text}");
        assert!(matches!(
            wrong(&[Route::Embedded], &["one"]),
            Error::NoPair { .. }
        ));
        let nobody = Pairs::of(
            &selection(&[Route::Wgsl, Route::Embedded], &["embedded"]),
            &[bossage_embedded::info()],
            nothing,
            nobody,
        );
        assert!(matches!(nobody, Err(Error::NoPair { .. })));
        // One of two routes, one of two adapters.
        assert!(matches!(
            wrong(&[Route::Wgsl, Route::Embedded], &["one"]),
            Error::NoPair { .. }
        ));
        assert!(matches!(
            wrong(&[Route::Wgsl], &["one", "embedded"]),
            Error::NoPair { .. }
        ));
    }

    #[test]
    fn what_is_named_and_not_there_is_an_error_of_the_environment() {
        let all = [bossage_embedded::info()];
        let wrong = |routes: &[Route], adapters: &[&str]| {
            Pairs::of(&selection(routes, adapters), &all, nothing, nobody).unwrap_err()
        };
        for error in [
            wrong(&[], &["lavapipe"]),
            wrong(&[Route::Wgsl], &[]),
            wrong(&[Route::Wgsl, Route::Embedded], &[]),
        ] {
            assert!(error.is_missing_environment(), "{error}");
        }
    }
}
