//! Puts buffers, textures and samplers on the device.

use crate::device::Device;
use crate::error::Error;
use crate::limits::within;
use crate::texture::{Filter, SamplerSettings, TextureData};

/// A buffer with these bytes (a multiple of four), which can be read back.
pub(crate) fn buffer(device: &Device, label: &str, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    let buffer = device.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: bytes.len() as u64,
        usage: usage | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    device.queue.write_buffer(&buffer, 0, bytes);
    buffer
}

/// A texture with its texels.
pub(crate) fn texture(
    device: &Device,
    job: &str,
    name: &str,
    data: &TextureData,
    usage: wgpu::TextureUsages,
) -> Result<wgpu::Texture, Error> {
    data.validate(name)?;
    if data.format.is_norm16() {
        let feature = wgpu::Features::TEXTURE_FORMAT_16BIT_NORM;
        device.require(job, feature, "textures of 16-bit normalised integers")?;
    }
    let limit = u64::from(device.limits().max_texture_dimension_2d);
    within(
        job,
        "a texture's side",
        u64::from(data.width.max(data.height)),
        limit,
    )?;
    let texture = device.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(name),
        size: extent(data, 0),
        mip_level_count: data.levels.len() as u32,
        sample_count: 1,
        dimension: data.dimension.wgpu(),
        format: data.format.wgpu(),
        usage: usage | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (level, bytes) in (0..).zip(&data.levels) {
        write_level(device, &texture, data, level, bytes);
    }
    Ok(texture)
}

/// A view of the whole texture.
pub(crate) fn view(texture: &wgpu::Texture, data: &TextureData) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(data.dimension.view()),
        ..wgpu::TextureViewDescriptor::default()
    })
}

fn extent(data: &TextureData, level: u32) -> wgpu::Extent3d {
    let (width, height) = data.level_size(level);
    wgpu::Extent3d {
        width,
        height,
        depth_or_array_layers: data.dimension.layers() * data.dimension.slices(level),
    }
}

fn write_level(device: &Device, texture: &wgpu::Texture, data: &TextureData, level: u32, bytes: &[u8]) {
    let size = extent(data, level);
    let place = wgpu::TexelCopyTextureInfo {
        texture,
        mip_level: level,
        origin: wgpu::Origin3d::ZERO,
        aspect: wgpu::TextureAspect::All,
    };
    let rows = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(size.width * data.format.texel_bytes() as u32),
        rows_per_image: Some(size.height),
    };
    device.queue.write_texture(place, bytes, rows, size);
}

/// A sampler.
pub(crate) fn sampler(
    device: &Device,
    label: &str,
    settings: &SamplerSettings,
    compare: Option<wgpu::CompareFunction>,
) -> wgpu::Sampler {
    let address = settings.address.wgpu();
    let filter = match settings.filter {
        Filter::Nearest => wgpu::FilterMode::Nearest,
        Filter::Linear => wgpu::FilterMode::Linear,
    };
    device.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some(label),
        address_mode_u: address,
        address_mode_v: address,
        address_mode_w: address,
        mag_filter: filter,
        min_filter: filter,
        mipmap_filter: match settings.mip_filter {
            Filter::Nearest => wgpu::MipmapFilterMode::Nearest,
            Filter::Linear => wgpu::MipmapFilterMode::Linear,
        },
        anisotropy_clamp: settings.anisotropy,
        compare,
        ..wgpu::SamplerDescriptor::default()
    })
}
