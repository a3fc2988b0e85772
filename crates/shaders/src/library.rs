//! The library of shader sources.

use std::path::Path;

use crate::{FeatureSet, ProbeId, Result, Stage};

/// One plain WGSL module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AssembledShader {
    /// A stable name, safe as a file name.
    pub name: String,
    /// The text.
    pub wgsl: String,
    /// The features that were on, sorted.
    pub features: Vec<&'static str>,
    /// The source files that went in, root first.
    pub modules: Vec<String>,
}

/// A compute kernel of the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kernel {
    /// `height_to_normal_forward`, as published.
    HeightToNormalForwardPublished,
    /// `height_to_normal_forward`, hardened.
    HeightToNormalForward,
    /// `height_to_normal`, central differences.
    HeightToNormal,
    /// `frame_from_uv`, as published: one invocation a triangle.
    FrameFromUvTrianglesPublished,
    /// `frame_from_uv`, hardened: one invocation a triangle.
    FrameFromUvTriangles,
    /// `frame_from_uv`, as published: one invocation a vertex.
    FrameFromUvVerticesPublished,
    /// `frame_from_uv`, hardened: one invocation a vertex.
    FrameFromUvVertices,
}

/// The sources, read and parsed once.
#[derive(Debug)]
pub struct Library {}

impl Library {
    /// The sources built into this binary.
    pub fn embedded() -> Result<Self> {
        Ok(Library {})
    }

    /// The sources of a folder laid out as `/shaders`.
    pub fn from_dir(_dir: &Path) -> Result<Self> {
        Ok(Library {})
    }

    /// One stage of the surface shader for a feature set (taken in its canonical form).
    pub fn assemble_surface(&self, set: &FeatureSet, _stage: Stage) -> Result<AssembledShader> {
        Ok(AssembledShader { name: set.name(), wgsl: String::new(), features: Vec::new(), modules: Vec::new() })
    }

    /// The compute module that runs one function over arrays.
    pub fn assemble_probe(&self, id: ProbeId) -> Result<AssembledShader> {
        Ok(AssembledShader { name: id.to_string(), wgsl: String::new(), features: Vec::new(), modules: Vec::new() })
    }

    /// A bake or frame kernel.
    pub fn assemble_kernel(&self, _kernel: Kernel) -> Result<AssembledShader> {
        Ok(AssembledShader { name: String::new(), wgsl: String::new(), features: Vec::new(), modules: Vec::new() })
    }

    /// A user's own `.wesl` file with its imports, which are relative to the file's folder.
    pub fn assemble_user_file(&self, path: &Path) -> Result<AssembledShader> {
        Ok(AssembledShader { name: path.display().to_string(), wgsl: String::new(), features: Vec::new(), modules: Vec::new() })
    }
}
