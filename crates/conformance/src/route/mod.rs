//! Routes: the ways from an assembled shader to results. One file a route.
//!
//! A route turns the library's WGSL into what it hands to the driver, so that what is judged is what users get; `embedded` needs
//! none. Routes of other languages hand the emitted text to a compiler of others and what that makes of it to the driver.

mod compiled;
mod embedded;
mod fault;
mod glsl;
mod hlsl;
mod msl;
pub(crate) mod opengl;
mod remote;
mod spirv;
pub(crate) mod tint;
pub(crate) mod tools;
mod wgsl;

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;
use std::sync::{Arc, Mutex, PoisonError};

use bossage_bounds::Program;
use bossage_runner::{AdapterInfo, Code, Shader};
use bossage_shaders::AssembledShader;
use bossage_translate::manifest::Entry;
use bossage_translate::{Manifest, Source};
use serde::Serialize;

use crate::case::with_causes;
use crate::error::Error;

pub use fault::Fault;

/// A way from an assembled shader to results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Route {
    /// The text, compiled by wgpu (naga), with its bounds checks.
    Wgsl,
    /// The emitted SPIR-V file, passed through to Vulkan unseen.
    Spirv,
    /// The emitted HLSL text, compiled by DXC: as DXIL, which its validator must accept, and as SPIR-V, which runs on Vulkan.
    Hlsl,
    /// The emitted GLSL text, compiled by glslang as SPIR-V, which runs on Vulkan.
    Glsl,
    /// The emitted GLSL text, compiled and run by OpenGL.
    Opengl,
    /// The emitted WGSL text, compiled by Tint and run by Dawn.
    Tint,
    /// The emitted MSL text, compiled by clang as native code, which runs in processes of its own.
    Msl,
    /// The text, evaluated by `bounds` in f32, without a driver.
    Embedded,
}

impl Route {
    /// All routes, in the order of the reports.
    pub const ALL: [Self; 8] = [
        Self::Wgsl,
        Self::Spirv,
        Self::Hlsl,
        Self::Glsl,
        Self::Opengl,
        Self::Tint,
        Self::Msl,
        Self::Embedded,
    ];

    /// The name on the command line and in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Wgsl => "wgsl",
            Self::Spirv => "spirv",
            Self::Hlsl => "hlsl",
            Self::Glsl => "glsl",
            Self::Opengl => "opengl",
            Self::Tint => "tint",
            Self::Msl => "msl",
            Self::Embedded => "embedded",
        }
    }

    /// Whether that adapter may run this route; it may still [refuse](Self::refused_by).
    #[must_use]
    pub fn runs_on(self, info: &AdapterInfo) -> bool {
        let is_embedded = info.name == bossage_embedded::NAME;
        let is_clang = info.name == bossage_metal::NAME;
        match self {
            Self::Wgsl | Self::Spirv | Self::Hlsl | Self::Glsl | Self::Opengl | Self::Tint => {
                !is_embedded && !is_clang
            }
            Self::Msl => is_clang,
            Self::Embedded => is_embedded,
        }
    }

    /// Whether it runs in a process of its own, with a machine of its own.
    #[must_use]
    pub const fn is_remote(self) -> bool {
        matches!(self, Self::Opengl | Self::Tint)
    }

    /// The compiler of others that this route needs.
    #[must_use]
    pub const fn tool(self) -> Option<&'static str> {
        match self {
            Self::Wgsl | Self::Spirv | Self::Embedded => None,
            Self::Hlsl => Some("dxc"),
            Self::Glsl => Some("glslangValidator"),
            Self::Opengl => Some(opengl::TOOL),
            Self::Tint => Some(tint::TOOL),
            Self::Msl => Some("clang"),
        }
    }

    /// Why this route cannot run on this computer, whatever the adapter: its compiler is missing. With the way to get it.
    #[must_use]
    pub fn missing(self) -> Option<String> {
        match self {
            Self::Opengl => opengl::missing(),
            _ => self.tool().and_then(tools::missing),
        }
    }

    /// Why that adapter does not run this route after all; `None` where it does.
    #[must_use]
    pub fn refused_by(self, info: &AdapterInfo) -> Option<String> {
        match self {
            Self::Opengl => opengl::refuses(info),
            Self::Tint => tint::refuses(info),
            Self::Wgsl | Self::Spirv | Self::Hlsl | Self::Glsl | Self::Msl | Self::Embedded => None,
        }
    }

    /// Makes what this route hands to the driver.
    ///
    /// # Errors
    /// What the translator says, as it shows it to people.
    pub fn prepare(self, assembled: &AssembledShader) -> Result<Prepared, String> {
        self.prepare_with(assembled, None)
    }

    /// As [`Self::prepare`], with a fault in what is emitted, if it is one of this route.
    ///
    /// # Errors
    /// As [`Self::prepare`], and when the fault finds no place.
    pub fn prepare_with(
        self,
        assembled: &AssembledShader,
        fault: Option<&Fault>,
    ) -> Result<Prepared, String> {
        let fault = fault.filter(|fault| fault.route == self);
        let shader = bossage_translate::Shader::parse(&assembled.name, &Source::Wgsl(assembled.wgsl.clone()))
            .map_err(|diagnostic| diagnostic.to_string())?;
        match self {
            Self::Wgsl => wgsl::prepare(shader, assembled, fault),
            Self::Spirv => spirv::prepare(shader, fault),
            Self::Hlsl => hlsl::prepare(shader, fault),
            Self::Glsl => glsl::prepare(shader, fault),
            Self::Opengl => opengl::prepare(shader, fault),
            Self::Tint => tint::prepare(shader, fault),
            Self::Msl => msl::prepare(shader, fault),
            Self::Embedded => embedded::prepare(shader, assembled, fault),
        }
    }
}

