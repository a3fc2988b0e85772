//! The sources are in order: no orphan, no undocumented file, no function without a probe; and faults in them are told with
//! file, line, column and a caret.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use bossage_shaders::{
    Error, FeatureSet, Form, Kernel, Library, Lights, PROBES, Probe, Result, Stage, TECHNIQUES,
};

fn shaders() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shaders")
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)
        .unwrap_or_else(|error| panic!("{}: {error}", folder.display()))
        .flatten()
    {
        let path = entry.path();
        if path.is_dir() {
            found.extend(files(&path))
        } else {
            found.push(path)
        }
    }
    found.sort();
    found
}

/// A copy of the library in a folder of its own.
fn copy() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("no temporary folder: {error}"));
    for file in files(&shaders()) {
        let target = folder.path().join(file.strip_prefix(shaders()).unwrap_or(&file));
        fs::create_dir_all(target.parent().unwrap_or(folder.path()))
            .unwrap_or_else(|error| panic!("{error}"));
        fs::copy(&file, &target).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    }
    folder
}

fn edit(folder: &Path, file: &str, from: &str, to: &str) {
    let path = folder.join(file);
    let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{file}: {error}"));
    assert!(text.contains(from), "{file} holds no `{from}`");
    fs::write(&path, text.replacen(from, to, 1)).unwrap_or_else(|error| panic!("{file}: {error}"));
}

fn message(result: Result<impl Sized>) -> String {
    match result {
        Ok(_) => panic!("the fault went unnoticed"),
        Err(error) => error.to_string(),
    }
}

/// The message for the library with one text of one file replaced.
fn fault(file: &str, from: &str, to: &str) -> String {
    let folder = copy();
    edit(folder.path(), file, from, to);
    message(Library::from_dir(folder.path()))
}

#[test]
fn a_folder_gives_what_the_binary_holds() -> Result<()> {
    let (embedded, folder) = (Library::embedded()?, Library::from_dir(&shaders())?);
    let set = FeatureSet {
        lights: Lights::Many,
        ..FeatureSet::default()
    }
    .all_effects();
    for stage in [Stage::Vertex, Stage::Fragment] {
        assert_eq!(
            embedded.assemble_surface(&set, stage)?,
            folder.assemble_surface(&set, stage)?
        );
    }
    Ok(())
}

#[test]
fn a_change_in_the_folder_shows() -> Result<()> {
    let folder = copy();
    edit(folder.path(), "techniques/parallax_offset.wesl", "0.05", "0.25");
    let shader = Library::from_dir(folder.path())?.assemble_probe(probe("parallax_offset").id)?;
    assert!(shader.wgsl.contains("0.25"));
    Ok(())
}

fn probe(id: &str) -> &'static Probe {
    Probe::find(id).unwrap_or_else(|| panic!("no probe {id}"))
}

#[test]
fn no_file_is_an_orphan() -> Result<()> {
    assert_eq!(Library::embedded()?.orphans(), [""; 0]);
    let folder = copy();
    fs::write(folder.path().join("lib/forgotten.wesl"), "fn forgotten() {}\n")
        .unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(
        Library::from_dir(folder.path())?.orphans(),
        ["lib/forgotten.wesl"]
    );
    Ok(())
}

#[test]
fn a_file_that_a_table_names_must_be_there() {
    let folder = copy();
    fs::remove_file(folder.path().join("techniques/dot3.wesl")).unwrap_or_else(|error| panic!("{error}"));
    let text = message(Library::from_dir(folder.path()));
    assert!(text.contains("has no `techniques/dot3.wesl`"), "{text}");
}

#[test]
fn a_folder_that_is_not_there_is_told() {
    let text = message(Library::from_dir(Path::new("no/such/folder")));
    assert!(text.contains("cannot read `no/such/folder`"), "{text}");
}

#[test]
fn every_feature_is_used_and_every_used_one_is_known() -> Result<()> {
    // A used feature that is unknown fails on reading; here: a known one that nothing uses.
    let library = Library::embedded()?;
    let mut on = BTreeSet::new();
    for set in FeatureSet::reachable() {
        for stage in [
            Stage::Vertex,
            Stage::Fragment,
            Stage::FragmentCapture,
            Stage::FragmentGivenHit,
        ] {
            on.extend(library.assemble_surface(&set, stage)?.features);
        }
    }
    for kernel in Kernel::all() {
        on.extend(library.assemble_kernel(kernel)?.features);
    }
    assert_eq!(on.into_iter().collect::<Vec<_>>(), library.features_used());
    Ok(())
}

#[test]
fn a_misspelt_feature_is_an_error() {
    let text = fault(
        "entry/surface_bindings.wesl",
        "@if(specular) shininess",
        "@if(specualr && !relief) shininess",
    );
    assert!(text.starts_with("entry/surface_bindings.wesl:"), "{text}");
    assert!(text.contains("there is no feature `specualr`"), "{text}");
    assert!(
        text.contains("    @if(specualr && !relief) shininess: f32,\n   |         ^^^^^^^^\n"),
        "{text}"
    );
    assert!(text.ends_with("did you mean `specular`?"), "{text}");
}

