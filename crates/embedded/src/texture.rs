//! Textures and samplers of jobs, as the evaluator's.

use bossage_bounds::{AddressMode, Dimension, Filter, Sampler, TexelFormat, Texture};
use bossage_runner::{
    AddressMode as JobAddress, Error, Filter as JobFilter, SamplerSettings, TexelFormat as JobFormat,
    TextureData, TextureDimension,
};

use crate::failure;
use crate::select::NAME;

/// A texture with all its levels.
pub(crate) fn texture(job: &str, data: &TextureData) -> Result<Texture, Error> {
    let dimension = match data.dimension {
        TextureDimension::Line => Dimension::D1,
        TextureDimension::Plane | TextureDimension::Array(_) => Dimension::D2,
        TextureDimension::Cube | TextureDimension::CubeArray(_) => Dimension::Cube,
        TextureDimension::Volume(_) => Dimension::D3,
    };
    let format = format(data.format);
    let (first, rest) = data.levels.split_first().ok_or_else(|| Error::Texture {
        name: job.to_owned(),
        problem: "it has no level".to_owned(),
    })?;
    let size = [data.width, data.height, data.dimension.slices(0)];
    let whole = Texture::new(dimension, format, size, data.dimension.layers(), first.clone());
    let chain = rest.iter().fold(whole, |texture, level| {
        texture.and_then(|texture| texture.with_level(level.clone()))
    });
    chain.map_err(|refusal| failure::of_job(job, refusal))
}

/// A format.
pub(crate) fn format(format: JobFormat) -> TexelFormat {
    match format {
        JobFormat::R8Unorm => TexelFormat::R8Unorm,
        JobFormat::R16Unorm => TexelFormat::R16Unorm,
        JobFormat::Rg8Unorm => TexelFormat::Rg8Unorm,
        JobFormat::Rg8Snorm => TexelFormat::Rg8Snorm,
        JobFormat::Rg16Unorm => TexelFormat::Rg16Unorm,
        JobFormat::Rg16Snorm => TexelFormat::Rg16Snorm,
        JobFormat::Rgba8Unorm => TexelFormat::Rgba8Unorm,
        JobFormat::Rgba8Snorm => TexelFormat::Rgba8Snorm,
        JobFormat::Rgba16Unorm => TexelFormat::Rgba16Unorm,
        JobFormat::Rgba16Snorm => TexelFormat::Rgba16Snorm,
        JobFormat::Rgba32Float => TexelFormat::Rgba32Float,
        JobFormat::R32Float => TexelFormat::R32Float,
        JobFormat::Rg32Float => TexelFormat::Rg32Float,
        JobFormat::Rgba16Float => TexelFormat::Rgba16Float,
        JobFormat::Rgba8Uint => TexelFormat::Rgba8Uint,
        JobFormat::Rgba8Sint => TexelFormat::Rgba8Sint,
        JobFormat::Rgba16Uint => TexelFormat::Rgba16Uint,
        JobFormat::Rgba16Sint => TexelFormat::Rgba16Sint,
        JobFormat::R32Uint => TexelFormat::R32Uint,
        JobFormat::R32Sint => TexelFormat::R32Sint,
        JobFormat::Rg32Uint => TexelFormat::Rg32Uint,
        JobFormat::Rg32Sint => TexelFormat::Rg32Sint,
        JobFormat::Rgba32Uint => TexelFormat::Rgba32Uint,
        JobFormat::Rgba32Sint => TexelFormat::Rgba32Sint,
        JobFormat::Bgra8Unorm => TexelFormat::Bgra8Unorm,
        JobFormat::Depth16Unorm => TexelFormat::Depth16Unorm,
    }
}

/// A sampler.
pub(crate) fn sampler(job: &str, settings: &SamplerSettings) -> Result<Sampler, Error> {
    if settings.anisotropy > 1 {
        return Err(Error::unsupported(job, NAME, "anisotropic filtering"));
    }
    let filter = |filter: JobFilter| match filter {
        JobFilter::Nearest => Filter::Nearest,
        JobFilter::Linear => Filter::Linear,
    };
    let address = match settings.address {
        JobAddress::Wrap => AddressMode::Repeat,
        JobAddress::Mirror => AddressMode::MirrorRepeat,
        JobAddress::Clamp => AddressMode::ClampToEdge,
    };
    Ok(Sampler {
        address: [address; 3],
        mag: filter(settings.filter),
        min: filter(settings.filter),
        mip: filter(settings.mip_filter),
        ..Sampler::default()
    })
}
