//! Targets and the depth buffer.

use bossage_bounds::{F32, Scalar};
use bossage_runner::{Blend, Clear, Depth, Picture, RenderTarget, SENTINEL_BITS, TargetFormat};

/// A target with its pixels.
#[derive(Debug)]
pub(crate) struct Surface {
    format: TargetFormat,
    pixels: Vec<[f32; 4]>,
}

impl Surface {
    /// A target of so many pixels, cleared.
    pub(crate) fn new(target: &RenderTarget, pixels: usize) -> Self {
        let colour = match target.clear {
            Clear::Colour(colour) => colour.map(|value| stored(target.format, f64::from(value))),
            Clear::Sentinel => [f32::from_bits(SENTINEL_BITS); 4],
        };
        Self {
            format: target.format,
            pixels: vec![colour; pixels],
        }
    }

    /// A draw's colour meets a pixel; integers replace it, whatever the blending.
    pub(crate) fn write(&mut self, at: usize, colour: [Scalar<F32>; 4], blend: Blend) {
        let Some(pixel) = self.pixels.get_mut(at) else {
            return;
        };
        for (kept, new) in pixel.iter_mut().zip(colour) {
            if self.format.is_integer() {
                // The low 32 bits are those of a signed and of an unsigned integer alike.
                *kept = f32::from_bits(new.int().unwrap_or_default() as u32);
                continue;
            }
            let new = new.float().unwrap_or(f64::NAN);
            *kept = stored(self.format, blended(self.format, f64::from(*kept), new, blend));
        }
    }

    /// The pixels as a job gives them back.
    pub(crate) fn picture(self, width: u32, height: u32) -> Picture {
        Picture {
            width,
            height,
            format: self.format,
            pixels: self.pixels,
        }
    }
}

/// In f64: exact for a product, and for a sum so close that it is rounded like the exact one.
fn blended(format: TargetFormat, kept: f64, new: f64, blend: Blend) -> f64 {
    // Bytes clamp a colour before it is blended.
    let new = match (format, blend) {
        (TargetFormat::Rgba8Unorm, Blend::Add | Blend::Multiply) => unit(new),
        (TargetFormat::Rgba8Unorm, Blend::Replace)
        | (TargetFormat::Rgba32Float | TargetFormat::Rgba32Uint | TargetFormat::Rgba32Sint, _) => new,
    };
    match blend {
        Blend::Replace => new,
        Blend::Add => kept + new,
        Blend::Multiply => kept * new,
    }
}

/// Clamped to [0, 1]; what is no number is 0.
fn unit(value: f64) -> f64 {
    if value.is_nan() {
        0.0
    } else {
        value.clamp(0.0, 1.0)
    }
}

/// A value as the format keeps it.
fn stored(format: TargetFormat, value: f64) -> f32 {
    match format {
        TargetFormat::Rgba32Float | TargetFormat::Rgba32Uint | TargetFormat::Rgba32Sint => value as f32,
        TargetFormat::Rgba8Unorm => ((unit(value) * 255.0).round() as f32) / 255.0,
    }
}

/// Whether a fragment passes against what the depth buffer holds.
pub(crate) fn passes(depth: Depth, fragment: f32, kept: f32) -> bool {
    match depth {
        Depth::TestAndWrite => fragment < kept,
        Depth::TestOnly => fragment <= kept,
        Depth::Equal => fragment == kept,
        Depth::Ignore => true,
    }
}

/// Whether a fragment that passes is written.
pub(crate) fn writes(depth: Depth) -> bool {
    match depth {
        Depth::TestAndWrite => true,
        Depth::TestOnly | Depth::Equal | Depth::Ignore => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(target: &RenderTarget, writes: &[([f64; 4], Blend)]) -> [f32; 4] {
        let mut surface = Surface::new(target, 1);
        for (colour, blend) in writes {
            surface.write(0, colour.map(Scalar::Float), *blend);
        }
        surface.pixels[0]
    }

    #[test]
    fn bytes_are_clamped_and_rounded_after_every_draw() {
        let target = RenderTarget::bytes([1.0, 0.5, 0.0, 1.0]);
        let code = |value: f32| (value * 255.0).round();
        let replaced = after(&target, &[([1.5, -0.5, f64::NAN, 0.1], Blend::Replace)]);
        assert_eq!(replaced.map(code), [255.0, 0.0, 0.0, 26.0]);
        let multiplied = after(&target, &[([0.5, 0.5, 2.0, 3.0], Blend::Multiply)]);
        assert_eq!(multiplied.map(code), [128.0, 64.0, 0.0, 255.0]);
        let added = after(&target, &[([0.5, 0.25, 0.25, 0.0], Blend::Add)]);
        assert_eq!(added.map(code), [255.0, 192.0, 64.0, 255.0]);
    }

    #[test]
    fn floats_are_kept_as_they_are() {
        let target = RenderTarget::floats(Clear::Colour([2.0, -1.0, 0.5, 1e30]));
        let multiplied = after(&target, &[([3.0, 3.0, -0.5, 1e30], Blend::Multiply)]);
        assert_eq!(multiplied, [6.0, -3.0, -0.25, f32::INFINITY]);
        let added = after(&target, &[([0.1_f32, 1.0, 0.0, 0.0].map(f64::from), Blend::Add)]);
        assert_eq!(added, [2.0 + 0.1_f32, 0.0, 0.5, 1e30]);
    }

    #[test]
    fn integers_are_kept_to_the_bit() {
        let mut surface = Surface::new(&RenderTarget::integers(true), 1);
        surface.write(
            0,
            [-1, 5, i128::from(i32::MIN), 0].map(|n| Scalar::Int(n, n)),
            Blend::Replace,
        );
        let bits = surface.pixels[0].map(f32::to_bits);
        assert_eq!(bits, [u32::MAX, 5, 1 << 31, 0]);
    }

    #[test]
    fn what_nothing_wrote_holds_the_sentinel_to_the_bit() {
        let surface = Surface::new(&RenderTarget::floats(Clear::Sentinel), 3);
        let picture = surface.picture(3, 1);
        assert!(picture.covered().iter().all(|covered| !covered));
    }

    #[test]
    fn depth_tests_differ_where_depths_are_equal() {
        let of = |depth| [0.25, 0.5, 0.75].map(|fragment| passes(depth, fragment, 0.5));
        assert_eq!(of(Depth::TestAndWrite), [true, false, false]);
        assert_eq!(of(Depth::TestOnly), [true, true, false]);
        assert_eq!(of(Depth::Equal), [false, true, false]);
        assert_eq!(of(Depth::Ignore), [true, true, true]);
    }
}
