//! Every fixture in every version of every language: emitted and accepted by an independent compiler, or refused with a
//! place, exactly as the table says.

mod support;

use std::collections::BTreeSet;

use bossage_translate::emit::spirv_listing;
use bossage_translate::external::{CheckState, check};
use bossage_translate::manifest::Entry;
use bossage_translate::{
    BoundsChecks, Code, Contents, EmitOptions, Emitted, GlslVersion, Shader, ShaderModel, Source, Target,
    emit, manifest,
};
use support::{good, shader, tool, wgsl};

/// What a GLSL version refuses, and the line that it must point at.
const REFUSED: [(&str, &str, u32); 8] = [
    // No compute shaders, no storage.
    ("compute.wgsl", "330", 6),
    ("compute.wgsl", "es300", 6),
    ("functions.wgsl", "330", 2),
    ("functions.wgsl", "es300", 2),
    ("overrides.wgsl", "330", 8),
    ("overrides.wgsl", "es300", 8),
    ("numbers.wgsl", "330", 18),
    ("numbers.wgsl", "es300", 18),
];

fn assert_accepted(emitted: &Emitted, options: &EmitOptions, tool_name: &str) {
    let Some(tools) = tool(tool_name) else {
        return;
    };
    let checks = check(emitted, options, &tools, None);
    assert_eq!(checks.len(), emitted.files.len());
    for checked in checks {
        let file = emitted
            .files
            .iter()
            .find(|f| f.file_name == checked.file)
            .unwrap();
        let text = file.contents.text().unwrap_or_default();
        assert_eq!(
            checked.state,
            CheckState::Pass,
            "{}: {}\n{text}",
            checked.file,
            checked.message
        );
    }
}

#[test]
fn spirv_is_valid() {
    for (name, text) in good() {
        let shader = wgsl(&name, &text);
        for spirv in [(1, 0), (1, 3), (1, 4), (1, 6)] {
            for bounds_checks in [BoundsChecks::Off, BoundsChecks::Restrict] {
                let options = EmitOptions {
                    spirv,
                    bounds_checks,
                    bound_loops: true,
                    ..EmitOptions::default()
                };
                let emitted = emit(&shader, Target::Spirv, &options).unwrap_or_else(|e| panic!("{e}"));
                assert_accepted(&emitted, &options, "spirv-val");
            }
        }
    }
}

#[test]
fn glsl_is_valid_or_refused_as_listed() {
    let mut refused = BTreeSet::new();
    for (name, text) in good() {
        let shader = wgsl(&name, &text);
        for glsl in GlslVersion::ALL {
            let options = EmitOptions {
                glsl,
                ..EmitOptions::default()
            };
            match emit(&shader, Target::Glsl, &options) {
                Ok(emitted) => assert_accepted(&emitted, &options, "glslangValidator"),
                Err(error) => {
                    assert_eq!(error.code, Code::Unsupported, "{name} {glsl}: {error}");
                    let line = error.line.unwrap_or_else(|| panic!("no place: {error}"));
                    refused.insert((name.clone(), glsl.name().to_owned(), line));
                }
            }
        }
    }
    let listed: BTreeSet<_> = REFUSED
        .iter()
        .map(|(name, version, line)| ((*name).to_owned(), (*version).to_owned(), *line))
        .collect();
    assert_eq!(refused, listed, "left: refused, right: listed");
}

#[test]
fn hlsl_has_no_sampler_heap_and_no_clash() {
    for (name, text) in good() {
        let shader = wgsl(&name, &text);
        for hlsl in ShaderModel::ALL {
            let options = EmitOptions {
                hlsl,
                ..EmitOptions::default()
            };
            let emitted = emit(&shader, Target::Hlsl, &options).unwrap_or_else(|e| panic!("{e}"));
            assert_accepted(&emitted, &options, "dxc");
            for file in &emitted.files {
                let text = file.contents.text().unwrap();
                assert!(!text.contains("Heap["), "{text}");
                assert!(!text.contains("StructuredBuffer<uint> naga"), "{text}");
                let registers: Vec<&str> = text
                    .lines()
                    .filter_map(|line| line.split_once(": register(")?.1.split_once(')'))
                    .map(|(register, _)| register)
                    .collect();
                let distinct: BTreeSet<&&str> = registers.iter().collect();
                assert_eq!(distinct.len(), registers.len(), "{name} {hlsl}: {registers:?}");
                if hlsl == ShaderModel::V5_0 {
                    assert!(!text.contains("space"), "{name}: {registers:?}\n{text}");
                    assert!(!text.contains("ConstantBuffer<"), "{text}");
                }
            }
        }
    }
}

