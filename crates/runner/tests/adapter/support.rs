//! The adapter under test, and shaders with their manifests.

use std::collections::BTreeMap;
use std::io::Write;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use bossage_runner::{AdapterSelector, Code, Device, Error, Shader};
use bossage_translate::{EmitOptions, Manifest, Source, Target, emit, manifest};

static SKIPPED: AtomicUsize = AtomicUsize::new(0);

/// The device that all tests share, or `None` after saying that the test is skipped.
///
/// # Panics
/// Where there is none though `BOSSAGE_REQUIRE` lists `lavapipe`.
pub(crate) fn device(test: &str) -> Option<&'static Device> {
    static DEVICE: OnceLock<Result<Device, Error>> = OnceLock::new();
    match DEVICE.get_or_init(open) {
        Ok(device) => Some(device),
        Err(error) => {
            assert!(!required("lavapipe"), "lavapipe is required, but: {error}");
            skip(test, error);
            None
        }
    }
}

fn open() -> Result<Device, Error> {
    let lavapipe = Device::open(&AdapterSelector::named("lavapipe"));
    if lavapipe.is_ok() || required("lavapipe") {
        lavapipe
    } else {
        Device::open(&AdapterSelector::Any)
    }
}

fn required(tool: &str) -> bool {
    std::env::var("BOSSAGE_REQUIRE").is_ok_and(|list| list.split(',').any(|name| name.trim() == tool))
}

/// Says that a test is skipped, past the capture of the test harness, which would hide it since the test passes.
fn skip(test: &str, why: &Error) {
    let count = SKIPPED.fetch_add(1, Ordering::Relaxed) + 1;
    writeln!(std::io::stderr(), "SKIP {count}: {test}: {why}").expect("standard error can be written");
}

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
