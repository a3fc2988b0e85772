//! Cases of compute kernels, which are run and judged as a whole.

use bossage_shaders::Kernel;

use crate::bench::Bench;
use crate::case::{Case, Outcome};
use crate::case_id::CaseId;
use crate::module::Module;
use crate::oracle;

/// One of them.
pub(super) trait KernelCase: Send + Sync {
    /// Its name.
    fn id(&self) -> &CaseId;

    /// The oracles that judge it.
    fn basis(&self) -> Vec<&'static str>;

    /// The kernels that it runs.
    fn kernels(&self) -> Vec<Kernel>;

    /// Runs and judges it.
    ///
    /// # Errors
    /// Why it could not be run, which fails the case.
    fn judge(&self, bench: &Bench<'_>) -> Result<Outcome, String>;
}

impl<T: KernelCase> Case for T {
    fn id(&self) -> &CaseId {
        KernelCase::id(self)
    }

    fn basis(&self) -> Vec<&'static str> {
        KernelCase::basis(self)
    }

    fn modules(&self) -> Result<Vec<Module>, String> {
        Ok(self.kernels().into_iter().map(Module::Kernel).collect())
    }

    fn run(&self, bench: &Bench<'_>) -> Outcome {
        self.judge(bench).unwrap_or_else(Outcome::failed)
    }
}

/// The oracle of a kernel that makes what the CPU makes as well.
pub(super) const TWIN: &str = "twin on the CPU";

/// The twin, and the oracles of all functions.
pub(super) fn twin_and_rules() -> Vec<&'static str> {
    std::iter::once(TWIN).chain(oracle::BASIS).collect()
}
