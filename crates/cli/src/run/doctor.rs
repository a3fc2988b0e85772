//! `bossage doctor`: what this machine can do, and how to make it do more.

use bossage_conformance::Route;
use bossage_runner::{AdapterInfo, AdapterSelector, HOW_TO_GET_AN_ADAPTER};
use bossage_translate::external::{self, Validator};
use serde::Serialize;

use crate::Verdict;
use crate::args::doctor::Doctor;
use crate::console;
use crate::error::Result;
use crate::machine;
use crate::run::check;

/// Why no machine has it: it is not for us to fetch.
const FXC: &str = "fxc, which alone compiles shader models 5.0 and 5.1: it is a library of Windows, and packages that bring it state no terms \
     under which others may use it; dxc checks the same text as shader model 6.0";

pub(crate) fn run(args: &Doctor) -> Result<Verdict> {
    let adapters = bossage_embedded::adapters();
    let has_driver = adapters.iter().any(|info| !machine::is_embedded(info));
    let swiftshader = AdapterSelector::named("swiftshader");
    let report = Report {
        schema: 1,
        version: env!("CARGO_PKG_VERSION"),
        platform: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        cores: std::thread::available_parallelism().map_or(1, usize::from),
        how_to_get_an_adapter: (!has_driver).then_some(HOW_TO_GET_AN_ADAPTER),
        lacks_swiftshader: !adapters.iter().any(|info| swiftshader.matches(info)),
        adapters: adapters.iter().map(Adapter::from).collect(),
        cache: check::cache_folder(None).map(|folder| folder.display().to_string()),
        validators: external::detect(),
        routes: Route::ALL.map(|route| RouteState::of(route, has_driver)).into(),
    };
    if args.json {
        console::print_json(&report)?;
    } else {
        console::print(&report.text())?;
    }
    Ok(Verdict::Fine)
}

#[derive(Debug, Serialize)]
struct Report {
    schema: u32,
    version: &'static str,
    platform: String,
    cores: usize,
    adapters: Vec<Adapter>,
    /// Printed only: in JSON it shows by not being among the adapters.
    #[serde(skip)]
    lacks_swiftshader: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    how_to_get_an_adapter: Option<&'static str>,
    validators: Vec<Validator>,
    routes: Vec<RouteState>,
    cache: Option<String>,
}

/// An adapter as JSON has it.
#[derive(Debug, Serialize)]
pub(crate) struct Adapter {
    pub(crate) name: String,
    driver: String,
    driver_info: String,
    kind: &'static str,
    backend: String,
    llvm: Option<String>,
    cpu: String,
}

impl From<&AdapterInfo> for Adapter {
    fn from(info: &AdapterInfo) -> Self {
        Self {
            name: info.name.clone(),
            driver: info.driver.clone(),
            driver_info: info.driver_info.clone(),
            kind: info.kind.name(),
            backend: info.backend.clone(),
            llvm: info.llvm.clone(),
            cpu: info.cpu.clone(),
        }
    }
}

/// A route from emitted code to numbers, and why it cannot run here.
#[derive(Debug, Serialize)]
struct RouteState {
    route: Route,
    /// With the way to get what is missing; `None` where nothing is.
    reason: Option<String>,
}

impl RouteState {
    /// An adapter may still refuse a route that lacks nothing, which `conform` says.
    fn of(route: Route, has_driver: bool) -> Self {
        let needs_driver = !matches!(route, Route::Msl | Route::Embedded);
        let no_driver = (needs_driver && !has_driver).then(|| "no driver's adapter".to_owned());
        Self {
            route,
            reason: route.missing().or(no_driver),
        }
    }
}

impl Report {
    /// The routes that run, in one line, then each of the others with what it lacks.
    fn routes_text(&self) -> String {
        let heading = console::heading("Routes from emitted code to numbers (conform --route)");
        let enabled: Vec<String> = self
            .routes
            .iter()
            .filter(|one| one.reason.is_none())
            .map(|one| one.route.to_string())
            .collect();
        let mut text = format!(
            "\n{heading}\n{}  {}\n",
            console::good("ENABLED "),
            enabled.join(", ")
        );
        for one in &self.routes {
            if let Some(reason) = &one.reason {
                let disabled = console::faint("DISABLED");
                text.push_str(&format!("{disabled}  {}: {reason}\n", one.route));
            }
        }
        text
    }

    fn text(&self) -> String {
        let mut text = format!(
            "bossage {} on {}, {} cores\n\n",
            self.version, self.platform, self.cores
        );
        text.push_str(&format!(
            "{}\n",
            console::heading("Adapters (conform, render, bake --gpu, demo)")
        ));
        for adapter in &self.adapters {
            text.push_str(&format!(
                "{}  {} [{}, {}, {}]\n",
                console::good("ENABLED "),
                adapter.name,
                adapter.backend,
                adapter.kind,
                adapter.driver_info
            ));
        }
        if self.lacks_swiftshader {
            text.push_str(&format!(
                "{}  SwiftShader, a second driver: ./x setup --full fetches it\n",
                console::faint("DISABLED")
            ));
        }
        if let Some(how) = self.how_to_get_an_adapter {
            text.push_str(&format!(
                "{}  no driver's adapter: {how}\n",
                console::faint("DISABLED")
            ));
        }
        text.push_str(&format!(
            "\n{}\n",
            console::heading("External compilers (check, demo)")
        ));
        text.push_str(&check::banner(&self.validators));
        text.push_str(&format!("{}  {FXC}\n", console::faint("DISABLED")));
        let cache = self.cache.as_deref().unwrap_or("none: no home folder");
        text.push_str(&format!("\nTheir verdicts are kept in: {cache}\n"));
        text.push_str(&self.routes_text());
        text
    }
}
