//! What a run ran on: adapters with driver and LLVM, CPU, versions, and the settings that change results.

use std::collections::BTreeMap;

use bossage_runner::AdapterInfo;
use serde::Serialize;

use crate::machines::NotRun;

/// The workspace's lock file: the one place that knows the versions this was built from.
const LOCK: &str = include_str!("../../../Cargo.lock");

/// Packages whose version changes numbers or code.
const PACKAGES: [&str; 4] = ["naga", "wesl", "wgpu", "glam"];

/// An adapter, as the report has it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Adapter {
    /// The device's name.
    pub name: String,
    /// `cpu`, `discrete-gpu`, …
    pub kind: String,
    /// The graphics interface.
    pub backend: String,
    /// The driver and its version in its own words.
    pub driver: String,
    /// LLVM's version, of drivers that compile for a CPU.
    pub llvm: Option<String>,
}

/// What a run ran on.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Environment {
    /// Our version.
    pub bossage: String,
    /// Operating system and processor architecture.
    pub platform: String,
    /// The CPU's model.
    pub cpu: String,
    /// The adapters that ran.
    pub adapters: Vec<Adapter>,
    /// Versions of the packages that change numbers or code.
    pub versions: BTreeMap<String, String>,
    /// The seed of the random generators.
    pub seed: u64,
    /// Whether the full number of inputs ran.
    pub full: bool,
    /// Which part of the cases ran, as `2/4`.
    pub shard: Option<String>,
    /// Routes that no adapter runs, each with the reason.
    pub not_run: Vec<NotRun>,
    /// When, in UTC.
    pub time: String,
}

impl Environment {
    /// The environment of this process with the adapters that run.
    #[must_use]
    pub fn of(adapters: &[AdapterInfo]) -> Self {
        Self {
            bossage: env!("CARGO_PKG_VERSION").to_owned(),
            platform: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            cpu: adapters
                .first()
                .map_or_else(|| "unknown".to_owned(), |adapter| adapter.cpu.clone()),
            adapters: adapters.iter().map(Adapter::of).collect(),
            versions: versions(LOCK),
            time: jiff::Timestamp::now().strftime("%Y-%m-%dT%H:%M:%SZ").to_string(),
            ..Self::default()
        }
    }

    /// Name and value of each entry, for people.
    #[must_use]
    pub fn rows(&self) -> Vec<(String, String)> {
        let mut rows = vec![
            ("bossage".to_owned(), self.bossage.clone()),
            ("platform".to_owned(), self.platform.clone()),
            ("CPU".to_owned(), self.cpu.clone()),
        ];
        rows.extend(
            self.adapters
                .iter()
                .map(|adapter| (format!("adapter {}", adapter.name), adapter.describe())),
        );
        rows.extend(self.not_run.iter().map(|one| {
            let reason = format!("not run: {}", one.reason);
            let on = one.adapter.iter().map(|adapter| format!(" on {adapter}"));
            (format!("route {}{}", one.route, on.collect::<String>()), reason)
        }));
        rows.extend(
            self.versions
                .iter()
                .map(|(name, version)| (name.clone(), version.clone())),
        );
        rows.push(("seed".to_owned(), self.seed.to_string()));
        rows.push((
            "inputs".to_owned(),
            if self.full { "full run" } else { "ordinary run" }.to_owned(),
        ));
        rows.extend(self.shard.iter().map(|shard| ("part".to_owned(), shard.clone())));
        rows.push(("time".to_owned(), self.time.clone()));
        rows
    }
}

impl Adapter {
    fn of(info: &AdapterInfo) -> Self {
        Self {
            name: info.name.clone(),
            kind: info.kind.name().to_owned(),
            backend: info.backend.clone(),
            driver: format!("{} {}", info.driver, info.driver_info),
            llvm: info.llvm.clone(),
        }
    }

    fn describe(&self) -> String {
        let llvm = self
            .llvm
            .as_ref()
            .map(|version| format!(", LLVM {version}"))
            .unwrap_or_default();
        format!("{}, {}, {}{llvm}", self.kind, self.backend, self.driver)
    }
}

/// The versions of [`PACKAGES`] in a lock file.
fn versions(lock: &str) -> BTreeMap<String, String> {
    let value = |line: &str, key: &str| {
        let rest = line.strip_prefix(key)?.strip_prefix(" = \"")?;
        rest.strip_suffix('"').map(str::to_owned)
    };
    let mut found = BTreeMap::new();
    let mut package = String::new();
    for line in lock.lines() {
        if let Some(name) = value(line, "name") {
            package = name;
        } else if let Some(version) = value(line, "version").filter(|_| PACKAGES.contains(&package.as_str()))
        {
            found.insert(package.clone(), version);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{LOCK, PACKAGES, versions};

    #[test]
    fn every_package_has_its_version() {
        let found = versions(LOCK);
        assert_eq!(found.len(), PACKAGES.len(), "{found:?}");
        assert!(found.values().all(|version| version.contains('.')));
    }
}
