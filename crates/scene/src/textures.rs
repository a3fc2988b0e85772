//! Textures as draws carry them: decoded, with their mip chain, independent of any graphics API.
//!
//! Conventions: albedo in linear light with alpha in w; normal maps as the bytes of their file, decoded by a uniform; heights
//! in one float channel. Level 0 is the file itself; a consumer that models one level takes the first.

use bossage_assets::{ColorMap, HeightField, NormalMap, mips};

/// Texels of one level, row by row from v = 0.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// Four bytes, each read as byte/255.
    Rgba8Unorm(Vec<[u8; 4]>),
    /// Four floats.
    Rgba32Float(Vec<[f32; 4]>),
    /// One float.
    R32Float(Vec<f32>),
}

impl Texels {
    /// How many texels.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Rgba8Unorm(texels) => texels.len(),
            Self::Rgba32Float(texels) => texels.len(),
            Self::R32Float(texels) => texels.len(),
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// One mip level.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` of them.
    pub texels: Texels,
}

/// A texture: levels from the largest on, each half the size of the last, down to 1×1.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// At least one; all of one texel format.
    pub levels: Vec<Level>,
}

impl Texture {
    /// One texel of floats.
    #[must_use]
    pub fn constant(rgba: [f32; 4]) -> Self {
        Self {
            levels: vec![Level {
                width: 1,
                height: 1,
                texels: Texels::Rgba32Float(vec![rgba]),
            }],
        }
    }

    /// One height.
    #[must_use]
    pub fn constant_height(height: f32) -> Self {
        Self {
            levels: vec![Level {
                width: 1,
                height: 1,
                texels: Texels::R32Float(vec![height]),
            }],
        }
    }

    /// One texel of bytes.
    #[must_use]
    pub fn constant_bytes(rgba: [u8; 4]) -> Self {
        Self {
            levels: vec![Level {
                width: 1,
                height: 1,
                texels: Texels::Rgba8Unorm(vec![rgba]),
            }],
        }
    }

    pub(crate) fn color(map: &ColorMap) -> Self {
        let level = |map: &ColorMap| Level {
            width: map.width,
            height: map.height,
            texels: Texels::Rgba32Float(map.to_linear()),
        };
        Self {
            levels: mips::color_chain(map).iter().map(level).collect(),
        }
    }

    pub(crate) fn normal(map: &NormalMap) -> Self {
        let level = |map: NormalMap| Level {
            width: map.width,
            height: map.height,
            texels: Texels::Rgba8Unorm(map.texels),
        };
        Self {
            levels: mips::normal_chain(map, mips::NormalMips::default())
                .into_iter()
                .map(level)
                .collect(),
        }
    }

    pub(crate) fn height(field: &HeightField) -> Self {
        let level = |field: HeightField| Level {
            width: field.width,
            height: field.height,
            texels: Texels::R32Float(field.texels),
        };
        Self {
            levels: mips::height_chain(field).into_iter().map(level).collect(),
        }
    }
}
