//! SPIR-V that compilers of others make of emitted text: everything is where the source has it, and tools that misbehave are told.

use std::collections::BTreeSet;
use std::path::Path;

use bossage_translate::external::{LIMITS, State, Validator, run, to_spirv};
use bossage_translate::{EmitOptions, Shader, ShaderModel, Source, Target, emit, manifest};

mod support;

/// Two textures that share a sampler, one that is only loaded from, buffers, and locations out of order.
const SURFACE: &str = "
    struct Tint { colour: vec4f, amount: f32 }
    @group(1) @binding(2) var<uniform> tint: Tint;
    @group(0) @binding(3) var albedo: texture_2d<f32>;
    @group(0) @binding(1) var normal: texture_2d<f32>;
    @group(2) @binding(0) var table: texture_2d<f32>;
    @group(0) @binding(5) var shared_sampler: sampler;
    struct In { @location(4) uv: vec2f, @location(1) light: vec3f }
    @fragment fn shade(in: In) -> @location(0) vec4f {
        let at = textureSample(normal, shared_sampler, in.uv).xy;
        let row = textureLoad(table, vec2i(1, 0), 0);
        return tint.amount * tint.colour * textureSample(albedo, shared_sampler, at) + row + vec4f(in.light, 0.0);
    }";

fn shader() -> Shader {
    Shader::parse("surface", &Source::Wgsl(SURFACE.to_owned())).unwrap_or_else(|error| panic!("{error}"))
}

fn options() -> EmitOptions {
    EmitOptions {
        hlsl: ShaderModel::V6_0,
        ..EmitOptions::default()
    }
}

/// What a tool makes of the surface in a language.
fn compile(target: Target, tools: &[Validator], cache: Option<&Path>) -> Result<Vec<u8>, String> {
    let (shader, options) = (shader(), options());
    let emitted = emit(&shader, target, &options).unwrap_or_else(|error| panic!("{error}"));
    let manifest = manifest(&shader, &options, std::slice::from_ref(&emitted));
    to_spirv(&emitted, &manifest.entries[0], &options, tools, cache).map(|made| made.bytes)
}

/// Every resource as its kind, group and binding, and every location that is read.
fn places(spirv: &[u8]) -> (BTreeSet<(String, u32, u32)>, BTreeSet<u32>) {
    let shader =
        Shader::parse("back", &Source::Spirv(spirv.to_vec())).unwrap_or_else(|error| panic!("{error}"));
    let manifest = manifest(&shader, &EmitOptions::default(), &[]);
    let entry = &manifest.entries[0];
    let kind = |kind| format!("{kind:?}");
    let resources = entry
        .bindings
        .iter()
        .map(|one| (kind(one.kind), one.group, one.binding));
    (
        resources.collect(),
        entry.inputs.iter().filter_map(|input| input.location).collect(),
    )
}

#[test]
fn resources_and_locations_are_where_the_source_has_them() {
    let expected = [
        ("Sampler", 0, 5),
        ("Texture", 0, 1),
        ("Texture", 0, 3),
        ("Texture", 2, 0),
        ("UniformBuffer", 1, 2),
    ];
    let expected: BTreeSet<_> = expected
        .map(|(kind, group, binding)| (kind.to_owned(), group, binding))
        .into();
    for (target, name) in [(Target::Hlsl, "dxc"), (Target::Glsl, "glslangValidator")] {
        let Some(tools) = support::tool(name) else {
            continue;
        };
        let spirv = compile(target, &tools, None).unwrap_or_else(|error| panic!("{target}: {error}"));
        assert_eq!(
            places(&spirv),
            (expected.clone(), BTreeSet::from([1, 4])),
            "{target}"
        );
    }
}

/// A texture and a sampler that are handed on through two functions, and one texture that is handed on to be loaded from.
const HANDED_ON: &str = "
    @group(0) @binding(3) var heights: texture_2d<f32>;
    @group(1) @binding(1) var table: texture_2d<f32>;
    @group(0) @binding(5) var shared_sampler: sampler;
    @group(0) @binding(0) var<storage, read_write> out: array<f32>;
    fn read(map: texture_2d<f32>, by: sampler, uv: vec2f) -> f32 { return textureSampleLevel(map, by, uv, 0.0).r; }
    fn first(map: texture_2d<f32>, scale: f32, row: vec2u) -> f32 { return scale * textureLoad(map, row, 0).r; }
    fn search(map: texture_2d<f32>, rows: texture_2d<f32>, by: sampler, uv: vec2f) -> f32 {
        return read(map, by, uv) + read(map, by, uv.yx) + first(rows, 2.0, vec2u(0u)) + f32(textureDimensions(map).x);
    }
    @compute @workgroup_size(1) fn main() { out[0] = search(heights, table, shared_sampler, vec2f(0.5)); }";