#[test]
fn a_misspelt_feature_is_found_wherever_a_condition_may_stand() {
    let planted = [
        (
            "techniques/dot3.wesl",
            "import package::lib::lambert",
            "@if(nosuch) import package::lib::lambert",
        ),
        (
            "techniques/dot3.wesl",
            "fn dot3_combiner(a: vec3f",
            "fn dot3_combiner(@if(nosuch) c: f32, a: vec3f",
        ),
        (
            "techniques/dot3.wesl",
            "fn dot3_combiner",
            "@if(nosuch) fn dot3_combiner",
        ),
        (
            "techniques/dot3.wesl",
            "    return lambert",
            "    @if(true) { @if(!(nosuch)) return vec3f(); }\n    return lambert",
        ),
        (
            "techniques/dot3.wesl",
            "    return lambert",
            "    for (var i = 0; i < 2; i++) { @if(nosuch || relief) break; }\n    return lambert",
        ),
        (
            "techniques/dot3.wesl",
            "    return lambert",
            "    if (true) {} else { @if(relief) let a = 0; @elif(nosuch) let a = 1; }\n    return lambert",
        ),
        (
            "techniques/dot3.wesl",
            "    return lambert",
            "    switch (1) { @if(nosuch) case 1 {} default { } }\n    return lambert",
        ),
        (
            "techniques/dot3.wesl",
            "    return lambert",
            "    loop { break; continuing { @if(nosuch) let a = 1; } }\n    return lambert",
        ),
        (
            "lib/normalise.wesl",
            "const SMALLEST",
            "@if(nosuch) const OTHER = 1;\nconst SMALLEST",
        ),
    ];
    for (file, from, to) in planted {
        let text = fault(file, from, to);
        assert!(text.contains("there is no feature `nosuch`"), "{to}: {text}");
        assert!(text.contains('^'), "{to}: {text}");
    }
}

#[test]
fn a_syntax_error_has_its_place() {
    let text = fault("techniques/dot3.wesl", "fn dot3_combiner(", "fn dot3_combiner[");
    let line = 1 + fs::read_to_string(shaders().join("techniques/dot3.wesl"))
        .unwrap_or_default()
        .lines()
        .position(|line| line.starts_with("fn dot3_combiner("))
        .unwrap_or(0);
    assert!(
        text.starts_with(&format!("techniques/dot3.wesl:{line}:17: unexpected token `[`")),
        "{text}"
    );
    assert!(text.contains("^"), "{text}");
}

#[test]
fn an_unknown_module_or_name_has_its_place() {
    let text = fault(
        "techniques/dot3.wesl",
        "package::lib::lambert::lambert",
        "package::lib::lamberd::lambert",
    );
    assert!(
        text.contains("there is no module `package::lib::lamberd`"),
        "{text}"
    );
    assert!(text.contains("\n   |                      ^^^^^^^"), "{text}");
    let text = fault(
        "techniques/dot3.wesl",
        "{normalise, normalise_published}",
        "{normalise, normalise_publshed}",
    );
    assert!(
        text.contains("`lib/normalise.wesl` declares no `normalise_publshed`"),
        "{text}"
    );
    assert!(text.ends_with("did you mean `normalise_published`?"), "{text}");
}

#[test]
fn one_name_declared_twice_is_an_error() -> Result<()> {
    let folder = copy();
    edit(
        folder.path(),
        "lib/frame.wesl",
        "// The third axis",
        "fn lambert() {}\n// The third axis",
    );
    edit(
        folder.path(),
        "lib/frame.wesl",
        "    return tangent.w",
        "    lambert();\n    return tangent.w",
    );
    let all = FeatureSet {
        lights: Lights::Directional,
        ..FeatureSet::default()
    }
    .all_effects();
    let all = FeatureSet {
        specular: false,
        ..all
    };
    let text = message(Library::from_dir(folder.path())?.assemble_surface(&all, Stage::Fragment));
    assert!(text.contains("`lambert` is declared twice"), "{text}");
    assert!(
        text.contains("lib/frame.wesl") && text.contains("lib/lambert.wesl"),
        "{text}"
    );
    Ok(())
}

#[test]
fn a_local_that_would_catch_an_import_is_an_error() {
    let folder = copy();
    let file = "techniques/dot3.wesl";
    edit(
        folder.path(),
        file,
        "lambert::lambert;",
        "lambert::lambert as diffuse_factor;",
    );
    edit(
        folder.path(),
        file,
        "fn dot3(",
        "fn caught(lambert: f32) {}\n\nfn dot3(",
    );
    let text = message(Library::from_dir(folder.path()));
    assert!(text.contains("a local variable has the name `lambert`"), "{text}");
}

