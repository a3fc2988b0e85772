//! Textures and samplers: formats, mip levels, filtering, cube maps.
//!
//! Filtering is written once over bounds. A point domain passes bounds that coincide and gets the ideal result (exact weights,
//! rounded once); an interval domain gets what hardware may do: coordinates are known to 8 sub-texel bits
//! ([`SUBTEXEL`]), levels of detail to 4 bits ([`LOD_SLACK`], the least that Vulkan asks for), and the weighted sum is rounded a
//! few times, in the precision of the texels where those are bytes or 16-bit numbers. Anisotropic filtering is not modelled.

pub(crate) mod cube;
mod encode;
pub(crate) mod filter;
pub(crate) mod format;
pub(crate) mod loads;
pub(crate) mod lod;
pub(crate) mod request;

pub use format::TexelFormat;
pub(crate) use format::storage_kind;

use crate::error::{Error, Result};
use std::sync::{Arc, OnceLock};

/// Half the width, in texels, of the coordinates that hardware may take for one: 8 sub-texel bits, rounded or truncated.
pub const SUBTEXEL: f64 = 1.0 / 256.0;

/// How far a level of detail may be off: 4 bits of fraction.
pub const LOD_SLACK: f64 = 1.0 / 16.0;

/// The largest side of a texture.
pub const MAX_SIDE: u32 = 16384;

/// A pair of a least and a greatest number.
pub(crate) type Bounds = (f64, f64);

/// The shape of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// One row of texels.
    D1,
    /// Rows of texels; several layers make an array.
    D2,
    /// Slices of rows.
    D3,
    /// Six square layers for each cube, in the order +x, −x, +y, −y, +z, −z.
    Cube,
}

/// One mip level.
#[derive(Debug)]
pub(crate) struct Level {
    pub(crate) size: [u32; 3],
    bytes: Vec<u8>,
    bounds: OnceLock<[Bounds; 4]>,
}

impl Level {
    /// The texel with a number, of a texture of single floats.
    fn f32_at(&self, at: usize) -> f64 {
        let b = &self.bytes[4 * at..4 * at + 4];
        f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
    }
}

/// A texture with its mip levels.
#[derive(Clone, Debug)]
pub struct Texture {
    dimension: Dimension,
    format: TexelFormat,
    layers: u32,
    samples: u32,
    /// Shared, so that a clone of a texture costs nothing.
    levels: Vec<Arc<Level>>,
}

impl Texture {
    /// A texture of one level. `size` is width, height and depth (1 where the dimension has none), `layers` the number of array
    /// layers or cube faces; bytes are tightly packed: texels in rows, rows in slices, slices in layers.
    ///
    /// # Errors
    /// [`Error::Texture`] when sizes and bytes do not fit each other.
    pub fn new(
        dimension: Dimension,
        format: TexelFormat,
        size: [u32; 3],
        layers: u32,
        bytes: Vec<u8>,
    ) -> Result<Self> {
        let texture = Self {
            dimension,
            format,
            layers,
            samples: 1,
            levels: Vec::new(),
        };
        texture.check(size)?;
        texture.with_level_of(size, bytes)
    }

    /// A two-dimensional texture of one layer.
    ///
    /// # Errors
    /// As [`Texture::new`].
    pub fn d2(format: TexelFormat, width: u32, height: u32, bytes: Vec<u8>) -> Result<Self> {
        Self::new(Dimension::D2, format, [width, height, 1], 1, bytes)
    }

    /// A two-dimensional texture of `f32` channels.
    ///
    /// # Errors
    /// As [`Texture::new`], and when the number of channels is not 1, 2 or 4.
    pub fn d2_floats(width: u32, height: u32, channels: u32, texels: &[f32]) -> Result<Self> {
        let format = match channels {
            1 => TexelFormat::R32Float,
            2 => TexelFormat::Rg32Float,
            4 => TexelFormat::Rgba32Float,
            n => {
                return Err(Error::Texture {
                    reason: format!("{n} channels of floats; use 1, 2 or 4"),
                });
            }
        };
        Self::d2(
            format,
            width,
            height,
            texels.iter().flat_map(|x| x.to_le_bytes()).collect(),
        )
    }

