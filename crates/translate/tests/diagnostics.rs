//! Mistakes of users: each has a code, a place and words.

mod support;

use bossage_translate::{
    Code, Diagnostic, EmitOptions, GlslUnits, GlslVersion, Overrides, Shader, ShaderModel, Source, Stage,
    Target, emit,
};
use support::{fixtures, wgsl};

fn bad(name: &str) -> Diagnostic {
    let text = std::fs::read_to_string(fixtures().join("bad").join(name)).unwrap();
    let source = if name.ends_with(".frag") {
        Source::Glsl {
            text,
            stage: Stage::Fragment,
        }
    } else {
        Source::Wgsl(text)
    };
    Shader::parse(name, &source).map(|_| ()).expect_err(name)
}

#[test]
fn bad_shaders_are_refused_with_their_place() {
    for (name, code, line, word) in [
        ("syntax.wgsl", Code::Parse, 3, "expected"),
        ("type.wgsl", Code::Validate, 3, "Add"),
        ("unknown_name.wgsl", Code::Parse, 3, "nothing"),
        ("layout.wgsl", Code::Validate, 3, "weights"),
        ("no_default.wgsl", Code::Override, 1, "size"),
        ("binding_twice.wgsl", Code::Validate, 2, "conflict"),
        ("broken.frag", Code::Parse, 4, "undeclared"),
    ] {
        let error = bad(name);
        let shown = error.to_string();
        assert_eq!(error.code, code, "{shown}");
        assert_eq!(error.line, Some(line), "{shown}");
        assert!(
            shown.to_lowercase().contains(&word.to_lowercase()),
            "{word} is not in: {shown}"
        );
        assert!(shown.contains('^'), "{shown}");
        assert!(shown.contains(&format!("{name}:{line}:")), "{shown}");
        assert!(!shown.contains("naga::"), "{shown}");
    }
}

#[test]
fn every_bad_fixture_is_refused() {
    for entry in std::fs::read_dir(fixtures().join("bad")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let shown = bad(&name).to_string();
        assert!(shown.contains(&name), "{shown}");
    }
}

#[test]
fn garbage_is_no_panic() {
    let mut header = vec![0x03, 0x02, 0x23, 0x07, 0, 0, 1, 0];
    header.extend([0; 12]);
    for bytes in [
        vec![],
        vec![1, 2, 3],
        vec![0; 64],
        header.clone(),
        [header, vec![0xff; 64]].concat(),
    ] {
        let error = Shader::parse("x.spv", &Source::Spirv(bytes)).unwrap_err();
        assert_eq!(error.file, "x.spv");
    }
    for text in [
        "",
        "\u{0}",
        "@",
        "fn f(",
        "/*",
        "𝒳",
        "@fragment fn f() -> @location(0) vec4f { return vec4f(1.0",
    ] {
        assert!(
            Shader::parse("x.wgsl", &Source::Wgsl(text.to_owned())).is_err(),
            "{text}"
        );
    }
    for text in ["", "#version", "#version 450\nvoid main() {", "#if"] {
        let source = Source::Glsl {
            text: text.to_owned(),
            stage: Stage::Vertex,
        };
        assert!(Shader::parse("x.vert", &source).is_err(), "{text}");
    }
}

#[test]
fn a_truncated_spirv_module_is_no_panic() {
    let emitted = emit(
        &support::shader("surface.wgsl"),
        Target::Spirv,
        &EmitOptions::default(),
    )
    .unwrap();
    let bytes = emitted.files[1].contents.bytes();
    for end in (0..bytes.len()).step_by(bytes.len() / 97) {
        assert!(
            Shader::parse("cut.spv", &Source::Spirv(bytes[..end].to_vec())).is_err(),
            "{end}"
        );
    }
}

