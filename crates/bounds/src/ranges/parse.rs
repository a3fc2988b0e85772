//! From a sidecar's text to [`Declared`].

use super::pattern::Pattern;
use super::report::{Report, suggestion};
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

const TOP: &[&str] = &["schema", "workgroups", "overrides", "ranges"];
const WORDS: &[&str] = &["lo", "hi", "unit", "one_of", "size"];

/// The most elements of a run-time sized array, and the largest side of a texture, that a sidecar may ask for.
const MAX_SIZE: i64 = 65536;

/// A parsed sidecar. What its keys name is checked against a shader by [`Declared::check`].
#[derive(Clone, Debug, PartialEq)]
pub struct Declared {
    pub(crate) file: String,
    pub(crate) text: String,
    pub(crate) workgroups: Option<[u32; 3]>,
    pub(crate) overrides: BTreeMap<String, f64>,
    pub(crate) entries: Vec<Entry>,
}

/// One range.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub(crate) key: String,
    pub(crate) pattern: Pattern,
    pub(crate) span: Range<usize>,
    pub(crate) values: Option<Said>,
    /// Where the values stand.
    pub(crate) values_span: Range<usize>,
    pub(crate) size: Option<Vec<u32>>,
    pub(crate) size_span: Range<usize>,
}

/// Values as written: one number for all scalars, or one each.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Said {
    Between(Vec<f64>, Vec<f64>),
    Unit,
    OneOf(Vec<f64>),
}

impl Declared {
    /// Reads a sidecar; `file` names it in messages.
    ///
    /// # Errors
    /// Everything that is wrong with it, each with its place.
    pub fn parse(file: &str, text: &str) -> Result<Self, Box<Report>> {
        let mut report = Report::new(file, text);
        let (document, syntax) = DeTable::parse_recoverable(text);
        for error in &syntax {
            let message = format!("not TOML: {}", error.message().replace('\n', ", "));
            report.note(
                error.span().unwrap_or(0..0),
                message,
                "see https://toml.io for the syntax",
            );
        }
        let mut declared = Self {
            file: file.to_owned(),
            text: text.to_owned(),
            workgroups: None,
            overrides: BTreeMap::new(),
            entries: Vec::new(),
        };
        if syntax.is_empty() {
            declared.read(document.get_ref(), &mut report);
        }
        report.check(declared)
    }

    fn read(&mut self, root: &DeTable<'_>, report: &mut Report) {
        let mut schema = false;
        for (key, value) in root {
            match key.get_ref().as_ref() {
                "schema" => {
                    schema = true;
                    if whole(value) != Some(1) {
                        report.note(
                            value.span(),
                            "this is not a schema that is known here",
                            "write schema = 1",
                        );
                    }
                }
                "workgroups" => self.workgroups = workgroups(value, report),
                "overrides" => self.constants(value, report),
                "ranges" => self.ranges(value, report),
                other => report.note(
                    key.span(),
                    format!("unknown key `{other}`"),
                    suggestion(other, "known", TOP),
                ),
            }
        }
        if !schema {
            report.note(0..0, "`schema` is missing", "write schema = 1 as the first line");
        }
    }

    /// Values of the shader's pipeline-overridable constants, by name, or by number where a constant has an `@id`.
    pub fn overrides(&self) -> &BTreeMap<String, f64> {
        &self.overrides
    }

    fn constants(&mut self, value: &Spanned<DeValue<'_>>, report: &mut Report) {
        let DeValue::Table(table) = value.get_ref() else {
            report.note(
                value.span(),
                "`overrides` is a table",
                "write [overrides] on a line of its own",
            );
            return;
        };
        for (key, value) in table {
            let given = match value.get_ref() {
                DeValue::Boolean(truth) => Some(f64::from(u8::from(*truth))),
                _ => number(value, report),
            };
            self.overrides
                .extend(given.map(|given| (key.get_ref().to_string(), given)));
        }
    }

