//! Reading fields from TOML with their place in the text, collecting problems instead of stopping at the first.
//!
//! A [`Table`] remembers which keys were asked for; [`Table::finish`] reports the rest as unknown. A reader that fails has
//! already noted why and returns `None`, so a caller only builds a value when all its parts are there.

use std::cell::RefCell;
use std::ops::Range;
use std::path::Path;

use glam::DVec3;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{Problem, Report, line_column};
use crate::sheet::Sheet;
use crate::suggest;

/// Where problems go.
pub(crate) struct Sink<'t> {
    sheet: &'t Sheet,
    problems: RefCell<Vec<Problem>>,
}

impl<'t> Sink<'t> {
    pub(crate) fn new(sheet: &'t Sheet) -> Self {
        Self {
            sheet,
            problems: RefCell::default(),
        }
    }

    /// Notes a problem.
    pub(crate) fn note(
        &self,
        field: &str,
        span: Range<usize>,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) {
        let (origin, text, span) = self.sheet.locate(&span);
        let (line, column) = line_column(text, span.start);
        let (message, hint, field) = (message.into(), hint.into(), field.to_owned());
        self.problems.borrow_mut().push(Problem {
            field,
            message,
            hint,
            origin,
            span,
            line,
            column,
        });
    }

    /// Notes what the TOML reader found.
    pub(crate) fn note_syntax(&self, errors: &[toml::de::Error]) {
        for error in errors {
            let span = error.span().unwrap_or(0..0);
            let message = format!("not TOML: {}", error.message().replace('\n', ", "));
            self.note("", span, message, "see https://toml.io for the syntax");
        }
    }

    /// The report, in file order, settings and files that are named last, if there is anything to report.
    pub(crate) fn into_report(self, path: &Path, text: &str) -> Option<Box<Report>> {
        let mut problems = self.problems.into_inner();
        problems.sort_by(|a, b| {
            let key = |problem: &Problem| (problem.span.start, problem.span.end);
            a.origin.cmp(&b.origin).then_with(|| key(a).cmp(&key(b)))
        });
        (!problems.is_empty()).then(|| {
            Box::new(Report {
                path: path.to_owned(),
                text: text.to_owned(),
                problems,
            })
        })
    }
}

/// A value with its field path.
#[derive(Clone)]
pub(crate) struct Value<'t> {
    pub(crate) field: String,
    pub(crate) span: Range<usize>,
    value: &'t DeValue<'t>,
    sink: &'t Sink<'t>,
}

/// The range a number must lie in, as the message states it.
#[derive(Clone, Copy)]
pub(crate) struct Bound {
    /// Whether a value is allowed.
    pub(crate) allows: fn(f64) -> bool,
    /// The range in words.
    pub(crate) words: &'static str,
}

/// Any finite number.
pub(crate) const ANY: Bound = Bound {
    allows: |_| true,
    words: "any finite number",
};
/// Greater than zero.
pub(crate) const POSITIVE: Bound = Bound {
    allows: |x| x > 0.0,
    words: "greater than 0",
};
/// Zero or greater.
pub(crate) const NOT_NEGATIVE: Bound = Bound {
    allows: |x| x >= 0.0,
    words: "0 or greater",
};
/// Anything but zero.
pub(crate) const NOT_ZERO: Bound = Bound {
    allows: |x| x != 0.0,
    words: "not 0",
};
/// In [0, 1].
pub(crate) const UNIT: Bound = Bound {
    allows: |x| (0.0..=1.0).contains(&x),
    words: "in [0, 1]",
};
/// In (0, 1].
pub(crate) const UNIT_NOT_ZERO: Bound = Bound {
    allows: |x| x > 0.0 && x <= 1.0,
    words: "in (0, 1]",
};

impl<'t> Value<'t> {
    /// Notes a problem at this value.
    pub(crate) fn note(&self, message: impl Into<String>, hint: impl Into<String>) {
        self.sink.note(&self.field, self.span.clone(), message, hint);
    }

    /// Notes the problems of the file that this value names.
    pub(crate) fn note_named(&self, report: Report) {
        self.sink.problems.borrow_mut().extend(report.into_named());
    }

    fn wrong_type(&self, expected: &str) {
        let found = self.value.type_str();
        self.note(
            format!("expected {expected}, found {}", with_article(found)),
            format!("write {expected} here"),
        );
    }

