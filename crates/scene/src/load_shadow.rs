//! The shadows of a material: `shadow`, and the settings that go with it.

use crate::fields::{Bound, Table};
use crate::load::refuse;
use crate::model::Shadow;
use crate::schema;

/// What a file may ask for.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    None,
    Hard,
    Soft,
}

const KINDS: [(&str, Kind); 3] = [("none", Kind::None), ("hard", Kind::Hard), ("soft", Kind::Soft)];
const HALF_WIDTH: Bound = Bound {
    allows: |x| (schema::LIGHT_HALF_WIDTH_ENDS[0]..=schema::LIGHT_HALF_WIDTH_ENDS[1]).contains(&x),
    words: "from 0.001 to 1000",
};

/// The shadows with their settings, those of the schema where the file gives none. `None`: something is wrong and noted.
pub(crate) fn shadow(table: &Table<'_>) -> Option<Shadow> {
    let kind = table.or("shadow", Kind::None, |value| value.word(&KINDS));
    let takes = |key: &'static str, allowed: bool, hint: &str| {
        if !allowed {
            refuse(
                table,
                key,
                &format!("without such a shadow there is no {key}"),
                hint,
            );
        }
    };
    let (any, soft) = (kind != Some(Kind::None), matches!(kind, Some(Kind::Soft) | None));
    takes(
        "light_samples",
        any,
        "remove it, or set shadow to `hard` or `soft`",
    );
    takes("light_half_width", soft, "remove it, or set shadow to `soft`");
    let samples = if any {
        table.or("light_samples", schema::LIGHT_SAMPLES, |value| {
            value.whole(1..=schema::MAX_STEPS)
        })
    } else {
        Some(schema::LIGHT_SAMPLES)
    };
    let half_width = if soft {
        table.or("light_half_width", schema::LIGHT_HALF_WIDTH, |value| {
            value.number(HALF_WIDTH)
        })
    } else {
        Some(schema::LIGHT_HALF_WIDTH)
    };
    let (samples, half_width) = (samples?, half_width?);
    kind.map(|kind| match kind {
        Kind::None => Shadow::None,
        Kind::Hard => Shadow::Hard { samples },
        Kind::Soft => Shadow::Soft { samples, half_width },
    })
}
