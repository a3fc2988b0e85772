//! The settings of a pinned search along the view ray, as a scene file gives them beside `technique`.

use std::ops::RangeInclusive;

use bossage_reference::relief_search::Search;

use crate::fields::Table;
use crate::load::refuse;
use crate::model::TechniquePin;
use crate::schema::{self, MAX_REFINEMENTS, MAX_STEPS};

const STEPS: RangeInclusive<u32> = 1..=MAX_STEPS;
const REFINEMENTS: RangeInclusive<u32> = 0..=MAX_REFINEMENTS;
/// Every key, and what it may be.
const KEYS: [(&str, RangeInclusive<u32>); 4] = [
    ("iterations", STEPS),
    ("layers", STEPS),
    ("refinements", REFINEMENTS),
    ("steps", STEPS),
];

/// The search with its settings, those of the schema where the file gives none. The outer `None`: something is wrong and noted.
pub(crate) fn settings(table: &Table<'_>, pin: TechniquePin) -> Option<Option<Search>> {
    let default = schema::search(pin);
    let taken = default.map(Search::settings).unwrap_or_default();
    for (key, _) in KEYS {
        if !taken.iter().any(|(name, _)| *name == key) {
            let message = format!("technique `{}` has no {key}", pin.as_str());
            let hint = match taken.as_slice() {
                [] => "remove it".to_owned(),
                taken => format!("remove it; it has {}", listed(taken)),
            };
            refuse(table, key, &message, &hint);
        }
    }
    let given = taken.iter().map(|&(name, default)| {
        let (_, range) = KEYS.iter().find(|(key, _)| *key == name)?;
        table.or(name, default, |value| value.whole(range.clone()))
    });
    // All of them, so that each wrong one is noted.
    let given: Vec<Option<u32>> = given.collect();
    let given: Vec<u32> = given.into_iter().collect::<Option<_>>()?;
    Some(default.map(|search| with(search, &given)))
}

fn listed(settings: &[(&str, u32)]) -> String {
    let names: Vec<String> = settings.iter().map(|(name, _)| format!("`{name}`")).collect();
    names.join(" and ")
}

/// The search with other settings, in the order of [`Search::settings`].
fn with(search: Search, given: &[u32]) -> Search {
    match (search, given) {
        (Search::ParallaxIterative { .. }, &[iterations]) => Search::ParallaxIterative { iterations },
        (Search::SteepParallax { .. }, &[layers]) => Search::SteepParallax { layers },
        (Search::ParallaxOcclusion { .. }, &[layers]) => Search::ParallaxOcclusion { layers },
        (Search::Relief { .. }, &[layers, refinements]) => Search::Relief { layers, refinements },
        (Search::ConeStep { .. }, &[steps]) => Search::ConeStep { steps },
        (Search::RelaxedConeStep { .. }, &[steps, refinements]) => {
            Search::RelaxedConeStep { steps, refinements }
        }
        (other, _) => other,
    }
}