#[test]
fn every_function_has_a_probe() -> Result<()> {
    // Words that a float cannot carry; the bake kernels run these, byte for byte.
    const EXEMPT: &[&str] = &["pack_rgba8", "pack_rgba16", "unpack_rgba8"];
    let missing = |library: &Library| -> Vec<String> {
        let functions = library.functions().into_iter();
        let probed = |file: &str, name: &str| {
            PROBES
                .iter()
                .any(|probe| probe.file == file && probe.function() == name)
        };
        let bound = library.texture_functions();
        functions
            .filter(|(file, name)| {
                !EXEMPT.contains(&name.as_str()) && !bound.contains(name) && !probed(file, name)
            })
            .map(|(_, name)| name)
            .collect()
    };
    assert_eq!(missing(&Library::embedded()?), [""; 0]);
    let folder = copy();
    edit(
        folder.path(),
        "lib/lambert.wesl",
        "fn lambert",
        "fn unprobed() {}\n\nfn lambert",
    );
    assert_eq!(missing(&Library::from_dir(folder.path())?), ["unprobed"]);
    Ok(())
}

#[test]
fn every_function_that_takes_a_texture_is_in_a_kernel() -> Result<()> {
    let missing = |library: &Library| -> Result<Vec<String>> {
        let kernels: Vec<String> = Kernel::all()
            .map(|kernel| library.assemble_kernel(kernel).map(|module| module.wgsl))
            .collect::<Result<_>>()?;
        let mut functions = library.texture_functions();
        functions.retain(|name| !kernels.iter().any(|text| text.contains(&format!("fn {name}("))));
        Ok(functions)
    };
    let library = Library::embedded()?;
    assert!(library.texture_functions().contains(&"height_at".to_owned()));
    assert_eq!(missing(&library)?, [""; 0]);
    let folder = copy();
    edit(
        folder.path(),
        "lib/lambert.wesl",
        "fn lambert",
        "fn unreached(map: texture_2d<f32>) {}\n\nfn lambert",
    );
    assert_eq!(missing(&Library::from_dir(folder.path())?)?, ["unreached"]);
    Ok(())
}

#[test]
fn tables_and_sources_agree() -> Result<()> {
    let functions: BTreeSet<(String, String)> = Library::embedded()?.functions().into_iter().collect();
    let mut ids = BTreeSet::new();
    for probe in PROBES {
        assert!(ids.insert(probe.id), "probe {} is listed twice", probe.id);
        assert!(
            functions.contains(&(probe.file.to_owned(), probe.function().to_owned())),
            "{}",
            probe.id
        );
        assert_eq!(
            probe.form == Form::Published,
            probe.id.as_str().ends_with("_published"),
            "{}",
            probe.id
        );
    }
    for technique in TECHNIQUES {
        assert_eq!(technique.files[0], format!("techniques/{}.wesl", technique.id));
        let published = functions
            .iter()
            .any(|(file, name)| file == technique.files[0] && name.ends_with("_published"));
        assert_eq!(
            published,
            technique.forms.contains(&Form::Published),
            "{}",
            technique.id
        );
    }
    let on_disk: Vec<PathBuf> = files(&shaders().join("techniques"));
    assert_eq!(on_disk.len(), TECHNIQUES.len());
    Ok(())
}

#[test]
fn every_file_says_what_it_is() {
    for file in files(&shaders())
        .iter()
        .filter(|file| file.extension().is_some_and(|ext| ext == "wesl"))
    {
        let text = fs::read_to_string(file).unwrap_or_default();
        let head: Vec<&str> = text.lines().take_while(|line| line.starts_with("//")).collect();
        assert!(head.len() >= 3, "{} has no header", file.display());
        if !file.components().any(|part| part.as_os_str() == "entry") {
            for word in ["// Source:", "// Domain:"] {
                assert!(
                    head.iter().any(|line| line.starts_with(word)),
                    "{} has no `{word}`",
                    file.display()
                );
            }
        }
    }
}

#[test]
fn the_readme_lists_every_technique_and_file() {
    let readme = fs::read_to_string(shaders().join("README.md")).unwrap_or_default();
    for file in files(&shaders())
        .iter()
        .filter(|file| file.extension().is_some_and(|ext| ext == "wesl"))
    {
        let shown = file.strip_prefix(shaders()).unwrap_or(file).display().to_string();
        assert!(
            readme.contains(&format!("`{shown}`")),
            "shaders/README.md does not list {shown}"
        );
    }
    for technique in TECHNIQUES {
        assert!(
            readme.contains(&format!("`{}`", technique.id)),
            "shaders/README.md does not list {}",
            technique.id
        );
    }
}

#[test]
fn an_id_of_another_table_is_an_error_and_not_a_panic() -> Result<()> {
    assert!(Probe::find("no_such_probe").is_none());
    let names: BTreeSet<String> = Kernel::all().map(Kernel::name).collect();
    assert_eq!(names.len(), Kernel::all().count());
    let error = Error::UnknownProbe("x".to_owned());
    assert_eq!(error.to_string(), "there is no probe `x`");
    Ok(())
}
