//! What was compiled for a device, kept so that thousands of small jobs compile each shader once.
//!
//! Modules are found by the whole of their code, not by a hash alone: a collision would run the wrong shader. Two threads
//! that need the same thing at once may both make it; one of the two is kept.

use std::collections::HashMap;
use std::hash::Hash;
use std::sync::Mutex;

use crate::device::lock;
use crate::error::Error;

/// How many things a device's caches hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CacheSizes {
    /// Shader modules.
    pub modules: usize,
    /// Pipeline layouts.
    pub layouts: usize,
    /// Compute and render pipelines.
    pub pipelines: usize,
}

/// A table that makes what it lacks.
#[derive(Debug)]
pub(crate) struct Cache<K, V>(Mutex<HashMap<K, V>>);

impl<K, V> Default for Cache<K, V> {
    fn default() -> Self {
        Self(Mutex::new(HashMap::new()))
    }
}

impl<K: Eq + Hash, V: Clone> Cache<K, V> {
    /// The value of `key`, made and kept where it is new. A failure is not kept.
    pub(crate) fn get(&self, key: K, make: impl FnOnce(&K) -> Result<V, Error>) -> Result<V, Error> {
        if let Some(value) = lock(&self.0).get(&key) {
            return Ok(value.clone());
        }
        // Made without the lock: compiling takes long.
        let value = make(&key)?;
        Ok(lock(&self.0).entry(key).or_insert(value).clone())
    }

    fn len(&self) -> usize {
        lock(&self.0).len()
    }
}

/// The code of a module, and its route.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct ModuleKey {
    pub(crate) route: &'static str,
    pub(crate) code: Box<[u8]>,
}

/// The layouts of a pipeline's groups.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    pub(crate) groups: Vec<Option<wgpu::BindGroupLayout>>,
    pub(crate) pipeline: wgpu::PipelineLayout,
}

/// The entries of each group, and the bytes of push constants.
pub(crate) type LayoutKey = (Vec<Vec<wgpu::BindGroupLayoutEntry>>, u32);

/// One stage of a pipeline.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct StageKey {
    pub(crate) module: wgpu::ShaderModule,
    pub(crate) entry: String,
}

/// Everything that a device keeps.
#[derive(Debug, Default)]
pub(crate) struct Caches {
    pub(crate) modules: Cache<ModuleKey, wgpu::ShaderModule>,
    pub(crate) layouts: Cache<LayoutKey, Layout>,
    pub(crate) compute: Cache<(StageKey, wgpu::PipelineLayout), wgpu::ComputePipeline>,
    pub(crate) render: Cache<crate::pipeline::RenderKey, wgpu::RenderPipeline>,
}

impl Caches {
    pub(crate) fn sizes(&self) -> CacheSizes {
        CacheSizes {
            modules: self.modules.len(),
            layouts: self.layouts.len(),
            pipelines: self.compute.len() + self.render.len(),
        }
    }
}
