//! One lint of one function or kernel of the library.

use bossage_bounds::Program;
use bossage_bounds::lint::{self, Finding, Options, Report};
use bossage_bounds::ranges::{Declared, Inputs};
use bossage_shaders::{Kernel, Library, Probe};

use crate::domain::{ONE_VERTEX, sidecar};

/// A report, and the text that it is about.
pub(crate) struct Linted {
    pub(crate) text: String,
    pub(crate) report: Report,
}

impl Linted {
    /// The line a span starts on.
    pub(crate) fn line(&self, span: naga::Span) -> &str {
        let at = span.location(&self.text).line_number as usize;
        self.text.lines().nth(at - 1).unwrap_or("").trim()
    }

    /// All findings, a line each.
    pub(crate) fn told(&self) -> Vec<String> {
        let told = |f: &Finding| {
            let witness = f.witness.as_ref().map_or("no witness".to_owned(), |w| {
                format!("{} {:?}", w.operands, w.inputs)
            });
            format!("{} at `{}` ({witness})", f.rule.id(), self.line(f.span))
        };
        self.report.findings.iter().map(told).collect()
    }
}

/// The values of an input at a finding's witness: all inputs whose name begins so, in order.
pub(crate) fn witness(finding: &Finding, name: &str) -> Vec<f64> {
    let inputs = finding.witness.as_ref().map_or(&[][..], |w| &w.inputs[..]);
    let values: Vec<f64> = inputs
        .iter()
        .filter(|(n, _)| n.starts_with(name))
        .flat_map(|(_, values)| values.iter().copied())
        .collect();
    assert!(!values.is_empty(), "no input {name} in {inputs:?}");
    values
}

/// The assembled text of a function's probe.
pub(crate) fn text(library: &Library, probe: &Probe) -> String {
    let assembled = library.assemble_probe(probe.id);
    assembled.unwrap_or_else(|e| panic!("{e}")).wgsl
}

pub(crate) fn probe(library: &Library, probe: &Probe, options: &Options) -> Linted {
    of_text(probe.entry, text(library, probe), &sidecar(probe), options)
}

/// The assembled text of a kernel of one vertex, with the ranges of what it reads.
pub(crate) fn kernel_text(library: &Library, entry: &str) -> (String, String) {
    let mut kernels = Kernel::ALL.into_iter();
    let kernel = kernels
        .find(|k| k.entry() == entry)
        .unwrap_or_else(|| panic!("no kernel {entry}"));
    let text = library
        .assemble_kernel(kernel)
        .unwrap_or_else(|e| panic!("{e}"))
        .wgsl;
    // The published form sums the normals itself.
    let normals = if kernel == Kernel::FrameFromUvVertices {
        "normals = { size = 3 }\n\"normals[0..3]\" = { unit = true }\n"
    } else {
        "normals = { size = 3 }\n"
    };
    (text, format!("{ONE_VERTEX}{normals}"))
}

pub(crate) fn kernel(library: &Library, entry: &str, options: &Options) -> Linted {
    let (text, ranges) = kernel_text(library, entry);
    of_text(entry, text, &ranges, options)
}

/// A published function or kernel, by name.
pub(crate) fn published(library: &Library, name: &str, options: &Options) -> Linted {
    match Probe::find(name) {
        Some(found) => probe(library, found, options),
        None => kernel(library, name, options),
    }
}

pub(crate) fn of_text(entry: &str, text: String, sidecar: &str, options: &Options) -> Linted {
    let module =
        naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
    let flags = naga::valid::ValidationFlags::all();
    let info = naga::valid::Validator::new(flags, naga::valid::Capabilities::all())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
    let program = Program::new(&module, &info, entry).unwrap_or_else(|e| panic!("{e}"));
    let declared = Declared::parse(entry, sidecar).unwrap_or_else(|e| panic!("{e}"));
    let inputs = Inputs::new(&module, &info, entry, Some(&declared)).unwrap_or_else(|e| panic!("{e}"));
    let report = lint::lint(&program, &inputs, options);
    Linted { text, report }
}