    fn ranges(&mut self, value: &Spanned<DeValue<'_>>, report: &mut Report) {
        let DeValue::Table(table) = value.get_ref() else {
            report.note(
                value.span(),
                "`ranges` is a table",
                "write [ranges] on a line of its own",
            );
            return;
        };
        for (key, value) in table {
            match Pattern::parse(key.get_ref()) {
                Ok(pattern) => self.entries.extend(entry(key, pattern, value, report)),
                Err(message) => report.note(
                    key.span(),
                    message,
                    "keys look like \"lights.items[].vector.xyz\", in quotes where they hold a dot or bracket",
                ),
            }
        }
        self.entries.sort_by_key(|entry| entry.pattern.specificity());
    }
}

fn entry(
    key: &Spanned<std::borrow::Cow<'_, str>>,
    pattern: Pattern,
    value: &Spanned<DeValue<'_>>,
    report: &mut Report,
) -> Option<Entry> {
    let DeValue::Table(table) = value.get_ref() else {
        report.note(
            value.span(),
            format!("the range of `{}` is a table", key.get_ref()),
            "for example { lo = 0, hi = 1 }, { unit = true } or { one_of = [-1, 1] }; a key with a dot needs quotes",
        );
        return None;
    };
    for (word, inner) in table {
        if !WORDS.contains(&word.get_ref().as_ref()) {
            let mut hint = suggestion(word.get_ref(), "known", WORDS);
            if matches!(inner.get_ref(), DeValue::Table(_)) {
                hint = format!(
                    "a key with a dot needs quotes: \"{}.{}\" = …; {hint}",
                    key.get_ref(),
                    word.get_ref()
                );
            }
            report.note(word.span(), format!("unknown key `{}`", word.get_ref()), hint);
        }
    }
    let size = table.get("size");
    Some(Entry {
        key: key.get_ref().to_string(),
        pattern,
        span: key.span(),
        values: said(value.span(), table, report),
        values_span: value.span(),
        size: size.and_then(|size| sizes(size, report)),
        size_span: size.map_or(0..0, Spanned::span),
    })
}

/// What a table says about values; `None` where it speaks of the size only, or is wrong.
fn said(span: Range<usize>, table: &DeTable<'_>, report: &mut Report) -> Option<Said> {
    let get = |word: &str| table.get(word);
    let (lo, hi, unit, one_of) = (get("lo"), get("hi"), get("unit"), get("one_of"));
    let kinds = usize::from(lo.is_some() || hi.is_some())
        + usize::from(unit.is_some())
        + usize::from(one_of.is_some());
    let help = "give lo and hi, or unit = true, or one_of = […], one of the three";
    match (lo, hi, unit, one_of) {
        _ if kinds > 1 => report.note(span, "more than one kind of range", help),
        (Some(lo), Some(hi), ..) => return between(lo, hi, report),
        (Some(one), None, ..) | (None, Some(one), ..) => {
            report.note(
                one.span(),
                "a range has both ends",
                "give lo and hi; both are included",
            );
        }
        (_, _, Some(unit), _) if matches!(unit.get_ref(), DeValue::Boolean(true)) => return Some(Said::Unit),
        (_, _, Some(unit), _) => report.note(unit.span(), "`unit` is true or left out", help),
        (_, _, _, Some(list)) => {
            let values = numbers(list, report)?;
            if !values.is_empty() {
                return Some(Said::OneOf(values));
            }
            report.note(list.span(), "a choice of nothing", "name at least one value");
        }
        (None, None, None, None) if get("size").is_some() => {}
        (None, None, None, None) => report.note(span, "this range says nothing", help),
    }
    None
}

fn between(lo: &Spanned<DeValue<'_>>, hi: &Spanned<DeValue<'_>>, report: &mut Report) -> Option<Said> {
    let (low, high) = (numbers(lo, report)?, numbers(hi, report)?);
    if low.is_empty() || high.is_empty() {
        report.note(
            lo.span(),
            "an end without numbers",
            "give a number, or one for each component",
        );
        return None;
    }
    if low.len() != high.len() && low.len() != 1 && high.len() != 1 {
        let message = format!("{} lower ends and {} upper ends", low.len(), high.len());
        report.note(
            hi.span(),
            message,
            "give one number for all components, or one for each",
        );
        return None;
    }
    let pairs = low.iter().cycle().zip(high.iter().cycle());
    if let Some((l, h)) = pairs.take(low.len().max(high.len())).find(|(l, h)| l > h) {
        report.note(
            lo.span(),
            format!("lo = {l} is above hi = {h}"),
            "a range goes from lo up to hi",
        );
        return None;
    }
    Some(Said::Between(low, high))
}

