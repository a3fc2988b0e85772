//! Pictures and samplers as a job gives them.
//!
//! Texels are handed over as they are: no colour space is applied here (all formats are linear), no mips are made.

use crate::error::Error;

/// Texel formats. Those of 16-bit integers not every device has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TexelFormat {
    /// One byte, read as byte / 255.
    R8Unorm,
    /// One 16-bit integer, read as integer / 65535.
    R16Unorm,
    /// Two bytes, each read as byte / 255.
    Rg8Unorm,
    /// Two signed bytes, each read as byte / 127, at least −1.
    Rg8Snorm,
    /// Two 16-bit integers, each read as integer / 65535.
    Rg16Unorm,
    /// Two signed 16-bit integers, each read as integer / 32767, at least −1.
    Rg16Snorm,
    /// Four bytes, each read as byte / 255.
    Rgba8Unorm,
    /// Four signed bytes, each read as byte / 127, at least −1.
    Rgba8Snorm,
    /// Four 16-bit integers, each read as integer / 65535.
    Rgba16Unorm,
    /// Four signed 16-bit integers, each read as integer / 32767, at least −1.
    Rgba16Snorm,
    /// Four floats.
    Rgba32Float,
    /// One float.
    R32Float,
    /// Two floats.
    Rg32Float,
    /// Four half floats.
    Rgba16Float,
    /// Four unsigned bytes.
    Rgba8Uint,
    /// Four signed bytes.
    Rgba8Sint,
    /// Four unsigned 16-bit integers.
    Rgba16Uint,
    /// Four signed 16-bit integers.
    Rgba16Sint,
    /// One unsigned 32-bit integer.
    R32Uint,
    /// One signed 32-bit integer.
    R32Sint,
    /// Two unsigned 32-bit integers.
    Rg32Uint,
    /// Two signed 32-bit integers.
    Rg32Sint,
    /// Four unsigned 32-bit integers.
    Rgba32Uint,
    /// Four signed 32-bit integers.
    Rgba32Sint,
    /// Four bytes, each read as byte / 255, the third channel first.
    Bgra8Unorm,
    /// A depth: one 16-bit integer, read as integer / 65535.
    Depth16Unorm,
}

impl TexelFormat {
    /// Bytes a texel.
    #[must_use]
    pub fn texel_bytes(self) -> usize {
        // Every format here has one plane, whose texels have a size.
        self.wgpu()
            .block_copy_size(None)
            .map_or(0, |bytes| bytes as usize)
    }

    /// Whether its components are 32-bit floats, which not every device filters.
    #[must_use]
    pub fn is_float(self) -> bool {
        let unfilterable = wgpu::TextureSampleType::Float { filterable: false };
        self.wgpu().sample_type(None, None) == Some(unfilterable)
    }

    /// Whether its components are 16-bit normalised integers, which not every device has.
    #[must_use]
    pub fn is_norm16(self) -> bool {
        let features = self.wgpu().required_features();
        features.contains(wgpu::Features::TEXTURE_FORMAT_16BIT_NORM)
    }

