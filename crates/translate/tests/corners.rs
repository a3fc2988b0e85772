//! Rare features, one a fixture, in every version of every language: what is emitted is accepted by an independent
//! compiler where there is one; what is refused is refused with a place; nothing fails inside the translator.

mod support;

use bossage_translate::external::{CheckState, check};
use bossage_translate::{
    BoundsChecks, Code, EmitOptions, Emitted, GlslVersion, Shader, ShaderModel, Target, emit, lint, manifest,
};
use support::{fixtures, tool, wgsl};

fn corners() -> Vec<Shader> {
    let mut paths: Vec<_> = std::fs::read_dir(fixtures().join("corners"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    assert!(paths.len() > 30);
    paths
        .iter()
        .map(|path| {
            wgsl(
                &path.file_name().unwrap().to_string_lossy(),
                &std::fs::read_to_string(path).unwrap(),
            )
        })
        .collect()
}

/// Every version of every language, with and without bounds checks.
fn all_options() -> Vec<(Target, EmitOptions)> {
    let mut all = vec![(Target::Wgsl, EmitOptions::default())];
    for bounds_checks in [BoundsChecks::Off, BoundsChecks::Restrict] {
        let base = EmitOptions {
            bounds_checks,
            ..EmitOptions::default()
        };
        for spirv in [(1, 0), (1, 3), (1, 4), (1, 6)] {
            all.push((
                Target::Spirv,
                EmitOptions {
                    spirv,
                    ..base.clone()
                },
            ));
        }
        for hlsl in ShaderModel::ALL {
            all.push((Target::Hlsl, EmitOptions { hlsl, ..base.clone() }));
        }
        for msl in [(2, 0), (2, 4), (3, 2)] {
            all.push((Target::Msl, EmitOptions { msl, ..base.clone() }));
        }
        for glsl in GlslVersion::ALL {
            all.push((Target::Glsl, EmitOptions { glsl, ..base.clone() }));
        }
    }
    all
}

#[test]
fn every_corner_is_emitted_right_or_refused() {
    let (mut emitted_files, mut refusals) = (0, 0);
    for shader in corners() {
        let _ = lint(&shader);
        for (target, options) in all_options() {
            match emit(&shader, target, &options) {
                Ok(emitted) => {
                    let made = manifest(&shader, &options, std::slice::from_ref(&emitted));
                    assert_eq!(made.entries.len(), emitted.files.len());
                    assert_accepted(&shader, &emitted, &options);
                    emitted_files += emitted.files.len();
                }
                Err(error) => {
                    assert!(
                        matches!(error.code, Code::Unsupported | Code::Binding),
                        "{target} {options:?}: {error}"
                    );
                    assert!(error.line.is_some(), "no place: {error}");
                    refusals += 1;
                }
            }
        }
    }
    // Neither side may swallow the other.
    assert!(
        emitted_files > 300 && refusals > 100,
        "{emitted_files} files, {refusals} refusals"
    );
}

fn assert_accepted(shader: &Shader, emitted: &Emitted, options: &EmitOptions) {
    let name = match emitted.target {
        Target::Spirv => "spirv-val",
        Target::Glsl => "glslangValidator",
        Target::Hlsl | Target::Msl | Target::Wgsl => return,
    };
    let Some(tools) = tool(name) else { return };
    for checked in check(emitted, options, &tools, None) {
        let text = emitted.files[0].contents.text().unwrap_or_default();
        assert_eq!(
            checked.state,
            CheckState::Pass,
            "{} {options:?}: {}\n{text}",
            shader.name(),
            checked.message
        );
    }
}
