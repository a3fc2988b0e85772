//! Textures as draws carry them: decoded, with their mip chain, independent of any graphics API.
//!
//! Conventions: albedo in linear light with alpha in w; normal maps as the bytes of their file, decoded by a uniform; heights
//! in one float channel; environments in linear light; normalisation cube maps as the integers of their depth. Level 0 is the
//! file itself; a consumer that models one level takes the first. Cubes have one level.

use bossage_assets::{
    ColorMap, CubeMap, HeightField, NormalMap, NormalisationCubeMap, Texels as Stored, mips,
};

/// How a texture's texels lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextureShape {
    /// One picture.
    #[default]
    Plane,
    /// Six square faces: +X, −X, +Y, −Y, +Z, −Z.
    Cube,
}

/// Texels of one level, row by row from v = 0; of a cube face by face.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// Four bytes, each read as byte/255.
    Rgba8Unorm(Vec<[u8; 4]>),
    /// Four 16-bit integers, each read as integer/65535.
    Rgba16Unorm(Vec<[u16; 4]>),
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
            Self::Rgba16Unorm(texels) => texels.len(),
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
    /// `width * height` of them, six times as many in a cube.
    pub texels: Texels,
}

/// A texture: levels from the largest on, each half the size of the last, down to 1×1.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Plane or cube.
    pub shape: TextureShape,
    /// At least one; all of one texel format.
    pub levels: Vec<Level>,
}

impl Texture {
    /// One texel of floats.
    #[must_use]
    pub fn constant(rgba: [f32; 4]) -> Self {
        Self::single(1, Texels::Rgba32Float(vec![rgba]))
    }

    /// One height.
    #[must_use]
    pub fn constant_height(height: f32) -> Self {
        Self::single(1, Texels::R32Float(vec![height]))
    }

    /// One texel of bytes.
    #[must_use]
    pub fn constant_bytes(rgba: [u8; 4]) -> Self {
        Self::single(1, Texels::Rgba8Unorm(vec![rgba]))
    }

    /// A surrounding that is one colour in linear light.
    #[must_use]
    pub fn constant_environment(rgba: [f32; 4]) -> Self {
        Self::cube(1, Texels::Rgba32Float(vec![rgba; 6]))
    }

    /// A surrounding, in linear light.
    #[must_use]
    pub fn environment(map: &CubeMap) -> Self {
        let texels = map.faces.iter().flat_map(ColorMap::to_linear);
        Self::cube(map.size, Texels::Rgba32Float(texels.collect()))
    }

    /// A normalisation cube map, as it is stored.
    #[must_use]
    pub fn normalisation(map: &NormalisationCubeMap) -> Self {
        let (mut eight, mut sixteen, mut floats) = (Vec::new(), Vec::new(), Vec::new());
        // All six are of one depth.
        for face in &map.faces {
            match face {
                Stored::Unorm8(samples) => eight.extend_from_slice(samples.as_chunks::<4>().0),
                Stored::Unorm16(samples) => sixteen.extend_from_slice(samples.as_chunks::<4>().0),
                Stored::Float32(samples) => floats.extend_from_slice(samples.as_chunks::<4>().0),
            }
        }
        let texels = if !eight.is_empty() {
            Texels::Rgba8Unorm(eight)
        } else if !sixteen.is_empty() {
            Texels::Rgba16Unorm(sixteen)
        } else {
            Texels::Rgba32Float(floats)
        };
        Self::cube(map.size, texels)
    }

    /// The normalisation cube map of one texel a face, in bytes: where nothing asks for one.
    pub(crate) fn smallest_normalisation() -> Self {
        let axis = |at: usize, code: u8| {
            let mut texel = [128, 128, 128, 255];
            texel[at] = code;
            texel
        };
        let faces = (0..3).flat_map(|at| [axis(at, 255), axis(at, 0)]);
        Self::cube(1, Texels::Rgba8Unorm(faces.collect()))
    }

    fn single(side: u32, texels: Texels) -> Self {
        Self {
            shape: TextureShape::Plane,
            levels: vec![Level {
                width: side,
                height: side,
                texels,
            }],
        }
    }

    fn cube(side: u32, texels: Texels) -> Self {
        Self {
            shape: TextureShape::Cube,
            ..Self::single(side, texels)
        }
    }

    pub(crate) fn plane(levels: Vec<Level>) -> Self {
        Self {
            shape: TextureShape::Plane,
            levels,
        }
    }

    pub(crate) fn color(map: &ColorMap) -> Self {
        let level = |map: &ColorMap| Level {
            width: map.width,
            height: map.height,
            texels: Texels::Rgba32Float(map.to_linear()),
        };
        Self::plane(mips::color_chain(map).iter().map(level).collect())
    }

    pub(crate) fn normal(map: &NormalMap, rule: mips::NormalMips) -> Self {
        let level = |map: NormalMap| Level {
            width: map.width,
            height: map.height,
            texels: Texels::Rgba8Unorm(map.texels),
        };
        let chain = mips::normal_chain(map, rule);
        Self::plane(chain.into_iter().map(level).collect())
    }

    pub(crate) fn height(field: &HeightField) -> Self {
        Self::chain(mips::height_chain(field))
    }

    /// Levels of one number a texel.
    pub(crate) fn chain(levels: Vec<HeightField>) -> Self {
        let level = |field: HeightField| Level {
            width: field.width,
            height: field.height,
            texels: Texels::R32Float(field.texels),
        };
        Self::plane(levels.into_iter().map(level).collect())
    }
}

#[cfg(test)]
mod tests {
    use bossage_assets::{CubeMap, NormalisationCubeMap, normalisation_cube_map::Depth};
    use glam::DVec3;

    use super::{Texels, Texture, TextureShape};

    #[test]
    fn cubes_keep_the_order_of_faces_and_their_integers() {
        let eight = NormalisationCubeMap::generate(1, Depth::Eight).unwrap();
        let texture = Texture::normalisation(&eight);
        assert_eq!(texture.shape, TextureShape::Cube);
        assert_eq!(texture, Texture::smallest_normalisation());
        let sixteen = Texture::normalisation(&NormalisationCubeMap::generate(2, Depth::Sixteen).unwrap());
        let Texels::Rgba16Unorm(texels) = &sixteen.levels[0].texels else {
            panic!("sixteen bits stay sixteen: {sixteen:?}")
        };
        assert_eq!((texels.len(), sixteen.levels[0].width), (24, 2));
    }

    #[test]
    fn a_surrounding_is_in_linear_light() {
        let half_above = CubeMap::from_fn(1, 1, |d| DVec3::splat(if d.y > 0.5 { 1.0 } else { 0.0 }));
        let texture = Texture::environment(&half_above);
        let Texels::Rgba32Float(texels) = &texture.levels[0].texels else {
            panic!("light is floats: {texture:?}")
        };
        let red: Vec<f32> = texels.iter().map(|texel| texel[0]).collect();
        assert_eq!(red, [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    }
}