    /// A finite number within a bound. Numbers end up in f32 in the shader, so what f32 cannot hold is refused too.
    pub(crate) fn number(&self, bound: Bound) -> Option<f64> {
        let number = match self.value {
            DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
                .ok()
                .map(|i| i as f64),
            DeValue::Float(float) => float.as_str().parse().ok(),
            DeValue::String(_)
            | DeValue::Boolean(_)
            | DeValue::Datetime(_)
            | DeValue::Array(_)
            | DeValue::Table(_) => {
                self.wrong_type("a number");
                return None;
            }
        };
        match number {
            Some(x) if x.is_nan() => self.refuse("NaN is not a usable number", bound),
            Some(x) if x.is_finite() && (x as f32).is_infinite() => {
                self.refuse("too large for a 32-bit float", bound)
            }
            Some(x) if x.is_finite() && (bound.allows)(x) => return Some(x),
            Some(x) if x.is_finite() => self.refuse(&format!("{x} is out of range"), bound),
            Some(_) => self.refuse("infinity is not a usable number", bound),
            None => self.refuse("this number is too large", bound),
        }
        None
    }

    fn refuse(&self, message: &str, bound: Bound) {
        self.note(message, format!("must be {}", bound.words));
    }

    /// A whole number in a closed range.
    pub(crate) fn whole(&self, range: std::ops::RangeInclusive<u32>) -> Option<u32> {
        let DeValue::Integer(integer) = self.value else {
            self.wrong_type("a whole number");
            return None;
        };
        let parsed = i64::from_str_radix(integer.as_str(), integer.radix())
            .ok()
            .and_then(|i| u32::try_from(i).ok());
        let found = parsed.filter(|whole| range.contains(whole));
        if found.is_none() {
            self.note(
                format!("{} is out of range", integer.as_str()),
                format!("must be a whole number from {} to {}", range.start(), range.end()),
            );
        }
        found
    }

    /// The version of a format, which must be the one that is read.
    pub(crate) fn version(&self, known: u32) -> Option<()> {
        let number = self.whole(0..=u32::MAX)?;
        if number != known {
            self.note(
                format!("schema {number} is not known"),
                format!("this version reads schema {known}"),
            );
            return None;
        }
        Some(())
    }

    /// A string.
    pub(crate) fn string(&self) -> Option<&'t str> {
        let found = self.value.as_str();
        if found.is_none() {
            self.wrong_type("a string");
        }
        found
    }

    /// A string that is not empty.
    pub(crate) fn name(&self) -> Option<&'t str> {
        let found = self.string()?;
        if found.trim().is_empty() {
            self.note("this name is empty", "give it a name that is not blank");
            return None;
        }
        Some(found)
    }

    /// One of a set of words.
    pub(crate) fn word<T: Copy>(&self, words: &[(&'static str, T)]) -> Option<T> {
        let got = self.string()?;
        let found = words
            .iter()
            .find(|(word, _)| *word == got)
            .map(|(_, value)| *value);
        if found.is_none() {
            let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
            self.note(
                format!("`{got}` is not known here"),
                suggest::hint(got, "known", &known),
            );
        }
        found
    }

    /// The items of an array.
    pub(crate) fn items(&self) -> Option<Vec<Value<'t>>> {
        let DeValue::Array(array) = self.value else {
            self.wrong_type("an array");
            return None;
        };
        Some(
            array
                .iter()
                .enumerate()
                .map(|(index, item)| self.child(format!("{}[{index}]", self.field), item))
                .collect(),
        )
    }

    fn child(&self, field: String, item: &'t Spanned<DeValue<'t>>) -> Value<'t> {
        Value {
            field,
            span: item.span(),
            value: item.get_ref(),
            sink: self.sink,
        }
    }

    /// Exactly `N` numbers.
    pub(crate) fn numbers<const N: usize>(&self, bound: Bound) -> Option<[f64; N]> {
        let items = self.items()?;
        if items.len() != N {
            self.note(
                format!("expected {N} numbers, found {}", items.len()),
                format!("write an array of {N} numbers"),
            );
            return None;
        }
        let read: Vec<Option<f64>> = items.iter().map(|item| item.number(bound)).collect();
        let read: Option<Vec<f64>> = read.into_iter().collect();
        read.and_then(|numbers| numbers.try_into().ok())
    }

    /// Three numbers.
    pub(crate) fn vec3(&self, bound: Bound) -> Option<DVec3> {
        self.numbers::<3>(bound).map(DVec3::from_array)
    }

    /// `true` or `false`.
    pub(crate) fn truth(&self) -> Option<bool> {
        let DeValue::Boolean(truth) = self.value else {
            self.wrong_type("true or false");
            return None;
        };
        Some(*truth)
    }

    /// Whether this is an array, for fields of more than one shape.
    pub(crate) fn is_array(&self) -> bool {
        matches!(self.value, DeValue::Array(_))
    }

    /// A table.
    pub(crate) fn table(&self) -> Option<Table<'t>> {
        let DeValue::Table(table) = self.value else {
            self.wrong_type("a table");
            return None;
        };
        Some(Table {
            field: self.field.clone(),
            span: self.span.clone(),
            document: "",
            table,
            sink: self.sink,
            asked: RefCell::default(),
        })
    }
}

