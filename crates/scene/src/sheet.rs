//! The text in which the places of problems are counted: the scene file's, and below it each setting as it was given.
//!
//! So a mistake in a setting is shown in the setting, although it is read as if it stood in the file.

use std::ops::Range;

use crate::error::Origin;
use crate::settings::Setting;

/// A scene file's text, followed by its settings, one a line.
pub(crate) struct Sheet {
    text: String,
    /// The settings' places in the text, in order.
    settings: Vec<Range<usize>>,
}

impl Sheet {
    pub(crate) fn new(file: &str, settings: &[Setting]) -> Self {
        let mut text = file.to_owned();
        let places = settings.iter().map(|setting| {
            text.push('\n');
            let start = text.len();
            text.push_str(setting.as_given());
            start..text.len()
        });
        Self {
            settings: places.collect(),
            text,
        }
    }

    /// The whole text.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// Where the settings begin, in order.
    pub(crate) fn starts(&self) -> impl Iterator<Item = usize> {
        self.settings.iter().map(|place| place.start)
    }

    /// Whose text a place lies in, that text, and the place within it.
    pub(crate) fn locate(&self, span: &Range<usize>) -> (Origin, &str, Range<usize>) {
        let holds = |place: &&Range<usize>| place.start <= span.start;
        match self.settings.iter().rev().find(holds) {
            None => (Origin::File, &self.text, span.clone()),
            Some(place) => {
                let given = &self.text[place.clone()];
                (
                    Origin::Setting(given.to_owned()),
                    given,
                    span.start - place.start..span.end - place.start,
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Sheet;
    use crate::error::Origin;

    #[test]
    fn a_place_is_counted_in_its_own_text() {
        let settings = ["occlusion=0", "shading=emboss"].map(|text| text.parse().unwrap());
        let sheet = Sheet::new("schema = 1\n", &settings);
        let second = sheet.starts().nth(1).unwrap();
        assert_eq!(sheet.locate(&(0..6)), (Origin::File, sheet.text(), 0..6));
        assert_eq!(
            sheet.locate(&(second + 8..second + 14)),
            (
                Origin::Setting("shading=emboss".to_owned()),
                "shading=emboss",
                8..14
            )
        );
    }
}
