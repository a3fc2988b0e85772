//! The budget of a scene file, and the cost profile that it names.

use std::sync::Arc;

use crate::fields::{POSITIVE, Table, Value};
use crate::files::Files;
use crate::model::Budget;
use crate::profile::Profile;
use crate::schema;

/// The `[budget]` table. Without one, and without an error or a time in it, the default error is wanted.
pub(crate) fn budget(root: &Table<'_>, files: &Files) -> Option<Budget> {
    let Some(value) = root.get("budget") else {
        return Some(Budget {
            error_px: Some(schema::ERROR_PX),
            time_ms: None,
            profile: Arc::new(bundled(schema::PROFILE)?),
        });
    };
    let table = value.table()?;
    let error_px = table.or("error_px", None, |v| v.number(POSITIVE).map(Some));
    let time_ms = table.or("time_ms", None, |v| v.number(POSITIVE).map(Some));
    let named = table.get("profile");
    if table.get("time_ms").is_some() && named.is_none() {
        table.need(
            "profile",
            "`profile`: on which machine `time_ms` is wanted, as `profile = \"lavapipe\"`",
        );
    }
    let profile = match &named {
        Some(value) => profile(value, files),
        None => bundled(schema::PROFILE),
    };
    table.finish();
    let (error_px, time_ms) = (error_px?, time_ms?);
    Some(Budget {
        error_px: error_px.or(time_ms.is_none().then_some(schema::ERROR_PX)),
        time_ms,
        profile: Arc::new(profile?),
    })
}

fn bundled(name: &str) -> Option<Profile> {
    Profile::bundled(name).ok()
}

/// A file where the name ends in `.toml`, else a profile that comes with the program.
fn profile(value: &Value<'_>, files: &Files) -> Option<Profile> {
    let name = value.name()?;
    if name.ends_with(".toml") {
        return files.profile(value);
    }
    Profile::bundled(name)
        .map_err(|hint| {
            let hint = format!("{hint}; a file of your own ends in `.toml`");
            value.note(format!("there is no cost profile `{name}`"), hint);
        })
        .ok()
}