/// A number or a list of them, all finite and within `f32`.
fn numbers(value: &Spanned<DeValue<'_>>, report: &mut Report) -> Option<Vec<f64>> {
    match value.get_ref() {
        DeValue::Array(items) => items.iter().map(|item| number(item, report)).collect(),
        DeValue::Integer(_)
        | DeValue::Float(_)
        | DeValue::String(_)
        | DeValue::Boolean(_)
        | DeValue::Datetime(_)
        | DeValue::Table(_) => Some(vec![number(value, report)?]),
    }
}

fn number(value: &Spanned<DeValue<'_>>, report: &mut Report) -> Option<f64> {
    let found = match value.get_ref() {
        DeValue::Integer(_) => whole(value).map(|x| x as f64),
        DeValue::Float(float) => float.as_str().replace('_', "").parse::<f64>().ok(),
        DeValue::String(_)
        | DeValue::Boolean(_)
        | DeValue::Datetime(_)
        | DeValue::Array(_)
        | DeValue::Table(_) => None,
    };
    let problem = match found {
        None => "this is not a number",
        Some(x) if x.is_nan() => "NaN is not the end of a range",
        Some(x) if !(x as f32).is_finite() => "this is beyond the numbers of f32",
        Some(x) => return Some(x),
    };
    report.note(
        value.span(),
        problem,
        "write a finite number that f32 can hold, such as 0.5",
    );
    None
}

fn whole(value: &Spanned<DeValue<'_>>) -> Option<i64> {
    match value.get_ref() {
        DeValue::Integer(integer) => {
            i64::from_str_radix(&integer.as_str().replace('_', ""), integer.radix()).ok()
        }
        DeValue::Float(_)
        | DeValue::String(_)
        | DeValue::Boolean(_)
        | DeValue::Datetime(_)
        | DeValue::Array(_)
        | DeValue::Table(_) => None,
    }
}

/// One to three sizes, each from 1 to [`MAX_SIZE`].
fn sizes(value: &Spanned<DeValue<'_>>, report: &mut Report) -> Option<Vec<u32>> {
    let list: Vec<Option<i64>> = match value.get_ref() {
        DeValue::Array(items) => items.iter().map(whole).collect(),
        DeValue::Integer(_)
        | DeValue::Float(_)
        | DeValue::String(_)
        | DeValue::Boolean(_)
        | DeValue::Datetime(_)
        | DeValue::Table(_) => vec![whole(value)],
    };
    let good = |n: &Option<i64>| n.filter(|n| (1..=MAX_SIZE).contains(n)).map(|n| n as u32);
    let found: Option<Vec<u32>> = list.iter().map(good).collect();
    let found = found.filter(|list| (1..=3).contains(&list.len()));
    if found.is_none() {
        let hint = format!("whole numbers from 1 to {MAX_SIZE}: one for an array, up to three for a texture");
        report.note(value.span(), "this is not a size", hint);
    }
    found
}

fn workgroups(value: &Spanned<DeValue<'_>>, report: &mut Report) -> Option<[u32; 3]> {
    let list = match value.get_ref() {
        DeValue::Array(items) => items.iter().map(whole).collect::<Option<Vec<_>>>(),
        DeValue::Integer(_)
        | DeValue::Float(_)
        | DeValue::String(_)
        | DeValue::Boolean(_)
        | DeValue::Datetime(_)
        | DeValue::Table(_) => None,
    };
    let counts: Option<[i64; 3]> = list.and_then(|list| list.try_into().ok());
    let good = counts.filter(|counts| counts.iter().all(|n| (1..=65535).contains(n)));
    if good.is_none() {
        report.note(
            value.span(),
            "this is not a number of workgroups",
            "three whole numbers from 1 to 65535, such as [2, 1, 1]",
        );
    }
    good.map(|counts| counts.map(|n| n as u32))
}
