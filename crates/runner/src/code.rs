//! The code of a shader in the form in which it is handed over: the route it takes to the driver.

use bossage_translate::Stage;
use bossage_translate::manifest::{Binding, Entry};

use crate::error::Error;

/// Shader code, by route.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Code<'a> {
    /// Route `wgsl`: wgpu's own compiler (naga) makes the driver's code of it, with bounds checks and loop bounds.
    Wgsl(&'a str),
    /// Route `spirv`: the bytes of an emitted module, passed to the driver unseen.
    Spirv(&'a [u8]),
    /// Emitted GLSL, for machines that take it: a [`Device`](crate::Device) does not.
    Glsl(&'a str),
    /// Route `msl`: the emitted text of one entry point. No driver here takes it; a machine that compiles it does.
    Msl(&'a str),
}

impl Code<'_> {
    /// The route's name in reports.
    #[must_use]
    pub fn route(&self) -> &'static str {
        match self {
            Self::Wgsl(_) => "wgsl",
            Self::Spirv(_) => "spirv",
            Self::Glsl(_) => "glsl",
            Self::Msl(_) => "msl",
        }
    }

    /// The bytes of the code.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        match self {
            Self::Wgsl(text) | Self::Glsl(text) | Self::Msl(text) => text.as_bytes(),
            Self::Spirv(bytes) => bytes,
        }
    }
}

/// An entry point to run: its code, and what its manifest says that it binds, reads and writes.
///
/// Nothing but the manifest decides how the code is bound, so a wrong manifest shows as a failure or a wrong result.
#[derive(Clone, Copy, Debug)]
pub struct Shader<'a> {
    /// The code.
    pub code: Code<'a>,
    /// The entry point's part of the manifest.
    pub entry: &'a Entry,
}

impl<'a> Shader<'a> {
    /// The binding of that name.
    #[must_use]
    pub fn binding(&self, name: &str) -> Option<&Binding> {
        self.entry.bindings.iter().find(|binding| binding.name == name)
    }

    /// Checks that it is of that stage.
    ///
    /// # Errors
    /// [`Error::Interface`].
    pub fn expect(&self, stage: Stage) -> Result<(), Error> {
        if self.entry.stage == stage {
            return Ok(());
        }
        let problem = format!("it is a {} shader, not a {stage} shader", self.entry.stage);
        Err(Error::misfit(self.entry, &self.entry.name, problem))
    }

    /// What the entry point is called in this code. WGSL is either the source, with the source's name, or emitted, with the
    /// name that the manifest states for it.
    #[must_use]
    pub fn entry_point(&self) -> &'a str {
        let emitted = self
            .entry
            .entry_points
            .get(self.code.route())
            .unwrap_or(&self.entry.name);
        match self.code {
            Code::Wgsl(text) if !defines(text, emitted) => &self.entry.name,
            Code::Wgsl(_) | Code::Spirv(_) | Code::Glsl(_) | Code::Msl(_) => emitted,
        }
    }

    /// Where a binding is in this code: (group, binding).
    #[must_use]
    pub fn place(&self, binding: &Binding) -> (u32, u32) {
        match (self.code, binding.spirv) {
            (Code::Spirv(_), Some(slot)) => (slot.set, slot.binding),
            (Code::Spirv(_), None) | (Code::Wgsl(_) | Code::Glsl(_) | Code::Msl(_), _) => {
                (binding.group, binding.binding)
            }
        }
    }
}

/// Whether WGSL text holds a function of that name.
fn defines(text: &str, name: &str) -> bool {
    let starts = text.match_indices(name).map(|(at, _)| at);
    starts.into_iter().any(|at| {
        let before = text[..at].trim_end();
        let after = text[at + name.len()..].trim_start();
        before.ends_with("fn") && after.starts_with('(') && before.len() < at
    })
}

#[cfg(test)]
mod tests {
    use super::defines;

    #[test]
    fn a_function_is_told_from_a_longer_name_and_a_call() {
        let text = "fn main_(a: f32) {}\nfn other() { main(1.0); }\nfn  main2 () {}";
        assert!(defines(text, "main_"));
        assert!(defines(text, "main2"));
        assert!(!defines(text, "main"));
        assert!(!defines("fnmain()", "main"));
    }
}