#[test]
fn hlsl_of_two_groups_of_samplers() {
    let shader = shader("shadow.wgsl");
    let emit_with = |hlsl| {
        let options = EmitOptions {
            hlsl,
            ..EmitOptions::default()
        };
        let emitted = emit(&shader, Target::Hlsl, &options).unwrap();
        emitted.files[0].contents.text().unwrap().to_owned()
    };
    let spaces = emit_with(ShaderModel::V6_0);
    assert!(
        spaces.contains("SamplerComparisonState shadow_sampler : register(s1);"),
        "{spaces}"
    );
    assert!(
        spaces.contains("SamplerState sky_sampler : register(s1, space1);"),
        "{spaces}"
    );
    let flat = emit_with(ShaderModel::V5_0);
    assert!(
        flat.contains("SamplerComparisonState shadow_sampler : register(s0);"),
        "{flat}"
    );
    assert!(
        flat.contains("SamplerState sky_sampler : register(s1);"),
        "{flat}"
    );
}

#[test]
fn hlsl_5_0_puts_writable_buffers_behind_render_targets() {
    let text = "@group(0) @binding(0) var<storage, read_write> out: array<u32, 4>;
        @fragment fn main() -> @location(1) vec4f { out[0] = 1u; return vec4f(); }";
    let options = EmitOptions {
        hlsl: ShaderModel::V5_0,
        ..EmitOptions::default()
    };
    let emitted = emit(&wgsl("uav.wgsl", text), Target::Hlsl, &options).unwrap();
    let text = emitted.files[0].contents.text().unwrap();
    assert!(
        text.contains("out_ : register(u2)") || text.contains("out : register(u2)"),
        "{text}"
    );
}

#[test]
fn msl_has_real_slots_only() {
    for (name, text) in good() {
        let shader = wgsl(&name, &text);
        for msl in [(2, 0), (2, 4), (3, 1)] {
            for bounds_checks in [BoundsChecks::Off, BoundsChecks::Restrict] {
                let options = EmitOptions {
                    msl,
                    bounds_checks,
                    ..EmitOptions::default()
                };
                let emitted = emit(&shader, Target::Msl, &options).unwrap_or_else(|e| panic!("{e}"));
                assert_accepted(&emitted, &options, "clang");
                for file in &emitted.files {
                    let text = file.contents.text().unwrap();
                    assert!(!text.contains("user(fake"), "{name}: {text}");
                    assert!(
                        text.contains(&format!(" {}(", file.entry_point)),
                        "{name}: {text}"
                    );
                }
            }
        }
    }
}

#[test]
fn wgsl_reads_back_as_the_same_shader() {
    for (name, text) in good() {
        let options = EmitOptions::default();
        let shader = wgsl(&name, &text);
        let emitted = emit(&shader, Target::Wgsl, &options).unwrap_or_else(|e| panic!("{e}"));
        let before = manifest(&shader, &options, &[]);
        for (file, before) in emitted.files.iter().zip(before.entries) {
            let back = wgsl(&file.file_name, file.contents.text().unwrap());
            let mut after = manifest(&back, &options, &[]).entries;
            assert_eq!(after.len(), 1);
            let mut after = after.remove(0);
            // The name of the file, and constants that are compiled in by then.
            after.shader.clone_from(&before.shader);
            after.overrides.clone_from(&before.overrides);
            // Names that are reserved words get an underscore.
            assert_eq!(without_names(after), without_names(before), "{name}");
        }
    }
}

/// An entry with trailing underscores of names dropped.
fn without_names(entry: Entry) -> serde_json::Value {
    let json = serde_json::to_string(&entry).unwrap().replace("_\"", "\"");
    serde_json::from_str(&json).unwrap()
}

#[test]
fn an_invariant_position_is_one_in_every_language_that_has_it() {
    let text = "struct Varyings { @builtin(position) @invariant at: vec4f }
        @vertex fn vs(@location(0) p: vec4f) -> Varyings { return Varyings(p); }
        @fragment fn fs(in: Varyings) -> @location(0) vec4f { return in.at; }";
    let shader = wgsl("invariant.wgsl", text);
    for glsl in GlslVersion::ALL {
        let options = EmitOptions {
            glsl,
            ..EmitOptions::default()
        };
        let emitted = emit(&shader, Target::Glsl, &options).unwrap();
        assert_accepted(&emitted, &options, "glslangValidator");
        assert!(
            emitted.files[0]
                .contents
                .text()
                .unwrap()
                .contains("invariant gl_Position;")
        );
    }
    let spirv = emit(&shader, Target::Spirv, &EmitOptions::default()).unwrap();
    assert_accepted(&spirv, &EmitOptions::default(), "spirv-val");
    let error = emit(&shader, Target::Msl, &EmitOptions::default()).unwrap_err();
    assert!(error.message.contains("2.1"), "{error}");
    let options = EmitOptions {
        msl: (2, 1),
        ..EmitOptions::default()
    };
    let msl = emit(&shader, Target::Msl, &options).unwrap();
    assert!(
        msl.files[0]
            .contents
            .text()
            .unwrap()
            .contains("[[position, invariant]]")
    );
}

#[test]
fn equal_input_gives_equal_output() {
    for (name, text) in good() {
        for target in Target::ALL {
            let options = EmitOptions::default();
            let emit_once = || emit(&wgsl(&name, &text), target, &options).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(emit_once(), emit_once(), "{name} {target}");
        }
    }
}

