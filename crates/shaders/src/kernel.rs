//! The compute kernels of the library: where each stands, and what its entry point is called.

use crate::relief_light::ReliefLight;
use crate::relief_search::ReliefSearch;

/// A compute kernel of the library. Bindings and domain are in the doc of its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kernel {
    /// Central differences.
    HeightToNormal,
    /// Forward differences, hardened.
    HeightToNormalForward,
    /// Forward differences, as published.
    HeightToNormalForwardPublished,
    /// One invocation a triangle, hardened.
    FrameFromUvTriangles,
    /// One invocation a triangle, as published.
    FrameFromUvTrianglesPublished,
    /// One invocation a vertex, hardened: gathers what [`Kernel::FrameFromUvTriangles`] wrote.
    FrameFromUvVertices,
    /// One invocation a vertex, as published: gathers what [`Kernel::FrameFromUvTrianglesPublished`] wrote.
    FrameFromUvVerticesPublished,
    /// The normalisation cube map, 8 bits a component.
    NormalisationCubeMap,
    /// The normalisation cube map, 16 bits a component.
    NormalisationCubeMap16,
    /// Bytes of a normal map to the base of its chain.
    NormalMipsDecode,
    /// One level of averages to the next.
    NormalMips,
    /// A level of averages to bytes.
    NormalMipsEncode,
    /// Heights of texels, in codes, to the base of the chain of maxima.
    MaxMipTexels,
    /// One level of maxima to the next.
    MaxMip,
    /// Heights of texels to the cells between them.
    ConesCells,
    /// One level of a pyramid over cells to the next.
    ConesAbove,
    /// The steepest way up from each cell, of either kind of cones.
    ConesSearch,
    /// Steepest ways to the cones' ratios.
    ConesRatios,
    /// One invocation a direction, through a sampler.
    NormalisationCubeMapLookup,
    /// One invocation a direction, filtered within a face.
    NormalisationCubeMapLookupInFace,
    /// One invocation a view ray: where it meets the relief.
    ReliefHits(ReliefSearch),
    /// One invocation a hit record: how much of a light is seen from there.
    ReliefLight(ReliefLight),
}

impl Kernel {
    /// Every kernel that has one form; [`Kernel::all`] has those with several too.
    pub const ALL: [Kernel; 20] = [
        Kernel::HeightToNormal,
        Kernel::HeightToNormalForward,
        Kernel::HeightToNormalForwardPublished,
        Kernel::FrameFromUvTriangles,
        Kernel::FrameFromUvTrianglesPublished,
        Kernel::FrameFromUvVertices,
        Kernel::FrameFromUvVerticesPublished,
        Kernel::NormalisationCubeMap,
        Kernel::NormalisationCubeMap16,
        Kernel::NormalMipsDecode,
        Kernel::NormalMips,
        Kernel::NormalMipsEncode,
        Kernel::MaxMipTexels,
        Kernel::MaxMip,
        Kernel::ConesCells,
        Kernel::ConesAbove,
        Kernel::ConesSearch,
        Kernel::ConesRatios,
        Kernel::NormalisationCubeMapLookup,
        Kernel::NormalisationCubeMapLookupInFace,
    ];

    /// Every kernel.
    pub fn all() -> impl Iterator<Item = Kernel> {
        Self::ALL
            .into_iter()
            .chain(ReliefSearch::all().map(Kernel::ReliefHits))
            .chain(ReliefLight::all().map(Kernel::ReliefLight))
    }

