//! Dropping an effect leaves no trace: for every example scene, in every target.
//!
//! Each effect of the plan has words of its own: bindings, uniform members, varyings and functions. Where the plan drops the
//! effect, no identifier of any emitted file of that material may be one of them, and no name in the manifest; where it is
//! kept, at least one must occur, or the list would check nothing. A word that several effects share goes when all of them
//! do. That the pictures do not change is the scene cases' part (`bossage conform scene`).

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use bossage_scene::{EffectId, MaterialPlan, State};
use bossage_shaders::{FeatureSet, Library, Lights, NormalSource, Normaliser, Relief, Shading, Shadow};
use bossage_translate::emit::spirv_listing;
use bossage_translate::{Contents, EmitOptions, Manifest, Shader, Source, Target, emit, manifest};

/// What only this effect has. `light_vector` has no name of its own: it is an expression on the position, which other
/// effects need too.
fn words(effect: EffectId) -> &'static [&'static str] {
    match effect {
        EffectId::Lighting => &["light", "lights", "radiance", "lambert", "light_dir"],
        EffectId::LightVector => &[],
        EffectId::LightLoop => &["lights", "items", "MAX_LIGHTS"],
        EffectId::Specular => &["specular", "shininess", "half_vector", "highlight_power"],
        EffectId::Environment => &["environment_map", "environment_bump", "reflected_dir", "specular"],
        EffectId::NormalMap => &["normal_map", "normal_decode", "normal_texel", "combine_frame"],
        EffectId::NormalisationCube => &["normalisation_map"],
        EffectId::AlbedoMap => &["albedo_map"],
        EffectId::AlphaDiscard => &["alpha_cutoff", "discard", "discard_fragment", "OpKill"],
        EffectId::Relief => &[
            "height_map",
            "relief",
            "elevation",
            "view_dir_ts",
            "parallax_offset",
            "parallax_offset_limited",
            "parallax_slope_ao",
            "parallax_slope_ao_directed",
            "parallax_slope_ao_delta",
        ],
        EffectId::Shadow => &[
            "self_shadow",
            "soft_shadow",
            "light_half_width",
            "seen_share",
            "light_rise",
            "seen",
        ],
        EffectId::PixelDepth => &["pixel_depth", "relief_place", "clip_z", "clip_w", "tile_width"],
        EffectId::AmbientOcclusion => &["occlusion", "slope_occlusion"],
        EffectId::Emboss => &[
            "height_map",
            "emboss",
            "emboss_step",
            "embossed",
            "height_toward_light",
        ],
        EffectId::Displacement => &["height_map", "elevation", "displacement", "displaced_position"],
        EffectId::SecondPass => &["dot3_first_pass"],
        EffectId::CofactorMatrix => &["cofactor", "handedness_sign"],
        EffectId::Handedness => &["lighting_space_handedness", "handedness"],
    }
}

fn examples() -> Vec<PathBuf> {
    let dir = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let files = std::fs::read_dir(dir)
        .expect("examples/ is there")
        .map(|entry| entry.unwrap().path());
    let mut scenes: Vec<PathBuf> = files
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    scenes.sort();
    assert!(scenes.len() >= 4, "examples/ lost scenes: {scenes:?}");
    scenes
}

/// The identifiers of a text, without the digits and underscores that a back end appends to keep names apart.
fn identifiers(text: &str) -> BTreeSet<String> {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    words
        .map(|word| {
            word.trim_end_matches(|c: char| c == '_' || c.is_ascii_digit())
                .to_owned()
        })
        .collect()
}

/// Every identifier of a permutation, over both stages: `(target, identifiers)`, and the manifest's names as one more row.
fn traces(library: &Library, set: &FeatureSet) -> Vec<(String, BTreeSet<String>)> {
    let mut rows = Vec::new();
    for &stage in set.stages() {
        let assembled = library.assemble_surface(set, stage).unwrap();
        let shader = Shader::parse(&assembled.name, &Source::Wgsl(assembled.wgsl)).unwrap();
        let options = EmitOptions::default();
        let emitted: Vec<_> = Target::ALL
            .iter()
            .map(|&t| emit(&shader, t, &options).unwrap())
            .collect();
        for one in &emitted {
            let texts = one.files.iter().map(|file| match &file.contents {
                Contents::Text(text) => text.clone(),
                Contents::Binary(bytes) => spirv_listing(bytes).unwrap(),
            });
            rows.push((
                format!("{stage:?} {}", one.target),
                texts.flat_map(|text| identifiers(&text)).collect(),
            ));
        }
        rows.push((
            format!("{stage:?} manifest"),
            manifest_names(&manifest(&shader, &options, &emitted)),
        ));
    }
    rows
}

/// Names of bindings, uniform members and varyings.
fn manifest_names(manifest: &Manifest) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for entry in &manifest.entries {
        names.extend(entry.bindings.iter().map(|b| b.name.clone()));
        names.extend(
            entry
                .uniforms
                .iter()
                .flat_map(|u| u.members.iter().map(|m| m.name.clone())),
        );
        names.extend(entry.inputs.iter().chain(&entry.outputs).map(|v| v.name.clone()));
    }
    names
}

