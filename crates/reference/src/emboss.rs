//! `emboss`: the slope of a height map toward the light, h(uv) − h(uv + k·L_t.xy), added to the diffuse term.
//!
//! Source: named by the first and third articles as the older form of bump mapping (no formula printed there); the formula
//! is the usual one (Schlag, *Fast Embossing Effects on Raster Image Data*, Graphics Gems IV, 1994), lit from L in tangent
//! space. Where the surface falls toward the light the difference is positive: it faces the light.
//!
//! Space: L in tangent space, from the surface toward the light; k in UV units, usually one texel. Heights in [0, 1].
//!
//! Limits: the difference estimates a slope, not a cosine: it does not know how steep the light is but through L_t.xy, and
//! lights the dark side of the polygon as much as the bright one; hence the light below the polygon (L_t.z ≤ 0) is the
//! caller's to exclude.

use glam::{DVec2, DVec3};

use crate::vector::saturate;

/// Where the second height is read.
#[must_use]
pub fn shifted_uv(uv: DVec2, light_ts: DVec3, step: f64) -> DVec2 {
    uv + step * light_ts.truncate()
}

/// The term, from the two heights.
#[must_use]
pub fn difference(height: f64, height_toward_light: f64) -> f64 {
    height - height_toward_light
}

/// The diffuse term with the difference added, in [0, 1].
#[must_use]
pub fn lit(diffuse: f64, height: f64, height_toward_light: f64) -> f64 {
    saturate(diffuse + difference(height, height_toward_light))
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3, DVec4};

    use super::{difference, lit, shifted_uv};
    use crate::texture::Texture;
    use bossage_assets::EdgeMode;

    /// A ridge: height rises to the middle of the tile and falls again.
    fn ridge() -> Texture {
        let heights = [0.0, 0.25, 0.5, 0.75, 0.75, 0.5, 0.25, 0.0];
        Texture {
            width: 8,
            height: 1,
            texels: heights.map(|h| DVec4::new(h, 0.0, 0.0, 1.0)).to_vec(),
        }
    }

    fn at(u: f64, light_ts: DVec3) -> f64 {
        let height = |uv| ridge().sample(EdgeMode::Clamp, uv).x;
        let uv = DVec2::new(u, 0.5);
        difference(height(uv), height(shifted_uv(uv, light_ts, 1.0 / 8.0)))
    }

    #[test]
    fn the_flank_toward_the_light_is_bright_and_the_other_dark() {
        // Light from +u, one texel's step: the right flank falls toward it by 1/4 a texel.
        let light = DVec3::new(1.0, 0.0, 0.0);
        assert_eq!([at(2.5 / 8.0, light), at(5.5 / 8.0, light)], [-0.25, 0.25]);
        assert_eq!([at(2.5 / 8.0, -light), at(5.5 / 8.0, -light)], [0.25, -0.25]);
    }

    #[test]
    fn light_from_straight_above_embosses_nothing() {
        assert_eq!(at(2.5 / 8.0, DVec3::Z), 0.0);
    }

    #[test]
    fn the_sum_stays_a_colour() {
        assert_eq!(
            [lit(0.5, 0.75, 0.5), lit(0.9, 1.0, 0.0), lit(0.1, 0.0, 1.0)],
            [0.75, 1.0, 0.0]
        );
    }
}
