//! Where cases run: a device, a route, and the library's modules as that route prepares them.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use bossage_runner::Machine;
use bossage_shaders::{AssembledShader, Library};

use crate::route::{Prepared, Route};

/// An adapter and a route, with what has been prepared for them.
#[derive(Debug)]
pub struct Bench<'a> {
    /// What runs the shaders: a device, or the evaluator.
    pub device: &'a dyn Machine,
    /// The route.
    pub route: Route,
    /// The shaders.
    pub library: &'a Library,
    prepared: Mutex<BTreeMap<String, Arc<Prepared>>>,
}

impl<'a> Bench<'a> {
    /// A bench with nothing prepared yet.
    #[must_use]
    pub fn new(device: &'a dyn Machine, route: Route, library: &'a Library) -> Self {
        Self {
            device,
            route,
            library,
            prepared: Mutex::default(),
        }
    }

    /// The module of that key, prepared once.
    ///
    /// # Errors
    /// What the library or the translator says.
    pub fn module(
        &self,
        key: &str,
        assemble: impl FnOnce(&Library) -> bossage_shaders::Result<AssembledShader>,
    ) -> Result<Arc<Prepared>, String> {
        let mut prepared = self.prepared.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = prepared.get(key) {
            return Ok(Arc::clone(found));
        }
        let assembled = assemble(self.library).map_err(|error| error.to_string())?;
        let module = Arc::new(self.route.prepare(&assembled)?);
        prepared.insert(key.to_owned(), Arc::clone(&module));
        Ok(module)
    }
}
