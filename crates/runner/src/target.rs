//! Render targets as a job gives them: what a pixel is kept in, and what it holds before the first draw.
//!
//! A target of floats can be cleared to the [sentinel](crate::SENTINEL), and so tell which pixels a draw wrote. A target of
//! bytes can't: each of its values is a colour that a draw may write. Where coverage matters beside such a target, give the
//! job a float target as well, or read the depth.

use crate::error::Error;

/// What the pixels of a target are kept in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TargetFormat {
    /// Four floats: nothing is rounded.
    #[default]
    Rgba32Float,
    /// Four bytes, each clamped to [0, 1] and rounded to the nearest 1/255, after every draw.
    Rgba8Unorm,
    /// Four unsigned integers of 32 bits, for a shader's output of that kind. A [`Picture`](crate::Picture) has their bits.
    Rgba32Uint,
    /// Four signed ones.
    Rgba32Sint,
}

impl TargetFormat {
    /// Bytes a pixel.
    #[must_use]
    pub fn pixel_bytes(self) -> u32 {
        match self {
            Self::Rgba32Float | Self::Rgba32Uint | Self::Rgba32Sint => 16,
            Self::Rgba8Unorm => 4,
        }
    }

    /// What a pixel counts against the adapter's limit for all targets together, which is more than its bytes.
    pub(crate) fn pixel_cost(self) -> u64 {
        u64::from(self.wgpu().target_pixel_byte_cost().unwrap_or(self.pixel_bytes()))
    }

    pub(crate) fn wgpu(self) -> wgpu::TextureFormat {
        match self {
            Self::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
            Self::Rgba8Unorm => wgpu::TextureFormat::Rgba8Unorm,
            Self::Rgba32Uint => wgpu::TextureFormat::Rgba32Uint,
            Self::Rgba32Sint => wgpu::TextureFormat::Rgba32Sint,
        }
    }

    /// Whether its pixels are integers of 32 bits.
    #[must_use]
    pub fn is_integer(self) -> bool {
        match self {
            Self::Rgba32Uint | Self::Rgba32Sint => true,
            Self::Rgba32Float | Self::Rgba8Unorm => false,
        }
    }

    /// Pixels of the bytes that the device gives back.
    #[must_use]
    pub fn pixels(self, bytes: &[u8]) -> Vec<[f32; 4]> {
        let float = |word: &[u8; 4]| f32::from_le_bytes(*word);
        match self {
            Self::Rgba32Float | Self::Rgba32Uint | Self::Rgba32Sint => bytes
                .as_chunks::<4>()
                .0
                .as_chunks::<4>()
                .0
                .iter()
                .map(|pixel| pixel.each_ref().map(float))
                .collect(),
            Self::Rgba8Unorm => bytes
                .as_chunks::<4>()
                .0
                .iter()
                .map(|pixel| pixel.map(|code| f32::from(code) / 255.0))
                .collect(),
        }
    }
}

/// What a target holds before the first draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Clear {
    /// A colour.
    Colour([f32; 4]),
    /// The sentinel's bits in every component; for targets of floats and of integers.
    Sentinel,
}

/// A target of a job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderTarget {
    /// What a pixel is kept in.
    pub format: TargetFormat,
    /// What it holds first.
    pub clear: Clear,
}

impl RenderTarget {
    /// A target of floats.
    #[must_use]
    pub fn floats(clear: Clear) -> Self {
        Self {
            format: TargetFormat::Rgba32Float,
            clear,
        }
    }

    /// A target of integers that holds the sentinel's bits first.
    #[must_use]
    pub fn integers(signed: bool) -> Self {
        Self {
            format: if signed {
                TargetFormat::Rgba32Sint
            } else {
                TargetFormat::Rgba32Uint
            },
            clear: Clear::Sentinel,
        }
    }

    /// A target of bytes that holds a colour first, each component in [0, 1].
    #[must_use]
    pub fn bytes(colour: [f32; 4]) -> Self {
        Self {
            format: TargetFormat::Rgba8Unorm,
            clear: Clear::Colour(colour),
        }
    }

    /// Checks that the format can hold what the target is cleared to.
    ///
    /// # Errors
    /// [`Error::Target`] for a sentinel, or a colour outside of [0, 1], in a target of bytes, and for a colour in one of integers.
    pub fn validate(&self, job: &str, location: usize) -> Result<(), Error> {
        let problem = match (self.format, self.clear) {
            (TargetFormat::Rgba32Float, _)
            | (TargetFormat::Rgba32Uint | TargetFormat::Rgba32Sint, Clear::Sentinel) => return Ok(()),
            (TargetFormat::Rgba32Uint | TargetFormat::Rgba32Sint, Clear::Colour(_)) => {
                "integers hold no colour: clear it to the sentinel".to_owned()
            }
            (TargetFormat::Rgba8Unorm, Clear::Sentinel) => {
                "bytes can't hold the sentinel: clear it to a colour, and take coverage from a float target or the depth"
                    .to_owned()
            }
            (TargetFormat::Rgba8Unorm, Clear::Colour(colour)) => {
                if colour.iter().all(|value| (0.0..=1.0).contains(value)) {
                    return Ok(());
                }
                format!("bytes hold 0 to 1, it is cleared to {colour:?}")
            }
        };
        Err(Error::Target {
            job: job.to_owned(),
            location,
            problem,
        })
    }
}

/// How a draw's colour meets what the target holds. Alpha goes the same way as the colours.
///
/// The sum or product is rounded to the target's format. Whether the draw's own colour is rounded to it first is up to the
/// adapter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Blend {
    /// It replaces it.
    #[default]
    Replace,
    /// It is added.
    Add,
    /// It is multiplied.
    Multiply,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_become_the_floats_that_a_texture_read_would_give() {
        let pixels = TargetFormat::Rgba8Unorm.pixels(&[0, 255, 51, 128]);
        assert_eq!(pixels, [[0.0, 1.0, 0.2, 128.0 / 255.0]]);
        let floats: Vec<u8> = [1.0_f32, -2.0, 0.5, 4.0]
            .iter()
            .flat_map(|value| value.to_le_bytes())
            .collect();
        assert_eq!(TargetFormat::Rgba32Float.pixels(&floats), [[1.0, -2.0, 0.5, 4.0]]);
    }

    #[test]
    fn what_bytes_cannot_hold_is_refused() {
        let colour = |value| RenderTarget::bytes([0.0, 1.0, value, 0.5]).validate("job", 3);
        assert!(colour(0.25).is_ok());
        for value in [-0.1, 1.01, f32::NAN, f32::INFINITY] {
            let error = colour(value).unwrap_err().to_string();
            assert!(error.starts_with("`job`: target 3: bytes hold 0 to 1"), "{error}");
        }
        let sentinel = RenderTarget {
            clear: Clear::Sentinel,
            ..RenderTarget::bytes([0.0; 4])
        };
        assert!(sentinel.validate("job", 0).is_err());
        assert!(RenderTarget::floats(Clear::Sentinel).validate("job", 0).is_ok());
        assert!(RenderTarget::integers(true).validate("job", 0).is_ok());
        let coloured = RenderTarget {
            clear: Clear::Colour([0.0; 4]),
            ..RenderTarget::integers(false)
        };
        assert!(coloured.validate("job", 0).is_err());
        assert!(
            RenderTarget::floats(Clear::Colour([f32::NAN; 4]))
                .validate("job", 0)
                .is_ok()
        );
    }
}
