//! What the library emits, as text that a reviewer reads: one snapshot a technique and target, and one index of everything.
//!
//! `snapshots/TECHNIQUE@TARGET.snap` holds the probe of a technique's main function, of a search along view rays its kernel; `surface_…@TARGET.snap` hold two whole
//! surfaces. `snapshots/permutations@index.snap` has one line a module that the feature model can reach: static cost, and a
//! hash of each target's file, so that any change of any emitted byte shows as a readable patch. `docs/testing.md` says how
//! to review and accept.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

use bossage_shaders::{Albedo, Alpha, Transform};
use bossage_shaders::{
    AssembledShader, FeatureSet, Form, HeightRead, Kernel, Library, LightTechnique, Lights, NormalSource,
    PROBES, Probe, Relief, ReliefLight, ReliefSearch, ReliefTechnique, Stage, TECHNIQUES, Technique,
};
use bossage_translate::emit::spirv_listing;
use bossage_translate::{Contents, Cost, EmitOptions, Emitted, Shader, Target, emit, manifest};

mod support;

use support::{modules, parse, settings, snapshot_dir};

const INDEX: &str = "permutations@index";

fn emit_all(shader: &Shader) -> Vec<Emitted> {
    let options = EmitOptions::default();
    let emitted = Target::ALL.iter().map(|&target| emit(shader, target, &options));
    emitted
        .map(|result| result.unwrap_or_else(|why| panic!("{why}")))
        .collect()
}

/// The text of a file as a person reads it: SPIR-V as its listing.
fn readable(emitted: &Emitted) -> String {
    let texts = emitted.files.iter().map(|file| match &file.contents {
        Contents::Text(text) => text.clone(),
        Contents::Binary(bytes) => spirv_listing(bytes).expect("our own SPIR-V disassembles"),
    });
    texts.collect::<Vec<_>>().join("\n")
}

/// The module that stands for a technique: that of a search for the hit, where it is one whose function takes textures; else the
/// probe of its main function.
fn main_module(library: &Library, technique: &Technique) -> AssembledShader {
    let heights = HeightRead::Filtered;
    let search = ReliefTechnique::find(technique.id)
        .map(|technique| Kernel::ReliefHits(ReliefSearch { technique, heights }));
    let light = LightTechnique::ALL
        .into_iter()
        .find(|light| light.id() == technique.id);
    let light = light.map(|technique| Kernel::ReliefLight(ReliefLight { technique, heights }));
    let kernel = search.or(light).filter(|_| Probe::find(technique.id).is_none());
    let assembled = match kernel {
        Some(kernel) => library.assemble_kernel(kernel),
        None => library.assemble_probe(main_probe(technique).id),
    };
    assembled.expect("the library assembles")
}

/// The function that stands for a technique: the one of its name if there is one, else its first hardened probe.
fn main_probe(technique: &Technique) -> &'static Probe {
    let mut own = PROBES.iter().filter(|probe| probe.technique == technique.id);
    let named = own.clone().find(|probe| probe.id.as_str() == technique.id);
    named
        .or_else(|| own.find(|probe| probe.form == Form::Hardened))
        .expect("every technique has a probe")
}

