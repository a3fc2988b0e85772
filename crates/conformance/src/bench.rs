//! Where cases run: a device, a route, and the library's modules as that route prepares them.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use bossage_runner::Machine;
use bossage_shaders::Library;

use crate::module::Module;
use crate::route::{Fault, Prepared, Route};

/// An adapter and a route, with what has been prepared for them.
#[derive(Debug)]
pub struct Bench<'a> {
    /// What runs the shaders: a device, or the evaluator.
    pub device: &'a dyn Machine,
    /// The route.
    pub route: Route,
    /// The shaders.
    pub library: &'a Library,
    fault: Option<&'a Fault>,
    prepared: Mutex<BTreeMap<Module, Arc<Prepared>>>,
}

impl<'a> Bench<'a> {
    /// A bench with nothing prepared yet.
    #[must_use]
    pub fn new(device: &'a dyn Machine, route: Route, library: &'a Library) -> Self {
        Self {
            device,
            route,
            library,
            fault: None,
            prepared: Mutex::default(),
        }
    }

    /// The same with a fault in what its route emits, if it is one of that route.
    #[must_use]
    pub fn planted(self, fault: Option<&'a Fault>) -> Self {
        Self { fault, ..self }
    }

    /// That module, prepared once. A case asks for none that [`Case::modules`](crate::case::Case::modules) does not name.
    ///
    /// # Errors
    /// What the library or the translator says.
    pub fn module(&self, module: &Module) -> Result<Arc<Prepared>, String> {
        let mut prepared = self.prepared.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = prepared.get(module) {
            return Ok(Arc::clone(found));
        }
        let assembled = module.assemble(self.library).map_err(|error| error.to_string())?;
        let made = Arc::new(self.route.prepare_with(&assembled, self.fault)?);
        prepared.insert(*module, Arc::clone(&made));
        Ok(made)
    }

    /// The modules that were asked for so far and could be prepared, sorted.
    #[must_use]
    pub fn asked(&self) -> Vec<Module> {
        let prepared = self.prepared.lock().unwrap_or_else(PoisonError::into_inner);
        prepared.keys().copied().collect()
    }
}