#[test]
fn textures_that_are_handed_to_functions_are_where_the_source_has_them() {
    let Some(tools) = support::tool("glslangValidator") else {
        return;
    };
    let shader = Shader::parse("handed_on", &Source::Wgsl(HANDED_ON.to_owned())).unwrap();
    let emitted = emit(&shader, Target::Glsl, &options()).unwrap();
    let manifest = manifest(&shader, &options(), std::slice::from_ref(&emitted));
    let made = to_spirv(&emitted, &manifest.entries[0], &options(), &tools, None).unwrap();
    let kinds: BTreeSet<_> = places(&made.bytes).0;
    let at = |group, binding| {
        kinds
            .iter()
            .filter(|(_, g, b)| (*g, *b) == (group, binding))
            .count()
    };
    assert_eq!([at(0, 3), at(1, 1), at(0, 5), at(0, 0)], [1; 4], "{kinds:?}");
}

/// One function that is called with two textures: no one variable can take the parameter's place.
#[test]
fn a_function_of_two_textures_is_refused_for_what_it_is() {
    let Some(tools) = support::tool("glslangValidator") else {
        return;
    };
    let text = HANDED_ON.replace("read(map, by, uv.yx)", "read(rows, by, uv.yx)");
    let shader = Shader::parse("two", &Source::Wgsl(text)).unwrap();
    let emitted = emit(&shader, Target::Glsl, &options()).unwrap();
    let manifest = manifest(&shader, &options(), std::slice::from_ref(&emitted));
    let refused = to_spirv(&emitted, &manifest.entries[0], &options(), &tools, None)
        .map(|_| ())
        .unwrap_err();
    assert!(refused.contains("different textures"), "{refused}");
}

/// Two images that are the same to HLSL, one of two components and one that is read and written.
const STORED: &str = "
    @group(0) @binding(0) var bytes: texture_storage_2d<rgba8unorm, write>;
    @group(0) @binding(1) var floats: texture_storage_2d<rgba32float, write>;
    @group(0) @binding(2) var halves: texture_storage_2d<rg16float, write>;
    @group(1) @binding(0) var counts: texture_storage_2d_array<r32uint, read_write>;
    @compute @workgroup_size(1) fn main() {
        textureStore(bytes, vec2u(0u), vec4f(0.5));
        textureStore(floats, vec2u(0u), vec4f(0.5));
        textureStore(halves, vec2u(0u), vec4f(0.5));
        let count = textureLoad(counts, vec2u(0u), 1u).x;
        textureStore(counts, vec2u(0u), 1u, vec4u(count + 1u));
    }";

const PUSHED: &str = "
    struct Pushed { scale: f32, offset: vec2f, weights: array<vec4f, 2> }
    var<immediate> pushed: Pushed;
    @group(0) @binding(0) var<uniform> other: vec4f;
    @group(0) @binding(1) var<storage, read_write> result: array<vec2f>;
    @compute @workgroup_size(2) fn main(@builtin(local_invocation_index) i: u32) {
        result[i] = pushed.offset * pushed.scale + pushed.weights[i].xy + other.xy;
    }";

/// The buffer that stands for them has no place of its own any more, and the other uniforms stay where they were.
#[test]
fn push_constants_of_hlsl_are_push_constants() {
    let Some(tools) = support::tool("dxc") else { return };
    let shader = Shader::parse("pushed", &Source::Wgsl(PUSHED.to_owned())).unwrap();
    let emitted = emit(&shader, Target::Hlsl, &options()).unwrap();
    let described = manifest(&shader, &options(), std::slice::from_ref(&emitted));
    let made = to_spirv(&emitted, &described.entries[0], &options(), &tools, None).unwrap();
    assert_valid(&made.bytes);
    let back = Shader::parse("back", &Source::Spirv(made.bytes)).unwrap();
    let back = manifest(&back, &EmitOptions::default(), &[]);
    let pushed = back.entries[0].immediates.as_ref().expect("push constants");
    let offsets: Vec<u32> = pushed.members.iter().map(|member| member.offset).collect();
    assert_eq!(offsets.first(), Some(&0));
    assert!(offsets.contains(&8) && offsets.contains(&16), "{offsets:?}");
    let places: Vec<_> = back.entries[0]
        .bindings
        .iter()
        .map(|one| (one.group, one.binding))
        .collect();
    assert_eq!(places, [(0, 0), (0, 1)]);
}

/// Group, binding and format of each storage texture in SPIR-V.
fn stored(spirv: &[u8]) -> Vec<(u32, u32, String)> {
    let shader =
        Shader::parse("back", &Source::Spirv(spirv.to_vec())).unwrap_or_else(|error| panic!("{error}"));
    let manifest = manifest(&shader, &EmitOptions::default(), &[]);
    let bindings = manifest.entries[0].bindings.iter();
    let mut all: Vec<_> = bindings
        .filter_map(|one| Some((one.group, one.binding, one.texture.as_ref()?.format.clone()?)))
        .collect();
    all.sort();
    all
}

