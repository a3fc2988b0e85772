//! "Did you mean …?" for names that are no flags: techniques, adapters, routes, case ids. (clap does it for the rest.)

/// The candidate that looks most like `word`, if any looks like it at all.
///
/// The measure and its threshold are those that clap uses for flags, so that all suggestions feel alike.
pub(crate) fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let likeness = |candidate: &str| strsim::jaro_winkler(&word.to_lowercase(), &candidate.to_lowercase());
    candidates
        .into_iter()
        .map(|candidate| (likeness(candidate), candidate))
        .filter(|(likeness, _)| *likeness > 0.7)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

/// "; did you mean `X`?", or what there is when nothing is near.
pub(crate) fn suggestion(word: &str, candidates: &[&str]) -> String {
    match nearest(word, candidates.iter().copied()) {
        Some(near) => format!("did you mean {near}?"),
        None if candidates.is_empty() => "there is none".to_owned(),
        None => format!("there is: {}", candidates.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typos_find_their_word_and_nonsense_finds_none() {
        let known = ["parallax_offset", "parallax_offset_limited", "dot3"];
        assert_eq!(nearest("paralax_ofset", known), Some("parallax_offset"));
        assert_eq!(nearest("DOT_3", known), Some("dot3"));
        assert_eq!(nearest("zzz", known), None);
        assert_eq!(suggestion("zzz", &["a", "b"]), "there is: a, b");
    }
}
