//! Truncation of small positive floats to whole numbers, in a form that becomes vector code.
//!
//! `x as u32` saturates and answers NaN, for which compilers fall back to one texel at a time (measured: a bake takes
//! several times as long). Adding 2²³ leaves no room for a fraction: the sum's low bits are x rounded to nearest; where that
//! went up, take one off.

/// 2²³: floats from here to 2²⁴ are the whole numbers.
const WHOLE: f32 = 8_388_608.0;

/// `trunc(x)` for 0 ≤ x < 256, exactly. Other arguments give some number below 512, or wrap.
#[inline(always)]
pub(crate) fn to_byte_range(x: f32) -> u32 {
    let shifted = x + WHOLE;
    let went_up = u32::from(shifted - WHOLE > x);
    (shifted.to_bits() & 0x1ff).wrapping_sub(went_up)
}

#[cfg(test)]
mod tests {
    use super::to_byte_range;
    use proptest::prelude::*;

    #[test]
    fn exact_around_every_whole_and_half_number() {
        for half in 0..512u32 {
            let x = half as f32 * 0.5;
            for near in [x, x.next_up(), x.next_down().max(0.0)] {
                assert_eq!(to_byte_range(near), near as u32, "{near}");
            }
        }
        assert_eq!(to_byte_range(256f32.next_down()), 255);
    }

    proptest! {
        #[test]
        fn exact_everywhere(x in 0.0f32..256.0) {
            prop_assert_eq!(to_byte_range(x), x as u32);
        }
    }
}
