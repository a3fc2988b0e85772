//! Prices on a driver: errors within what the interfaces allow, and times that are times.

use std::io::Write;

use bossage_runner::{AdapterSelector, Device, Error};
use bossage_shaders::Library;
use bossage_study::prices::{Context, chart};
use bossage_study::record::Price;

/// The driver's adapter, or `None` after saying that the test is skipped.
///
/// # Panics
/// Where there is none though `BOSSAGE_REQUIRE` lists `lavapipe`.
fn device(test: &str) -> Option<Device> {
    let list = std::env::var("BOSSAGE_REQUIRE").unwrap_or_default();
    let is_required = list.split(',').any(|name| name.trim() == "lavapipe");
    let opened = match Device::open(&AdapterSelector::named("lavapipe")) {
        Err(Error::NoSuchAdapter { .. }) if !is_required => Device::open(&AdapterSelector::Any),
        opened => opened,
    };
    match opened {
        Ok(device) => Some(device),
        Err(error) => {
            assert!(!is_required, "lavapipe is required, but: {error}");
            writeln!(std::io::stderr(), "SKIP: {test}: {error}").expect("standard error can be written");
            None
        }
    }
}

fn measured(device: &Device, name: &str) -> Vec<Price> {
    let library = Library::embedded().unwrap();
    let context = Context {
        machine: device,
        library: &library,
        quick: true,
        seed: 1,
    };
    let prices = chart(name, &context).unwrap();
    for price in &prices {
        let time = price
            .time_ms
            .unwrap_or_else(|| panic!("{}: {:?}", price.variant, price.no_time));
        assert!(price.no_time.is_none() && time.runs == 5);
        assert!(0.0 < time.min && time.min <= time.median && time.median <= time.max);
    }
    prices
}

/// A sampler keeps 8 bits of the place between texels, and of noise the next texel may be any: 2⁻⁸ of the range along each axis.
/// Filtering 8-bit texels in 8-bit arithmetic loses up to 1/255 along each axis besides, 16-bit ones twice 1/65535. Arithmetic over
/// loaded texels has its roundings only, and the reader's.
#[test]
fn a_drivers_filter_errs_within_its_liberties_and_arithmetic_by_rounding() {
    let Some(device) = device("a_drivers_filter_errs_within_its_liberties_and_arithmetic_by_rounding") else {
        return;
    };
    for price in measured(&device, "filter") {
        let steps = match price.bytes as u32 {
            1 => 2.0 / 255.0,
            2 => 4.0 / 65_535.0,
            _ => 0.0,
        };
        let rounding = 16.0 * 2f64.powi(-24);
        let bound = if price.variant.starts_with("sampler") {
            2.0 / 256.0 + steps + rounding
        } else if price.variant.starts_with("gather") {
            // Another four texels than the shader has in mind: anything.
            1.0
        } else {
            rounding
        };
        assert!(price.max <= bound, "{}: {} > {bound}", price.variant, price.max);
    }
}

/// The first pass keeps half a code, the blending unit either code around its product, of which it may round the source first.
#[test]
fn a_driver_draws_one_pass_within_half_a_code_and_two_within_two() {
    let Some(device) = device("a_driver_draws_one_pass_within_half_a_code_and_two_within_two") else {
        return;
    };
    for price in measured(&device, "passes") {
        let codes = match price.variant.as_str() {
            "one pass, bytes" => 0.5,
            "two passes, bytes" => 0.5 + 0.5 + 1.0,
            _ => 0.0,
        };
        let bound = codes / 255.0 + 16.0 * 2f64.powi(-24);
        assert!(price.max <= bound, "{}: {} > {bound}", price.variant, price.max);
    }
}