/// Two whole surfaces: the brick wall's, and one with everything on.
fn surfaces() -> [(&'static str, FeatureSet); 2] {
    let bricks = FeatureSet {
        relief: Relief::ParallaxOffsetLimited,
        normal: NormalSource::Map,
        lights: Lights::Directional,
        specular: true,
        albedo: Albedo::Map,
        ..FeatureSet::default()
    };
    let everything = FeatureSet {
        relief: Relief::ParallaxOffset,
        lights: Lights::Many,
        alpha: Alpha::Mask,
        transform: Transform::General,
        mirrored_uv: true,
        ..bricks
    };
    [("surface_bricks", bricks), ("surface_everything", everything)]
}

/// Every snapshot that this file takes: its name, and the modules whose text it holds.
fn plan(library: &Library) -> Vec<(String, Target, Vec<AssembledShader>)> {
    let mut rows = Vec::new();
    for technique in TECHNIQUES {
        let assembled = main_module(library, technique);
        rows.extend(
            Target::ALL
                .iter()
                .map(|&t| (technique.id.to_owned(), t, vec![assembled.clone()])),
        );
    }
    for (name, set) in surfaces() {
        let stages = set
            .stages()
            .iter()
            .map(|&stage| library.assemble_surface(&set, stage).unwrap())
            .collect::<Vec<_>>();
        rows.extend(Target::ALL.iter().map(|&t| (name.to_owned(), t, stages.clone())));
    }
    rows
}

#[test]
fn techniques_at_targets() {
    let library = Library::embedded().unwrap();
    settings().bind(|| {
        for (name, target, modules) in plan(&library) {
            let options = EmitOptions::default();
            let texts = modules
                .iter()
                .map(|m| readable(&emit(&parse(m), target, &options).unwrap()));
            insta::assert_snapshot!(format!("{name}@{target}"), texts.collect::<Vec<_>>().join("\n"));
        }
    });
}

/// One line a module: name, static cost, and for each target a hash of its file and how long it is (SPIR-V: words; text:
/// statements).
fn index_line(assembled: &AssembledShader) -> String {
    let shader = parse(assembled);
    let emitted = emit_all(&shader);
    let manifest = manifest(&shader, &EmitOptions::default(), &emitted);
    let [entry] = &manifest.entries[..] else {
        panic!("{}: one entry point a module", assembled.name)
    };
    let mut line = format!("{}: {}", assembled.name, cost(&entry.cost));
    for one in &emitted {
        let hash = &entry.sha256[one.target.name()][..8];
        let _ = write!(
            line,
            " | {} {hash} {}",
            one.target,
            length(&one.files[0].contents)
        );
    }
    line
}

fn cost(cost: &Cost) -> String {
    format!(
        "ops {} samples {} loads {} branches {} loops {}",
        cost.ops, cost.samples, cost.texture_loads, cost.branches, cost.loops
    )
}

fn length(contents: &Contents) -> usize {
    match contents {
        Contents::Text(text) => text.matches(';').count(),
        Contents::Binary(bytes) => bytes.len() / 4,
    }
}

#[test]
fn the_index_of_all_permutations() {
    let library = Library::embedded().unwrap();
    let modules = modules(&library);
    let sets = FeatureSet::reachable().len();
    // A sum, not a product: 911 without the searches along the view ray, and 62 for each of these.
    assert!(
        modules.len() < 1600,
        "the feature model must keep the number of modules a sum: {}",
        modules.len()
    );
    let head = format!("{sets} feature sets, {} modules", modules.len());
    let lines: Vec<String> = modules.iter().map(index_line).collect();
    settings().bind(|| insta::assert_snapshot!(INDEX, format!("{head}\n\n{}", lines.join("\n"))));
}

#[test]
fn a_changed_byte_changes_the_index() {
    let library = Library::embedded().unwrap();
    let [(_, set), _] = surfaces();
    let assembled = library.assemble_surface(&set, Stage::Fragment).unwrap();
    let mut changed = assembled.clone();
    changed.wgsl = assembled.wgsl.replacen("max(", "min(", 1);
    assert_ne!(assembled.wgsl, changed.wgsl, "the control needs a max() to swap");
    assert_ne!(index_line(&assembled), index_line(&changed));
}

/// Snapshots of `source` that no test takes any more, and files that are no snapshots.
fn orphans(dir: &Path, source: &str, taken: &BTreeSet<String>) -> Vec<String> {
    let files = std::fs::read_dir(dir)
        .expect("the snapshot folder is there")
        .map(|entry| entry.unwrap().path());
    let mut found: Vec<String> = files.filter_map(|path| orphan(&path, source, taken)).collect();
    found.sort();
    found
}

fn orphan(path: &Path, source: &str, taken: &BTreeSet<String>) -> Option<String> {
    let name = path.file_name()?.to_str()?.to_owned();
    let Some(stem) = name.strip_suffix(".snap") else {
        return Some(format!("{name}: not a snapshot"));
    };
    let text = std::fs::read_to_string(path).expect("a snapshot is text");
    let from = text
        .lines()
        .find_map(|line| line.strip_prefix("source: "))
        .unwrap_or("nowhere");
    let unused = from == source && !taken.contains(stem);
    let unknown = ![
        source,
        "crates/cli/tests/help.rs",
        "tests/instructions.rs",
        "crates/conformance/tests/widths.rs",
    ]
    .contains(&from);
    (unused || unknown).then(|| format!("{name}: taken by {from}, which has no such snapshot"))
}

fn taken() -> BTreeSet<String> {
    let library = Library::embedded().unwrap();
    let mut names: BTreeSet<String> = plan(&library)
        .into_iter()
        .map(|(name, t, _)| format!("{name}@{t}"))
        .collect();
    names.insert(INDEX.to_owned());
    names
}

#[test]
fn no_orphans() {
    assert_eq!(
        orphans(&snapshot_dir(), "tests/snapshots.rs", &taken()),
        Vec::<String>::new()
    );
}

#[test]
fn an_orphan_is_caught() {
    let dir = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(dir.path().join(name), text).unwrap();
    write("gone@hlsl.snap", "---\nsource: tests/snapshots.rs\n---\n");
    write("dot3@hlsl.snap", "---\nsource: tests/snapshots.rs\n---\n");
    write("dot3@msl.snap.new", "");
    assert_eq!(orphans(dir.path(), "tests/snapshots.rs", &taken()).len(), 2);
}