    pub(crate) fn wgpu(self) -> wgpu::TextureFormat {
        match self {
            Self::R8Unorm => wgpu::TextureFormat::R8Unorm,
            Self::R16Unorm => wgpu::TextureFormat::R16Unorm,
            Self::Rg8Unorm => wgpu::TextureFormat::Rg8Unorm,
            Self::Rg8Snorm => wgpu::TextureFormat::Rg8Snorm,
            Self::Rg16Unorm => wgpu::TextureFormat::Rg16Unorm,
            Self::Rg16Snorm => wgpu::TextureFormat::Rg16Snorm,
            Self::Rgba8Unorm => wgpu::TextureFormat::Rgba8Unorm,
            Self::Rgba8Snorm => wgpu::TextureFormat::Rgba8Snorm,
            Self::Rgba16Unorm => wgpu::TextureFormat::Rgba16Unorm,
            Self::Rgba16Snorm => wgpu::TextureFormat::Rgba16Snorm,
            Self::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
            Self::R32Float => wgpu::TextureFormat::R32Float,
            Self::Rg32Float => wgpu::TextureFormat::Rg32Float,
            Self::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
            Self::Rgba8Uint => wgpu::TextureFormat::Rgba8Uint,
            Self::Rgba8Sint => wgpu::TextureFormat::Rgba8Sint,
            Self::Rgba16Uint => wgpu::TextureFormat::Rgba16Uint,
            Self::Rgba16Sint => wgpu::TextureFormat::Rgba16Sint,
            Self::R32Uint => wgpu::TextureFormat::R32Uint,
            Self::R32Sint => wgpu::TextureFormat::R32Sint,
            Self::Rg32Uint => wgpu::TextureFormat::Rg32Uint,
            Self::Rg32Sint => wgpu::TextureFormat::Rg32Sint,
            Self::Rgba32Uint => wgpu::TextureFormat::Rgba32Uint,
            Self::Rgba32Sint => wgpu::TextureFormat::Rgba32Sint,
            Self::Bgra8Unorm => wgpu::TextureFormat::Bgra8Unorm,
            Self::Depth16Unorm => wgpu::TextureFormat::Depth16Unorm,
        }
    }

    /// What a shader reads from it, in the manifest's words: `f32`, `u32` or `i32`.
    #[must_use]
    pub fn sample_type(self) -> &'static str {
        match self.wgpu().sample_type(None, None) {
            Some(wgpu::TextureSampleType::Uint) => "u32",
            Some(wgpu::TextureSampleType::Sint) => "i32",
            Some(wgpu::TextureSampleType::Float { .. } | wgpu::TextureSampleType::Depth) | None => "f32",
        }
    }
}

/// How the texels of a texture are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TextureDimension {
    /// One row.
    Line,
    /// One layer.
    Plane,
    /// So many layers.
    Array(u32),
    /// Six layers: +x, −x, +y, −y, +z, −z.
    Cube,
    /// So many cubes, one after the other.
    CubeArray(u32),
    /// So many slices, halved from level to level.
    Volume(u32),
}

impl TextureDimension {
    /// How many layers.
    #[must_use]
    pub fn layers(self) -> u32 {
        match self {
            Self::Line | Self::Plane | Self::Volume(_) => 1,
            Self::Array(layers) => layers,
            Self::Cube => 6,
            Self::CubeArray(cubes) => 6 * cubes,
        }
    }

    /// How many slices a level has.
    #[must_use]
    pub fn slices(self, level: u32) -> u32 {
        match self {
            Self::Volume(slices) => slices.checked_shr(level).unwrap_or(0).max(1),
            Self::Line | Self::Plane | Self::Array(_) | Self::Cube | Self::CubeArray(_) => 1,
        }
    }

    /// Its shape in the manifest's words, and whether it is an array.
    pub(crate) fn words(self) -> (&'static str, bool) {
        match self {
            Self::Line => ("1d", false),
            Self::Plane => ("2d", false),
            Self::Array(_) => ("2d", true),
            Self::Cube => ("cube", false),
            Self::CubeArray(_) => ("cube", true),
            Self::Volume(_) => ("3d", false),
        }
    }

    pub(crate) fn view(self) -> wgpu::TextureViewDimension {
        match self {
            Self::Line => wgpu::TextureViewDimension::D1,
            Self::Plane => wgpu::TextureViewDimension::D2,
            Self::Array(_) => wgpu::TextureViewDimension::D2Array,
            Self::Cube => wgpu::TextureViewDimension::Cube,
            Self::CubeArray(_) => wgpu::TextureViewDimension::CubeArray,
            Self::Volume(_) => wgpu::TextureViewDimension::D3,
        }
    }

    pub(crate) fn wgpu(self) -> wgpu::TextureDimension {
        match self {
            Self::Line => wgpu::TextureDimension::D1,
            Self::Plane | Self::Array(_) | Self::Cube | Self::CubeArray(_) => wgpu::TextureDimension::D2,
            Self::Volume(_) => wgpu::TextureDimension::D3,
        }
    }
}

