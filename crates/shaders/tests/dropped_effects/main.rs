//! A dropped effect leaves nothing behind: no binding, varying, uniform member, function or local of it is in the text.
//!
//! Each effect has a list of words of its own. Where a feature set leaves the effect out, none of them may occur in its
//! modules as a whole word; where it is in, at least one must, or the list would check nothing.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use bossage_shaders::{FeatureSet, Library, Result, Stage};

mod effects;

use effects::{EFFECTS, Effect};

/// The words of dropped effects that a module holds.
fn left_behind(set: &FeatureSet, stage: Stage, wgsl: &str) -> Vec<String> {
    let words = words(wgsl);
    let dropped = EFFECTS.iter().filter(|effect| !(effect.on)(set));
    let found = dropped.flat_map(|effect| list(effect, stage).iter().map(move |word| (effect.name, *word)));
    found
        .filter(|(_, word)| words.contains(word))
        .map(|(effect, word)| format!("{effect}: {word}"))
        .collect()
}

fn list(effect: &Effect, stage: Stage) -> &'static [&'static str] {
    match stage {
        Stage::Vertex => effect.vertex,
        Stage::Fragment | Stage::SecondPass | Stage::FragmentCapture | Stage::FragmentGivenHit => {
            effect.fragment
        }
    }
}

/// The words of the code; the header is a comment.
fn words(wgsl: &str) -> Vec<&str> {
    let code = wgsl.lines().filter(|line| !line.starts_with("//"));
    code.flat_map(|line| line.split(|c: char| !c.is_alphanumeric() && c != '_'))
        .filter(|word| !word.is_empty())
        .collect()
}

/// Every leak in every `step`th reachable permutation.
fn leaks(library: &Library, step: usize) -> Result<Vec<String>> {
    let (mut assembled, mut leaks) = (BTreeMap::new(), Vec::new());
    for set in FeatureSet::reachable().into_iter().step_by(step) {
        for stage in [Stage::Vertex, Stage::Fragment] {
            let name = if stage == Stage::Vertex {
                set.vertex().name()
            } else {
                set.fragment().name()
            };
            if !assembled.contains_key(&name) {
                assembled.insert(name.clone(), library.assemble_surface(&set, stage)?.wgsl);
            }
            leaks.extend(
                left_behind(&set, stage, &assembled[&name])
                    .into_iter()
                    .map(|leak| format!("{name}: {leak}")),
            );
        }
    }
    Ok(leaks)
}

#[test]
fn a_dropped_effect_leaves_no_name_behind() -> Result<()> {
    let leaks = leaks(&Library::embedded()?, 1)?;
    assert!(leaks.is_empty(), "{}", leaks.join("\n"));
    Ok(())
}

#[test]
fn every_word_on_the_lists_occurs_where_its_effect_is_kept() -> Result<()> {
    let library = Library::embedded()?;
    let mut seen = BTreeSet::new();
    for set in FeatureSet::reachable().into_iter().step_by(3) {
        for stage in [Stage::Vertex, Stage::Fragment, Stage::FragmentCapture] {
            let shader = library.assemble_surface(&set, stage)?;
            seen.extend(
                words(&shader.wgsl)
                    .into_iter()
                    .map(|word| (stage == Stage::Vertex, word.to_owned())),
            );
        }
    }
    for effect in EFFECTS {
        for (vertex, words) in [(true, effect.vertex), (false, effect.fragment)] {
            for word in words {
                assert!(
                    seen.contains(&(vertex, (*word).to_owned())),
                    "`{word}` of {} occurs nowhere",
                    effect.name
                );
            }
        }
    }
    Ok(())
}

/// The second pass writes the colour and knows of nothing else.
#[test]
fn a_second_pass_holds_the_colour_alone() -> Result<()> {
    let library = Library::embedded()?;
    let mut seen = 0;
    for set in FeatureSet::reachable()
        .into_iter()
        .filter(|set| set.second_pass().is_some())
    {
        let wgsl = library.assemble_surface(&set, Stage::SecondPass)?.wgsl;
        for word in [
            "light",
            "normal_map",
            "ambient",
            "tangent",
            "normal",
            "position",
            "view",
        ] {
            assert!(!words(&wgsl).contains(&word), "{}: `{word}`", set.name());
        }
        assert!(words(&wgsl).contains(&"albedo"));
        seen += 1;
    }
    assert!(seen > 1);
    Ok(())
}

/// The library in a folder, with one text in one file replaced.
fn edited(file: &str, from: &str, to: &str) -> Result<Library> {
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("no temporary folder: {error}"));
    copy(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shaders"),
        folder.path(),
    );
    let path = folder.path().join(file);
    let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{file}: {error}"));
    assert!(text.contains(from), "{file} holds no `{from}`");
    fs::write(&path, text.replacen(from, to, 1)).unwrap_or_else(|error| panic!("{file}: {error}"));
    Library::from_dir(folder.path())
}

fn copy(from: &Path, to: &Path) {
    for entry in fs::read_dir(from)
        .unwrap_or_else(|error| panic!("{}: {error}", from.display()))
        .flatten()
    {
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            fs::create_dir(&target).unwrap_or_else(|error| panic!("{}: {error}", target.display()));
            copy(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), &target).unwrap_or_else(|error| panic!("{}: {error}", target.display()));
        }
    }
}

/// Takes the guard off one declaration, member or statement at a time: each must be noticed.
#[test]
fn a_missing_guard_is_caught() -> Result<()> {
    let planted = [
        (
            "entry/surface_bindings.wesl",
            "@if(specular) shininess",
            "shininess",
        ),
        (
            "entry/surface_bindings.wesl",
            "@if(soft_shadow) light_half_width",
            "light_half_width",
        ),
        (
            "entry/surface_bindings.wesl",
            "@if(pixel_depth) tile_width",
            "tile_width",
        ),
        (
            "entry/surface_bindings.wesl",
            "@if(relief) relief: vec4f",
            "relief: vec4f",
        ),
        (
            "entry/surface_varyings.wesl",
            "struct FragmentInput {\n    @if(position_varying) ",
            "struct FragmentInput {\n    ",
        ),
        (
            "entry/surface_vertex.wesl",
            "@if(general_transform) cofactor",
            "cofactor",
        ),
        ("entry/surface_fragment.wesl", "@elif(alpha_mask)\n", "@else\n"),
        (
            "entry/surface_bindings.wesl",
            "@if(specular_color) specular",
            "specular",
        ),
        ("entry/surface_bindings.wesl", "@if(slope) occlusion", "occlusion"),
        (
            "entry/surface_fragment.wesl",
            "@if(view_vector)\n    let view_dir",
            "let view_dir",
        ),
    ];
    for (file, from, to) in planted {
        // A statement without its guard may also name what is not there any more; that is caught as well.
        let caught = leaks(&edited(file, from, to)?, 7).map_or(true, |leaks| !leaks.is_empty());
        assert!(caught, "{file}: dropping the guard of `{to}` went unnoticed");
    }
    Ok(())
}