    /// Adds the next mip level, which must be half the size of the last one, rounded down, but at least 1.
    ///
    /// # Errors
    /// [`Error::Texture`] when there is nothing left to halve or the bytes do not fit.
    pub fn with_level(self, bytes: Vec<u8>) -> Result<Self> {
        let last = self.size(self.levels.len() - 1);
        if last == [1, 1, 1] {
            return Err(Error::Texture {
                reason: "a mip level below 1 by 1".into(),
            });
        }
        let depth = if self.dimension == Dimension::D3 {
            (last[2] / 2).max(1)
        } else {
            last[2]
        };
        self.with_level_of([(last[0] / 2).max(1), (last[1] / 2).max(1), depth], bytes)
    }

    /// Makes it a multisampled texture: the bytes then hold `samples` images, one after the other, as layers.
    ///
    /// # Errors
    /// [`Error::Texture`] unless the texture has that many layers and one level.
    pub fn multisampled(mut self, samples: u32) -> Result<Self> {
        if self.layers != samples || self.levels.len() != 1 || samples == 0 {
            let reason = format!(
                "{samples} samples need {samples} layers and one level, not {} and {}",
                self.layers,
                self.levels.len()
            );
            return Err(Error::Texture { reason });
        }
        self.samples = samples;
        self.layers = 1;
        Ok(self)
    }

    fn check(&self, size: [u32; 3]) -> Result<()> {
        let bad = |reason: String| Err(Error::Texture { reason });
        if size.iter().any(|&n| n == 0 || n > MAX_SIDE) || self.layers == 0 || self.layers > MAX_SIDE {
            return bad(format!(
                "size {size:?} with {} layers; sides are 1 to {MAX_SIDE}",
                self.layers
            ));
        }
        match self.dimension {
            Dimension::D1 if size[1] != 1 || size[2] != 1 => {
                bad("a 1D texture has height and depth 1".into())
            }
            Dimension::D2 if size[2] != 1 => bad("a 2D texture has depth 1; layers are given apart".into()),
            Dimension::Cube if size[0] != size[1] || size[2] != 1 || !self.layers.is_multiple_of(6) => {
                bad("a cube has square faces and a multiple of six layers".into())
            }
            Dimension::D1 | Dimension::D2 | Dimension::D3 | Dimension::Cube => Ok(()),
        }
    }

    fn with_level_of(mut self, size: [u32; 3], bytes: Vec<u8>) -> Result<Self> {
        let texels = size.iter().map(|&n| n as usize).product::<usize>() * self.layers as usize;
        let needed = texels * self.format.bytes();
        if bytes.len() != needed {
            let reason = format!(
                "level {} of size {size:?} needs {needed} bytes, not {}",
                self.levels.len(),
                bytes.len()
            );
            return Err(Error::Texture { reason });
        }
        self.levels.push(Arc::new(Level {
            size,
            bytes,
            bounds: OnceLock::new(),
        }));
        Ok(self)
    }

    /// The texel format.
    pub fn format(&self) -> TexelFormat {
        self.format
    }

    /// The shape.
    pub fn dimension(&self) -> Dimension {
        self.dimension
    }

    /// Number of mip levels.
    pub fn levels(&self) -> usize {
        self.levels.len()
    }

    /// Width, height and depth of a level.
    pub fn size(&self, level: usize) -> [u32; 3] {
        self.levels[level].size
    }

    /// Array layers; of cubes, the six faces count as one.
    pub fn layers(&self) -> u32 {
        if self.dimension == Dimension::Cube {
            self.layers / 6
        } else {
            self.layers
        }
    }