/// The layers of a cube, as messages call them.
const FACES: [&str; 6] = ["+x", "−x", "+y", "−y", "+z", "−z"];

/// A texture with its mip chain.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureData {
    /// Width of level 0.
    pub width: u32,
    /// Height of level 0.
    pub height: u32,
    /// The texels' format.
    pub format: TexelFormat,
    /// Its shape.
    pub dimension: TextureDimension,
    /// The levels, largest first, each `max(1, size >> level)` wide and high: rows from v = 0 on, tightly packed, the
    /// layers or slices one after the other.
    pub levels: Vec<Vec<u8>>,
}

impl TextureData {
    /// A plane of one level in [`TexelFormat::Rgba8Unorm`].
    #[must_use]
    pub fn rgba8(width: u32, height: u32, texels: &[[u8; 4]]) -> Self {
        Self::plane(
            width,
            height,
            TexelFormat::Rgba8Unorm,
            bytemuck::cast_slice(texels),
        )
    }

    /// A plane of one level in [`TexelFormat::Rgba32Float`].
    #[must_use]
    pub fn rgba32f(width: u32, height: u32, texels: &[[f32; 4]]) -> Self {
        Self::plane(
            width,
            height,
            TexelFormat::Rgba32Float,
            bytemuck::cast_slice(texels),
        )
    }

    /// A plane of one level in [`TexelFormat::R32Float`].
    #[must_use]
    pub fn r32f(width: u32, height: u32, texels: &[f32]) -> Self {
        Self::plane(width, height, TexelFormat::R32Float, bytemuck::cast_slice(texels))
    }

    /// A cube of one level: six square faces of this side, +x, −x, +y, −y, +z, −z, rows from the top (t = 0) on, tightly packed.
    ///
    /// # Errors
    /// [`Error::Texture`] for another number of faces, and for a face of another size, naming it.
    pub fn cube<T: bytemuck::NoUninit, F: AsRef<[T]>>(
        name: &str,
        side: u32,
        format: TexelFormat,
        faces: &[F],
    ) -> Result<Self, Error> {
        Self {
            width: side,
            height: side,
            format,
            dimension: TextureDimension::Cube,
            levels: Vec::new(),
        }
        .with_cube_level(name, faces)
    }

    /// Adds the next smaller level of a cube, in the order of [`Self::cube`].
    ///
    /// # Errors
    /// As [`Self::cube`].
    pub fn with_cube_level<T: bytemuck::NoUninit, F: AsRef<[T]>>(
        mut self,
        name: &str,
        faces: &[F],
    ) -> Result<Self, Error> {
        let level = self.levels.len() as u32;
        let side = self.level_size(level).0 as usize;
        let expected = side * side * self.format.texel_bytes();
        let wrong = |problem: String| Error::Texture {
            name: name.to_owned(),
            problem: format!("level {level}: {problem}"),
        };
        if faces.len() != FACES.len() {
            let (order, given) = (FACES.join(", "), faces.len());
            return Err(wrong(format!(
                "a cube has six faces ({order}); {given} are given"
            )));
        }
        let mut bytes = Vec::with_capacity(6 * expected);
        for (face, texels) in FACES.iter().zip(faces) {
            let texels: &[u8] = bytemuck::cast_slice(texels.as_ref());
            if texels.len() != expected {
                let given = texels.len();
                return Err(wrong(format!(
                    "face {face} has {given} bytes; {side} x {side} texels are {expected}"
                )));
            }
            bytes.extend_from_slice(texels);
        }
        self.levels.push(bytes);
        Ok(self)
    }

    /// A plane of one level: rows from v = 0 on, tightly packed. [`Self::validate`] says whether the bytes are as many as they should be.
    #[must_use]
    pub fn plane(width: u32, height: u32, format: TexelFormat, bytes: &[u8]) -> Self {
        Self {
            width,
            height,
            format,
            dimension: TextureDimension::Plane,
            levels: vec![bytes.to_vec()],
        }
    }

