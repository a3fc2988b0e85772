//! Shaders with their manifests, as GLSL.

use std::collections::BTreeMap;

use bossage_runner::{Code, Shader};
use bossage_translate::{Contents, EmitOptions, Manifest, Source, Target, emit, manifest};

/// A shader as GLSL, with its manifest.
pub(crate) struct Compiled {
    glsl: BTreeMap<String, String>,
    manifest: Manifest,
}

/// Emits WGSL as GLSL.
pub(crate) fn compile(wgsl: &str) -> Compiled {
    let shader =
        bossage_translate::Shader::parse("test", &Source::Wgsl(wgsl.to_owned())).expect("valid WGSL");
    let options = EmitOptions::default();
    let emitted = emit(&shader, Target::Glsl, &options).expect("emitted GLSL");
    let text = |file: &bossage_translate::EmittedFile| match &file.contents {
        Contents::Text(text) => (file.entry.clone(), text.clone()),
        Contents::Binary(_) => panic!("GLSL is text"),
    };
    Compiled {
        glsl: emitted.files.iter().map(text).collect(),
        manifest: manifest(&shader, &options, std::slice::from_ref(&emitted)),
    }
}

impl Compiled {
    /// Under the name that the tests of every machine ask for.
    pub(crate) fn wgsl(&self, entry: &str) -> Shader<'_> {
        Shader {
            code: Code::Glsl(&self.glsl[entry]),
            entry: self.manifest.entry(entry).expect("an entry"),
        }
    }

    pub(crate) fn both(&self, entry: &str) -> [Shader<'_>; 1] {
        [self.wgsl(entry)]
    }
}

/// The bits of floats, for comparisons that tell NaNs and zeros apart.
pub(crate) fn bits(floats: &[f32]) -> Vec<u32> {
    floats.iter().map(|value| value.to_bits()).collect()
}
