//! What is checked once, when a set of sources is read: misspelt features, imports that lead nowhere, files that nothing
//! reaches, and names that would be caught by a local variable.

use std::collections::{BTreeMap, BTreeSet};

use wesl::ModulePath;

use crate::error::Error;
use crate::features;
use crate::source::{Imported, Source};

/// Sources by absolute module path, as `package::lib::normalise`.
pub(crate) type Sources = BTreeMap<String, Source>;

/// Every feature that a source names is known.
pub(crate) fn features_known(source: &Source, known: &[&str]) -> Result<(), Error> {
    match features::used(&source.syntax)
        .into_iter()
        .find(|(name, _)| !known.contains(&name.as_str()))
    {
        None => Ok(()),
        Some((name, range)) => {
            let error = crate::SourceError::at(
                format!("there is no feature `{name}`"),
                &source.file,
                &source.text,
                range,
            );
            Err(error.hint(nearest(&name, known)).into())
        }
    }
}

/// Every import names an existing declaration of an existing module.
pub(crate) fn imports_resolve(source: &Source, here: &ModulePath, sources: &Sources) -> Result<(), Error> {
    for Imported { module, item, .. } in source.imports(here) {
        let Some(target) = sources.get(&module.to_string()) else {
            let last = module
                .components
                .last()
                .cloned()
                .unwrap_or_else(|| module.to_string());
            return Err(source
                .fault_at_import(&last, format!("there is no module `{module}`"))
                .into());
        };
        if !target.declared().any(|declared| declared == item) {
            let message = format!("`{}` declares no `{item}`", target.file);
            let declared: Vec<String> = target.declared().collect();
            let names: Vec<&str> = declared.iter().map(String::as_str).collect();
            return Err(source
                .fault_at_import(&item, message)
                .hint(nearest(&item, &names))
                .into());
        }
    }
    Ok(())
}

/// Assembled names are those of the declaring file. Where a file uses another name (`import … as …`) or a path, a local
/// variable of the original name would catch the reference.
pub(crate) fn no_capture(source: &Source, here: &ModulePath) -> Result<(), Error> {
    match captured(source, here).first() {
        None => Ok(()),
        Some(name) => {
            let message = format!(
                "a local variable has the name `{name}`, which an import brings in under another name"
            );
            Err(source
                .fault_at_word(name, message)
                .hint("rename the local variable")
                .into())
        }
    }
}

/// The names that a local variable of this file would catch.
pub(crate) fn captured(source: &Source, here: &ModulePath) -> Vec<String> {
    let mut hidden: BTreeSet<String> = source
        .imports(here)
        .into_iter()
        .filter(|import| import.renamed)
        .map(|import| import.item)
        .collect();
    hidden.extend(source.inline_path_items().into_iter().map(|(name, _)| name));
    let locals: BTreeSet<String> = source.locals().into_iter().collect();
    hidden.intersection(&locals).cloned().collect()
}

/// The files that the given roots do not reach.
pub(crate) fn orphans(sources: &Sources, roots: &[ModulePath]) -> Vec<String> {
    let mut reached = BTreeSet::new();
    let mut todo: Vec<ModulePath> = roots.to_vec();
    while let Some(path) = todo.pop() {
        if !reached.insert(path.to_string()) {
            continue;
        }
        if let Some(source) = sources.get(&path.to_string()) {
            todo.extend(source.imports(&path).into_iter().map(|import| import.module));
        }
    }
    sources
        .iter()
        .filter(|(path, _)| !reached.contains(*path))
        .map(|(_, source)| source.file.clone())
        .collect()
}

/// "did you mean", or the list of what there is.
fn nearest(word: &str, known: &[&str]) -> String {
    match known.iter().min_by_key(|name| edit_distance(word, name)) {
        Some(best) if edit_distance(word, best) <= 2 + word.len() / 4 => format!("did you mean `{best}`?"),
        Some(_) => format!("there are: {}", known.join(", ")),
        None => "none is defined here".to_owned(),
    }
}

/// Levenshtein's distance.
fn edit_distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.chars().enumerate() {
            let replaced = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.chars().count()]
}

#[cfg(test)]
mod tests {
    use super::{edit_distance, nearest};

    #[test]
    fn distances() {
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("specualr", "specular"), 2);
        assert_eq!(edit_distance("relief", "relief"), 0);
    }

    #[test]
    fn hints() {
        assert_eq!(
            nearest("specualr", &["relief", "specular"]),
            "did you mean `specular`?"
        );
        assert_eq!(
            nearest("x", &["relief", "specular"]),
            "there are: relief, specular"
        );
        assert_eq!(nearest("x", &[]), "none is defined here");
    }
}
