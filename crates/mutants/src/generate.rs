//! All mutants of a set of sources, in the order of the text, each once.

use std::collections::{BTreeMap, BTreeSet};

use crate::error::Error;
use crate::folder::Sources;
use crate::mutant::{Change, Mutant};
use crate::operator::OPERATORS;
use crate::syntax::File;

/// A change that an operator proposes.
struct Proposal {
    item: String,
    /// The place of the operator in the table.
    operator: usize,
    change: Change,
    text: String,
}

/// Every mutant, by file and place.
///
/// # Errors
/// [`Error::Syntax`] for a source that cannot be parsed.
pub fn mutants(sources: &Sources) -> Result<Vec<Mutant>, Error> {
    let mut all = Vec::new();
    for (file, text) in &sources.files {
        all.extend(of_file(file, text)?);
    }
    Ok(all)
}

/// The mutants of one file.
///
/// # Errors
/// [`Error::Syntax`].
pub fn of_file(file: &str, text: &str) -> Result<Vec<Mutant>, Error> {
    let syntax = File::parse(file, text)?;
    let mut proposals = Vec::new();
    syntax.walk(&mut |item, node| {
        for (operator, row) in OPERATORS.iter().enumerate() {
            proposals.extend((row.changes)(&node, text).into_iter().map(|change| Proposal {
                item: item.to_owned(),
                operator,
                text: change.apply(text),
                change,
            }));
        }
    });
    Ok(named(file, text, unique(text, proposals)))
}

/// Each text once, for the first operator that makes it, in the order of the places.
fn unique(text: &str, mut proposals: Vec<Proposal>) -> Vec<Proposal> {
    proposals.sort_by_key(|it| (it.operator, it.change.range.start, it.change.range.end));
    let mut seen = BTreeSet::from([text.to_owned()]);
    proposals.retain(|it| seen.insert(it.text.clone()));
    proposals.sort_by_key(|it| (it.change.range.start, it.change.range.end, it.operator));
    proposals
}

fn named(file: &str, text: &str, proposals: Vec<Proposal>) -> Vec<Mutant> {
    let mut numbers = BTreeMap::new();
    let mut alike = BTreeMap::new();
    let mut count = move |item: &str, operator: &'static str| next(&mut numbers, (item.to_owned(), operator));
    let name = |it: Proposal| {
        let operator = OPERATORS[it.operator].name;
        let (line, was, is) = it.change.lines(text);
        let number = count(&it.item, operator);
        let nth = next(&mut alike, (it.item.clone(), operator, was.clone(), is.clone()));
        Mutant {
            id: format!("{file}:{}:{operator}:{number}", it.item),
            file: file.to_owned(),
            item: it.item,
            operator,
            line,
            was,
            is,
            nth,
            text: it.text,
        }
    };
    proposals.into_iter().map(name).collect()
}

/// The next number of a key, from 1.
fn next<K: Ord>(numbers: &mut BTreeMap<K, usize>, key: K) -> usize {
    let number = numbers.entry(key).or_insert(0);
    *number += 1;
    *number
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{mutants, of_file};
    use crate::folder::Sources;

    const TEXT: &str = "const LOW: f32 = 0.05;\n\nfn shift(uv: vec2f, z: f32, v: vec3f) -> vec2f {\n    \
                        return uv + z * v.xy / max(v.z, LOW);\n}\n";

    #[test]
    fn a_formula_is_broken_in_every_way() {
        let mutants = of_file("techniques/shift.wesl", TEXT).unwrap();
        let made: BTreeSet<&str> = mutants.iter().map(|mutant| mutant.is.as_str()).collect();
        let wanted = [
            "const LOW: f32 = 0.0505;",
            "return uv - z * v.xy / max(v.z, LOW);",
            "return uv + z / v.xy / max(v.z, LOW);",
            "return uv + z * v.xy * max(v.z, LOW);",
            "return uv + z * v.yx / max(v.z, LOW);",
            "return uv + z * v.xy / min(v.z, LOW);",
            "return uv + z * v.xy / max(v.x, LOW);",
            "return uv + z * v.xy / (v.z);",
            "return uv + z * v.xy / (LOW);",
            "return (uv);",
            "return (z * v.xy / max(v.z, LOW));",
            "{}",
        ];
        assert_eq!(made, BTreeSet::from(wanted));
    }

    #[test]
    fn ids_are_unique_and_stable() {
        let first = of_file("techniques/shift.wesl", TEXT).unwrap();
        let ids: BTreeSet<&str> = first.iter().map(|mutant| mutant.id.as_str()).collect();
        assert_eq!(ids.len(), first.len());
        assert!(ids.contains("techniques/shift.wesl:shift:swap_arithmetic:3"));
        // Another function before it changes no id and no key, only lines.
        let later = format!("fn other(a: f32) -> f32 {{ return a * 2.0; }}\n{TEXT}");
        let later = of_file("techniques/shift.wesl", &later).unwrap();
        for (a, b) in first
            .iter()
            .zip(later.iter().filter(|mutant| mutant.item != "other"))
        {
            assert_eq!((&a.id, &a.was, &a.is, a.nth), (&b.id, &b.was, &b.is, b.nth));
        }
    }

    #[test]
    fn one_text_counts_once() {
        // `select` with its branches swapped and with the argument dropped differ; both drops of equal branches are one.
        let text = "fn f(a: f32) -> f32 { return max(a, a); }";
        let mutants = of_file("x.wesl", text).unwrap();
        let texts: BTreeSet<&str> = mutants.iter().map(|mutant| mutant.text.as_str()).collect();
        assert_eq!(texts.len(), mutants.len());
        assert_eq!(
            mutants
                .iter()
                .filter(|mutant| mutant.operator == "drop_guard")
                .count(),
            1
        );
    }

    #[test]
    fn equal_lines_are_told_apart() {
        let text =
            "fn f(a: f32) -> f32 {\n    if (a < 0.5) {\n        return 1.0;\n    }\n    return 1.0;\n}";
        let mutants = of_file("x.wesl", text).unwrap();
        let nth: Vec<usize> = mutants
            .iter()
            .filter(|mutant| mutant.is == "return 1.01;")
            .map(|mutant| mutant.nth)
            .collect();
        assert_eq!(nth, [1, 2]);
    }

    #[test]
    fn files_come_in_the_order_of_their_names() {
        let files =
            [("b.wesl", TEXT), ("a.wesl", TEXT)].map(|(file, text)| (file.to_owned(), text.to_owned()));
        let mutants = mutants(&Sources {
            files: files.into_iter().collect(),
        })
        .unwrap();
        let (first, second) = mutants.split_at(mutants.len() / 2);
        assert!(first.iter().all(|mutant| mutant.file == "a.wesl"));
        assert!(second.iter().all(|mutant| mutant.file == "b.wesl"));
    }
}
