//! Adapters with this one among them, and how one is chosen.

use bossage_runner::{AdapterInfo, AdapterSelector, Device, DeviceKind, Error, Machine, cpu_model};

use crate::machine::Embedded;

/// The name of this adapter.
pub const NAME: &str = "embedded";

/// What reports say of this adapter.
#[must_use]
pub fn info() -> AdapterInfo {
    AdapterInfo {
        name: NAME.to_owned(),
        driver: "bossage-bounds".to_owned(),
        driver_info: format!(
            "{} (no driver; f32, rounded to nearest)",
            env!("CARGO_PKG_VERSION")
        ),
        kind: DeviceKind::Cpu,
        backend: "evaluator".to_owned(),
        llvm: None,
        cpu: cpu_model(),
    }
}

/// Every adapter of this machine: those that drivers bring, sorted, and this one.
#[must_use]
pub fn adapters() -> Vec<AdapterInfo> {
    let mut all = bossage_runner::adapters();
    all.push(info());
    all
}

/// Opens the adapter that the selector takes: a driver's before this one, unless this one is named.
///
/// # Errors
/// [`Error::NoSuchAdapter`] or [`Error::NoAdapter`] when none is of that name, [`Error::Open`].
pub fn open(selector: &AdapterSelector) -> Result<Box<dyn Machine>, Error> {
    let named = matches!(selector, AdapterSelector::Named(text) if text.eq_ignore_ascii_case(NAME));
    if named {
        return Ok(Box::new(Embedded::new()));
    }
    let ours = || selector.matches(&info());
    match Device::open(selector) {
        Ok(device) => Ok(Box::new(device)),
        Err(Error::NoAdapter | Error::NoSuchAdapter { .. }) if ours() => Ok(Box::new(Embedded::new())),
        Err(Error::NoSuchAdapter { wanted, mut found }) => {
            found.push(NAME.to_owned());
            Err(Error::NoSuchAdapter { wanted, found })
        }
        Err(error) => Err(error),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_always_found_and_always_opens() {
        assert_eq!(adapters().last(), Some(&info()));
        let machine = open(&AdapterSelector::named("Embedded")).unwrap();
        assert_eq!(machine.info().name, NAME);
    }

    #[test]
    fn what_is_nowhere_is_an_error_of_the_environment() {
        let error = open(&AdapterSelector::named("no such thing")).unwrap_err();
        assert!(error.is_missing_environment(), "{error}");
    }
}
