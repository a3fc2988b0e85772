//! The manifest against the files it describes: SPIR-V decorations are read back with another library, the other
//! languages by the text of the declaration.

mod support;

use std::collections::{BTreeMap, BTreeSet};

use bossage_translate::manifest::{Binding, Entry, Kind};
use bossage_translate::{EmitOptions, Emitted, GlslVersion, Manifest, ShaderModel, Target, emit, manifest};
use rspirv::dr::{Module, Operand};
use rspirv::spirv::{Decoration, Op};
use support::{good, shader, wgsl};

fn emit_all(shader: &bossage_translate::Shader, options: &EmitOptions) -> Vec<Emitted> {
    Target::ALL
        .iter()
        .map(|target| emit(shader, *target, options).unwrap_or_else(|e| panic!("{e}")))
        .collect()
}

/// Every good fixture with the given options: emitted files and manifest.
fn all(options: &EmitOptions) -> Vec<(Vec<Emitted>, Manifest)> {
    good()
        .iter()
        .map(|(name, text)| {
            let shader = wgsl(name, text);
            let emitted = emit_all(&shader, options);
            let manifest = manifest(&shader, options, &emitted);
            (emitted, manifest)
        })
        .collect()
}

fn text<'a>(emitted: &'a [Emitted], target: Target, entry: &Entry) -> &'a str {
    let emitted = emitted.iter().find(|e| e.target == target).unwrap();
    let file = emitted.file(&entry.name).unwrap();
    assert_eq!(entry.files[target.name()], file.file_name);
    file.contents.text().unwrap()
}

/// Decorations of a SPIR-V module by target id.
fn decorations(module: &Module) -> BTreeMap<u32, BTreeMap<Decoration, u32>> {
    let mut found: BTreeMap<u32, BTreeMap<Decoration, u32>> = BTreeMap::new();
    for annotation in &module.annotations {
        if let (
            Op::Decorate,
            [
                Operand::IdRef(id),
                Operand::Decoration(d),
                Operand::LiteralBit32(value),
            ],
        ) = (annotation.class.opcode, annotation.operands.as_slice())
        {
            found.entry(*id).or_default().insert(*d, *value);
        }
    }
    found
}

fn names(module: &Module) -> BTreeMap<u32, String> {
    module
        .debug_names
        .iter()
        .filter_map(|name| match name.operands.as_slice() {
            [Operand::IdRef(id), Operand::LiteralString(text)] => Some((*id, text.clone())),
            _ => None,
        })
        .collect()
}

#[test]
fn spirv_sets_and_bindings_are_those_of_the_module() {
    for (emitted, manifest) in all(&EmitOptions::default()) {
        for entry in &manifest.entries {
            let file = emitted[0].file(&entry.name).unwrap();
            let module = rspirv::dr::load_bytes(file.contents.bytes()).unwrap();
            let names = names(&module);
            let in_module: BTreeSet<(String, u32, u32)> = decorations(&module)
                .iter()
                .filter_map(|(id, d)| {
                    let (set, binding) = (d.get(&Decoration::DescriptorSet)?, d.get(&Decoration::Binding)?);
                    Some((names[id].clone(), *set, *binding))
                })
                .collect();
            let stated: BTreeSet<(String, u32, u32)> = entry
                .bindings
                .iter()
                .map(|b| (b.name.clone(), b.spirv.unwrap().set, b.spirv.unwrap().binding))
                .collect();
            assert_eq!(stated, in_module, "{}", entry.files["spirv"]);
        }
    }
}

/// Offsets of the members of every struct of a SPIR-V module, by the struct's name.
fn offsets(module: &Module) -> BTreeMap<String, BTreeMap<u32, u32>> {
    let names = names(module);
    let mut found: BTreeMap<String, BTreeMap<u32, u32>> = BTreeMap::new();
    for annotation in &module.annotations {
        if let (
            Op::MemberDecorate,
            [
                Operand::IdRef(id),
                Operand::LiteralBit32(member),
                Operand::Decoration(Decoration::Offset),
                Operand::LiteralBit32(offset),
            ],
        ) = (annotation.class.opcode, annotation.operands.as_slice())
            && let Some(name) = names.get(id)
        {
            found.entry(name.clone()).or_default().insert(*member, *offset);
        }
    }
    found
}

