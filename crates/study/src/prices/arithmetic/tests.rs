use super::super::tests::{embedded, find, library, measured};
use super::*;

/// Half a unit in the last place of 1, by format.
fn rounding(real: Real) -> f64 {
    2f64.powi(match real {
        Real::F16 => -11,
        Real::F32 => -24,
        Real::F64 => -53,
    })
}

/// By hand for `dot3`, in roundings u of numbers up to 1: the normal, the light and the colour are rounded once each (in f16 only), the
/// light is scaled (1), squared and added up (3), its root taken (1), divided (1), multiplied and added up (3), multiplied by the
/// colour (1): thirteen in relative terms. Sums of three products of unit vectors have terms of up to 1 in all, by Cauchy and
/// Schwarz √3 at most: 13·√3 < 23. Truth has four of f64's own.
const DOT3_ROUNDINGS: f64 = 27.0;

#[test]
fn dot3_errs_by_its_roundings_in_each_format() {
    let prices = measured("arithmetic");
    for real in Real::ALL {
        let price = find(prices, &format!("dot3 {real}"));
        let bound = DOT3_ROUNDINGS * rounding(real);
        assert!(price.max <= bound, "{real}: {} > {bound}", price.max);
        // Each colour is rounded at least once.
        assert!(price.max >= 0.25 * rounding(real), "{real}: {}", price.max);
    }
}

#[test]
fn each_format_is_better_than_the_one_before_and_costs_the_same_operations() {
    let prices = measured("arithmetic");
    for function in ["dot3", "blinn_phong"] {
        let [half, single, double] = Real::ALL.map(|real| find(prices, &format!("{function} {real}")));
        assert!(
            half.p50 > 100.0 * single.p50 && single.p50 > 1e6 * double.p50,
            "{function}"
        );
        assert!(half.max > single.max && single.max > double.max);
        assert_eq!([half.bytes, single.bytes, double.bytes], [2.0, 4.0, 8.0]);
    }
    // The power multiplies the error of the cosine by the exponent, up to 256.
    let highlight = find(prices, "blinn_phong f16").max;
    assert!(highlight > 5.0 * find(prices, "dot3 f16").max, "{highlight}");
    let reason = find(prices, "blinn_phong f64").no_time.as_deref();
    assert_eq!(reason, Some("SPIR-V has no power of 64-bit floats"));
}

#[test]
fn another_formula_is_seen() {
    let library = library();
    let context = embedded(&library);
    let broken = Function {
        text: "import package::techniques::dot3::dot3_published;
            import package::lib::normalise::SMALLEST_NORMAL;
            fn shade(n: vec3f, l: vec3f, v: vec3f, d: vec3f, s: vec3f, p: f32) -> vec3f {
                return dot3_published(n, l + SMALLEST_NORMAL, d.zyx);
            }",
        ..FUNCTIONS[0]
    };
    let prices = measure(&context, &[broken]).unwrap();
    let worst = find(&prices, "dot3 f32").max;
    assert!(worst > 1000.0 * DOT3_ROUNDINGS * rounding(Real::F32), "{worst}");
}

#[test]
fn what_is_not_a_number_is_wrong() {
    let found = [0.5, f64::NAN, 0.5, 0.25, 0.5, 0.5];
    assert_eq!(errors(&[DVec3::splat(0.5); 2], &found), [WRONG, 0.25]);
}

#[test]
fn truth_is_the_references() {
    for item in items(1, 1000) {
        let (truth, reference) = (
            dot3(&item),
            bossage_reference::dot3::hardened(item.normal, item.light, item.surface.diffuse),
        );
        // A dozen roundings of 2^-53 in either.
        assert!((truth - reference).abs().max_element() < 3e-15);
    }
}
