//! The name of a case: `technique[/form]/generator:params`, for example
//! `blinn_phong/hardened/random:probe=specular_lobe;n=10000;seed=1`.
//!
//! Names are stable: `bossage conform 'NAME'` runs exactly that case again. Parameters are sorted by key.

use std::collections::BTreeMap;
use std::fmt;

/// The name of a case.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CaseId {
    /// Technique id, as in the library's table; `scene` for a whole scene, `surface` for its stages.
    pub technique: String,
    /// `published` or `hardened` where the technique has both.
    pub form: Option<String>,
    /// What makes the inputs: `control`, `edge`, `random`, `defect`, `bake`, `mesh`, `planned`, …
    pub generator: String,
    /// Parameters of the generator.
    pub params: BTreeMap<String, String>,
}

impl CaseId {
    /// A name without parameters.
    #[must_use]
    pub fn new(technique: &str, form: Option<&str>, generator: &str) -> Self {
        Self {
            technique: technique.to_owned(),
            form: form.map(str::to_owned),
            generator: generator.to_owned(),
            params: BTreeMap::new(),
        }
    }

    /// Adds a parameter.
    #[must_use]
    pub fn with(mut self, key: &str, value: impl fmt::Display) -> Self {
        self.params.insert(key.to_owned(), value.to_string());
        self
    }

    /// Whether it is about a formula as printed, faults included.
    #[must_use]
    pub fn is_published(&self) -> bool {
        let function = self.params.get("fn");
        self.form.as_deref() == Some("published") || function.is_some_and(|name| name.ends_with("_published"))
    }

    /// Whether a filter selects this case: the whole name, or any part of it.
    #[must_use]
    pub fn matches(&self, filter: &str) -> bool {
        self.to_string().contains(filter)
    }
}

impl fmt::Display for CaseId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.technique)?;
        if let Some(form) = &self.form {
            write!(f, "/{form}")?;
        }
        write!(f, "/{}", self.generator)?;
        for (i, (key, value)) in self.params.iter().enumerate() {
            write!(f, "{}{key}={value}", if i == 0 { ':' } else { ';' })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::CaseId;

    #[test]
    fn parameters_are_sorted_and_the_form_is_optional() {
        let id = CaseId::new("dot3", Some("published"), "random")
            .with("seed", 7)
            .with("n", 100);
        assert_eq!(id.to_string(), "dot3/published/random:n=100;seed=7");
        assert_eq!(
            CaseId::new("frame_mikktspace", None, "edge").to_string(),
            "frame_mikktspace/edge"
        );
    }

    #[test]
    fn a_published_function_is_known_by_its_form_or_its_name() {
        let library = CaseId::new("normalise", None, "random");
        assert!(!library.is_published());
        assert!(library.with("fn", "normalise_published").is_published());
        assert!(CaseId::new("dot3", Some("published"), "edge").is_published());
        assert!(!CaseId::new("dot3", Some("hardened"), "edge").is_published());
    }

    #[test]
    fn filters_are_parts_of_the_name() {
        let id = CaseId::new("dot3", Some("published"), "edge");
        assert!(id.matches("dot3") && id.matches("published/edge") && id.matches(""));
        assert!(!id.matches("dot4"));
    }
}