#[test]
fn member_offsets_are_those_of_the_spirv_module() {
    let mut compared = 0;
    for (emitted, manifest) in all(&EmitOptions::default()) {
        for entry in &manifest.entries {
            let file = emitted[0].file(&entry.name).unwrap();
            let in_module = offsets(&rspirv::dr::load_bytes(file.contents.bytes()).unwrap());
            for block in entry.uniforms.iter().chain(&entry.storage) {
                let binding = entry.bindings.iter().find(|b| b.name == block.name).unwrap();
                let Some(decorated) = in_module.get(&binding.ty) else {
                    continue;
                };
                let stated: BTreeMap<u32, u32> = (0..).zip(block.members.iter().map(|m| m.offset)).collect();
                assert_eq!(&stated, decorated, "{} {}", entry.name, block.name);
                compared += 1;
            }
        }
    }
    assert!(compared >= 6, "only {compared} blocks were compared");
}

#[test]
fn layouts_follow_the_rules_of_wgsl() {
    let surface = shader("surface.wgsl");
    let manifest = manifest(&surface, &EmitOptions::default(), &[]);
    let fragment = manifest.entry("fragment_main").unwrap();
    let block = |name: &str| fragment.uniforms.iter().find(|b| b.name == name).unwrap();
    // WGSL: a vec3f is aligned to 16 and takes 12; a struct's size is rounded up to its alignment.
    let material: Vec<_> = block("material")
        .members
        .iter()
        .map(|m| (m.name.as_str(), m.offset, m.size))
        .collect();
    assert_eq!(
        material,
        [
            ("albedo", 0, 16),
            ("relief", 16, 16),
            ("shininess", 32, 4),
            ("tint", 48, 12),
            ("alpha_cutoff", 60, 4)
        ]
    );
    assert_eq!(block("material").size, 64);
    let items = &block("lights").members[1];
    let array = items.array.unwrap();
    assert_eq!(
        (items.offset, items.size, array.count, array.stride),
        (16, 512, 16, 32)
    );
    assert_eq!(
        items.members.iter().map(|m| m.offset).collect::<Vec<_>>(),
        [0, 16]
    );
    let vertex = manifest.entry("vertex_main").unwrap();
    let matrix = vertex.uniforms[0].members[1].value.as_ref().unwrap();
    assert_eq!((matrix.rows, matrix.columns, matrix.column_stride), (4, 4, 16));
}

#[test]
fn hlsl_registers_are_declared_as_stated() {
    for hlsl in ShaderModel::ALL {
        let options = EmitOptions {
            hlsl,
            ..EmitOptions::default()
        };
        for (emitted, manifest) in all(&options) {
            for entry in &manifest.entries {
                let text = text(&emitted, Target::Hlsl, entry);
                for binding in &entry.bindings {
                    let slot = binding.hlsl.as_ref().unwrap();
                    let space = match slot.space {
                        0 => String::new(),
                        space => format!(", space{space}"),
                    };
                    let declared = format!("{} : register({}{space})", slot.name, slot.register);
                    assert!(text.contains(&declared), "{declared} is not in\n{text}");
                    assert!(
                        line_of(text, &declared).contains(hlsl_keyword(binding)),
                        "{declared}"
                    );
                }
                if let Some(special) = &entry.hlsl_special_constants {
                    assert!(text.contains(&special.slot.name) && special.fields.len() == 3);
                } else {
                    assert!(!text.contains("NagaConstants"), "{text}");
                }
            }
        }
    }
}

fn line_of<'a>(text: &'a str, part: &str) -> &'a str {
    text.lines().find(|line| line.contains(part)).unwrap()
}

fn hlsl_keyword(binding: &Binding) -> &'static str {
    match binding.kind {
        Kind::UniformBuffer => "cbuffer ",
        Kind::StorageBuffer => "RWByteAddressBuffer ",
        Kind::ReadOnlyStorageBuffer => "ByteAddressBuffer ",
        Kind::Texture | Kind::DepthTexture => "Texture",
        Kind::StorageTexture => "RWTexture",
        Kind::Sampler => "SamplerState ",
        Kind::ComparisonSampler => "SamplerComparisonState ",
    }
}

