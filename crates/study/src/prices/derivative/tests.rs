use super::super::tests::{embedded, find, library, measured};
use super::super::waves::STEEPEST;
use super::*;

/// What each difference leaves of a wave's slope, whose phase goes on by φ from texel to texel: |1 − (e^{iφ} − 1)/(iφ)| ≤ φ/2,
/// 1 − sin φ/φ ≤ φ²/6 and 1 − (8 sin φ − sin 2φ)/(6φ) ≤ φ⁴/30. An angle is at most the difference of the slopes, along two axes √2
/// times as much.
fn bound_deg(order: &str, surface: &Waves) -> f64 {
    let step = surface.greatest_step();
    let left = match order {
        "forward" => step / 2.0,
        "central" => step.powi(2) / 6.0,
        "fourth order" => step.powi(4) / 30.0,
        other => panic!("no order `{other}`"),
    };
    // Heights of 24 bits, four a slope, weighted by 18/12 at most; and a dozen roundings of the normal.
    let texels = surface.scale * f64::from(surface.side);
    let rounding = 2f64.sqrt() * 1.5 * texels * 2f64.powi(-24) + 12.0 * 2f64.powi(-24);
    (2f64.sqrt() * STEEPEST * left + rounding).to_degrees()
}

#[test]
fn no_difference_errs_beyond_its_bound_by_hand() {
    let prices = measured("derivative");
    for length in LENGTHS {
        let surface = Waves::new(1, 128, length);
        for (order, _) in ORDERS {
            let price = find(prices, &format!("{order}, waves of {length} texels"));
            let bound = bound_deg(order, &surface);
            assert!(price.max <= bound, "{}: {} > {bound}", price.variant, price.max);
        }
    }
}

#[test]
fn errors_fall_with_the_order_and_cost_reads() {
    let prices = measured("derivative");
    let of = |order: &str, length: u32| find(prices, &format!("{order}, waves of {length} texels"));
    for length in LENGTHS {
        let [first, second, fourth] = ORDERS.map(|(order, _)| of(order, length));
        assert!(fourth.p50 < second.p50 && second.p50 < first.p50);
        assert_eq!([first.fetches, second.fetches, fourth.fetches], [3.0, 4.0, 8.0]);
    }
    // From 16 to 32 texels by 2, 4 and 16, but for the next term of each series, φ²/20 of the first at most where φ ≤ 0.6, and for
    // angles that are not slopes: a tenth is let through.
    for ((order, _), power) in ORDERS.into_iter().zip([1, 2, 4]) {
        let ratio = of(order, 16).p50 / of(order, 32).p50;
        assert!(ratio > 0.9 * 2_f64.powi(power), "{order}: {ratio}");
    }
}

#[test]
fn a_wrong_weight_is_seen() {
    let library = library();
    let context = embedded(&library);
    let surface = Waves::new(1, 128, 64);
    let truth: Vec<DVec3> = surface.centres().map(|uv| surface.normal(uv)).collect();
    // Halves for twelfths: six times the slope.
    let frame = frame_of(&context, "fourth_order_at_texels", &surface, Storage::Float32).unwrap();
    let frame = frame.buffer("settings", &bytes_of(&[(surface.scale * 128.0 * 6.0) as f32]));
    let errors = errors_deg(&truth, &frame.measure(&context).unwrap().outputs, 3);
    let worst = errors.into_iter().fold(0.0, f64::max);
    assert!(worst > 100.0 * bound_deg("fourth order", &surface));
}