#[test]
fn an_entry_point_carries_nothing_of_another() {
    let numbers = shader("numbers.wgsl");
    for target in Target::ALL {
        let emitted = emit(&numbers, target, &EmitOptions::default()).unwrap();
        assert_eq!(emitted.files.len(), 3);
        let names: BTreeSet<&str> = emitted.files.iter().map(|f| f.file_name.as_str()).collect();
        assert_eq!(names.len(), 3);
        if let Some(text) = emitted.file("triangle").unwrap().contents.text() {
            assert!(!text.contains("Targets") && !text.contains("log"), "{text}");
        }
    }
}

#[test]
fn listings_are_readable_and_stable() {
    let surface = shader("surface.wgsl");
    let emitted = emit(&surface, Target::Spirv, &EmitOptions::default()).unwrap();
    for file in &emitted.files {
        let listing = || spirv_listing(file.contents.bytes()).unwrap();
        let text = listing();
        assert_eq!(text, listing());
        assert!(
            text.contains("OpEntryPoint") && text.contains("DescriptorSet"),
            "{text}"
        );
    }
    assert!(spirv_listing(b"not spirv!!!").is_err());
    assert!(spirv_listing(b"odd").is_err());
}

#[test]
fn a_broken_file_fails_its_check() {
    let plain = shader("plain.wgsl");
    let options = EmitOptions::default();
    let tools = [
        (Target::Spirv, "spirv-val"),
        (Target::Glsl, "glslangValidator"),
        (Target::Hlsl, "dxc"),
        (Target::Msl, "clang"),
    ];
    for (target, name) in tools {
        let Some(tools) = tool(name) else { continue };
        let mut emitted = emit(&plain, target, &options).unwrap();
        for file in &mut emitted.files {
            file.contents = match &file.contents {
                Contents::Text(text) => Contents::Text(format!("{text}}}\n")),
                Contents::Binary(bytes) => {
                    let mut bytes = bytes.clone();
                    bytes.truncate(bytes.len() - 8);
                    Contents::Binary(bytes)
                }
            };
        }
        for checked in check(&emitted, &options, &tools, None) {
            assert_eq!(checked.state, CheckState::Fail, "{name}");
            assert!(!checked.message.is_empty());
        }
    }
}

#[test]
fn verdicts_come_from_the_cache() {
    let Some(mut tools) = tool("spirv-val") else {
        return;
    };
    let dir = tempfile::tempdir().unwrap();
    let options = EmitOptions::default();
    let emitted = emit(&shader("plain.wgsl"), Target::Spirv, &options).unwrap();
    let first = check(&emitted, &options, &tools, Some(dir.path()));
    assert!(std::fs::read_dir(dir.path()).unwrap().count() >= 2);
    // Now the program is gone; only the cache can answer.
    for tool in &mut tools {
        tool.path = Some("/nowhere/at/all".into());
    }
    assert_eq!(check(&emitted, &options, &tools, Some(dir.path())), first);
    let uncached = check(&emitted, &options, &tools, None);
    assert!(uncached.iter().all(|c| c.state == CheckState::Fail));
}

#[test]
fn a_missing_tool_is_a_skip_with_the_way_to_get_it() {
    let nowhere = tempfile::tempdir().unwrap();
    let tools = bossage_translate::external::detect_in(&[nowhere.path().to_path_buf()]);
    let options = EmitOptions::default();
    let emitted = emit(&shader("plain.wgsl"), Target::Spirv, &options).unwrap();
    for checked in check(&emitted, &options, &tools, None) {
        assert_eq!(checked.state, CheckState::Skip);
        assert!(
            checked.message.contains("apt install spirv-tools"),
            "{}",
            checked.message
        );
    }
}

#[test]
fn spirv_and_glsl_are_read() {
    let surface = shader("surface.wgsl");
    let options = EmitOptions::default();
    let spirv = emit(&surface, Target::Spirv, &options).unwrap();
    for file in &spirv.files {
        let bytes = file.contents.bytes().to_vec();
        let back = Shader::parse("back.spv", &Source::Spirv(bytes)).unwrap_or_else(|e| panic!("{e}"));
        for target in Target::ALL {
            emit(&back, target, &options).unwrap_or_else(|e| panic!("{target}: {e}"));
        }
    }
    let glsl = Source::Glsl {
        text: "#version 450
            layout(set = 0, binding = 1) uniform U { vec4 tint; };
            layout(location = 0) in vec2 uv;
            layout(location = 0) out vec4 color;
            void main() { color = tint * uv.xyxy; }"
            .to_owned(),
        stage: bossage_translate::Stage::Fragment,
    };
    let shader = Shader::parse("tint.frag", &glsl).unwrap_or_else(|e| panic!("{e}"));
    for target in Target::ALL {
        emit(&shader, target, &options).unwrap_or_else(|e| panic!("{target}: {e}"));
    }
}
