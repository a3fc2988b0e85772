//! Reads the lines of an OBJ file just enough to say which line is wrong: numbers that are not finite, and faces that point
//! at vertices, texture coordinates or normals that are not there.
//!
//! A positive index may point forward (some exporters write the faces first); a negative one counts back from its line.
//! What this cannot read it leaves to the parser, which then complains.

use crate::MeshDefect;

const ATTRIBUTES: [&str; 3] = ["v", "vt", "vn"];

type Found = (usize, MeshDefect);

/// The first defect with its line, from 1.
pub(super) fn check(bytes: &[u8]) -> Result<(), Found> {
    let totals = count(bytes);
    let mut so_far = [0usize; 3];
    for (number, line) in lines(bytes) {
        let mut words = line.split_whitespace();
        let keyword = words.next().unwrap_or_default();
        if let Some(kind) = ATTRIBUTES.iter().position(|a| *a == keyword) {
            finite(ATTRIBUTES[kind], so_far[kind], words).map_err(|d| (number, d))?;
            so_far[kind] += 1;
        } else if keyword == "f" {
            words
                .try_for_each(|corner| in_range(corner, &so_far, &totals))
                .map_err(|d| (number, d))?;
        }
    }
    Ok(())
}

fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &str)> {
    let text = |(i, line)| Some((i + 1, str::from_utf8(line).ok()?));
    bytes.split(|&b| b == b'\n').enumerate().filter_map(text)
}

fn count(bytes: &[u8]) -> [usize; 3] {
    let mut totals = [0; 3];
    for (_, line) in lines(bytes) {
        let keyword = line.split_whitespace().next().unwrap_or_default();
        if let Some(kind) = ATTRIBUTES.iter().position(|a| *a == keyword) {
            totals[kind] += 1;
        }
    }
    totals
}

fn finite<'a>(
    attribute: &'static str,
    vertex: usize,
    mut words: impl Iterator<Item = &'a str>,
) -> Result<(), MeshDefect> {
    let wrong = words.find(|w| w.parse::<f32>().is_ok_and(|v| !v.is_finite()));
    match wrong {
        Some(value) => Err(MeshDefect::NonFinite {
            attribute,
            vertex,
            value: value.into(),
        }),
        None => Ok(()),
    }
}

fn in_range(corner: &str, so_far: &[usize; 3], totals: &[usize; 3]) -> Result<(), MeshDefect> {
    for (kind, text) in corner.split('/').enumerate().take(3) {
        let Ok(index) = text.parse::<i64>() else { continue };
        let back = usize::try_from(index.unsigned_abs()).unwrap_or(usize::MAX);
        let count = if index < 0 { so_far[kind] } else { totals[kind] };
        if index == 0 || back > count {
            return Err(MeshDefect::FaceOutOfRange {
                attribute: ATTRIBUTES[kind],
                index,
                count,
            });
        }
    }
    Ok(())
}
