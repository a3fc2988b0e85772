//! Settings: keys of materials with values in place of the file's, for drawing one scene in two ways.
//!
//! A setting is written `KEY=VALUE`, where VALUE is a word (quotes may be left out), a number, `true` or `false`. It goes for every material of the
//! scene, and is read and checked like a line of the file; what is wrong with it is shown in the setting.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A key of all materials, and its value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    /// As it was given.
    given: String,
    key: String,
    /// Where the value stands in what was given, in bytes.
    place: Range<usize>,
    /// The value as a line of TOML, under the key `value`.
    line: String,
}

impl fmt::Display for Setting {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.line.trim_start_matches("value = ").trim_matches('"');
        write!(out, "{}={value}", self.key)
    }
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let wrong = || {
            format!("`{text}` is no setting; write KEY=VALUE, such as shading=dot3_two_pass or occlusion=0")
        };
        let (key, value) = text.split_once('=').ok_or_else(wrong)?;
        let (key, value) = (key.trim(), value.trim());
        let word = |text: &str| {
            let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
            text.starts_with(|c: char| c.is_ascii_alphabetic()) && text.chars().all(plain)
        };
        if !word(key) {
            return Err(wrong());
        }
        let line = if word(value) && !matches!(value, "true" | "false") {
            format!("value = \"{value}\"")
        } else {
            format!("value = {value}")
        };
        let place = text.rfind(value).ok_or_else(wrong)?;
        let setting = Self {
            given: text.to_owned(),
            key: key.to_owned(),
            place: place..place + value.len(),
            line,
        };
        setting.value().map(|_| setting.clone()).ok_or_else(wrong)
    }
}

impl Setting {
    /// The value; none where it is neither a word nor a number nor a truth value.
    fn value(&self) -> Option<DeValue<'_>> {
        let table = DeTable::parse(&self.line).ok()?.into_inner();
        let (_, value) = table.into_iter().next().filter(|_| !self.line.contains('\n'))?;
        match value.into_inner() {
            value @ (DeValue::String(_) | DeValue::Integer(_) | DeValue::Float(_) | DeValue::Boolean(_)) => {
                Some(value)
            }
            DeValue::Datetime(_) | DeValue::Array(_) | DeValue::Table(_) => None,
        }
    }

    /// The setting as it was given.
    pub(crate) fn as_given(&self) -> &str {
        &self.given
    }

    /// Sets the key in every material of a document. Places are counted from `start`, where the setting's text begins.
    pub(crate) fn apply<'d>(&'d self, document: &mut DeTable<'d>, start: usize) {
        let materials = document.iter_mut().find(|(key, _)| key.get_ref() == "materials");
        let Some(DeValue::Array(list)) = materials.map(|(_, value)| value.get_mut()) else {
            return;
        };
        let key_start = start + self.given.find(&self.key).unwrap_or(0);
        let key_place = key_start..key_start + self.key.len();
        let value_place = start + self.place.start..start + self.place.end;
        for material in list.iter_mut() {
            if let (DeValue::Table(table), Some(value)) = (material.get_mut(), self.value()) {
                table.insert(
                    Spanned::new(key_place.clone(), self.key.as_str().into()),
                    Spanned::new(value_place.clone(), value),
                );
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Setting;

    #[test]
    fn words_numbers_and_truth_values_are_settings() {
        for (text, shown) in [
            ("shading=dot3_two_pass", "shading=dot3_two_pass"),
            (" occlusion = 0.5 ", "occlusion=0.5"),
            ("shininess=8", "shininess=8"),
            ("pixel_depth=true", "pixel_depth=true"),
        ] {
            assert_eq!(text.parse::<Setting>().unwrap().to_string(), shown);
        }
        for text in [
            "",
            "shading",
            "=1",
            "a.b=1",
            "x=",
            "x=[1, 2]",
            "x={a = 1}",
            "x=1\ny=2",
            "x=1979-05-27",
            "x=\"\"\"",
        ] {
            let error = text.parse::<Setting>().unwrap_err();
            assert!(error.contains("KEY=VALUE"), "{text}: {error}");
        }
    }
}