    /// The assembled module's name: the entry point's, and behind it what distinguishes modules that share one.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Kernel::ReliefHits(search) => format!(
                "{}-{}-{}",
                self.entry(),
                search.technique.id(),
                search.heights.id()
            ),
            Kernel::ReliefLight(light) => {
                format!("{}-{}-{}", self.entry(), light.technique.id(), light.heights.id())
            }
            other => other.entry().to_owned(),
        }
    }

    /// The features that are on in its module, sorted.
    pub(crate) fn features(self) -> Vec<&'static str> {
        match self {
            Kernel::ReliefHits(search) => search.features(),
            Kernel::ReliefLight(light) => light.features(),
            _ => Vec::new(),
        }
    }

    /// The entry point.
    #[must_use]
    pub fn entry(self) -> &'static str {
        match self {
            Kernel::HeightToNormal => "bake_height_to_normal",
            Kernel::HeightToNormalForward => "bake_height_to_normal_forward",
            Kernel::HeightToNormalForwardPublished => "bake_height_to_normal_forward_published",
            Kernel::FrameFromUvTriangles => "frame_from_uv_triangles",
            Kernel::FrameFromUvTrianglesPublished => "frame_from_uv_triangles_published",
            Kernel::FrameFromUvVertices => "frame_from_uv_vertices",
            Kernel::FrameFromUvVerticesPublished => "frame_from_uv_vertices_published",
            Kernel::NormalisationCubeMap => "bake_normalisation_cube_map",
            Kernel::NormalisationCubeMap16 => "bake_normalisation_cube_map_16",
            Kernel::NormalMipsDecode => "bake_normal_mips_decode",
            Kernel::NormalMips => "bake_normal_mips",
            Kernel::NormalMipsEncode => "bake_normal_mips_encode",
            Kernel::MaxMipTexels => "bake_max_mip_texels",
            Kernel::MaxMip => "bake_max_mip",
            Kernel::ConesCells => "bake_cones_cells",
            Kernel::ConesAbove => "bake_cones_above",
            Kernel::ConesSearch => "bake_cones_search",
            Kernel::ConesRatios => "bake_cones_ratios",
            Kernel::NormalisationCubeMapLookup => "normalisation_cube_map_lookup",
            Kernel::NormalisationCubeMapLookupInFace => "normalisation_cube_map_lookup_in_face",
            Kernel::ReliefHits(_) => "relief_hits",
            Kernel::ReliefLight(_) => "relief_light",
        }
    }

    /// Invocations a workgroup, x, y, z.
    #[must_use]
    pub fn workgroup_size(self) -> [u32; 3] {
        match self {
            Kernel::HeightToNormal
            | Kernel::HeightToNormalForward
            | Kernel::HeightToNormalForwardPublished
            | Kernel::NormalisationCubeMap
            | Kernel::NormalisationCubeMap16
            | Kernel::NormalMips
            | Kernel::MaxMipTexels
            | Kernel::MaxMip
            | Kernel::ConesCells
            | Kernel::ConesAbove
            | Kernel::ConesSearch
            | Kernel::ConesRatios => [8, 8, 1],
            Kernel::FrameFromUvTriangles
            | Kernel::FrameFromUvTrianglesPublished
            | Kernel::FrameFromUvVertices
            | Kernel::FrameFromUvVerticesPublished
            | Kernel::NormalMipsDecode
            | Kernel::NormalMipsEncode
            | Kernel::NormalisationCubeMapLookup
            | Kernel::NormalisationCubeMapLookupInFace
            | Kernel::ReliefHits(_)
            | Kernel::ReliefLight(_) => [64, 1, 1],
        }
    }

    /// The file, below `shaders/`.
    #[must_use]
    pub fn file(self) -> &'static str {
        match self {
            Kernel::HeightToNormal | Kernel::HeightToNormalForward => "entry/height_to_normal.wesl",
            Kernel::HeightToNormalForwardPublished => "entry/height_to_normal_forward.wesl",
            Kernel::FrameFromUvTriangles
            | Kernel::FrameFromUvTrianglesPublished
            | Kernel::FrameFromUvVertices
            | Kernel::FrameFromUvVerticesPublished => "entry/frame_from_uv.wesl",
            Kernel::NormalisationCubeMap | Kernel::NormalisationCubeMap16 => {
                "entry/normalisation_cube_map.wesl"
            }
            Kernel::NormalMipsDecode | Kernel::NormalMips | Kernel::NormalMipsEncode => {
                "entry/normal_mips.wesl"
            }
            Kernel::MaxMipTexels | Kernel::MaxMip => "entry/max_mip.wesl",
            Kernel::ConesCells | Kernel::ConesAbove | Kernel::ConesSearch | Kernel::ConesRatios => {
                "entry/cone_map.wesl"
            }
            Kernel::NormalisationCubeMapLookup | Kernel::NormalisationCubeMapLookupInFace => {
                "entry/normalisation_cube_map_lookup.wesl"
            }
            Kernel::ReliefHits(_) => "entry/relief_hits.wesl",
            Kernel::ReliefLight(_) => "entry/relief_light.wesl",
        }
    }
}