impl fmt::Display for Route {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Route {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let found = Self::ALL.into_iter().find(|route| route.name() == text);
        found.ok_or_else(|| Error::NoSuchRoute {
            given: text.to_owned(),
            known: Self::ALL.map(Self::name).to_vec(),
        })
    }
}

/// A module as a route hands it to the driver, and as `bounds` evaluates it.
#[derive(Debug)]
pub struct Prepared {
    /// What each entry point binds, reads and writes.
    pub manifest: Manifest,
    code: Vec<(String, Text)>,
    /// The assembled WGSL, read and validated: every route starts here.
    source: bossage_translate::Shader,
    programs: Mutex<BTreeMap<String, Arc<Program>>>,
}

/// One entry point's code.
#[derive(Clone, Debug)]
enum Text {
    Wgsl(String),
    Spirv(Vec<u8>),
    Glsl(String),
    Msl(String),
}

impl Prepared {
    fn new(source: bossage_translate::Shader, manifest: Manifest, code: Vec<(String, Text)>) -> Self {
        Self {
            manifest,
            code,
            source,
            programs: Mutex::default(),
        }
    }

    /// A file of SPIR-V as it is, for the route that passes it through.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn of_spirv(name: &str, bytes: &[u8]) -> Result<Self, String> {
        spirv::as_it_is(name, bytes)
    }

    /// The assembled WGSL: what is computed from it once may serve as long as this is the same.
    #[must_use]
    pub fn text(&self) -> &str {
        self.source.text()
    }

    /// The IR of the entry point of that name, compiled once for `bounds`: the very module that every route starts from.
    ///
    /// # Errors
    /// When the module lacks it, or `bounds` leaves out something that it needs.
    pub fn program(&self, entry: &str) -> Result<Arc<Program>, String> {
        let mut programs = self.programs.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = programs.get(entry) {
            return Ok(Arc::clone(found));
        }
        let (module, info) = self
            .source
            .module(entry)
            .ok_or_else(|| format!("the module has no entry point `{entry}`"))?;
        let program = Program::new(module, info, entry).map_err(|error| {
            format!(
                "no interval can be derived for `{entry}`: {}",
                with_causes(&error)
            )
        })?;
        let program = Arc::new(program);
        programs.insert(entry.to_owned(), Arc::clone(&program));
        Ok(program)
    }

    /// What the manifest says of the entry point of that name.
    ///
    /// # Errors
    /// When it lacks it.
    pub fn entry(&self, name: &str) -> Result<&Entry, String> {
        self.manifest
            .entry(name)
            .ok_or_else(|| format!("the manifest has no entry point `{name}`"))
    }

    /// The entry point of that name, ready to run.
    ///
    /// # Errors
    /// When the module lacks it.
    pub fn shader(&self, entry: &str) -> Result<Shader<'_>, String> {
        let described = self.entry(entry)?;
        let found = self.code.iter().find(|(name, _)| name == entry);
        let (_, text) = found.ok_or_else(|| format!("no code was made for entry point `{entry}`"))?;
        let code = match text {
            Text::Wgsl(text) => Code::Wgsl(text),
            Text::Spirv(bytes) => Code::Spirv(bytes),
            Text::Glsl(text) => Code::Glsl(text),
            Text::Msl(text) => Code::Msl(text),
        };
        Ok(Shader {
            code,
            entry: described,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Route;

    #[test]
    fn names_read_back() {
        for route in Route::ALL {
            assert_eq!(route.name().parse::<Route>().unwrap(), route);
        }
        let message = "spriv".parse::<Route>().unwrap_err().to_string();
        assert_eq!(
            message,
            "no route is called `spriv`; there are: wgsl, spirv, hlsl, glsl, opengl, tint, msl, embedded"
        );
    }
}