    /// Samples of a texel.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// The channels of a texel that exists, missing ones filled by 0, 0, 0, 1.
    pub(crate) fn texel(&self, level: usize, [x, y, z]: [u32; 3], layer: u32) -> [f64; 4] {
        let level = &self.levels[level];
        let [w, h, d] = level.size.map(|n| n as usize);
        let at = ((layer as usize * d + z as usize) * h + y as usize) * w + x as usize;
        match self.format {
            // The formats of most textures, without the detour through channels.
            TexelFormat::R32Float => [level.f32_at(at), 0.0, 0.0, 1.0],
            TexelFormat::Rgba8Unorm => {
                let b = &level.bytes[4 * at..4 * at + 4];
                std::array::from_fn(|c| f64::from(b[c]) / 255.0)
            }
            other => other.decode(&level.bytes[at * other.bytes()..]),
        }
    }

    /// The least and greatest value of every channel in a level, with zero and one for texels outside.
    pub(crate) fn level_bounds(&self, level: usize) -> [Bounds; 4] {
        *self.levels[level].bounds.get_or_init(|| {
            let mut out = [(0.0f64, 1.0f64); 4];
            for texel in self.levels[level].bytes.chunks(self.format.bytes()) {
                for (bounds, x) in out.iter_mut().zip(self.format.decode(texel)) {
                    *bounds = (bounds.0.min(x), bounds.1.max(x));
                }
            }
            out
        })
    }
}

/// What a coordinate outside of the texture reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AddressMode {
    /// The nearest edge texel.
    ClampToEdge,
    /// The texture repeats.
    Repeat,
    /// The texture repeats, every other time mirrored.
    MirrorRepeat,
    /// The sampler's border colour.
    ClampToBorder,
}

/// How values between texels, or between levels, come about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// The nearest one.
    Nearest,
    /// Linear interpolation.
    Linear,
}

/// The comparison of a depth sampler: `reference OP texel`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "each name says it")]
pub enum CompareFunction {
    Never,
    Less,
    Equal,
    LessEqual,
    Greater,
    NotEqual,
    GreaterEqual,
    Always,
}

/// How a texture is sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampler {
    /// Address mode for u, v, w.
    pub address: [AddressMode; 3],
    /// Filter where a texel covers a pixel or more.
    pub mag: Filter,
    /// Filter where a pixel covers more than a texel.
    pub min: Filter,
    /// Filter between levels.
    pub mip: Filter,
    /// Least and greatest level of detail.
    pub lod: (f32, f32),
    /// Comparison, for depth samplers.
    pub compare: Option<CompareFunction>,
    /// What [`AddressMode::ClampToBorder`] reads.
    pub border: [f32; 4],
    /// Whether the filter is known to be the ideal one: exact weights, rounded once, as the evaluator's own is. Interval domains then allow
    /// nothing for sub-texel bits and for arithmetic in the texels' precision.
    pub ideal: bool,
}

impl Default for Sampler {
    fn default() -> Self {
        Self {
            address: [AddressMode::ClampToEdge; 3],
            mag: Filter::Nearest,
            min: Filter::Nearest,
            mip: Filter::Nearest,
            lod: (0.0, 32.0),
            compare: None,
            border: [0.0; 4],
            ideal: false,
        }
    }
}

impl Sampler {
    /// Linear filtering in all three places.
    pub fn linear(mode: AddressMode) -> Self {
        Self {
            address: [mode; 3],
            mag: Filter::Linear,
            min: Filter::Linear,
            mip: Filter::Linear,
            ..Self::default()
        }
    }

    /// Nearest texels.
    pub fn nearest(mode: AddressMode) -> Self {
        Self {
            address: [mode; 3],
            ..Self::default()
        }
    }

    /// The same with a comparison.
    pub fn comparing(self, function: CompareFunction) -> Self {
        Self {
            compare: Some(function),
            ..self
        }
    }
}
