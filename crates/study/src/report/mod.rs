//! The report of a study: charts and pictures as files, and one page that holds all of them.
//!
//! Nothing is written here. [`files`] gives names and bytes, so that whoever calls can write all of them or none.

mod check;
mod error;
mod page;
mod pair;
mod table;
mod versus;

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::chart::{self, Theme};
use crate::record::Study;

pub use error::Error;
pub use pair::{Pair, Shot};

/// The page's file name.
pub const PAGE: &str = "index.html";

/// File names, without folders, and what the files hold.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The page; each chart as `NAME.svg`, `NAME.png` and `NAME-dark.png`; of each pair both pictures and their difference.
///
/// ```
/// use bossage_study::record::Study;
/// use bossage_study::report;
///
/// let files = report::files(&Study::default(), &[])?;
/// assert!(files.contains_key(report::PAGE));
/// # Ok::<(), report::Error>(())
/// ```
///
/// # Errors
/// [`Error::Figure`] for a figure that is negative, infinite or no number; [`Error::Collision`] where names of maps differ in
/// nothing that a file's name can hold; [`Error::Pair`] for pictures that can't be compared; [`Error::Chart`] and [`Error::Encode`] when
/// a drawing crate refuses.
pub fn files(study: &Study, pairs: &[Pair]) -> Result<Files, Error> {
    check::figures(study)?;
    let charts = chart::all(study)?;
    let mut files = Files::new();
    let drawn: Vec<[(String, Vec<u8>); 3]> = charts.par_iter().map(chart_files).collect::<Result<_, _>>()?;
    for (name, bytes) in drawn.into_iter().flatten() {
        add(&mut files, name, bytes)?;
    }
    let compared: Vec<pair::Compared<'_>> = pairs.par_iter().map(pair::compared).collect::<Result<_, _>>()?;
    for (name, bytes) in compared.iter().flat_map(pair::Compared::files) {
        add(&mut files, name, bytes)?;
    }
    let page = page::write(study, &charts, &compared);
    add(&mut files, PAGE.to_owned(), page.into_bytes())?;
    Ok(files)
}

fn chart_files(chart: &chart::Chart) -> Result<[(String, Vec<u8>); 3], Error> {
    let name = &chart.name;
    Ok([
        (format!("{name}.svg"), chart.svg().into_bytes()),
        (format!("{name}.png"), chart.png(Theme::Light)?),
        (format!("{name}-dark.png"), chart.png(Theme::Dark)?),
    ])
}

/// Names that differ in case only are one file on some systems.
fn add(files: &mut Files, name: String, bytes: Vec<u8>) -> Result<(), Error> {
    if files.keys().any(|there| there.eq_ignore_ascii_case(&name)) {
        return Err(Error::Collision(name));
    }
    files.insert(name, bytes);
    Ok(())
}

#[cfg(test)]
mod tests;
