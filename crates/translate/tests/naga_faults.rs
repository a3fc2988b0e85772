//! What naga's writers are known to write wrongly and nothing here repairs: each reduced to a shader, with the text that shows it and
//! the text that would be right. What comes of them when they run stands in `crates/conformance/src/deviation.rs`.
//!
//! A fault that is gone fails here: then its entry there has to go too.

mod support;

use bossage_translate::{EmitOptions, Target, emit};
use support::{fixtures, wgsl};

/// A fault of a writer.
struct Fault {
    /// The reduced shader.
    fixture: &'static str,
    target: Target,
    /// What is written.
    wrong: &'static str,
    /// What would say the same as the source.
    right: &'static str,
}

const FAULTS: [Fault; 4] = [
    Fault {
        fixture: "sign_as_bits.wgsl",
        target: Target::Hlsl,
        wrong: "asuint(sign(",
        right: "asuint(float(sign(",
    },
    Fault {
        fixture: "conversion_unclamped.wgsl",
        target: Target::Glsl,
        wrong: "= int(_e",
        right: "= int(clamp(_e",
    },
    Fault {
        fixture: "conversion_unclamped.wgsl",
        target: Target::Glsl,
        wrong: "= uint(_e",
        right: "= uint(clamp(_e",
    },
    Fault {
        fixture: "remainder_of_negative.wgsl",
        target: Target::Glsl,
        wrong: "(dividend % divisor)",
        right: "naga_mod(dividend, divisor)",
    },
];

/// Whether an emitted text shows the fault; neither or both means that the writer has changed, and a person has to look.
fn shows(fault: &Fault, text: &str) -> Result<bool, String> {
    match (text.contains(fault.wrong), text.contains(fault.right)) {
        (true, false) => Ok(true),
        (false, true) => Ok(false),
        _ => Err(format!("neither form, or both, in\n{text}")),
    }
}

fn emitted(fault: &Fault) -> String {
    let text = std::fs::read_to_string(fixtures().join("naga").join(fault.fixture)).unwrap();
    let shader = wgsl(fault.fixture, &text);
    let emitted = emit(&shader, fault.target, &EmitOptions::default()).unwrap();
    emitted.files[0].contents.text().unwrap().to_owned()
}

#[test]
fn every_known_fault_still_shows() {
    for fault in &FAULTS {
        let showing = shows(fault, &emitted(fault));
        assert_eq!(
            showing,
            Ok(true),
            "{}: cured? take its entry out of the deviations",
            fault.fixture
        );
    }
}

#[test]
fn a_cured_writer_is_seen() {
    for fault in &FAULTS {
        let cured = emitted(fault).replace(fault.wrong, fault.right);
        assert_eq!(shows(fault, &cured), Ok(false), "{}", fault.fixture);
    }
}

#[test]
fn every_fixture_belongs_to_a_fault() {
    for entry in std::fs::read_dir(fixtures().join("naga")).unwrap() {
        let name = entry.unwrap().file_name();
        assert!(FAULTS.iter().any(|fault| *fault.fixture == *name), "{name:?}");
    }
}
