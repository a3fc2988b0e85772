//! An open adapter.

use crate::adapter::{AdapterInfo, AdapterSelector};
use crate::error::Error;

/// An adapter, opened. It can be shared between threads.
#[derive(Debug)]
pub struct Device {
    info: AdapterInfo,
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    features: wgpu::Features,
    limits: wgpu::Limits,
}

impl Device {
    /// Opens the adapter that the selector takes.
    ///
    /// # Errors
    /// [`Error::NoAdapter`], [`Error::NoSuchAdapter`] or [`Error::Open`].
    pub fn open(selector: &AdapterSelector) -> Result<Self, Error> {
        let (info, adapter) = crate::adapter::select(selector)?;
        let features = adapter.features();
        let limits = adapter.limits();
        let _ = (info, features, limits);
        Err(Error::NoAdapter)
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
}
