//! Vulkan drivers of the project's own cache, shown to the Vulkan loader.
//!
//! `./x setup --full` puts SwiftShader into `tools/swiftshader` of the cache, or of the folder that `BOSSAGE_TOOLS` names. The loader
//! learns of further drivers by `VK_ADD_DRIVER_FILES`, which has to be set before a process starts: so the program starts itself
//! again, once, with that variable. Whoever sets it, or `VK_DRIVER_FILES` or `VK_ICD_FILENAMES` (to nothing, say), has chosen, and
//! is left alone.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use crate::run::check::cache_folder;

/// What tells the loader of further drivers.
const ADD: &str = "VK_ADD_DRIVER_FILES";

/// Any of these means that the drivers are chosen already.
const CHOSEN: [&str; 3] = [ADD, "VK_DRIVER_FILES", "VK_ICD_FILENAMES"];

/// Starts this program again with the cache's drivers shown, where there are any and nobody has chosen. Returns where there is
/// nothing to do; a program that can't be started again goes on without them.
pub fn show_own() {
    let own = std::env::var_os("BOSSAGE_TOOLS").map(PathBuf::from);
    let tools = own.or_else(|| cache_folder(None).map(|cache| cache.join("tools")));
    let manifest = tools.and_then(|tools| to_show(&tools, |name| std::env::var_os(name).is_some()));
    if let Some(manifest) = manifest {
        start_again(manifest.as_os_str());
    }
}

/// The manifest of the cache's driver, unless drivers are chosen.
fn to_show(tools: &Path, is_set: impl Fn(&str) -> bool) -> Option<PathBuf> {
    let manifest = tools.join("swiftshader/vk_swiftshader_icd.json");
    (manifest.is_file() && !CHOSEN.iter().any(|name| is_set(name))).then_some(manifest)
}

#[cfg(unix)]
fn start_again(manifest: &OsStr) {
    use std::os::unix::process::CommandExt;

    let Ok(program) = std::env::current_exe() else {
        return;
    };
    let mut line = std::env::args_os();
    let name = line.next().unwrap_or_else(|| program.clone().into_os_string());
    // Returns only where it fails.
    let _ = std::process::Command::new(program)
        .arg0(name)
        .args(line)
        .env(ADD, manifest)
        .exec();
}

/// The cache is filled on Debian only.
#[cfg(not(unix))]
fn start_again(_: &OsStr) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cache_s_driver_is_shown_unless_drivers_are_chosen() {
        let tools = tempfile::tempdir().unwrap();
        let nothing_set = |_: &str| false;
        assert_eq!(to_show(tools.path(), nothing_set), None, "no driver is there");
        let folder = tools.path().join("swiftshader");
        std::fs::create_dir_all(&folder).unwrap();
        let manifest = folder.join("vk_swiftshader_icd.json");
        std::fs::write(&manifest, "{}").unwrap();
        assert_eq!(to_show(tools.path(), nothing_set), Some(manifest));
        for chosen in CHOSEN {
            assert_eq!(to_show(tools.path(), |name| name == chosen), None, "{chosen}");
        }
    }
}
