//! Shaders with their manifests, in the language that the machine takes.

use std::collections::BTreeMap;

use bossage_runner::{Code, Shader};
use bossage_translate::{EmitOptions, Manifest, Source, Target, emit, manifest};

use crate::machine::TESTED;

/// A shader as written and as emitted, with its manifest.
pub(crate) struct Compiled {
    wgsl: String,
    emitted: BTreeMap<String, String>,
    manifest: Manifest,
}

/// Emits WGSL in the language of the machine.
pub(crate) fn compile(wgsl: &str) -> Compiled {
    let shader =
        bossage_translate::Shader::parse("test", &Source::Wgsl(wgsl.to_owned())).expect("valid WGSL");
    let options = EmitOptions::default();
    let emitted = emit(&shader, TESTED.target, &options).expect("it can be emitted");
    let text = |file: &bossage_translate::EmittedFile| {
        let text = file.contents.text().expect("these languages are text");
        (file.entry.clone(), text.to_owned())
    };
    Compiled {
        wgsl: wgsl.to_owned(),
        emitted: emitted.files.iter().map(text).collect(),
        manifest: manifest(&shader, &options, std::slice::from_ref(&emitted)),
    }
}

/// A text as code in the language of the machine.
pub(crate) fn code(text: &str) -> Code<'_> {
    match TESTED.target {
        Target::Wgsl => Code::Wgsl(text),
        Target::Glsl => Code::Glsl(text),
        other => panic!("no machine of these takes {other}"),
    }
}

impl Compiled {
    /// Under the name that the tests of every machine ask for.
    pub(crate) fn wgsl(&self, entry: &str) -> Shader<'_> {
        self.with(entry, self.text(entry))
    }

    /// The text that goes in: as it was written, where the machine takes that.
    pub(crate) fn text(&self, entry: &str) -> &str {
        match TESTED.target {
            Target::Wgsl => &self.wgsl,
            _ => &self.emitted[entry],
        }
    }

    /// Another text with this shader's manifest.
    pub(crate) fn with<'a>(&'a self, entry: &str, text: &'a str) -> Shader<'a> {
        Shader {
            code: code(text),
            entry: self.manifest.entry(entry).expect("an entry"),
        }
    }

    /// As written, where the machine takes that, and as emitted.
    pub(crate) fn both(&self, entry: &str) -> Vec<Shader<'_>> {
        let mut all = vec![self.wgsl(entry)];
        if TESTED.target == Target::Wgsl {
            all.push(self.with(entry, &self.emitted[entry]));
        }
        all
    }
}

/// The bits of floats, for comparisons that tell NaNs and zeros apart.
pub(crate) fn bits(floats: &[f32]) -> Vec<u32> {
    floats.iter().map(|value| value.to_bits()).collect()
}
