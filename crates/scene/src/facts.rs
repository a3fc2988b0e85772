//! What the files hold: the numbers that decisions rest on, found by looking at every texel and vertex.

use bossage_assets::{ColorMap, HeightField, Mesh, NormalCodec, NormalMap};
use glam::DVec4;

use crate::model::{AlphaMode, Material};

/// Facts about one material's maps.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialFacts {
    /// About colour and alpha, map and constant together.
    pub albedo: AlbedoFacts,
    /// About the normal map.
    pub normal: Option<NormalFacts>,
    /// About the height map.
    pub height: Option<HeightFacts>,
}

/// Facts about colour and alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlbedoFacts {
    /// Whether all texels have one colour (alpha aside).
    pub constant_rgb: bool,
    /// Whether all texels have one alpha.
    pub constant_alpha: bool,
    /// The first texel (linear) times the constant: the colour itself where both are constant.
    pub first: DVec4,
    /// Smallest alpha after the constant's factor.
    pub alpha_min: f64,
    /// Largest alpha after the constant's factor.
    pub alpha_max: f64,
    /// Share of texels whose alpha is below the cutoff; 0 where nothing is masked.
    pub below_cutoff: f64,
}

/// Facts about a normal map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalFacts {
    /// Whether all texels hold the same normal.
    pub constant: bool,
    /// The first texel, decoded.
    pub first: [f64; 3],
    /// Largest component-wise distance of any texel from (0, 0, 1).
    pub max_off_flat: f64,
    /// Half a step of the codec: how near to (0, 0, 1) a stored normal can be expected to come.
    pub half_quantum: f64,
}

impl NormalFacts {
    /// Whether the map says no more than the geometry does: one normal everywhere, (0, 0, 1) as near as the codec can
    /// write it. A constant *tilted* normal is not flat.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        self.constant && self.max_off_flat <= self.half_quantum
    }
}

/// Facts about a height map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightFacts {
    /// Lowest height.
    pub min: f64,
    /// Highest height.
    pub max: f64,
}

impl HeightFacts {
    /// Whether the surface is a plane.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.min == self.max
    }
}

impl MaterialFacts {
    /// Looks at every texel of the material's maps.
    #[must_use]
    pub fn of(material: &Material) -> Self {
        Self {
            albedo: AlbedoFacts::of(material),
            normal: material
                .normal
                .as_ref()
                .map(|normal| NormalFacts::of(&normal.map)),
            height: material
                .height
                .as_ref()
                .map(|height| HeightFacts::of(&height.field)),
        }
    }
}

impl AlbedoFacts {
    fn of(material: &Material) -> Self {
        let color = material.albedo.color;
        let white = ColorMap::constant([255; 4]);
        let map = material
            .albedo
            .map
            .as_ref()
            .map_or(&white, |(_, map)| map.as_ref());
        let first = map.texels[0];
        let alpha = |byte: u8| f64::from(byte) / 255.0 * color.w;
        let (min, max) = map.alpha_range();
        let cutoff = match material.alpha {
            AlphaMode::Opaque => 0.0,
            AlphaMode::Mask { cutoff } => cutoff,
        };
        let below = map.texels.iter().filter(|texel| alpha(texel[3]) < cutoff).count();
        Self {
            constant_rgb: map.texels.iter().all(|texel| texel[..3] == first[..3]),
            constant_alpha: min == max,
            first: DVec4::from(map.texel_linear(0, 0).map(f64::from)) * color,
            alpha_min: alpha(min),
            alpha_max: alpha(max),
            below_cutoff: below as f64 / map.texels.len() as f64,
        }
    }
}

impl NormalFacts {
    fn of(map: &NormalMap) -> Self {
        let off_flat = |texel: &[u8; 4]| {
            let [x, y, z] = decode(map.codec, texel);
            x.abs().max(y.abs()).max((z - 1.0).abs())
        };
        Self {
            constant: map.texels.iter().all(|texel| texel[..3] == map.texels[0][..3]),
            first: decode(map.codec, &map.texels[0]),
            max_off_flat: map.texels.iter().map(off_flat).fold(0.0, f64::max),
            half_quantum: match map.codec {
                NormalCodec::Unorm => 1.0 / 255.0,
                NormalCodec::Biased => 0.5 / 127.0,
            },
        }
    }
}

/// Exact to f64, so that 127/255 and 128/255 lie at half a step on either side of zero: (2b − 255)/255.
fn decode(codec: NormalCodec, texel: &[u8; 4]) -> [f64; 3] {
    [texel[0], texel[1], texel[2]].map(|byte| match codec {
        NormalCodec::Unorm => (2.0 * f64::from(byte) - 255.0) / 255.0,
        NormalCodec::Biased => (f64::from(byte) - 128.0) / 127.0,
    })
}

impl HeightFacts {
    fn of(field: &HeightField) -> Self {
        let (min, max) = field.range();
        Self {
            min: f64::from(min),
            max: f64::from(max),
        }
    }
}

/// Whether any vertex of a mesh has a mirrored frame (tangent sign −1).
pub(crate) fn has_mirrored_uv(mesh: &Mesh) -> bool {
    mesh.tangents.iter().any(|tangent| tangent.w < 0.0)
}
