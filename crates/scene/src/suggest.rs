//! Did-you-mean: the nearest of the known names, if one is near enough to be a slip of the hand.

/// The known name nearest to `got` by the Damerau-Levenshtein distance, if at most a third of the longer name differs.
/// Ties go to the first in `known`.
pub(crate) fn nearest<'a>(got: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let got = got.to_lowercase();
    known
        .into_iter()
        .map(|name| (strsim::damerau_levenshtein(&got, &name.to_lowercase()), name))
        .filter(|(distance, name)| distance * 3 <= got.chars().count().max(name.chars().count()))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

/// ``did you mean `near`? `` where a name is near, then the list of what is known.
pub(crate) fn hint(got: &str, what: &str, known: &[&str]) -> String {
    let list = known
        .iter()
        .map(|name| format!("`{name}`"))
        .collect::<Vec<_>>()
        .join(", ");
    match nearest(got, known.iter().copied()) {
        Some(name) => format!("did you mean `{name}`? {what}: {list}"),
        None => format!("{what}: {list}"),
    }
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn slips_are_found_and_strangers_are_not() {
        let known = ["shininess", "specular", "albedo"];
        assert_eq!(nearest("shinyness", known), Some("shininess"));
        assert_eq!(nearest("Specualr", known), Some("specular"));
        assert_eq!(nearest("roughness", known), None);
    }
}
