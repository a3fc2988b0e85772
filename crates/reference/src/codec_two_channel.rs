//! `codec_two_channel`: x and y of a unit normal in two channels, z = √(1 − x² − y²) put back on reading (BC5, RG8).
//!
//! Source: the usual way to keep tangent-space normals in two channels; z ≥ 0, so it serves tangent space only.
//! Range: x and y in [−1, 1], as the texture's own code (`codec_snorm`, `codec_unorm`) decodes them.
//!
//! Known fault of the published form: two channels can hold x² + y² > 1 (quantised, filtered or compressed texels do), where
//! the root is NaN: 22 % of all RG8 codes. Hardened: the root of a negative number is 0. The vector then is (x, y, 0), up to
//! √2 long: normalise before use, as after any filtering.

use glam::{DVec2, DVec3};

/// The two channels of a unit normal: x and y as they are.
#[must_use]
pub fn encode(normal: DVec3) -> DVec2 {
    normal.truncate()
}

/// As published: NaN in z for x² + y² > 1.
#[must_use]
pub fn decode_published(xy: DVec2) -> DVec3 {
    xy.extend((1.0 - xy.x * xy.x - xy.y * xy.y).sqrt())
}

/// Hardened: z = √max(0, 1 − x² − y²).
#[must_use]
pub fn decode_hardened(xy: DVec2) -> DVec3 {
    xy.extend((1.0 - xy.x * xy.x - xy.y * xy.y).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::{decode_hardened, decode_published, encode};
    use crate::{codec_snorm, codec_unorm};

    #[test]
    fn unit_normals_come_back() {
        for n in crate::sphere::fibonacci(1000).filter(|n| n.z > 0.0) {
            // z² is off by 4 roundings of at most 1: z by that over 2z, and z ≥ 1/1000 in this set.
            assert!((decode_published(encode(n)) - n).length() < 4.0 * 2f64.powi(-53) / (2.0 * n.z) + 1e-15);
            assert_eq!(decode_published(encode(n)), decode_hardened(encode(n)));
        }
        assert_eq!(decode_hardened(DVec2::X), DVec3::X);
    }

    /// How many of the 65536 pairs of codes make the published form fail.
    fn broken(decode: impl Fn(u8) -> f64) -> usize {
        let value: Vec<f64> = (0..=255).map(decode).collect();
        let pairs = value
            .iter()
            .flat_map(|&x| value.iter().map(move |&y| DVec2::new(x, y)));
        pairs.filter(|&xy| decode_published(xy).is_nan()).count()
    }

    #[test]
    fn witness_a_fifth_of_all_codes_is_not_a_number() {
        // The corners outside of the circle, 1 − π/4 = 21.46 % of the square, but for the codes whose cells the circle cuts: at
        // most 8·127.5 of 65536. The signed format has two codes for −1, so up to 2·256 pairs more.
        let corners = 1.0 - std::f64::consts::FRAC_PI_4;
        let cut = 8.0 * 127.5 / 65536.0;
        let unorm = broken(codec_unorm::decode_byte) as f64 / 65536.0;
        let signed = |byte: u8| codec_snorm::decode(i32::from(byte as i8), codec_snorm::Bits::Eight);
        let snorm = broken(signed) as f64 / 65536.0;
        assert!((unorm - corners).abs() < cut, "{unorm}");
        assert!((snorm - corners).abs() < cut + 512.0 / 65536.0, "{snorm}");
    }

    #[test]
    fn hardened_is_finite_for_all_codes_and_at_most_root_two_long() {
        let codes = (0..=255u8).flat_map(|r| (0..=255u8).map(move |g| [r, g]));
        for [r, g] in codes {
            let n = decode_hardened(DVec2::new(
                codec_unorm::decode_byte(r),
                codec_unorm::decode_byte(g),
            ));
            assert!(n.is_finite() && n.length() <= 2f64.sqrt() + 1e-15);
        }
    }
}
