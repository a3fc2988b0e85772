//! The sentinel: the bit pattern that outputs hold before a shader runs.
//!
//! An output that still holds it afterwards was never written. It is a quiet NaN with a payload of its own, so that
//! arithmetic that touches it is spoiled visibly, and so that it differs from the NaNs that hardware makes
//! (`0x7fc00000`, `0xffc00000`).
//!
//! Limit: a shader that copies an output cell which it never wrote, or an input that holds this very pattern, looks
//! unwritten. Inputs are ours, so they don't.

/// The pattern, as the bits of an `f32` (a quiet NaN with payload `0x05a5a5`).
pub const SENTINEL_BITS: u32 = 0x7fc5_a5a5;

/// The pattern as an `f32`. Compare by [`is_unwritten`], never by `==`: it is a NaN.
pub const SENTINEL: f32 = f32::from_bits(SENTINEL_BITS);

/// Whether this value is the sentinel, bit for bit.
#[must_use]
pub fn is_unwritten(value: f32) -> bool {
    value.to_bits() == SENTINEL_BITS
}

/// The indices of the values that still hold the sentinel: the outputs that nothing wrote.
#[must_use]
pub fn unwritten(values: &[f32]) -> Vec<usize> {
    let marked = values
        .iter()
        .enumerate()
        .filter(|(_, value)| is_unwritten(**value));
    marked.map(|(index, _)| index).collect()
}

/// `bytes` bytes of the repeated pattern (a last partial word is filled as far as it goes).
pub(crate) fn fill(bytes: usize) -> Vec<u8> {
    SENTINEL_BITS
        .to_le_bytes()
        .into_iter()
        .cycle()
        .take(bytes)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentinel_is_a_quiet_nan_unlike_the_default_one() {
        assert!(SENTINEL.is_nan());
        assert_ne!(SENTINEL_BITS & 0x0040_0000, 0, "the quiet bit is set");
        assert!(!is_unwritten(f32::NAN));
        assert!(!is_unwritten(f32::from_bits(0xffc0_0000)));
        assert!(is_unwritten(SENTINEL));
    }

    #[test]
    fn unwritten_names_exactly_the_marked_values() {
        assert_eq!(unwritten(&[0.0, SENTINEL, f32::NAN, SENTINEL]), [1, 3]);
        assert!(unwritten(&[]).is_empty());
    }

    #[test]
    fn fill_repeats_the_pattern_from_the_first_byte() {
        assert_eq!(fill(6), [0xa5, 0xa5, 0xc5, 0x7f, 0xa5, 0xa5]);
    }
}
