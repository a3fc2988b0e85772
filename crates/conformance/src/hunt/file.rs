//! What the files of hard inputs share: how they are read, which finds they keep, and how they write numbers.
//!
//! Numbers are hexadecimal floats as C writes them: exact, and their bits can be read off.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;

use crate::error::Error;

/// A file as TOML has it.
pub(crate) trait File: DeserializeOwned {
    /// The version of the format that it names.
    fn schema(&self) -> u32;
}

/// What is wrong with a file.
pub(crate) fn wrong(file: &str, message: String) -> Error {
    Error::Corpus {
        file: file.to_owned(),
        message,
    }
}

/// Reads a file; `name` is what messages call it.
///
/// # Errors
/// [`Error::Corpus`], with the place where the file is no TOML or has an unknown key.
pub(crate) fn parse<F: File>(name: &str, text: &str) -> Result<F, Error> {
    let file: F =
        toml::from_str(text).map_err(|error| wrong(name, error.to_string().trim_end().to_owned()))?;
    match file.schema() {
        1 => Ok(file),
        other => Err(wrong(
            name,
            format!("schema {other} is not known here; write schema = 1"),
        )),
    }
}

/// Reads each entry.
///
/// # Errors
/// [`Error::Corpus`] with the number of the first that is wrong, counted from 1.
pub(crate) fn entries<E, T>(
    name: &str,
    entries: Vec<E>,
    read: impl Fn(E) -> Result<T, String>,
) -> Result<Vec<T>, Error> {
    (1..)
        .zip(entries)
        .map(|(number, entry)| {
            read(entry).map_err(|problem| wrong(name, format!("found number {number}: {problem}")))
        })
        .collect()
}

/// Of finds with the same key the one that reaches most, the earlier where they are equal; in the order of keys.
pub(crate) fn best<T, K: Ord>(
    found: impl IntoIterator<Item = T>,
    key: impl Fn(&T) -> K,
    ulps: impl Fn(&T) -> f64,
) -> Vec<T> {
    let mut all: BTreeMap<K, T> = BTreeMap::new();
    for one in found {
        let key = key(&one);
        if all.get(&key).is_none_or(|kept| ulps(&one) > ulps(kept)) {
            all.insert(key, one);
        }
    }
    all.into_values().collect()
}

/// A float as C writes it in hexadecimal.
pub(crate) fn hex(x: f32) -> String {
    let bits = x.to_bits();
    let sign = if bits >> 31 == 1 { "-" } else { "" };
    let (exponent, mantissa) = ((bits >> 23) & 0xff, bits & 0x007f_ffff);
    let (lead, power) = match exponent {
        0 if mantissa == 0 => return format!("{sign}0x0p+0"),
        0 => (0, -126),
        _ => (1, exponent as i32 - 127),
    };
    let digits = format!("{:06x}", mantissa << 1);
    let digits = digits.trim_end_matches('0');
    let point = if digits.is_empty() { "" } else { "." };
    format!("{sign}0x{lead}{point}{digits}p{power:+}")
}

/// Reads what [`hex`] writes.
pub(crate) fn unhex(text: &str) -> Result<f32, String> {
    let wrong = || format!("`{text}` is no hexadecimal float; they look like -0x1.8p-3");
    let (negative, rest) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text),
    };
    let (digits, power) = rest
        .strip_prefix("0x")
        .and_then(|rest| rest.split_once('p'))
        .ok_or_else(wrong)?;
    let power: i32 = power.parse().map_err(|_| wrong())?;
    let (lead, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let all = format!("{lead}{fraction}");
    let known = all.len() <= 8 && !lead.is_empty() && (-200..=200).contains(&power);
    let mantissa = u32::from_str_radix(&all, 16)
        .ok()
        .filter(|_| known)
        .ok_or_else(wrong)?;
    let exact = f64::from(mantissa) * f64::from(power - 4 * fraction.len() as i32).exp2();
    let x = if negative { -exact } else { exact };
    if f64::from(x as f32) == x && x.is_finite() {
        Ok(x as f32)
    } else {
        Err(format!("`{text}` is no f32"))
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::{best, hex, unhex};
    use crate::error::Error;

    /// A text that reads is refused with the file's name and a word where a part of it is another.
    pub(crate) fn refuses<T>(
        parse: impl Fn(&str, &str) -> Result<T, Error>,
        text: &str,
        (from, to, word): (&str, &str, &str),
    ) {
        assert!(text.contains(from), "{from} is not in\n{text}");
        assert!(parse("a.toml", text).is_ok(), "{text}");
        let Err(error) = parse("a.toml", &text.replace(from, to)) else {
            panic!("{to} is taken");
        };
        let message = error.to_string();
        assert!(message.contains("a.toml") && message.contains(word), "{message}");
    }

    #[test]
    fn of_equal_finds_the_earlier_stays_and_of_others_the_best() {
        let found = [("b", 1.0, 1), ("a", 2.0, 2), ("b", 1.0, 3), ("a", 3.0, 4)];
        let kept = best(found, |one| one.0, |one| one.1);
        assert_eq!(kept, [("a", 3.0, 4), ("b", 1.0, 1)]);
    }

    #[test]
    fn hexadecimal_floats_are_exact() {
        for x in [
            0.0,
            -0.0,
            1.0,
            -1.5,
            0.1,
            f32::MAX,
            f32::MIN_POSITIVE,
            1e-45,
            -1.175_493_2e-38,
            16_777_217.0,
        ] {
            let read = unhex(&hex(x)).unwrap();
            assert_eq!(read.to_bits(), x.to_bits(), "{x:?} is {}", hex(x));
        }
        assert_eq!(hex(0.1), "0x1.99999ap-4");
        for wrong in [
            "",
            "1.0",
            "0x",
            "0xp1",
            "0x1",
            "0x1.gp0",
            "0x1p999",
            "0x1.0000001p+0",
            "nan",
        ] {
            assert!(unhex(wrong).is_err(), "{wrong}");
        }
    }
}
