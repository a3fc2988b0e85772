//! The machine under test, and shaders as it takes them, under the names that the tests of every machine ask for.
#![allow(dead_code, reason = "each test file uses its own part")]
#![allow(clippy::print_stderr, reason = "a skip must be seen")]

use std::collections::BTreeMap;
use std::sync::OnceLock;

use bossage_metal::Metal;
use bossage_runner::{Code, Shader};
use bossage_translate::external::{self, Validator};
use bossage_translate::{EmitOptions, Manifest, Source, Target, emit, manifest};

/// The compilers that are here.
pub(crate) fn tools() -> &'static [Validator] {
    static FOUND: OnceLock<Vec<Validator>> = OnceLock::new();
    FOUND.get_or_init(external::detect)
}

/// The machine that all tests share. A missing clang fails where `BOSSAGE_REQUIRE` lists it; elsewhere the skip is printed.
pub(crate) fn device(test: &str) -> Option<&'static Metal> {
    static MACHINE: OnceLock<Option<Metal>> = OnceLock::new();
    let cache = external::cache_folder();
    let machine = MACHINE.get_or_init(|| Metal::new(tools(), cache.as_deref()).ok());
    if machine.is_none() {
        let list = std::env::var("BOSSAGE_REQUIRE").unwrap_or_default();
        assert!(
            !list.split(',').any(|name| name.trim() == "clang"),
            "clang is required"
        );
        eprintln!("SKIP 1 test: {test}: clang is DISABLED");
    }
    machine.as_ref()
}

/// A shader as MSL with its manifest, and as the WGSL that it came from.
pub(crate) struct Compiled {
    pub(crate) source: String,
    pub(crate) msl: BTreeMap<String, String>,
    pub(crate) manifest: Manifest,
}

/// Emits WGSL as MSL.
pub(crate) fn compile(wgsl: &str) -> Compiled {
    let options = EmitOptions::default();
    let shader = bossage_translate::Shader::parse("test", &Source::Wgsl(wgsl.to_owned()))
        .unwrap_or_else(|e| panic!("{e}"));
    let emitted = emit(&shader, Target::Msl, &options).unwrap_or_else(|e| panic!("{e}"));
    let text = |file: &bossage_translate::EmittedFile| {
        let text = file.contents.text().expect("MSL is text");
        (file.entry.clone(), text.to_owned())
    };
    Compiled {
        source: wgsl.to_owned(),
        msl: emitted.files.iter().map(text).collect(),
        manifest: manifest(&shader, &options, std::slice::from_ref(&emitted)),
    }
}

impl Compiled {
    pub(crate) fn msl(&self, entry: &str) -> Shader<'_> {
        Shader {
            code: Code::Msl(&self.msl[entry]),
            entry: self.manifest.entry(entry).expect("an entry"),
        }
    }

    /// For the evaluator.
    pub(crate) fn evaluated(&self, entry: &str) -> Shader<'_> {
        Shader {
            code: Code::Wgsl(&self.source),
            entry: self.manifest.entry(entry).expect("an entry"),
        }
    }

    /// What other machines take by the route `wgsl`.
    pub(crate) fn wgsl(&self, entry: &str) -> Shader<'_> {
        self.msl(entry)
    }

    /// What other machines take by the route `spirv`.
    pub(crate) fn spirv(&self, entry: &str) -> Shader<'_> {
        self.msl(entry)
    }

    pub(crate) fn both(&self, entry: &str) -> [Shader<'_>; 2] {
        [self.msl(entry), self.msl(entry)]
    }
}

/// The bits of floats, for comparisons that tell NaNs and zeros apart.
pub(crate) fn bits(floats: &[f32]) -> Vec<u32> {
    floats.iter().map(|value| value.to_bits()).collect()
}
