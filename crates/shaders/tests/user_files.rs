//! A user's own file: imports beside it and from the library, clashing names, and messages for what is wrong.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use bossage_shaders::{AssembledShader, Library, Result};

/// Files in a folder of their own; the first is the root.
struct Project {
    folder: tempfile::TempDir,
    root: PathBuf,
}

impl Project {
    fn new(files: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("no temporary folder: {error}"));
        for (file, text) in files {
            let path = folder.path().join(file);
            fs::create_dir_all(path.parent().unwrap_or(folder.path()))
                .unwrap_or_else(|error| panic!("{error}"));
            fs::write(&path, text).unwrap_or_else(|error| panic!("{file}: {error}"));
        }
        let root = folder.path().join(files[0].0);
        Project { folder, root }
    }

    fn assemble(&self) -> Result<AssembledShader> {
        Library::embedded()?.assemble_user_file(&self.root)
    }

    fn message(&self) -> String {
        match self.assemble() {
            Ok(shader) => panic!("the fault went unnoticed:\n{}", shader.wgsl),
            Err(error) => error
                .to_string()
                .replace(&format!("{}/", self.folder.path().display()), ""),
        }
    }
}

fn validate(shader: &AssembledShader) {
    let module =
        naga::front::wgsl::parse_str(&shader.wgsl).unwrap_or_else(|error| panic!("{error}\n{}", shader.wgsl));
    naga::valid::Validator::new(
        naga::valid::ValidationFlags::all(),
        naga::valid::Capabilities::default(),
    )
    .validate(&module)
    .unwrap_or_else(|error| panic!("{error:?}\n{}", shader.wgsl));
}

const MAIN: &str = "
import super::shapes::area;
import package::deep::inner::twice as doubled;
import bossage::lib::normalise::normalise;

@group(0) @binding(0) var<storage, read_write> out: array<f32>;

@compute @workgroup_size(1)
fn main() {
    let n = normalise(vec3f(1.0, 2.0, 3.0));
    out[0] = doubled(area(n.x)) + super::shapes::scale();
}
";
const SHAPES: &str = "fn area(r: f32) -> f32 { return r * scale(); }\nfn scale() -> f32 { return 3.0; }\n";
const INNER: &str = "fn twice(x: f32) -> f32 { return 2.0 * x; }\n";

#[test]
fn imports_are_relative_to_the_file_and_the_library_is_a_package() -> Result<()> {
    let project = Project::new(&[
        ("my shader.wesl", MAIN),
        ("shapes.wgsl", SHAPES),
        ("deep/inner.wesl", INNER),
    ]);
    let shader = project.assemble()?;
    validate(&shader);
    assert_eq!(shader.name, "my_shader");
    assert!(
        shader.wgsl.contains("fn area(")
            && shader.wgsl.contains("fn twice(")
            && shader.wgsl.contains("fn normalise(")
    );
    assert_eq!(shader.modules.len(), 4);
    assert_eq!(project.assemble()?, shader);
    Ok(())
}

#[test]
fn clashing_names_are_told_apart_and_the_roots_own_stay() -> Result<()> {
    let root = "
import package::shapes::area;
import bossage::lib::normalise::normalise_published as unit;
@group(0) @binding(0) var<storage, read_write> out: array<f32>;
fn scale() -> f32 { return 5.0; }
@compute @workgroup_size(1)
fn main() {
    let normalise_published = unit(vec3f(1.0));
    out[0] = area(scale()) + unit(normalise_published).x;
}
";
    let shader = Project::new(&[("main.wesl", root), ("shapes.wesl", SHAPES)]).assemble()?;
    validate(&shader);
    assert!(
        shader.wgsl.contains("fn scale() -> f32 {\n    return 5.0;"),
        "{}",
        shader.wgsl
    );
    assert!(
        shader
            .wgsl
            .contains("fn shapes_scale() -> f32 {\n    return 3.0;"),
        "{}",
        shader.wgsl
    );
    assert!(
        shader.wgsl.contains("fn normalise_normalise_published("),
        "{}",
        shader.wgsl
    );
    Ok(())
}

#[test]
fn an_unused_declaration_of_the_file_is_kept() -> Result<()> {
    let shader = Project::new(&[(
        "a.wesl",
        "const spare = 1;\n@compute @workgroup_size(1) fn main() {}\n",
    )])
    .assemble()?;
    assert!(shader.wgsl.contains("spare"));
    Ok(())
}

#[test]
fn features_are_given_or_refused() -> Result<()> {
    let text = "@if(fancy) const level = 2;\n@else const level = 1;\n";
    let project = Project::new(&[("a.wesl", text)]);
    let message = project.message();
    assert!(
        message.starts_with("a.wesl:1:5: there is no feature `fancy`"),
        "{message}"
    );
    for (on, expected) in [(true, "level = 2"), (false, "level = 1")] {
        let given = BTreeMap::from([("fancy".to_owned(), on)]);
        let shader = Library::embedded()?.assemble_user_file_with(&project.root, &given)?;
        assert!(shader.wgsl.contains(expected), "{}", shader.wgsl);
    }
    Ok(())
}

#[test]
fn faults_are_told_with_their_place() {
    let cases = [
        (
            "fn f() -> f32 { return ; ; }\nfn g( { }\n",
            "a.wesl:2:7: unexpected token `{`",
        ),
        (
            "// import package::nosuch::x;\nimport package::nosuch::x;\n",
            "a.wesl:2:17: there is no module `package::nosuch`",
        ),
        ("import package::b::x;\n", "a.wesl:1:20: `b.wesl` declares no `x`"),
        (
            "import bossage::lib::normalise::normalize;\n",
            "a.wesl:1:33: `bossage:lib/normalise.wesl` declares no `normalize`",
        ),
        (
            "import other::x::y;\n",
            "a.wesl:1:15: there is no module `other::x`",
        ),
        (
            "@if(1 + 2) const a = 1;\n",
            "a.wesl:1:5: invalid if attribute expression",
        ),
        (
            "@else const a = 1;\n",
            "a.wesl:1:1: an @elif or @else attribute must be preceded",
        ),
    ];
    for (text, expected) in cases {
        let message = Project::new(&[("a.wesl", text), ("b.wesl", "const y = 1;\n")]).message();
        assert!(message.starts_with(expected), "{text}\n{message}");
        assert!(message.contains('^'), "{message}");
    }
}

#[test]
fn a_fault_in_an_imported_file_names_that_file() {
    let message =
        Project::new(&[("a.wesl", "import package::b::x;\n"), ("b.wesl", "const y = ;\n")]).message();
    assert!(message.starts_with("b.wesl:1:11:"), "{message}");
}

#[test]
fn files_that_cannot_be_read_are_told() {
    let project = Project::new(&[("a.wesl", "")]);
    fs::write(&project.root, [0xff, 0xfe, 0x00]).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(project.message(), "`a.wesl` is not UTF-8 text");
    fs::remove_file(&project.root).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(project.message(), "cannot read `a.wesl`");
}

#[test]
fn files_that_import_each_other_are_no_endless_loop() -> Result<()> {
    let a = "import package::b::g;\nfn f() -> f32 { return 1.0; }\n@compute @workgroup_size(1) fn main() { _ = g(); }\n";
    let b = "import package::a::f;\nfn g() -> f32 { return f(); }\n";
    validate(&Project::new(&[("a.wesl", a), ("b.wesl", b)]).assemble()?);
    Ok(())
}