/// Asks `spirv-val`, where it is.
fn assert_valid(spirv: &[u8]) {
    let Some(tools) = support::tool("spirv-val") else {
        return;
    };
    let path = tools
        .iter()
        .find(|one| one.tool == "spirv-val")
        .and_then(|one| one.path.clone());
    let arguments = ["--target-env", "vulkan1.1", "-"].map(str::to_owned);
    let outcome = run(&path.expect("it is enabled"), &arguments, spirv, &LIMITS).unwrap();
    assert!(outcome.success, "{}", outcome.output);
}

/// What `crates/translate/src/spirv.rs` repairs. Where naga reads it by itself, that can go.
#[test]
fn naga_alone_does_not_read_layers_at_integer_coordinates() {
    let Some(tools) = support::tool("dxc") else { return };
    let shader = Shader::parse("stored", &Source::Wgsl(STORED.to_owned())).unwrap();
    let emitted = emit(&shader, Target::Hlsl, &options()).unwrap();
    let manifest = manifest(&shader, &options(), std::slice::from_ref(&emitted));
    let made = to_spirv(&emitted, &manifest.entries[0], &options(), &tools, None).unwrap();
    let read =
        || naga::front::spv::parse_u8_slice(&made.bytes, &naga::front::spv::Options::default()).is_ok();
    assert!(
        !std::panic::catch_unwind(read).unwrap_or(false),
        "naga reads it now"
    );
}

#[test]
fn storage_images_have_the_formats_of_the_source() {
    let expected = [
        (0, 0, "rgba8unorm"),
        (0, 1, "rgba32float"),
        (0, 2, "rg16float"),
        (1, 0, "r32uint"),
    ]
    .map(|(group, binding, format)| (group, binding, format.to_owned()));
    let shader = Shader::parse("stored", &Source::Wgsl(STORED.to_owned())).unwrap();
    for (target, name) in [(Target::Hlsl, "dxc"), (Target::Glsl, "glslangValidator")] {
        let Some(tools) = support::tool(name) else {
            continue;
        };
        let emitted = emit(&shader, target, &options()).unwrap();
        let manifest = manifest(&shader, &options(), std::slice::from_ref(&emitted));
        let made = to_spirv(&emitted, &manifest.entries[0], &options(), &tools, None).unwrap();
        assert_valid(&made.bytes);
        assert_eq!(stored(&made.bytes), expected, "{target}");
    }
}

#[test]
fn a_register_that_is_stated_wrongly_is_refused() {
    let Some(tools) = support::tool("dxc") else { return };
    let (shader, options) = (shader(), options());
    let emitted = emit(&shader, Target::Hlsl, &options).unwrap();
    let mut manifest = manifest(&shader, &options, std::slice::from_ref(&emitted));
    let slot = manifest.entries[0].bindings[0].hlsl.as_mut().expect("a register");
    slot.register = "t9".to_owned();
    let refused = to_spirv(&emitted, &manifest.entries[0], &options, &tools, None).unwrap_err();
    assert!(refused.contains("register"), "{refused}");
}

#[test]
fn what_was_compiled_once_comes_from_the_cache() {
    let Some(mut tools) = support::tool("glslangValidator") else {
        return;
    };
    let cache = tempfile::tempdir().unwrap();
    let first = compile(Target::Glsl, &tools, Some(cache.path())).unwrap();
    for tool in &mut tools {
        tool.path = Some("/nowhere/at/all".into());
    }
    assert_eq!(compile(Target::Glsl, &tools, Some(cache.path())).unwrap(), first);
    assert!(compile(Target::Glsl, &tools, None).is_err());
}

/// A tool that is a shell script.
#[cfg(unix)]
fn scripted(name: &str, script: &str, folder: &Path) -> Vec<Validator> {
    use std::os::unix::fs::PermissionsExt;

    let path = folder.join(name);
    std::fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
    vec![Validator {
        tool: name.to_owned(),
        version: Some("0".to_owned()),
        path: Some(path),
        state: State::Enabled,
        reason: None,
    }]
}

#[cfg(unix)]
#[test]
fn tools_that_crash_write_nothing_or_write_megabytes_are_told_apart() {
    for (target, name) in [(Target::Hlsl, "dxc"), (Target::Glsl, "glslangValidator")] {
        for (script, said) in [
            ("kill -SEGV $$", "signal"),
            ("exit 0", "wrote nothing"),
            ("yes error | head -c 5000000; exit 1", "more bytes"),
            (
                "for last; do :; done; for o; do [ -w \"$o\" ] && echo junk > \"$o\"; done; exit 0",
                "no SPIR-V",
            ),
        ] {
            let folder = tempfile::tempdir().unwrap();
            let problem = compile(target, &scripted(name, script, folder.path()), None).unwrap_err();
            assert!(problem.contains(said), "{name}, {script}: {problem}");
            assert!(problem.len() < 20_000, "{} bytes", problem.len());
        }
    }
}
