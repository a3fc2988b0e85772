use super::super::tests::{embedded, find, library, measured};
use super::*;

/// Seven roundings of numbers up to 1: the texel, two differences and three products and sums each, of which at most seven follow
/// one another. A place of 24 bits on 256 texels less half a texel is exact.
const ROUNDINGS: f64 = 7.0 / 16_777_216.0;

#[test]
fn an_ideal_filter_errs_by_its_roundings_and_costs_a_read_where_arithmetic_takes_four() {
    let prices = measured("filter");
    for storage in Storage::ALL {
        let of = |way: &str| find(prices, &format!("{way} {}", storage.bits()));
        for way in ["sampler", "four loads", "gather"] {
            assert!(of(way).max <= ROUNDINGS, "{way} {storage:?}: {}", of(way).max);
            assert_eq!(of(way).bytes, storage.bytes());
        }
        assert_eq!((of("sampler").fetches, of("four loads").fetches), (1.0, 4.0));
        assert!(of("sampler").ops < of("gather").ops && of("gather").ops < of("four loads").ops);
    }
}

#[test]
fn a_filter_that_forgets_the_half_texel_is_seen() {
    let library = library();
    let broken = TEXT.replace(" - 0.5;", ";");
    assert_ne!(broken, TEXT);
    let prices = measure(&embedded(&library), &broken).unwrap();
    // Noise: texels beside each other differ by a third of the range on average.
    for storage in Storage::ALL {
        assert!(find(&prices, &format!("four loads {}", storage.bits())).p50 > 0.05);
        assert!(find(&prices, &format!("sampler {}", storage.bits())).max <= ROUNDINGS);
    }
}

#[test]
fn what_is_not_a_number_is_wrong() {
    assert_eq!(errors(&[0.5, 0.5], &[f64::INFINITY, 0.25]), [WRONG, 0.25]);
}
