//! `codec_unorm`: what the texture unit does to colours; bytes 0 to 255 for −1 to 1.
//!
//! Published form: `c = 0.5·n + 0.5`, `n = 2·c − 1` on floats, the texture unit converting c to bytes and back
//! (round to nearest, c = byte/255). Fault: no byte decodes to 0 (128 gives 0.0039), so a flat map tilts by
//! atan(√2/255) = 0.318° along the diagonal; and bytes of `codec_biased` are off when read this way.
//!
//! Hardened form: the same code, with the input clamped and NaN answered; and [`decode_normal`], which gives back unit
//! vectors. The tilt is the code's own: only another code (`codec_biased`) cures it.

/// Half of the published form: a component to a colour in [0, 1].
#[inline]
#[must_use]
pub fn to_color(n: f32) -> f32 {
    0.5 * n + 0.5
}

/// The other half: a colour to a component.
#[inline]
#[must_use]
pub fn from_color(c: f32) -> f32 {
    2.0 * c - 1.0
}

/// Encodes as published: [`to_color`], then the conversion that a UNORM texture does on writing.
#[inline]
#[must_use]
pub fn encode_published(n: f32) -> u8 {
    (to_color(n) * 255.0 + 0.5) as u8
}

/// Decodes as published: the conversion that a UNORM texture does on reading, then [`from_color`].
#[inline]
#[must_use]
pub fn decode_published(byte: u8) -> f32 {
    from_color(f32::from(byte) / 255.0)
}

/// Encodes to the nearest byte: clamp to [−1, 1], multiply by 127.5, add 128, truncate. NaN becomes byte 128, the
/// nearest there is to 0.
#[inline]
#[must_use]
pub fn encode(n: f32) -> u8 {
    let n = if n.is_nan() { 0.0 } else { n.clamp(-1.0, 1.0) };
    (n * 127.5 + 128.0) as u8
}

/// Decodes one component. The same as published: there is nothing to cure in a component by itself.
#[inline]
#[must_use]
pub fn decode(byte: u8) -> f32 {
    decode_published(byte)
}

/// Decodes a normal and makes it a unit vector. Three bytes never give a zero vector, since no byte decodes to 0.
#[inline]
#[must_use]
pub fn decode_normal(bytes: [u8; 3]) -> glam::Vec3 {
    glam::Vec3::from(bytes.map(decode)).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Decoding rounds c (≤ 2⁻²⁵ relative to 1) doubled, then the difference (2⁻²⁵): under 2⁻²³ in all.
    const DECODING: f64 = 1.2e-7;

    #[test]
    fn witness_a_flat_map_tilts() {
        let flat = decode_normal([128, 128, 255]);
        let tilt = f64::from(flat.truncate().length())
            .atan2(f64::from(flat.z))
            .to_degrees();
        // Exact: atan(√2/255). f32 gives the components to 2⁻²³, which is 7e-6 degrees a component.
        let exact = (2f64.sqrt() / 255.0).atan().to_degrees();
        assert!((tilt - exact).abs() < 2e-5, "{tilt} against {exact}");
        assert!(tilt > 0.317, "the fault must stay visible");
    }

    #[test]
    fn witness_biased_bytes_read_as_unorm_are_off() {
        // The article bakes with the one and samples with the other: −1 comes back as −0.992.
        let byte = crate::codec_biased::encode_published(-1.0);
        assert!((f64::from(decode_published(byte)) + 253.0 / 255.0).abs() <= DECODING);
    }

    #[test]
    fn every_byte_survives_a_round_trip() {
        for byte in 0..=255u8 {
            assert_eq!(encode(decode(byte)), byte);
            assert_eq!(encode_published(decode_published(byte)), byte);
        }
    }

    #[test]
    fn the_ends_are_exact_and_beyond_saturates() {
        assert_eq!([-1.0, 1.0, -7.0, 7.0].map(encode), [0, 255, 0, 255]);
        assert_eq!(encode(f32::NAN), 128);
        assert_eq!((decode(0), decode(255)), (-1.0, 1.0));
    }

    #[test]
    fn no_three_bytes_give_a_zero_vector() {
        assert!((0..=255u8).all(|byte| decode(byte).abs() >= 0.0039));
    }

    proptest! {
        #[test]
        fn errors_stay_within_half_a_step(n in -1.0f32..=1.0) {
            // Sums below 256 rounded twice to 2⁻¹⁷, over 127.5 steps a unit; plus decoding.
            let bound = 1.0 / 255.0 + 2.0 * 2f64.powi(-17) / 127.5 + DECODING;
            for decoded in [decode(encode(n)), decode_published(encode_published(n))] {
                prop_assert!((f64::from(decoded) - f64::from(n)).abs() <= bound);
            }
        }

        #[test]
        fn decoded_normals_are_unit_vectors(bytes in any::<[u8; 3]>()) {
            // Sum of squares: 3 products and 2 sums (≤ 3·2⁻²⁴ relative after the root), root, division or product: 6 in all.
            let length = decode_normal(bytes).as_dvec3().length();
            prop_assert!((length - 1.0).abs() <= 6.0 * 2f64.powi(-24));
        }
    }
}
