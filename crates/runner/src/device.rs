//! An open adapter: features, limits, errors, and the caches of what was compiled for it.
//!
//! Every failure of the device ends in an [`Error`] of the job that met it: jobs run inside error scopes, what escapes
//! those (on other threads, or late) is kept and given to the next job, and a lost device fails every later job.

use std::sync::{Arc, Mutex, PoisonError};

use crate::adapter::{AdapterInfo, AdapterSelector};
use crate::cache::{CacheSizes, Caches};
use crate::error::Error;

/// An adapter, opened. It can be shared between threads.
#[derive(Debug)]
pub struct Device {
    info: AdapterInfo,
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    limits: wgpu::Limits,
    pub(crate) caches: Caches,
    trouble: Arc<Trouble>,
}

/// What the device said outside of any job's scopes.
#[derive(Debug, Default)]
struct Trouble {
    lost: Mutex<Option<String>>,
    uncaptured: Mutex<Vec<wgpu::Error>>,
}

/// What is asked for where the adapter has it; jobs that need one say so when it isn't there.
const WANTED: wgpu::Features = wgpu::Features::PASSTHROUGH_SHADERS
    .union(wgpu::Features::TIMESTAMP_QUERY)
    .union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS)
    .union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_PASSES)
    .union(wgpu::Features::FLOAT32_FILTERABLE)
    .union(wgpu::Features::FLOAT32_BLENDABLE)
    .union(wgpu::Features::TEXTURE_FORMAT_16BIT_NORM)
    // What users' shaders may store to, and what they may calculate with.
    .union(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES)
    .union(wgpu::Features::SHADER_F16)
    .union(wgpu::Features::SHADER_F64)
    .union(wgpu::Features::SHADER_INT64)
    .union(wgpu::Features::SUBGROUP)
    .union(wgpu::Features::IMMEDIATES);

impl Device {
    /// Opens the adapter that the selector takes, with all of its limits.
    ///
    /// # Errors
    /// [`Error::NoAdapter`], [`Error::NoSuchAdapter`] or [`Error::Open`].
    pub fn open(selector: &AdapterSelector) -> Result<Self, Error> {
        let (info, adapter) = crate::adapter::select(selector)?;
        let limits = adapter.limits();
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("bossage"),
            required_features: adapter.features() & WANTED,
            required_limits: limits.clone(),
            ..Default::default()
        };
        let opened = pollster::block_on(adapter.request_device(&descriptor));
        let (device, queue) = opened.map_err(|source| Error::Open {
            adapter: info.name.clone(),
            source,
        })?;
        let trouble = Arc::new(Trouble::default());
        listen(&device, &trouble);
        Ok(Self {
            info,
            device,
            queue,
            limits,
            caches: Caches::default(),
            trouble,
        })
    }

    /// Which adapter this is.
    #[must_use]
    pub fn info(&self) -> &AdapterInfo {
        &self.info
    }

    /// The adapter's limits.
    #[must_use]
    pub fn limits(&self) -> &wgpu::Limits {
        &self.limits
    }

    /// Whether the device writes timestamps.
    #[must_use]
    pub fn has_timestamps(&self) -> bool {
        self.has(wgpu::Features::TIMESTAMP_QUERY)
    }

    /// Whether SPIR-V can be passed through: whether the `spirv` route exists here.
    #[must_use]
    pub fn has_passthrough(&self) -> bool {
        self.has(wgpu::Features::PASSTHROUGH_SHADERS)
    }

    /// Whether textures of 32-bit floats can be filtered linearly.
    #[must_use]
    pub fn filters_floats(&self) -> bool {
        self.has(wgpu::Features::FLOAT32_FILTERABLE)
    }

    /// How much is cached. Modules and pipelines are kept until the device is dropped, by the whole of their code.
    #[must_use]
    pub fn cache_sizes(&self) -> CacheSizes {
        self.caches.sizes()
    }

    pub(crate) fn has(&self, feature: wgpu::Features) -> bool {
        self.device.features().contains(feature)
    }

    /// Fails when the device lacks the feature.
    pub(crate) fn require(&self, job: &str, feature: wgpu::Features, what: &str) -> Result<(), Error> {
        if self.has(feature) {
            return Ok(());
        }
        Err(Error::unsupported(job, &self.info.name, what))
    }

    /// Runs `work` so that every error of the device inside becomes an [`Error`] of this job. The device's own word goes
    /// before what `work` returns, since that is usually a consequence of it.
    pub(crate) fn scoped<T>(&self, job: &str, work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
        self.check_lost(job)?;
        let filters = [
            wgpu::ErrorFilter::Internal,
            wgpu::ErrorFilter::OutOfMemory,
            wgpu::ErrorFilter::Validation,
        ];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let result = work();
        // Scopes are a stack: the last pushed goes first.
        let caught: Vec<_> = scopes
            .into_iter()
            .rev()
            .filter_map(|scope| pollster::block_on(scope.pop()))
            .collect();
        self.check_lost(job)?;
        let escaped = std::mem::take(&mut *lock(&self.trouble.uncaptured));
        match caught.into_iter().chain(escaped).next() {
            Some(error) => Err(translate(job, &error)),
            None => result,
        }
    }

    fn check_lost(&self, job: &str) -> Result<(), Error> {
        match &*lock(&self.trouble.lost) {
            Some(message) => Err(Error::Lost {
                job: job.to_owned(),
                message: message.clone(),
            }),
            None => Ok(()),
        }
    }

    /// Waits until this submission is done.
    pub(crate) fn wait(&self, job: &str, submission: wgpu::SubmissionIndex) -> Result<(), Error> {
        let poll = wgpu::PollType::Wait {
            submission_index: Some(submission),
            timeout: None,
        };
        let waited = self.device.poll(poll);
        waited.map(|_| ()).map_err(|error| Error::Internal {
            job: job.to_owned(),
            message: error.to_string(),
        })
    }
}

fn listen(device: &wgpu::Device, trouble: &Arc<Trouble>) {
    let kept = Arc::clone(trouble);
    device.on_uncaptured_error(Arc::new(move |error| lock(&kept.uncaptured).push(error)));
    let kept = Arc::clone(trouble);
    device.set_device_lost_callback(move |reason, message| {
        // Dropping a device is no loss.
        if reason != wgpu::DeviceLostReason::Destroyed {
            *lock(&kept.lost) = Some(message);
        }
    });
}

/// A poisoned lock holds data that is as good as before: nothing here is left half-changed.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn translate(job: &str, error: &wgpu::Error) -> Error {
    let job = job.to_owned();
    match error {
        wgpu::Error::OutOfMemory { .. } => Error::OutOfMemory { job },
        wgpu::Error::Validation { description, .. } => Error::Validation {
            job,
            message: description.clone(),
        },
        wgpu::Error::Internal { description, .. } => Error::Internal {
            job,
            message: description.clone(),
        },
    }
}
