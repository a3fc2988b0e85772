//! What naga's writers are known to write wrongly, each reduced to a shader, with the text that shows it and the text that would be
//! right. What nothing here repairs comes out of [`emit`]; what comes of it when it runs stands in
//! `crates/conformance/src/deviation.rs`. What is repaired (`src/emit/sample_arguments.rs`) is shown by naga alone.
//!
//! A fault that is gone fails here: then its deviation or its repair has to go too.

mod support;

use bossage_translate::external::{CheckState, check};
use bossage_translate::{Contents, EmitOptions, Target, emit};
use support::{fixtures, tool, wgsl};

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

/// What is set right before it is emitted.
const REPAIRED: [Fault; 3] = [
    Fault {
        fixture: "gradient_of_cube.wgsl",
        target: Target::Msl,
        wrong: "sky.sample(linear, direction, metal::gradient2d(",
        right: "sky.sample(linear, direction, metal::gradientcube(",
    },
    Fault {
        fixture: "gradient_of_volume.wgsl",
        target: Target::Msl,
        wrong: "fog.sample(linear, place, metal::gradient2d(",
        right: "fog.sample(linear, place, metal::gradient3d(",
    },
    Fault {
        fixture: "offset_in_volume.wgsl",
        target: Target::Hlsl,
        wrong: ", int2(int3(int(1), int(0), int(-1))))",
        right: ", int3(int3(int(1), int(0), int(-1))))",
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

fn source(fault: &Fault) -> String {
    std::fs::read_to_string(fixtures().join("naga").join(fault.fixture)).unwrap()
}

fn emitted(fault: &Fault) -> String {
    let shader = wgsl(fault.fixture, &source(fault));
    let emitted = emit(&shader, fault.target, &EmitOptions::default()).unwrap();
    emitted.files[0].contents.text().unwrap().to_owned()
}

/// What naga writes by itself.
fn written(fault: &Fault) -> String {
    use naga::back::{hlsl, msl};
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    let module = naga::front::wgsl::parse_str(&source(fault)).unwrap();
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .unwrap();
    let mut text = String::new();
    match fault.target {
        Target::Msl => {
            let pipeline = msl::PipelineOptions::default();
            let written = msl::write_string(&module, &info, &msl::Options::default(), &pipeline);
            text = written.unwrap().0;
        }
        Target::Hlsl => {
            let (options, pipeline) = (hlsl::Options::default(), hlsl::PipelineOptions::default());
            let mut writer = hlsl::Writer::new(&mut text, &options, &pipeline);
            writer.write(&module, &info, None).unwrap();
        }
        Target::Spirv | Target::Glsl | Target::Wgsl => panic!("nothing is repaired there"),
    }
    text
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
fn every_repair_is_still_called_for() {
    for fault in &REPAIRED {
        assert_eq!(
            shows(fault, &written(fault)),
            Ok(true),
            "{}: cured? take its repair out of `src/emit/sample_arguments.rs`",
            fault.fixture
        );
        assert_eq!(shows(fault, &emitted(fault)), Ok(false), "{}", fault.fixture);
    }
}

/// The compiler of the language takes the repaired text and refuses what naga writes.
#[test]
fn compilers_tell_the_repaired_text_from_the_other() {
    for fault in &REPAIRED {
        let name = if fault.target == Target::Msl {
            "clang"
        } else {
            "dxc"
        };
        let Some(tools) = tool(name) else { continue };
        let shader = wgsl(fault.fixture, &source(fault));
        let options = EmitOptions::default();
        let mut emitted = emit(&shader, fault.target, &options).unwrap();
        for expected in [CheckState::Pass, CheckState::Fail] {
            let checked = check(&emitted, &options, &tools, None);
            assert_eq!(
                checked[0].state, expected,
                "{}: {}",
                fault.fixture, checked[0].message
            );
            let text = emitted.files[0].contents.text().unwrap();
            emitted.files[0].contents = Contents::Text(text.replace(fault.right, fault.wrong));
        }
    }
}

#[test]
fn a_cured_writer_is_seen() {
    let unrepaired = FAULTS.iter().map(|fault| (fault, emitted(fault)));
    let repaired = REPAIRED.iter().map(|fault| (fault, written(fault)));
    for (fault, text) in unrepaired.chain(repaired) {
        let cured = text.replace(fault.wrong, fault.right);
        assert_eq!(shows(fault, &cured), Ok(false), "{}", fault.fixture);
    }
}

#[test]
fn every_fixture_belongs_to_a_fault() {
    for entry in std::fs::read_dir(fixtures().join("naga")).unwrap() {
        let name = entry.unwrap().file_name();
        assert!(
            FAULTS
                .iter()
                .chain(&REPAIRED)
                .any(|fault| *fault.fixture == *name),
            "{name:?}"
        );
    }
}
