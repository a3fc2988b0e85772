//! A draw's mesh and textures as the runner takes them: every texture with its first level alone, which is what the
//! reference models.

use bossage_assets::EdgeMode;
use bossage_runner::{AddressMode, Mesh, TexelFormat, TextureData, TextureDimension};
use bossage_scene::{Draw, Texels, Texture, TextureShape};

pub(super) fn address(edge: EdgeMode) -> AddressMode {
    match edge {
        EdgeMode::Wrap => AddressMode::Wrap,
        EdgeMode::Mirror => AddressMode::Mirror,
        EdgeMode::Clamp => AddressMode::Clamp,
    }
}

pub(super) fn mesh(draw: &Draw) -> Mesh {
    let mesh = &draw.mesh;
    let three = |vectors: &[glam::Vec3]| vectors.iter().map(|v| v.to_array()).collect::<Vec<_>>();
    let uvs: Vec<[f32; 2]> = mesh.uvs.iter().map(|uv| uv.to_array()).collect();
    let tangents: Vec<[f32; 4]> = mesh.tangents.iter().map(|t| t.to_array()).collect();
    Mesh::new(mesh.indices.clone())
        .with("position", &three(&mesh.positions))
        .with("normal", &three(&mesh.normals))
        .with("uv", &uvs)
        .with("tangent", &tangents)
}

/// The first level of each texture, by name.
pub(super) fn textures(draw: &Draw) -> Vec<(String, TextureData)> {
    let first = |(name, texture): (&String, &std::sync::Arc<Texture>)| Some((name.clone(), data(texture)?));
    draw.textures.iter().filter_map(first).collect()
}

fn data(texture: &Texture) -> Option<TextureData> {
    let level = texture.levels.first()?;
    let (format, bytes): (_, &[u8]) = match &level.texels {
        Texels::Rgba8Unorm(texels) => (TexelFormat::Rgba8Unorm, bytemuck::cast_slice(texels)),
        Texels::Rgba16Unorm(texels) => (TexelFormat::Rgba16Unorm, bytemuck::cast_slice(texels)),
        Texels::Rgba32Float(texels) => (TexelFormat::Rgba32Float, bytemuck::cast_slice(texels)),
        Texels::R32Float(texels) => (TexelFormat::R32Float, bytemuck::cast_slice(texels)),
    };
    Some(TextureData {
        width: level.width,
        height: level.height,
        format,
        dimension: match texture.shape {
            TextureShape::Plane => TextureDimension::Plane,
            TextureShape::Cube => TextureDimension::Cube,
        },
        levels: vec![bytes.to_vec()],
    })
}
