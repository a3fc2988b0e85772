//! What all charts have in common.

use std::sync::OnceLock;

use bossage_embedded::Embedded;
use bossage_shaders::Library;

use super::{CHARTS, Context, Error, all, chart};
use crate::record::Price;

pub(super) fn library() -> Library {
    Library::embedded().unwrap()
}

/// The machine without a driver, with few items.
pub(super) fn embedded(library: &Library) -> Context<'_> {
    static MACHINE: OnceLock<Embedded> = OnceLock::new();
    Context {
        machine: MACHINE.get_or_init(Embedded::new),
        library,
        quick: true,
        seed: 1,
    }
}

/// A chart of that machine, measured once for all tests.
pub(super) fn measured(name: &str) -> &'static [Price] {
    static ALL: OnceLock<Vec<(&str, Vec<Price>)>> = OnceLock::new();
    let charts = ALL.get_or_init(|| {
        let library = library();
        let context = embedded(&library);
        CHARTS.map(|name| (name, chart(name, &context).unwrap())).to_vec()
    });
    let found = charts.iter().find(|(chart, _)| *chart == name);
    &found.unwrap_or_else(|| panic!("no chart `{name}`")).1
}

/// The variant of that name.
pub(super) fn find<'a>(prices: &'a [Price], variant: &str) -> &'a Price {
    let found = prices.iter().find(|price| price.variant == variant);
    found.unwrap_or_else(|| panic!("no variant `{variant}`"))
}

#[test]
fn an_unknown_chart_is_refused_with_the_list() {
    let library = library();
    let error = chart("codecs", &embedded(&library)).unwrap_err();
    assert!(matches!(error, Error::NoSuchChart { .. }));
    let message = error.to_string();
    assert!(CHARTS.iter().all(|name| message.contains(name)), "{message}");
}

#[test]
fn charts_are_the_same_each_time_finite_and_say_how_to_make_them_again() {
    let library = library();
    let context = embedded(&library);
    let prices = all(&context).unwrap();
    assert_eq!(prices, CHARTS.map(measured).concat());
    for price in &prices {
        let figures = [
            price.p50,
            price.p99,
            price.max,
            price.ops,
            price.fetches,
            price.bytes,
        ];
        assert!(figures.iter().all(|figure| figure.is_finite() && *figure >= 0.0));
        assert!(price.p50 <= price.p99 && price.p99 <= price.max, "{price:?}");
        assert!(price.time_ms.is_none() && price.no_time.is_some());
        let expected = format!(
            "bossage study --price {} --quick --seed 1 --adapter 'embedded' -o DIR",
            price.chart
        );
        assert_eq!(price.rerun, expected);
    }
    for name in CHARTS {
        let of_chart: Vec<&Price> = prices.iter().filter(|price| price.chart == name).collect();
        assert!(of_chart.len() >= 2, "`{name}` compares nothing");
        assert!(of_chart.iter().all(|price| price.unit == of_chart[0].unit));
        let mut names: Vec<&str> = of_chart.iter().map(|price| price.variant.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(
            names.len(),
            of_chart.len(),
            "`{name}` has two variants of one name"
        );
    }
}

#[test]
fn other_seeds_are_other_inputs() {
    let library = library();
    let context = embedded(&library);
    let one = measured("codec");
    let two = chart("codec", &Context { seed: 2, ..context }).unwrap();
    assert!(one.iter().zip(&two).all(|(one, two)| one.p50 != two.p50));
}