/// One line for each word of a dropped effect that is there all the same, and for each kept effect with no word at all.
fn faults(material: &MaterialPlan, rows: &[(String, BTreeSet<String>)]) -> Vec<String> {
    let mut found = Vec::new();
    // What a kept effect needs is no trace of a dropped one.
    let needed: BTreeSet<&str> = material
        .effects
        .iter()
        .filter(|effect| effect.state == State::Kept)
        .flat_map(|effect| words(effect.id))
        .copied()
        .collect();
    for effect in &material.effects {
        let words = words(effect.id);
        let seen = |word: &&&str| rows.iter().find(|(_, names)| names.contains(**word));
        match effect.state {
            State::Dropped => found.extend(words.iter().filter(|word| !needed.contains(**word)).filter_map(
                |word| {
                    let (place, _) = seen(&word)?;
                    Some(format!(
                        "{}: {} was dropped, but `{word}` is in {place}",
                        material.name,
                        effect.id.as_str()
                    ))
                },
            )),
            State::Kept if !words.is_empty() && !words.iter().any(|word| seen(&word).is_some()) => {
                found.push(format!(
                    "{}: {} is kept, but none of its words occurs",
                    material.name,
                    effect.id.as_str()
                ));
            }
            State::Kept => {}
        }
    }
    found
}

#[test]
fn dropped_effects_leave_no_trace_in_any_target() {
    let library = Library::embedded().unwrap();
    let mut checked = 0;
    for path in examples() {
        let scene = bossage_scene::load(&path).unwrap_or_else(|why| panic!("{why}"));
        for material in &bossage_scene::plan(&scene).materials {
            let rows = traces(&library, &material.features);
            assert_eq!(
                faults(material, &rows),
                Vec::<String>::new(),
                "{}",
                path.display()
            );
            checked += material
                .effects
                .iter()
                .filter(|e| e.state == State::Dropped && !words(e.id).is_empty())
                .count();
        }
    }
    assert!(checked >= 20, "the examples must drop something: {checked}");
}

/// Sets that have among them every effect that has words: no one permutation has them all, since the articles' techniques
/// exclude each other.
fn full_sets() -> Vec<FeatureSet> {
    let lit = FeatureSet {
        lights: Lights::Directional,
        ..FeatureSet::default()
    };
    let pinned = [
        FeatureSet {
            relief: Relief::ParallaxOffset,
            ..lit
        },
        FeatureSet {
            shading: Shading::WrapLambert,
            normal: NormalSource::Map,
            relief: Relief::ParallaxSlopeAo,
            ..lit
        },
        FeatureSet {
            shading: Shading::Emboss,
            ..lit
        },
        FeatureSet {
            relief: Relief::Displacement,
            ..lit
        },
        FeatureSet {
            shading: Shading::Dot3SinglePass,
            normaliser: Normaliser::Cube,
            ..lit
        },
        FeatureSet {
            shading: Shading::Dot3TwoPass,
            ..lit
        },
        FeatureSet {
            relief: Relief::SteepParallax,
            shadow: Shadow::Soft,
            pixel_depth: true,
            ..lit
        },
    ];
    pinned.map(FeatureSet::all_effects).to_vec()
}

/// A plan that says "dropped" while the shader still has the effect is caught, for every effect that has words.
#[test]
fn an_effect_that_was_left_in_is_caught() {
    let library = Library::embedded().unwrap();
    let scene = bossage_scene::load(&examples()[0]).unwrap_or_else(|why| panic!("{why}"));
    let mut material = bossage_scene::plan(&scene).materials.swap_remove(0);
    for effect in &mut material.effects {
        effect.state = State::Dropped;
    }
    let found: Vec<String> = full_sets()
        .iter()
        .flat_map(|set| faults(&material, &traces(&library, set)))
        .collect();
    for id in EffectId::ALL.into_iter().filter(|&id| !words(id).is_empty()) {
        let needle = format!("{} was dropped", id.as_str());
        assert!(
            found.iter().any(|line| line.contains(&needle)),
            "{needle} was not caught: {found:?}"
        );
        // And by a word that no other effect has, or the effect could hide behind one that is kept.
        let own = |word: &&&str| {
            !EffectId::ALL
                .into_iter()
                .any(|other| other != id && words(other).contains(*word))
        };
        assert!(
            words(id).iter().filter(own).any(|word| found
                .iter()
                .any(|line| line.contains(&needle) && line.contains(&format!("`{word}`")))),
            "{}: only words of others show it",
            id.as_str()
        );
    }
}

/// A word that a kept effect needs is no fault, and without that effect it is one.
#[test]
fn shared_words_go_with_the_last_effect_that_needs_them() {
    let library = Library::embedded().unwrap();
    let scene = bossage_scene::load(&examples()[0]).unwrap_or_else(|why| panic!("{why}"));
    let mut material = bossage_scene::plan(&scene).materials.swap_remove(0);
    let embossed = full_sets()[2];
    let rows = traces(&library, &embossed);
    for effect in &mut material.effects {
        effect.state = State::Dropped;
    }
    let height_map = |material: &MaterialPlan| {
        faults(material, &rows)
            .iter()
            .filter(|line| line.contains("`height_map`"))
            .count()
    };
    assert_eq!(height_map(&material), 3);
    let emboss = EffectId::ALL
        .iter()
        .position(|id| *id == EffectId::Emboss)
        .unwrap();
    material.effects[emboss].state = State::Kept;
    assert_eq!(height_map(&material), 0);
}
