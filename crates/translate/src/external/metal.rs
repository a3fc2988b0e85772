//! Our `metal_stdlib` as files for a compiler: written once into a folder whose name is a hash of them.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::Duration;

use crate::external::{Limits, cache, cache_folder, clang, run};

macro_rules! headers {
    ($($path:literal)*) => {
        &[$(($path, include_str!(concat!("../../tools/metal/", $path)))),*]
    };
}

/// Path in the folder, and contents.
const HEADERS: &[(&str, &str)] = headers! {
    "metal_stdlib"
    "msl_components.h"
    "msl_conversions.h"
    "msl_detail.h"
    "msl_faces.h"
    "msl_filtering.h"
    "msl_fragments.h"
    "msl_images.h"
    "msl_integers.h"
    "msl_interface.h"
    "msl_math.h"
    "msl_matrices.h"
    "msl_names.h"
    "msl_packed.h"
    "msl_packing.h"
    "msl_samplers.h"
    "msl_scalars.h"
    "msl_texels.h"
    "msl_textures.h"
    "msl_threads.h"
    "msl_traits.h"
    "msl_vectors.h"
    "msl_words.h"
    "simd/simd.h"
};

/// What a compiler may take for the library or a program.
pub(super) const LIMITS: Limits = Limits {
    time: Duration::from_secs(120),
    memory_bytes: 4 << 30,
    output_bytes: 16 * 1024,
};

/// The folder with the headers, in the user's cache or in the system's folder for temporary files.
pub(super) fn headers() -> Result<&'static Path, String> {
    static FOLDER: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    let made = FOLDER.get_or_init(|| {
        let folder = folder();
        HEADERS
            .iter()
            .try_for_each(|(name, text)| keep(&folder.join(name), text.as_bytes()))
            .map_err(|error| format!("the headers for MSL could not be written: {error}"))?;
        Ok(folder)
    });
    made.as_deref().map_err(Clone::clone)
}

/// The headers as that compiler keeps them when it has read them; made when they are first asked for.
pub(super) fn precompiled(compiler: &Path, version: &str) -> Result<PathBuf, String> {
    // Two threads that make the same file would do the work twice.
    static MAKING: Mutex<()> = Mutex::new(());
    let _one = MAKING.lock().unwrap_or_else(PoisonError::into_inner);
    let headers = headers()?;
    let flags = clang::LANGUAGE.map(str::to_owned);
    let path = headers.join(format!("{}.pch", cache::key("read", version, &flags, b"")));
    if is_whole(&path) {
        return Ok(path);
    }
    let mut arguments = flags.to_vec();
    arguments.extend(["-I".to_owned(), headers.to_string_lossy().into_owned()]);
    arguments.extend(["-x", "c++-header"].map(str::to_owned));
    arguments.push(headers.join("metal_stdlib").to_string_lossy().into_owned());
    made_at(&path, |partial| {
        let mut arguments = arguments.clone();
        arguments.extend(["-o".to_owned(), partial.to_string_lossy().into_owned()]);
        let outcome = run(compiler, &arguments, &[], &LIMITS)?;
        if outcome.success {
            Ok(())
        } else {
            Err(outcome.output)
        }
    })?;
    Ok(path)
}

fn folder() -> PathBuf {
    let parts = HEADERS
        .iter()
        .flat_map(|(name, text)| [name.as_bytes(), text.as_bytes()]);
    let parts: Vec<&[u8]> = parts.collect();
    let place = cache_folder().unwrap_or_else(|| std::env::temp_dir().join("bossage"));
    place.join(format!("metal-{}", &cache::digest(&parts)[..32]))
}

/// Writes a file unless it is there with these contents: beside, then renamed.
fn keep(path: &Path, contents: &[u8]) -> std::io::Result<()> {
    if std::fs::read(path).is_ok_and(|kept| kept == contents) {
        return Ok(());
    }
    let folder = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)?;
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    file.write_all(contents)?;
    file.persist(path)?;
    Ok(())
}

/// A file that a program makes, with a checksum beside it: made under another name, then renamed. `make` gets that name.
pub(super) fn made_at(path: &Path, make: impl FnOnce(&Path) -> Result<(), String>) -> Result<(), String> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let cannot = |error: std::io::Error| format!("{}: {error}", path.display());
    std::fs::create_dir_all(folder).map_err(cannot)?;
    let work = tempfile::tempdir_in(folder).map_err(cannot)?;
    let partial = work.path().join("made");
    make(&partial)?;
    let bytes = std::fs::read(&partial).map_err(cannot)?;
    keep(&sum_of(path), cache::digest(&[&bytes]).as_bytes()).map_err(cannot)?;
    std::fs::rename(&partial, path).map_err(cannot)
}

/// Whether a file is there and as it was made.
pub(super) fn is_whole(path: &Path) -> bool {
    let (Ok(bytes), Ok(sum)) = (std::fs::read(path), std::fs::read(sum_of(path))) else {
        return false;
    };
    sum == cache::digest(&[&bytes]).as_bytes()
}

fn sum_of(path: &Path) -> PathBuf {
    path.with_extension("sum")
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn what_was_made_is_whole_until_it_is_touched() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("program");
        assert!(!is_whole(&path));
        made_at(&path, |partial| {
            std::fs::write(partial, "code").map_err(|e| e.to_string())
        })
        .unwrap();
        assert!(is_whole(&path));
        std::fs::write(&path, "cod").unwrap();
        assert!(!is_whole(&path));
    }

    /// The files that a header includes, and theirs.
    fn included(name: &str, found: &mut BTreeSet<String>) {
        let header = HEADERS.iter().find(|(known, _)| *known == name);
        let (_, text) = header.unwrap_or_else(|| panic!("{name} is not listed"));
        if found.insert(name.to_owned()) {
            for line in text.lines().filter_map(|line| line.strip_prefix("#include \"")) {
                included(line.trim_end_matches('"'), found);
            }
        }
    }

    #[test]
    fn every_file_is_listed_and_included() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tools/metal");
        let names = std::fs::read_dir(folder).unwrap();
        let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let files: BTreeSet<String> = names.filter(|name| name != "simd").collect();
        let mut found = BTreeSet::new();
        included("metal_stdlib", &mut found);
        assert_eq!(found, files);
    }

    #[test]
    fn headers_that_somebody_changed_are_written_anew() {
        let folder = headers().unwrap();
        for (name, text) in HEADERS {
            let path = folder.join(name);
            assert_eq!(std::fs::read_to_string(&path).unwrap(), *text, "{name}");
            keep(&path, text.as_bytes()).unwrap();
        }
        let other = tempfile::tempdir().unwrap();
        let own = other.path().join("a/b");
        keep(&own, b"one").unwrap();
        std::fs::write(&own, "two").unwrap();
        keep(&own, b"one").unwrap();
        assert_eq!(std::fs::read(&own).unwrap(), b"one");
    }
}
