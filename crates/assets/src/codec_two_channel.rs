//! `codec_two_channel`: x and y in two channels, z = √(1 − x² − y²) put back (BC5, RG8). Tangent space only: z ≥ 0.
//!
//! Published form: the root as it stands. Fault: where x² + y² > 1, as in 22 % of all pairs of bytes, it is NaN. Hardened: the
//! root of max(0, …); the vector is (x, y, 0) there and up to √2 long.

use glam::{Vec2, Vec3};

/// Decodes as published: NaN in z for x² + y² > 1.
#[inline]
#[must_use]
pub fn decode_published(xy: Vec2) -> Vec3 {
    xy.extend((1.0 - xy.x * xy.x - xy.y * xy.y).sqrt())
}

/// Decodes, z being 0 where nothing is left for it.
#[inline]
#[must_use]
pub fn decode(xy: Vec2) -> Vec3 {
    xy.extend((1.0 - xy.x * xy.x - xy.y * xy.y).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codec_unorm;

    #[test]
    fn known_answers() {
        assert_eq!(decode(Vec2::ZERO), Vec3::Z);
        assert_eq!(decode(Vec2::X), Vec3::X);
        // 0.36 + 0.64 = 1 but for two roundings of 2⁻²⁵ under the root.
        assert!(decode(Vec2::new(0.6, 0.8)).z < 3e-4);
    }

    #[test]
    fn witness_published_is_not_a_number_for_a_fifth_of_all_bytes() {
        let pairs = (0..=255u8).flat_map(|r| (0..=255u8).map(move |g| [r, g]));
        let decoded = pairs.map(|rg| Vec2::from(rg.map(codec_unorm::decode)));
        let (mut broken, mut finite) = (0, 0);
        for xy in decoded {
            broken += u32::from(decode_published(xy).is_nan());
            finite += u32::from(decode(xy).is_finite());
        }
        assert_eq!(finite, 65536);
        // 1 − π/4 = 21.5 % but for the codes that the circle's line cuts: at most 8·127.5.
        assert!(broken.abs_diff(14064) < 1020, "{broken}");
    }
}
