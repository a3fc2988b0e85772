//! Shaders with their manifests, for both routes.

use std::collections::BTreeMap;

use bossage_runner::{Code, Shader};
use bossage_translate::{EmitOptions, Manifest, Source, Target, emit, manifest};

/// A shader in both routes, with its manifest.
pub(crate) struct Compiled {
    wgsl: String,
    spirv: BTreeMap<String, Vec<u8>>,
    manifest: Manifest,
}

/// Compiles WGSL for both routes.
pub(crate) fn compile(wgsl: &str) -> Compiled {
    compile_with(wgsl, &EmitOptions::default())
}

/// Compiles WGSL for both routes, with options for the emitted SPIR-V.
pub(crate) fn compile_with(wgsl: &str, options: &EmitOptions) -> Compiled {
    let shader =
        bossage_translate::Shader::parse("test", &Source::Wgsl(wgsl.to_owned())).expect("valid WGSL");
    let emitted = emit(&shader, Target::Spirv, options).expect("emitted SPIR-V");
    let bytes = |file: &bossage_translate::EmittedFile| (file.entry.clone(), file.contents.bytes().to_vec());
    Compiled {
        wgsl: wgsl.to_owned(),
        spirv: emitted.files.iter().map(bytes).collect(),
        manifest: manifest(&shader, options, std::slice::from_ref(&emitted)),
    }
}

impl Compiled {
    pub(crate) fn wgsl(&self, entry: &str) -> Shader<'_> {
        Shader {
            code: Code::Wgsl(&self.wgsl),
            entry: self.manifest.entry(entry).expect("an entry"),
        }
    }

    pub(crate) fn spirv(&self, entry: &str) -> Shader<'_> {
        Shader {
            code: Code::Spirv(&self.spirv[entry]),
            entry: self.manifest.entry(entry).expect("an entry"),
        }
    }

    pub(crate) fn both(&self, entry: &str) -> [Shader<'_>; 2] {
        [self.wgsl(entry), self.spirv(entry)]
    }
}

/// The bits of floats, for comparisons that tell NaNs and zeros apart.
pub(crate) fn bits(floats: &[f32]) -> Vec<u32> {
    floats.iter().map(|value| value.to_bits()).collect()
}
