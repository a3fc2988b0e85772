//! The machine: jobs in, results out, programs compiled once.

use std::path::{Path, PathBuf};
use std::time::Duration;

use bossage_runner::{
    AdapterInfo, ComputeJob, ComputeOutput, DeviceKind, DispatchLimits, Error, Machine, RenderJob,
    RenderOutput, cpu_model,
};
use bossage_translate::external::{Limits, State, Validator};

use crate::compute;
use crate::program::Programs;
use crate::stages::Compiled;
use crate::tables::MAX_BUFFER_BYTES;

/// The name of this adapter.
pub const NAME: &str = "clang";

/// Workgroups of a dispatch along an axis: what WebGPU promises everywhere.
const MAX_WORKGROUPS: u32 = 65_535;

/// What one job may take.
const LIMITS: Limits = Limits {
    time: Duration::from_secs(60),
    memory_bytes: 8 << 30,
    // Each job knows how many it writes.
    output_bytes: 0,
};

/// A machine that compiles MSL to native code. It can be shared between threads.
#[derive(Debug)]
pub struct Metal {
    info: AdapterInfo,
    pub(crate) programs: Programs,
    pub(crate) limits: Limits,
    /// Where programs are kept that no cache keeps.
    _own: Option<tempfile::TempDir>,
}

/// What reports say of this adapter; `None` without a clang among the tools.
#[must_use]
pub fn info(tools: &[Validator]) -> Option<AdapterInfo> {
    let clang = tools
        .iter()
        .find(|tool| tool.tool == "clang" && tool.state == State::Enabled)?;
    let version = clang.version.clone()?;
    Some(AdapterInfo {
        name: NAME.to_owned(),
        driver: "bossage-metal".to_owned(),
        driver_info: format!("clang {version} (no driver; native code of the emitted MSL)"),
        kind: DeviceKind::Cpu,
        backend: "native".to_owned(),
        llvm: Some(version.split(' ').next().unwrap_or_default().to_owned()),
        cpu: cpu_model(),
    })
}

impl Metal {
    /// A machine over the clang among these tools. Programs are kept in the cache, or, without one, as long as the machine lives.
    ///
    /// # Errors
    /// Why not: there is no clang, with the way to get it.
    pub fn new(tools: &[Validator], cache: Option<&Path>) -> Result<Self, Error> {
        let open = |problem: String| Error::unsupported(NAME, NAME, problem);
        let reason = || {
            let clang = tools.iter().find(|tool| tool.tool == "clang");
            clang
                .and_then(|tool| tool.reason.clone())
                .unwrap_or_else(|| "clang".to_owned())
        };
        let info = info(tools).ok_or_else(|| open(reason()))?;
        let (folder, own): (PathBuf, _) = match cache {
            Some(folder) => (folder.to_owned(), None),
            None => {
                let own =
                    tempfile::tempdir().map_err(|error| open(format!("a folder for programs: {error}")))?;
                (own.path().to_owned(), Some(own))
            }
        };
        Ok(Self {
            info,
            programs: Programs::new(tools, &folder),
            limits: LIMITS,
            _own: own,
        })
    }

    /// The same with another limit on the time of one job.
    #[must_use]
    pub fn with_time_limit(mut self, time: Duration) -> Self {
        self.limits.time = time;
        self
    }
}

impl Machine for Metal {
    fn info(&self) -> &AdapterInfo {
        &self.info
    }

    fn dispatch_limits(&self) -> DispatchLimits {
        DispatchLimits {
            workgroups: MAX_WORKGROUPS,
            buffer_bytes: MAX_BUFFER_BYTES,
        }
    }

    fn compute(&self, job: &ComputeJob<'_>) -> Result<ComputeOutput, Error> {
        compute::run(self, job)
    }

    fn render(&self, job: &RenderJob<'_>) -> Result<RenderOutput, Error> {
        bossage_embedded::render(job, &|draw| Ok(Box::new(Compiled::new(self, job.name, draw)?)))
    }
}