#[test]
fn msl_slots_are_declared_as_stated() {
    let options = EmitOptions::default();
    for (emitted, manifest) in all(&options) {
        for entry in &manifest.entries {
            let text = text(&emitted, Target::Msl, entry);
            let mut stated: Vec<String> = entry
                .bindings
                .iter()
                .filter_map(|b| b.msl.as_ref())
                .chain(entry.msl_buffer_sizes.as_ref().map(|sizes| &sizes.slot))
                .map(|slot| format!("[[{}({})]]", slot.slot, slot.index))
                .collect();
            stated.sort();
            let mut declared: Vec<String> = text
                .split("[[")
                .skip(1)
                .filter_map(|rest| rest.split_once("]]"))
                .map(|(attribute, _)| format!("[[{attribute}]]"))
                .filter(|a| {
                    ["[[buffer(", "[[texture(", "[[sampler("]
                        .iter()
                        .any(|s| a.starts_with(s))
                })
                .collect();
            declared.sort();
            assert_eq!(stated, declared, "{text}");
            assert_eq!(
                entry.msl_buffer_sizes.is_some(),
                text.contains("_mslBufferSizes&"),
                "{text}"
            );
        }
    }
}

#[test]
fn msl_sizes_are_in_the_order_of_the_struct() {
    let compute = shader("compute.wgsl");
    let options = EmitOptions::default();
    let emitted = emit_all(&compute, &options);
    let manifest = manifest(&compute, &options, &emitted);
    let sizes = manifest.entries[0].msl_buffer_sizes.as_ref().unwrap();
    assert_eq!(sizes.buffers, ["grid", "sums"]);
    let text = text(&emitted, Target::Msl, &manifest.entries[0]);
    let body = text
        .split_once("struct _mslBufferSizes {")
        .unwrap()
        .1
        .split_once('}')
        .unwrap()
        .0;
    assert_eq!(body.matches("uint size").count(), sizes.buffers.len(), "{body}");
}

#[test]
fn glsl_names_and_units_are_declared_as_stated() {
    for glsl in GlslVersion::ALL {
        let options = EmitOptions {
            glsl,
            ..EmitOptions::default()
        };
        for (name, source) in good() {
            let shader = wgsl(&name, &source);
            let Ok(emitted) = emit(&shader, Target::Glsl, &options) else {
                continue;
            };
            let emitted = [emitted];
            for entry in &manifest(&shader, &options, &emitted).entries {
                let text = text(&emitted, Target::Glsl, entry);
                for binding in &entry.bindings {
                    assert_glsl_binding(binding, text, glsl);
                }
                let first_instance = text.contains("uniform uint naga_vs_first_instance");
                assert_eq!(entry.glsl_first_instance.is_some(), first_instance, "{text}");
            }
        }
    }
}

fn assert_glsl_binding(binding: &Binding, text: &str, version: GlslVersion) {
    let slot = binding
        .glsl
        .as_ref()
        .unwrap_or_else(|| panic!("{} has no place", binding.name));
    if matches!(binding.kind, Kind::Sampler | Kind::ComparisonSampler) {
        assert!(!slot.textures.is_empty());
        assert!(
            slot.textures
                .iter()
                .all(|texture| text.contains(&format!(" {texture};")))
        );
        return;
    }
    let declaration = text
        .lines()
        .find(|line| line.contains("uniform ") | line.contains("buffer ") && line.contains(&slot.name))
        .filter(|line| line.contains(&slot.name))
        .or_else(|| {
            text.lines()
                .find(|line| line.contains(&format!(" {}", slot.name)))
        })
        .unwrap_or_else(|| panic!("{} is not in\n{text}", slot.name));
    let stated = declaration.contains(&format!("binding = {}", slot.unit));
    assert_eq!(stated, version.has_binding_layout(), "{declaration}");
}

#[test]
fn inputs_and_outputs_have_the_stated_names() {
    let options = EmitOptions::default();
    for (emitted, manifest) in all(&options) {
        for entry in &manifest.entries {
            let hlsl = text(&emitted, Target::Hlsl, entry);
            let msl = text(&emitted, Target::Msl, entry);
            let glsl = text(&emitted, Target::Glsl, entry);
            for varying in entry.inputs.iter().chain(&entry.outputs) {
                if let Some(name) = &varying.hlsl {
                    assert!(hlsl.contains(&format!(" : {name}")), "{name} is not in\n{hlsl}");
                }
                let name = varying.msl.as_ref().unwrap();
                assert!(msl.contains(&format!("[[{name}")), "{name} is not in\n{msl}");
                let name = varying.glsl.as_ref().unwrap();
                // A built-in that is only declared may not be read.
                assert!(
                    varying.location.is_none() || glsl.contains(name.as_str()),
                    "{name} is not in\n{glsl}"
                );
            }
        }
    }
}

