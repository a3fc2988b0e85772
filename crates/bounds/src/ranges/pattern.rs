//! Keys of a sidecar: `lights.items[].vector.xyz`, `heights[0..3]`.

/// One step of a path.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Step {
    /// A variable, an input, a member.
    Name(String),
    /// An element of an array, a column of a matrix.
    Index(u32),
    /// A component of a vector.
    Component(u8),
}

/// One step of a key.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Part {
    Name(String),
    All,
    Index(u32),
    Span(u32, u32),
}

/// A parsed key.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pattern(Vec<Part>);

impl Pattern {
    /// Reads a key.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub(crate) fn parse(key: &str) -> Result<Self, String> {
        let mut parts = Vec::new();
        for (at, piece) in pieces(key).into_iter().enumerate() {
            let (name, mut rest) = match piece.find('[') {
                Some(open) => (&piece[..open], &piece[open..]),
                None => (piece, ""),
            };
            if name.is_empty() {
                return Err(format!("a name is missing in part {} of `{key}`", at + 1));
            }
            parts.push(Part::Name(name.to_owned()));
            while !rest.is_empty() {
                let close = rest
                    .find(']')
                    .filter(|_| rest.starts_with('['))
                    .ok_or_else(|| format!("`{rest}` is no index; write [], [3] or [0..3]"))?;
                parts.push(index(&rest[1..close])?);
                rest = &rest[close + 1..];
            }
        }
        Ok(Self(parts))
    }

    /// The first name: of a variable or an input.
    pub(crate) fn head(&self) -> &str {
        match self.0.first() {
            Some(Part::Name(name)) => name,
            Some(Part::All | Part::Index(_) | Part::Span(..)) | None => "",
        }
    }

    /// Whether the key is nothing but a variable's or an input's name.
    pub(crate) fn is_plain(&self) -> bool {
        self.0.len() == 1
    }

    /// Whether the last step takes a run of elements together.
    pub(crate) fn takes_a_run(&self) -> bool {
        matches!(self.0.last(), Some(Part::Span(..)))
    }

    /// General keys first: by length, then by how many elements an index takes.
    pub(crate) fn specificity(&self) -> (usize, usize) {
        let exact = self.0.iter().map(|part| match part {
            Part::Name(_) | Part::Index(_) => 2,
            Part::Span(..) => 1,
            Part::All => 0,
        });
        (self.0.len(), exact.sum())
    }

    /// Whether the key names a scalar at the path, or something it is part of.
    pub(crate) fn matches(&self, path: &[Step]) -> bool {
        let mut steps = path.iter();
        for (at, part) in self.0.iter().enumerate() {
            let last = at + 1 == self.0.len();
            let fits = match (part, steps.next()) {
                (Part::Name(name), Some(Step::Name(found))) => name == found,
                (Part::Name(name), Some(Step::Component(c))) if last => components(name).contains(c),
                (Part::All, Some(Step::Index(_))) => true,
                (Part::Index(i), Some(Step::Index(found))) => i == found,
                (Part::Span(from, to), Some(Step::Index(found))) => (from..to).contains(&found),
                (_, Some(Step::Name(_) | Step::Component(_) | Step::Index(_)) | None) => false,
            };
            if !fits {
                return false;
            }
        }
        true
    }
}

/// Splits at dots that stand outside of brackets: `[0..3]` holds two.
fn pieces(key: &str) -> Vec<&str> {
    let mut depth = 0_i32;
    key.split(|c| {
        depth += match c {
            '[' => 1,
            ']' => -1,
            _ => 0,
        };
        c == '.' && depth <= 0
    })
    .collect()
}

fn index(text: &str) -> Result<Part, String> {
    let number = |t: &str| {
        t.trim()
            .parse::<u32>()
            .map_err(|_| format!("`{t}` is no index; write [], [3] or [0..3]"))
    };
    match text.split_once("..") {
        None if text.trim().is_empty() => Ok(Part::All),
        None => Ok(Part::Index(number(text)?)),
        Some((from, to)) => match (number(from)?, number(to)?) {
            (from, to) if from < to => Ok(Part::Span(from, to)),
            (from, to) => Err(format!("[{from}..{to}] holds nothing: the end is exclusive")),
        },
    }
}

/// The components that a swizzle names; none for other words.
fn components(word: &str) -> Vec<u8> {
    let number = |c: char| match c {
        'x' | 'r' => Some(0),
        'y' | 'g' => Some(1),
        'z' | 'b' => Some(2),
        'w' | 'a' => Some(3),
        _ => None,
    };
    word.chars()
        .map(number)
        .collect::<Option<_>>()
        .unwrap_or_default()
}

/// A path as the shader would write it.
pub(crate) fn written(path: &[Step]) -> String {
    let mut text = String::new();
    for step in path {
        match step {
            Step::Name(name) if text.is_empty() => text.push_str(name),
            Step::Name(name) => {
                text.push('.');
                text.push_str(name);
            }
            Step::Index(i) => text.push_str(&format!("[{i}]")),
            Step::Component(c) => text.push_str([".x", ".y", ".z", ".w"][usize::from(*c) % 4]),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(variable: &str) -> Vec<Step> {
        vec![
            Step::Name(variable.to_owned()),
            Step::Name("items".to_owned()),
            Step::Index(3),
            Step::Name("vector".to_owned()),
            Step::Component(2),
        ]
    }

    #[test]
    fn a_key_names_everything_below_it() {
        let fits = |key: &str| Pattern::parse(key).unwrap().matches(&path("lights"));
        for key in [
            "lights",
            "lights.items",
            "lights.items[]",
            "lights.items[3]",
            "lights.items[2..4].vector",
            "lights.items[].vector.xyz",
            "lights.items[3].vector.b",
        ] {
            assert!(fits(key), "{key}");
        }
        for key in [
            "light",
            "lights.items[2]",
            "lights.items[4..9]",
            "lights.items[].vector.xy",
            "lights.items.vector",
            "lights.count",
        ] {
            assert!(!fits(key), "{key}");
        }
    }

    #[test]
    fn keys_that_are_none_say_why() {
        for key in ["", "a.", "a[", "a[x]", "a[3..3]", "a[1]b", ".a"] {
            assert!(Pattern::parse(key).is_err(), "{key}");
        }
    }

    #[test]
    fn the_specific_key_comes_last() {
        let of = |key: &str| Pattern::parse(key).unwrap().specificity();
        assert!(of("a") < of("a[]") && of("a[]") < of("a[0..3]") && of("a[0..3]") < of("a[1]"));
        assert!(of("a[1]") < of("a[].x"));
    }

    #[test]
    fn paths_are_written_as_in_the_shader() {
        assert_eq!(written(&path("lights")), "lights.items[3].vector.z");
    }
}
