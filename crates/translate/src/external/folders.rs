//! Where tools of others and what they made are looked for and kept.

use std::path::PathBuf;

/// The user's cache folder for ours; `None` where the system has no such thing.
#[must_use]
pub fn cache_folder() -> Option<PathBuf> {
    let home = || std::env::home_dir().filter(|home| home.is_absolute());
    let users = if cfg!(windows) {
        variable("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        home().map(|home| home.join("Library/Caches"))
    } else {
        variable("XDG_CACHE_HOME").or_else(|| home().map(|home| home.join(".cache")))
    };
    users.map(|folder| folder.join("bossage"))
}

fn variable(name: &str) -> Option<PathBuf> {
    let given = std::env::var_os(name).map(PathBuf::from);
    given.filter(|path| path.is_absolute())
}

/// The first program of that name in [`tool_folders`].
#[must_use]
pub fn find_program(name: &str) -> Option<PathBuf> {
    let program = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    let mut all = tool_folders().into_iter().map(|folder| folder.join(&program));
    all.find(|path| path.is_file())
}

/// Where programs are looked for, the first hit wins: the folders of `PATH`, then those that `./x setup --full` fills, which are in
/// the cache folder unless `BOSSAGE_TOOLS` names another. So what users have themselves comes before what was fetched.
#[must_use]
pub fn tool_folders() -> Vec<PathBuf> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let mut folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    let fetched = variable("BOSSAGE_TOOLS").or_else(|| cache_folder().map(|cache| cache.join("tools")));
    folders.extend(fetched.map(|tools| tools.join("bin")));
    folders
}
