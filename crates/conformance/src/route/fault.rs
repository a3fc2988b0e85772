//! A fault put into what a route emits: the negative control of that route, and of nothing before it.

use bossage_translate::Contents;

use super::Route;

/// A fault for one route: the files that it emits have other text, the others do not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The route.
    pub route: Route,
    /// What is replaced, wherever it stands. In SPIR-V, a number: the words that hold it.
    pub from: String,
    /// What comes in its place.
    pub to: String,
}

impl Fault {
    /// Puts it into files of one module.
    ///
    /// # Errors
    /// When it finds no place: nothing would be wrong then.
    pub(super) fn plant<'a>(&self, files: impl IntoIterator<Item = &'a mut Contents>) -> Result<(), String> {
        let mut places = 0;
        for contents in files {
            places += match contents {
                Contents::Text(text) => self.plant_in_text(text),
                Contents::Binary(bytes) => self.plant_in_words(bytes)?,
            };
        }
        if places == 0 {
            return Err(format!("the fault finds no `{}` in what is emitted", self.from));
        }
        Ok(())
    }

    /// As [`Self::plant`], for a text.
    pub(super) fn plant_in_text(&self, text: &mut String) -> usize {
        let places = text.matches(&self.from).count();
        *text = text.replace(&self.from, &self.to);
        places
    }

    fn plant_in_words(&self, bytes: &mut [u8]) -> Result<usize, String> {
        let word = |text: &str| {
            let number: Result<f32, _> = text.parse();
            number
                .map(f32::to_le_bytes)
                .map_err(|_| format!("a fault in SPIR-V is a number, not `{text}`"))
        };
        let (from, to) = (word(&self.from)?, word(&self.to)?);
        let found = bytes
            .as_chunks_mut::<4>()
            .0
            .iter_mut()
            .filter(|word| **word == from);
        Ok(found.map(|word| *word = to).count())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(from: &str, to: &str) -> Fault {
        Fault {
            route: Route::Hlsl,
            from: from.to_owned(),
            to: to.to_owned(),
        }
    }

    #[test]
    fn it_is_put_wherever_it_fits_and_must_fit_somewhere() {
        let mut files = [Contents::Text("a.x + a.x".into()), Contents::Text("none".into())];
        fault("a.x", "a.y").plant(&mut files).unwrap();
        assert_eq!(files[0], Contents::Text("a.y + a.y".into()));
        let error = fault("a.x", "a.y").plant(&mut files).unwrap_err();
        assert_eq!(error, "the fault finds no `a.x` in what is emitted");
    }

    #[test]
    fn numbers_are_found_in_words() {
        let bytes = |number: f32| [1_u32.to_le_bytes(), number.to_le_bytes()].concat();
        let mut files = [Contents::Binary(bytes(0.5))];
        fault("0.5", "0.25").plant(&mut files).unwrap();
        assert_eq!(files, [Contents::Binary(bytes(0.25))]);
        assert!(
            fault("x", "y")
                .plant(&mut files)
                .unwrap_err()
                .contains("is a number")
        );
    }
}
