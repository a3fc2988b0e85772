//! Shaders with their manifests, as written and as emitted.

use std::collections::BTreeMap;

use bossage_runner::{Code, Shader};
use bossage_translate::{Contents, EmitOptions, Manifest, Source, Target, emit, manifest};

/// A shader as written and as emitted, with its manifest.
pub(crate) struct Compiled {
    wgsl: String,
    emitted: BTreeMap<String, String>,
    manifest: Manifest,
}

/// Emits WGSL as WGSL.
pub(crate) fn compile(wgsl: &str) -> Compiled {
    let shader =
        bossage_translate::Shader::parse("test", &Source::Wgsl(wgsl.to_owned())).expect("valid WGSL");
    let options = EmitOptions::default();
    let emitted = emit(&shader, Target::Wgsl, &options).expect("emitted WGSL");
    let text = |file: &bossage_translate::EmittedFile| match &file.contents {
        Contents::Text(text) => (file.entry.clone(), text.clone()),
        Contents::Binary(_) => panic!("WGSL is text"),
    };
    Compiled {
        wgsl: wgsl.to_owned(),
        emitted: emitted.files.iter().map(text).collect(),
        manifest: manifest(&shader, &options, std::slice::from_ref(&emitted)),
    }
}

impl Compiled {
    pub(crate) fn wgsl(&self, entry: &str) -> Shader<'_> {
        Shader {
            code: Code::Wgsl(&self.wgsl),
            entry: self.manifest.entry(entry).expect("an entry"),
        }
    }

    pub(crate) fn both(&self, entry: &str) -> [Shader<'_>; 2] {
        let emitted = Shader {
            code: Code::Wgsl(&self.emitted[entry]),
            entry: self.manifest.entry(entry).expect("an entry"),
        };
        [self.wgsl(entry), emitted]
    }
}

/// The bits of floats, for comparisons that tell NaNs and zeros apart.
pub(crate) fn bits(floats: &[f32]) -> Vec<u32> {
    floats.iter().map(|value| value.to_bits()).collect()
}