    /// Adds the next smaller level.
    #[must_use]
    pub fn with_level<T: bytemuck::NoUninit>(mut self, texels: &[T]) -> Self {
        self.levels.push(bytemuck::cast_slice(texels).to_vec());
        self
    }

    /// Width and height of a level.
    #[must_use]
    pub fn level_size(&self, level: u32) -> (u32, u32) {
        let halved = |size: u32| size.checked_shr(level).unwrap_or(0).max(1);
        (halved(self.width), halved(self.height))
    }

    /// Checks sizes, the number of levels and the length of each.
    ///
    /// # Errors
    /// [`Error::Texture`], naming the level that is off.
    pub fn validate(&self, name: &str) -> Result<(), Error> {
        let wrong = |problem: String| {
            Err(Error::Texture {
                name: name.to_owned(),
                problem,
            })
        };
        if self.width == 0 || self.height == 0 {
            return wrong(format!("its size is {} x {}", self.width, self.height));
        }
        let is_cube = matches!(
            self.dimension,
            TextureDimension::Cube | TextureDimension::CubeArray(_)
        );
        if self.dimension.layers() == 0 || self.dimension == TextureDimension::Volume(0) {
            return wrong("it has no layer".to_owned());
        }
        if self.dimension == TextureDimension::Line && self.height != 1 {
            return wrong(format!("a line is 1 high, not {}", self.height));
        }
        if is_cube && self.width != self.height {
            return wrong(format!(
                "a cube's faces are square, not {} x {}",
                self.width, self.height
            ));
        }
        let most = self.width.max(self.height).ilog2() as usize + 1;
        if self.levels.is_empty() || self.levels.len() > most {
            return wrong(format!(
                "it has {} levels; 1 to {most} are possible",
                self.levels.len()
            ));
        }
        match (0..)
            .zip(&self.levels)
            .find(|(level, bytes)| bytes.len() != self.level_bytes(*level))
        {
            Some((level, bytes)) => wrong(format!(
                "level {level} has {} bytes instead of {}",
                bytes.len(),
                self.level_bytes(level)
            )),
            None => Ok(()),
        }
    }

    fn level_bytes(&self, level: u32) -> usize {
        let (width, height) = self.level_size(level);
        let layers = self.dimension.layers() * self.dimension.slices(level);
        width as usize * height as usize * layers as usize * self.format.texel_bytes()
    }
}

/// What lies beyond the edge of a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum AddressMode {
    /// It repeats.
    #[default]
    Wrap,
    /// It repeats mirrored.
    Mirror,
    /// The edge texel goes on.
    Clamp,
}

impl AddressMode {
    pub(crate) fn wgpu(self) -> wgpu::AddressMode {
        match self {
            Self::Wrap => wgpu::AddressMode::Repeat,
            Self::Mirror => wgpu::AddressMode::MirrorRepeat,
            Self::Clamp => wgpu::AddressMode::ClampToEdge,
        }
    }
}

/// How texels are mixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Filter {
    /// The closest only.
    Nearest,
    /// The linear mix.
    #[default]
    Linear,
}

/// A sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SamplerSettings {
    /// In all directions.
    pub address: AddressMode,
    /// Inside a level, for enlarging and shrinking.
    pub filter: Filter,
    /// Between levels.
    pub mip_filter: Filter,
    /// Largest anisotropy, 1 = none (more needs linear filters everywhere).
    pub anisotropy: u16,
}

impl Default for SamplerSettings {
    fn default() -> Self {
        Self {
            address: AddressMode::Wrap,
            filter: Filter::Linear,
            mip_filter: Filter::Linear,
            anisotropy: 1,
        }
    }
}

impl SamplerSettings {
    /// Whether texels or levels are mixed.
    #[must_use]
    pub fn is_filtering(&self) -> bool {
        self.filter == Filter::Linear || self.mip_filter == Filter::Linear
    }
}