/// A fragment shader with this declaration in front and this value returned.
fn fragment(declarations: &str, value: &str) -> Shader {
    wgsl(
        "t.wgsl",
        &format!(
            "{declarations}\n@fragment fn main(@location(0) x: f32) -> @location(0) vec4f {{\n return {value}; }}"
        ),
    )
}

fn refused(shader: &Shader, target: Target, options: &EmitOptions) -> Diagnostic {
    emit(shader, target, options)
        .map(|_| ())
        .expect_err("the target cannot express this")
}

#[test]
fn one_target_refuses_and_the_others_do_not() {
    let double = fragment("", "vec4f(f32(f64(x) * 2.0lf))");
    let options = EmitOptions::default();
    for target in [Target::Msl, Target::Wgsl] {
        let error = refused(&double, target, &options);
        assert_eq!((error.code, error.line), (Code::Unsupported, Some(3)), "{error}");
        assert!(error.message.contains("f64"), "{error}");
    }
    for target in [Target::Spirv, Target::Hlsl, Target::Glsl] {
        emit(&double, target, &options).unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn half_floats_need_a_target_that_has_them() {
    let half = fragment("enable f16;", "vec4f(vec4<f16>(f16(x)))");
    let old = refused(&half, Target::Hlsl, &EmitOptions::default());
    assert!(old.message.contains("it comes with 6.2"), "{old}");
    let new = EmitOptions {
        hlsl: ShaderModel::V6_2,
        ..EmitOptions::default()
    };
    let emitted = emit(&half, Target::Hlsl, &new).unwrap();
    assert!(emitted.files[0].contents.text().unwrap().contains("half"));
    refused(&half, Target::Glsl, &new);
    for target in [Target::Spirv, Target::Msl, Target::Wgsl] {
        emit(&half, target, &new).unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn texture_queries_are_refused_where_they_are_used() {
    let levels = fragment(
        "@group(0) @binding(0) var t: texture_2d<f32>;",
        "vec4f(f32(textureNumLevels(t)))",
    );
    for glsl in [GlslVersion::Es300, GlslVersion::Es310] {
        let error = refused(
            &levels,
            Target::Glsl,
            &EmitOptions {
                glsl,
                ..EmitOptions::default()
            },
        );
        assert_eq!(error.line, Some(3), "{error}");
        assert!(error.message.contains("textureNumLevels"), "{error}");
    }
    emit(&levels, Target::Glsl, &EmitOptions::default()).unwrap();
}

#[test]
fn a_texture_with_two_samplers_is_refused_in_glsl_only() {
    let two = fragment(
        "@group(0) @binding(0) var t: texture_2d<f32>; @group(0) @binding(1) var a: sampler; @group(0) @binding(2) var b: sampler;",
        "textureSample(t, a, vec2f(x)) + textureSample(t, b, vec2f(x))",
    );
    let options = EmitOptions::default();
    let error = refused(&two, Target::Glsl, &options);
    assert_eq!((error.code, error.line), (Code::Unsupported, Some(1)), "{error}");
    for target in [Target::Spirv, Target::Hlsl, Target::Msl, Target::Wgsl] {
        emit(&two, target, &options).unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn gather_is_refused_in_old_glsl() {
    let gather = fragment(
        "@group(0) @binding(0) var t: texture_2d<f32>; @group(0) @binding(1) var s: sampler;",
        "textureGather(1, t, s, vec2f(x))",
    );
    for (glsl, accepted) in [
        (GlslVersion::Core330, false),
        (GlslVersion::Es300, false),
        (GlslVersion::Es310, true),
        (GlslVersion::Core450, true),
    ] {
        let result = emit(
            &gather,
            Target::Glsl,
            &EmitOptions {
                glsl,
                ..EmitOptions::default()
            },
        );
        assert_eq!(result.is_ok(), accepted, "{glsl}");
    }
}

#[test]
fn loads_from_depth_textures_are_refused_in_glsl_only() {
    let load = fragment(
        "@group(0) @binding(0) var t: texture_depth_2d;",
        "vec4f(textureLoad(t, vec2i(i32(x)), 0))",
    );
    let options = EmitOptions::default();
    let error = refused(&load, Target::Glsl, &options);
    assert_eq!((error.code, error.line), (Code::Unsupported, Some(3)), "{error}");
    for target in [Target::Spirv, Target::Hlsl, Target::Msl, Target::Wgsl] {
        emit(&load, target, &options).unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn external_textures_are_no_panic() {
    let external = fragment(
        "@group(0) @binding(0) var t: texture_external; @group(0) @binding(1) var s: sampler;",
        "textureSampleBaseClampToEdge(t, s, vec2f(x))",
    );
    for target in [Target::Spirv, Target::Hlsl, Target::Msl, Target::Glsl] {
        let error = refused(&external, target, &EmitOptions::default());
        assert_eq!(error.code, Code::Unsupported, "{error}");
    }
}

#[test]
fn numbers_that_do_not_fit_are_refused() {
    let units = |map: &[((u32, u32), u32)]| EmitOptions {
        glsl_units: GlslUnits::Map(map.iter().copied().collect()),
        ..EmitOptions::default()
    };
    let two = fragment(
        "@group(0) @binding(0) var<uniform> a: vec4f; @group(0) @binding(1) var<uniform> b: vec4f;",
        "a + b + x",
    );
    for (options, word) in [
        (units(&[((0, 0), 1)]), "no number is given for `b`"),
        (units(&[((0, 0), 1), ((0, 1), 1)]), "would both be number 1"),
        (units(&[((0, 0), 1), ((0, 1), 256)]), "the largest is 255"),
    ] {
        let error = refused(&two, Target::Glsl, &options);
        assert_eq!(error.code, Code::Binding);
        assert!(error.message.contains(word), "{error}");
    }
    let far = fragment("@group(100) @binding(0) var<uniform> a: vec4f;", "a + x");
    assert_eq!(
        refused(&far, Target::Hlsl, &EmitOptions::default()).code,
        Code::Binding
    );
}

#[test]
fn unknown_versions_are_refused() {
    let plain = fragment("", "vec4f(x)");
    for (target, options) in [
        (
            Target::Msl,
            EmitOptions {
                msl: (1, 2),
                ..EmitOptions::default()
            },
        ),
        (
            Target::Msl,
            EmitOptions {
                msl: (9, 0),
                ..EmitOptions::default()
            },
        ),
        (
            Target::Spirv,
            EmitOptions {
                spirv: (1, 7),
                ..EmitOptions::default()
            },
        ),
    ] {
        assert_eq!(refused(&plain, target, &options).code, Code::Unsupported);
    }
}

#[test]
fn an_override_that_is_not_there_is_refused_with_those_that_are() {
    let text = std::fs::read_to_string(fixtures().join("good/overrides.wgsl")).unwrap();
    let values = Overrides::from([("layer".to_owned(), 1.0)]);
    let error = Shader::parse_with("o.wgsl", &Source::Wgsl(text.clone()), &values).unwrap_err();
    assert_eq!(error.code, Code::Override);
    assert!(
        error.to_string().contains("layers, 7, fancy, group_size, area"),
        "{error}"
    );
    for value in [f64::NAN, -1.0, 1e300] {
        let values = Overrides::from([("layers".to_owned(), value)]);
        let error = Shader::parse_with("o.wgsl", &Source::Wgsl(text.clone()), &values).unwrap_err();
        assert_eq!(error.code, Code::Override, "{value}: {error}");
    }
}

#[test]
fn names_that_would_be_one_file_are_refused() {
    let text = "@vertex fn a_() -> @builtin(position) vec4f { return vec4f(); }
        @fragment fn A_() -> @location(0) vec4f { return vec4f(); }";
    let error = refused(&wgsl("n.wgsl", text), Target::Wgsl, &EmitOptions::default());
    assert_eq!(error.code, Code::Collision);
}