fn with_article(kind: &str) -> String {
    let article = if kind.starts_with(['a', 'e', 'i', 'o', 'u']) {
        "an"
    } else {
        "a"
    };
    format!("{article} {kind}")
}

/// A table whose keys are asked for one by one.
pub(crate) struct Table<'t> {
    pub(crate) field: String,
    pub(crate) span: Range<usize>,
    /// What the file is, for its root.
    document: &'static str,
    table: &'t DeTable<'t>,
    sink: &'t Sink<'t>,
    asked: RefCell<Vec<&'static str>>,
}

impl<'t> Table<'t> {
    /// The whole file, which is `document`: "a scene".
    pub(crate) fn root(table: &'t Spanned<DeTable<'t>>, document: &'static str, sink: &'t Sink<'t>) -> Self {
        // Problems of the file as a whole point at its first character.
        Self {
            field: String::new(),
            span: 0..0,
            document,
            table: table.get_ref(),
            sink,
            asked: RefCell::default(),
        }
    }

    /// The path of a key of this table.
    pub(crate) fn path_of(&self, key: &str) -> String {
        if self.field.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.field)
        }
    }

    /// Notes a problem at this table.
    pub(crate) fn note(&self, message: impl Into<String>, hint: impl Into<String>) {
        self.sink.note(&self.field, self.header_span(), message, hint);
    }

    /// The first line of the table: a caret under a whole table would mark pages.
    fn header_span(&self) -> Range<usize> {
        let text = &self.sink.sheet.text()[self.span.clone()];
        let first_line = text.find('\n').unwrap_or(text.len());
        self.span.start..self.span.start + first_line
    }

    /// An optional field.
    pub(crate) fn get(&self, key: &'static str) -> Option<Value<'t>> {
        let mut asked = self.asked.borrow_mut();
        if !asked.contains(&key) {
            asked.push(key);
        }
        let (_, value) = self.table.iter().find(|(name, _)| name.get_ref() == key)?;
        Some(Value {
            field: self.path_of(key),
            span: value.span(),
            value: value.get_ref(),
            sink: self.sink,
        })
    }

    /// A field that must be there.
    pub(crate) fn need(&self, key: &'static str, what: &str) -> Option<Value<'t>> {
        let found = self.get(key);
        if found.is_none() {
            self.sink.note(
                &self.path_of(key),
                self.header_span(),
                format!("`{key}` is missing"),
                format!("add {what}"),
            );
        }
        found
    }

    /// An optional field with the documented default, `None` only when it is there and wrong.
    pub(crate) fn or<T>(
        &self,
        key: &'static str,
        default: T,
        read: impl FnOnce(&Value<'t>) -> Option<T>,
    ) -> Option<T> {
        match self.get(key) {
            Some(value) => read(&value),
            None => Some(default),
        }
    }

    /// Reports every key that was not asked for.
    pub(crate) fn finish(&self) {
        let known = self.asked.borrow();
        for (key, _) in self
            .table
            .iter()
            .filter(|(key, _)| !known.contains(&key.get_ref().as_ref()))
        {
            let name = key.get_ref().as_ref();
            let what = if self.field.is_empty() {
                format!("keys of {}", self.document)
            } else {
                format!("keys of `{}`", self.field)
            };
            self.sink.note(
                &self.path_of(name),
                key.span(),
                format!("unknown key `{name}`"),
                suggest::hint(name, &what, &known),
            );
        }
    }
}
