//! What the tests of the golden indexes share.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use bossage_shaders::{AssembledShader, FeatureSet, Library};
use bossage_translate::{Shader, Source};

pub(crate) fn snapshot_dir() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots")
}

pub(crate) fn settings() -> insta::Settings {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(snapshot_dir());
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings
}

pub(crate) fn parse(assembled: &AssembledShader) -> Shader {
    Shader::parse(&assembled.name, &Source::Wgsl(assembled.wgsl.clone()))
        .unwrap_or_else(|why| panic!("{why}"))
}

/// Every module that some canonical feature set uses, by name.
pub(crate) fn modules(library: &Library) -> Vec<AssembledShader> {
    let mut modules = BTreeMap::new();
    for set in FeatureSet::reachable() {
        for &stage in set.stages() {
            let assembled = library
                .assemble_surface(&set, stage)
                .expect("every reachable set assembles");
            let before = modules.insert(assembled.name.clone(), assembled.clone());
            assert!(
                before.is_none_or(|b: AssembledShader| b == assembled),
                "{}: one name, two texts",
                assembled.name
            );
        }
    }
    modules.into_values().collect()
}
