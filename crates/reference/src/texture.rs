//! Bilinear filtering in float64 on decoded texels, one mip level.
//!
//! Source: the texture filtering equations of the graphics interfaces: a uv is scaled by the size, half a texel is taken
//! off, and the four texels around it are weighted by the fractional part. Real samplers keep 8 bits of that fraction; this
//! module keeps all of it, so a comparison has to allow for the difference.

use bossage_assets::EdgeMode;
use glam::{DVec2, DVec4};

/// Decoded texels, row-major, row 0 at v = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` texels as the sampler returns them: bytes divided by 255, nothing else.
    pub texels: Vec<DVec4>,
}

/// The four texels around a uv and where it lies between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// Texels at (i, j), (i+1, j), (i, j+1), (i+1, j+1).
    pub texels: [DVec4; 4],
    /// The fractional position, each in [0, 1).
    pub fraction: DVec2,
}

impl Footprint {
    /// The bilinear interpolant.
    #[must_use]
    pub fn blend(&self) -> DVec4 {
        let [t00, t10, t01, t11] = self.texels;
        let (near, far) = (t00.lerp(t10, self.fraction.x), t01.lerp(t11, self.fraction.x));
        near.lerp(far, self.fraction.y)
    }
}

impl Texture {
    /// From four bytes a texel (unsigned normalised).
    #[must_use]
    pub fn from_rgba8(width: u32, height: u32, bytes: &[u8]) -> Self {
        let decode =
            |t: &[u8]| DVec4::from_array([t[0], t[1], t[2], t[3]].map(|byte| f64::from(byte) / 255.0));
        Self {
            width,
            height,
            texels: bytes.chunks_exact(4).map(decode).collect(),
        }
    }

    /// From one float a texel, in red; green and blue are 0, alpha 1.
    #[must_use]
    pub fn from_r32float(width: u32, height: u32, values: &[f32]) -> Self {
        let decode = |&value: &f32| DVec4::new(f64::from(value), 0.0, 0.0, 1.0);
        Self {
            width,
            height,
            texels: values.iter().map(decode).collect(),
        }
    }

    /// The texel at an index that may lie outside, by the edge mode.
    #[must_use]
    pub fn texel(&self, edge: EdgeMode, x: i64, y: i64) -> DVec4 {
        let (x, y) = (edge.resolve(x, self.width), edge.resolve(y, self.height));
        self.texels[y as usize * self.width as usize + x as usize]
    }

    /// The four texels around a uv.
    #[must_use]
    pub fn footprint(&self, edge: EdgeMode, uv: DVec2) -> Footprint {
        let p = uv * DVec2::new(f64::from(self.width), f64::from(self.height)) - 0.5;
        let cell = p.floor();
        let (i, j) = (cell.x as i64, cell.y as i64);
        let texels = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| self.texel(edge, i + dx, j + dy));
        Footprint {
            texels,
            fraction: p - cell,
        }
    }

    /// The filtered texel at a uv.
    #[must_use]
    pub fn sample(&self, edge: EdgeMode, uv: DVec2) -> DVec4 {
        self.footprint(edge, uv).blend()
    }
}

#[cfg(test)]
mod tests {
    use bossage_assets::EdgeMode;
    use glam::{DVec2, DVec4};

    use super::Texture;

    fn checker() -> Texture {
        Texture::from_rgba8(
            2,
            2,
            &[0, 0, 0, 255, 255, 0, 0, 255, 0, 255, 0, 255, 255, 255, 255, 255],
        )
    }

    #[test]
    fn texel_centres_return_the_texel() {
        assert_eq!(
            checker().sample(EdgeMode::Wrap, DVec2::new(0.75, 0.25)),
            DVec4::new(1.0, 0.0, 0.0, 1.0)
        );
    }

    #[test]
    fn the_middle_is_the_mean() {
        assert_eq!(
            checker().sample(EdgeMode::Clamp, DVec2::splat(0.5)),
            DVec4::new(0.5, 0.5, 0.25, 1.0)
        );
    }

    #[test]
    fn edges_follow_the_mode() {
        let corner = |edge| checker().sample(edge, DVec2::ZERO).x;
        assert_eq!(
            [EdgeMode::Wrap, EdgeMode::Mirror, EdgeMode::Clamp].map(corner),
            [0.5, 0.0, 0.0]
        );
    }
}
