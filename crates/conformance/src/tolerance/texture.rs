//! The bound of a filtered texture read.
//!
//! A bilinear sampler is allowed three liberties here, besides the error that the coordinate carries:
//!
//! 1. the weights keep [`SUBTEXEL_BITS`](super::SUBTEXEL_BITS) bits: the sample may lie 2⁻⁸ texel away on each axis;
//! 2. an 8-bit texture may be filtered in 8-bit arithmetic: each of the two passes (along u, along v) may be off by one step of
//!    1/255;
//! 3. a float texture is filtered in f32: the two passes are three products and sums each, 6 ULP of the largest texel.
//!
//! The interval is the exact range of the bilinear surface over the square in which the sample may lie: the surface is
//! bilinear in each cell, so its extremes lie at the corners of the pieces into which the texel lines cut the square.

use bossage_assets::EdgeMode;
use bossage_reference::texture::Texture;
use glam::{DVec2, DVec4};

use crate::bounded::Bounded;

/// How a texture's texels are stored, which decides how it may be filtered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Storage {
    /// Four bytes.
    Unorm8,
    /// f32.
    Float32,
}

/// A sample may be this many texels off before nothing can be said: the square then covers too many cells to be a bound.
const MAX_RADIUS_TEXELS: f64 = 4.0;

/// The four channels of a filtered read at a bounded coordinate.
pub(crate) fn sample(texture: &Texture, storage: Storage, edge: EdgeMode, uv: &[Bounded; 2]) -> [Bounded; 4] {
    let size = DVec2::new(f64::from(texture.width), f64::from(texture.height));
    let value = DVec2::new(uv[0].value, uv[1].value);
    // uv · size − ½ is computed in f32 by the sampler: two more roundings at the size of the coordinate in texels.
    let rounding = (value * size).abs().max(DVec2::ONE) * 2.0 * f64::from(f32::EPSILON);
    let weight = 2f64.powi(-super::SUBTEXEL_BITS);
    let radius = DVec2::new(uv[0].error, uv[1].error) * size + rounding + weight;
    if !value.is_finite() || radius.is_nan() || radius.max_element() > MAX_RADIUS_TEXELS {
        return [Bounded::OPEN; 4];
    }
    let centre = value * size - 0.5;
    let (low, high) = range(texture, edge, centre - radius, centre + radius);
    let nominal = texture.sample(edge, value).to_array();
    let (low, high) = (low.to_array(), high.to_array());
    std::array::from_fn(|i| {
        let slack = match storage {
            Storage::Unorm8 => 2.0 / 255.0,
            Storage::Float32 => 6.0 * f64::from(f32::EPSILON) * low[i].abs().max(high[i].abs()),
        };
        // A constant neighbourhood is returned as it is by any filter whose weights sum to 1; 8-bit arithmetic keeps that.
        let slack = if low[i] == high[i] && storage == Storage::Unorm8 {
            2.0 * f64::from(f32::EPSILON)
        } else {
            slack
        };
        Bounded::between(nominal[i], low[i] - slack, high[i] + slack).marked(uv)
    })
}

/// The least and the greatest value of each channel over a rectangle of texel coordinates.
fn range(texture: &Texture, edge: EdgeMode, low: DVec2, high: DVec2) -> (DVec4, DVec4) {
    let (xs, ys) = (stations(low.x, high.x), stations(low.y, high.y));
    let size = DVec2::new(f64::from(texture.width), f64::from(texture.height));
    let mut range = (DVec4::INFINITY, DVec4::NEG_INFINITY);
    for &y in &ys {
        for &x in &xs {
            let texel = texture.sample(edge, (DVec2::new(x, y) + 0.5) / size);
            range = (range.0.min(texel), range.1.max(texel));
        }
    }
    range
}

/// The ends of a stretch and the whole numbers between them.
fn stations(low: f64, high: f64) -> Vec<f64> {
    let first = low.floor() as i64 + 1;
    let lines = (first..).map(|line| line as f64).take_while(|line| *line < high);
    [low, high].into_iter().chain(lines).collect()
}

#[cfg(test)]
mod tests {
    use bossage_assets::EdgeMode;
    use bossage_reference::texture::Texture;
    use glam::DVec2;

    use super::{Storage, sample};
    use crate::bounded::Bounded;

    fn noise() -> Texture {
        let values: Vec<f32> = (0..64u32)
            .map(|i| (i.wrapping_mul(2_654_435_761) >> 16 & 255) as f32 / 255.0)
            .collect();
        Texture::from_r32float(8, 8, &values)
    }

    #[test]
    fn every_sample_in_the_square_lies_in_the_interval() {
        let texture = noise();
        for i in 0..200 {
            let uv = DVec2::new(0.013 * f64::from(i), 1.0 - 0.027 * f64::from(i));
            let error = 0.2 / 8.0;
            let bound = sample(
                &texture,
                Storage::Float32,
                EdgeMode::Mirror,
                &[Bounded::within(uv.x, error), Bounded::within(uv.y, error)],
            );
            for (dx, dy) in [(-1.0, -1.0), (1.0, -1.0), (0.3, 0.9), (0.0, 0.0), (-0.5, 1.0)] {
                let near = texture
                    .sample(EdgeMode::Mirror, uv + error * DVec2::new(dx, dy))
                    .x;
                assert!(
                    bound[0].contains(near),
                    "{uv} {dx} {dy}: {near} not in {:?}",
                    bound[0]
                );
            }
        }
    }

    #[test]
    fn a_constant_texture_stays_constant() {
        let white = Texture::from_rgba8(1, 1, &[255, 128, 0, 255]);
        let bound = sample(
            &white,
            Storage::Unorm8,
            EdgeMode::Wrap,
            &[Bounded::input(3.7), Bounded::input(-2.0)],
        );
        assert!(bound[1].error < 1e-6 && (bound[1].value - 128.0 / 255.0).abs() < 1e-12);
    }

    #[test]
    fn the_wrong_texel_is_outside() {
        let texture = Texture::from_rgba8(2, 1, &[0, 0, 0, 255, 255, 255, 255, 255]);
        let bound = sample(
            &texture,
            Storage::Unorm8,
            EdgeMode::Clamp,
            &[Bounded::input(0.25), Bounded::input(0.5)],
        );
        assert!(bound[0].contains(0.004) && !bound[0].contains(0.02));
    }

    #[test]
    fn a_coordinate_that_is_not_known_leaves_it_open() {
        let bound = sample(
            &noise(),
            Storage::Float32,
            EdgeMode::Wrap,
            &[Bounded::OPEN, Bounded::input(0.5)],
        );
        assert!(bound.iter().all(|channel| !channel.is_decided()));
    }
}