#[test]
fn entry_points_are_there_under_their_stated_names() {
    for (emitted, manifest) in all(&EmitOptions::default()) {
        for entry in &manifest.entries {
            for target in [Target::Hlsl, Target::Msl, Target::Glsl, Target::Wgsl] {
                let text = text(&emitted, target, entry);
                let name = &entry.entry_points[target.name()];
                assert!(
                    text.contains(&format!("{name}(")),
                    "{target}: {name} is not in\n{text}"
                );
            }
        }
    }
}

#[test]
fn stages_of_separate_modules_share_glsl_units_without_collision() {
    let vertex = wgsl(
        "v.wgsl",
        "@group(1) @binding(0) var<uniform> a: vec4f;
         @vertex fn vs() -> @builtin(position) vec4f { return a; }",
    );
    let fragment = wgsl(
        "f.wgsl",
        "@group(0) @binding(0) var<uniform> a: vec4f;
         @fragment fn fs() -> @location(0) vec4f { return a; }",
    );
    let options = EmitOptions::default();
    let unit = |shader: &bossage_translate::Shader| {
        let emitted = emit_all(shader, &options);
        manifest(shader, &options, &emitted).entries[0].bindings[0]
            .glsl
            .clone()
            .unwrap()
            .unit
    };
    assert_eq!((unit(&vertex), unit(&fragment)), (8, 0));
}

#[test]
fn the_json_reads_back() {
    for (_, manifest) in all(&EmitOptions::default()) {
        let json = serde_json::to_string_pretty(&manifest).unwrap();
        assert_eq!(serde_json::from_str::<Manifest>(&json).unwrap(), manifest);
    }
}

#[test]
fn keys_are_those_of_the_format() {
    let surface = shader("surface.wgsl");
    let options = EmitOptions::default();
    let emitted = emit_all(&surface, &options);
    let json = serde_json::to_value(manifest(&surface, &options, &emitted)).unwrap();
    assert_eq!(json["schema"], 1);
    assert_eq!(json["tools"]["naga"], "30.0.1");
    let entry = &json["entries"][1];
    assert_eq!(entry["name"], "fragment_main");
    assert_eq!(entry["stage"], "fragment");
    for target in ["spirv", "hlsl", "msl", "glsl", "wgsl"] {
        assert!(entry["files"][target].is_string(), "{target}");
        assert_eq!(entry["sha256"][target].as_str().unwrap().len(), 64);
    }
    let binding = &entry["bindings"][3];
    assert_eq!(binding["name"], "albedo_map");
    assert_eq!(binding["kind"], "texture");
    assert_eq!((&binding["group"], &binding["binding"]), (&2.into(), &1.into()));
    assert_eq!(binding["spirv"], serde_json::json!({"set": 2, "binding": 1}));
    assert_eq!(binding["hlsl"]["register"], "t1");
    assert_eq!(binding["hlsl"]["space"], 2);
    assert_eq!(binding["msl"], serde_json::json!({"slot": "texture", "index": 0}));
    assert_eq!(binding["glsl"]["name"], "_group_2_binding_1_fs");
    assert_eq!(binding["glsl"]["unit"], 17);
    let uniform = &entry["uniforms"][0];
    assert_eq!(uniform["name"], "view");
    assert_eq!(uniform["members"][0]["name"], "eye");
    assert!(entry["inputs"].is_array() && entry["outputs"].is_array());
    assert!(entry["cost"]["ops"].as_u64().unwrap() > 0);
    assert_eq!(json["entries"][0]["workgroup_size"], serde_json::Value::Null);
}

#[test]
fn overrides_are_compiled_in_and_stated() {
    let text = std::fs::read_to_string(support::fixtures().join("good/overrides.wgsl")).unwrap();
    let values = [("group_size".to_owned(), 16.0), ("7".to_owned(), 3.0)].into();
    let source = bossage_translate::Source::Wgsl(text);
    let shader = bossage_translate::Shader::parse_with("o.wgsl", &source, &values).unwrap();
    let manifest = manifest(&shader, &EmitOptions::default(), &[]);
    let entry = &manifest.entries[0];
    assert_eq!(entry.workgroup_size, Some([16, 1, 1]));
    let value = |name: &str| entry.overrides.iter().find(|o| o.name == name).unwrap().value;
    assert_eq!(value("scale"), Some(3.0));
    assert_eq!(value("layers"), Some(4.0));
    // Its default is an expression of another override.
    assert_eq!(value("area"), None);
}
