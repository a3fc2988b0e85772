//! What a scene is, after loading: every value checked, every file read, nothing optional left to guess.
//!
//! Units: world units are the scene's own; angles in degrees where a name ends in `_deg`; colours are linear; elevations as
//! in the techniques: z(h) = scale · h + bias in UV units, 1 = one tile of the texture.

use std::path::PathBuf;
use std::sync::Arc;

use bossage_assets::normal_mips::NormalMips;
use bossage_assets::{ColorMap, CubeMap, EdgeMode, HeightField, Mesh, NormalMap, NormalisationCubeMap};
use bossage_reference::relief_search::Search;
use bossage_shaders::{Form, LightingSpace, Relief, Shading, Shadow as Feature};
use glam::{DMat3, DMat4, DQuat, DVec2, DVec3, DVec4};

use crate::profile::Profile;

/// A loaded scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The file it came from, as given.
    pub path: PathBuf,
    /// The one view.
    pub camera: Camera,
    /// Ambient radiance, linear RGB.
    pub ambient: DVec3,
    /// Lights, in file order; at most [`crate::schema::MAX_LIGHTS`].
    pub lights: Vec<Light>,
    /// What surrounds everything, if anything does.
    pub environment: Option<Environment>,
    /// Materials, in file order; names are unique.
    pub materials: Vec<Material>,
    /// Objects, in file order; names are unique.
    pub objects: Vec<Object>,
    /// What the planner may spend.
    pub budget: Budget,
}

impl Scene {
    /// The material of an object.
    #[must_use]
    pub fn material_of(&self, object: &Object) -> &Material {
        &self.materials[object.material]
    }

    /// The objects that use a material, by its index.
    pub fn objects_of(&self, material: usize) -> impl Iterator<Item = &Object> {
        self.objects
            .iter()
            .filter(move |object| object.material == material)
    }

    /// The lights that are not black.
    pub fn active_lights(&self) -> impl Iterator<Item = &Light> {
        self.lights.iter().filter(|light| !light.is_black())
    }
}

/// Six pictures of what surrounds the scene, infinitely far away, in world space.
#[derive(Clone, Debug)]
pub struct Environment {
    /// The files, in the order +X, −X, +Y, −Y, +Z, −Z.
    pub paths: Vec<PathBuf>,
    /// The faces: file bytes sRGB, decoded to linear.
    pub map: Arc<CubeMap>,
}

impl Environment {
    /// Whether no texel gives any light.
    #[must_use]
    pub fn is_black(&self) -> bool {
        let dark = |texel: &[u8; 4]| texel[..3] == [0, 0, 0];
        self.map.faces.iter().all(|face| face.texels.iter().all(dark))
    }
}

/// A pinhole camera, right-handed, looking from `position` to `target`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The eye, world space.
    pub position: DVec3,
    /// The point looked at, world space.
    pub target: DVec3,
    /// Up, world space, not parallel to the viewing direction.
    pub up: DVec3,
    /// Vertical field of view, degrees, in (0, 180).
    pub fov_deg: f64,
    /// Near plane, > 0.
    pub near: f64,
    /// Far plane, > near.
    pub far: f64,
    /// Image size in pixels, width and height.
    pub size: [u32; 2],
}

/// A light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Its name, unique among lights.
    pub name: String,
    /// Where it is or comes from.
    pub kind: LightKind,
    /// Linear RGB.
    pub color: DVec3,
    /// Factor on the colour.
    pub intensity: f64,
}

impl Light {
    /// Colour times intensity, as the shader gets it.
    #[must_use]
    pub fn radiance(&self) -> DVec3 {
        self.color * self.intensity
    }

    /// Whether it gives no light, after rounding to the shader's f32.
    #[must_use]
    pub fn is_black(&self) -> bool {
        self.radiance().as_vec3() == glam::Vec3::ZERO
    }
}

/// Directional or point light, world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Light travels along `direction` (unit), everywhere.
    Directional {
        /// The way the light travels: from the light into the scene.
        direction: DVec3,
    },
    /// Light comes from one point; no attenuation.
    Point {
        /// The point.
        position: DVec3,
    },
}

/// A surface.
#[derive(Clone, Debug)]
pub struct Material {
    /// Its name, unique.
    pub name: String,
    /// Base colour.
    pub albedo: AlbedoSource,
    /// Normal map, if any.
    pub normal: Option<NormalSource>,
    /// Height map with its elevation, if any.
    pub height: Option<HeightSource>,
    /// Specular colour, linear.
    pub specular: DVec3,
    /// Blinn-Phong exponent, > 0.
    pub shininess: f64,
    /// Opaque or masked.
    pub alpha: AlphaMode,
    /// What happens outside [0, 1]², for all maps.
    pub address: EdgeMode,
    /// `auto` or a technique.
    pub technique: TechniquePin,
    /// The settings that go with a pinned search; where there are none, those of the schema count.
    pub search: Option<Search>,
    /// What of the relief stands before the lights.
    pub shadow: Shadow,
    /// Whether the depth written is that of the place on the relief.
    pub pixel_depth: bool,
    /// How much ambient light a unit of shift takes away, for the techniques that occlude it.
    pub occlusion: f64,
    /// What light does.
    pub shading: Shading,
    /// What normalises the light vector of `dot3`.
    pub normaliser: Normaliser,
    /// How far toward the light the second height of `emboss` is read, texels.
    pub emboss_texels: f64,
    /// Whether the environment is mirrored.
    pub reflection: ReflectionPin,
    /// As published, or hardened.
    pub form: Form,
    /// Where light and view vectors are measured.
    pub lighting_space: LightingSpace,
    /// How tangents are made.
    pub tangents: Tangents,
}

/// Base colour: a constant that multiplies a map, if there is one.
#[derive(Clone, Debug)]
pub struct AlbedoSource {
    /// Linear RGB and alpha.
    pub color: DVec4,
    /// The map (file bytes sRGB, decoded to linear) and its path.
    pub map: Option<(PathBuf, Arc<ColorMap>)>,
}

/// A normal map with its codec.
#[derive(Clone, Debug)]
pub struct NormalSource {
    /// The file: of the map, or of the heights it was baked from.
    pub path: PathBuf,
    /// The texels, with the codec of the texture: the file's where that is linear, else one to which it was decoded.
    pub map: Arc<NormalMap>,
    /// How the smaller levels are made.
    pub mips: NormalMips,
}

/// A height map and the elevation it stands for.
#[derive(Clone, Debug)]
pub struct HeightSource {
    /// The file.
    pub path: PathBuf,
    /// Heights in [0, 1].
    pub field: Arc<HeightField>,
    /// Elevation.
    pub elevation: Elevation,
}

/// z(h) = scale · h + bias, in UV units of each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elevation {
    /// Scale along u and v: they differ only on tiles that are not square in the world.
    pub scale: DVec2,
    /// Bias along u and v.
    pub bias: DVec2,
}

impl Elevation {
    /// z(h), by axis.
    #[must_use]
    pub fn at(&self, height: f64) -> DVec2 {
        self.scale * height + self.bias
    }
}

/// Alpha handling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored.
    Opaque,
    /// Fragments with alpha below the cutoff are discarded.
    Mask {
        /// In (0, 1].
        cutoff: f64,
    },
}

/// Which relief technique a scene asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TechniquePin {
    /// The planner chooses.
    Auto,
    /// No relief, although there is a height map.
    None,
    /// `parallax_offset`.
    ParallaxOffset,
    /// `parallax_offset_limited`.
    ParallaxOffsetLimited,
    /// `parallax_slope_ao`.
    ParallaxSlopeAo,
    /// `parallax_slope_ao_directed`.
    ParallaxSlopeAoDirected,
    /// `displacement`.
    Displacement,
    /// `parallax_iterative`.
    ParallaxIterative,
    /// `steep_parallax`.
    SteepParallax,
    /// `parallax_occlusion`.
    ParallaxOcclusion,
    /// `relief`.
    Relief,
    /// `cone_step`.
    ConeStep,
    /// `relaxed_cone_step`.
    RelaxedConeStep,
    /// `exact`.
    Exact,
}

impl TechniquePin {
    /// Every word and what it means.
    pub const NAMES: [(&'static str, Self); 14] = [
        ("auto", Self::Auto),
        ("none", Self::None),
        ("parallax_offset", Self::ParallaxOffset),
        ("parallax_offset_limited", Self::ParallaxOffsetLimited),
        ("parallax_slope_ao", Self::ParallaxSlopeAo),
        ("parallax_slope_ao_directed", Self::ParallaxSlopeAoDirected),
        ("displacement", Self::Displacement),
        ("parallax_iterative", Self::ParallaxIterative),
        ("steep_parallax", Self::SteepParallax),
        ("parallax_occlusion", Self::ParallaxOcclusion),
        ("relief", Self::Relief),
        ("cone_step", Self::ConeStep),
        ("relaxed_cone_step", Self::RelaxedConeStep),
        ("exact", Self::Exact),
    ];

    /// The word used in scene files and on the command line.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        Self::NAMES[self as usize].0
    }

    /// The technique that is pinned; none for `auto`.
    #[must_use]
    pub fn relief(self) -> Option<Relief> {
        match self {
            Self::Auto => None,
            Self::None => Some(Relief::None),
            Self::ParallaxOffset => Some(Relief::ParallaxOffset),
            Self::ParallaxOffsetLimited => Some(Relief::ParallaxOffsetLimited),
            Self::ParallaxSlopeAo => Some(Relief::ParallaxSlopeAo),
            Self::ParallaxSlopeAoDirected => Some(Relief::ParallaxSlopeAoDirected),
            Self::Displacement => Some(Relief::Displacement),
            Self::ParallaxIterative => Some(Relief::ParallaxIterative),
            Self::SteepParallax => Some(Relief::SteepParallax),
            Self::ParallaxOcclusion => Some(Relief::ParallaxOcclusion),
            Self::Relief => Some(Relief::Relief),
            Self::ConeStep => Some(Relief::ConeStep),
            Self::RelaxedConeStep => Some(Relief::RelaxedConeStep),
            Self::Exact => Some(Relief::Exact),
        }
    }
}

/// What of the relief stands between a place on it and the lights, and how that is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shadow {
    /// Nothing.
    None,
    /// `self_shadow`.
    Hard {
        /// Samples on the way to each light.
        samples: u32,
    },
    /// `soft_shadow`.
    Soft {
        /// Samples on the way to each light.
        samples: u32,
        /// Half the extent of each light, in slopes of the ray to its middle.
        half_width: f64,
    },
}

impl Shadow {
    /// What the surface draws it by.
    #[must_use]
    pub fn feature(self) -> Feature {
        match self {
            Self::None => Feature::None,
            Self::Hard { .. } => Feature::Hard,
            Self::Soft { .. } => Feature::Soft,
        }
    }

    /// Samples on the way to each light, 0 without shadows.
    #[must_use]
    pub fn samples(self) -> u32 {
        match self {
            Self::None => 0,
            Self::Hard { samples } | Self::Soft { samples, .. } => samples,
        }
    }
}

/// What makes a unit vector of the light vector of `dot3`.
#[derive(Clone, Debug, PartialEq)]
pub enum Normaliser {
    /// Division by the length.
    Arithmetic,
    /// A lookup in this map.
    Cube(Arc<NormalisationCubeMap>),
}

/// Whether a material mirrors the environment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReflectionPin {
    /// Where there is an environment and something to mirror it with.
    Auto,
    /// Not at all.
    None,
    /// `environment_bump`.
    EnvironmentBump,
}

/// How the mesh's tangents are generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Tangents {
    /// MikkTSpace.
    MikkTSpace,
    /// Per-triangle UV gradients summed per vertex.
    FromUv,
    /// From each vertex's normal alone: along no texture axis.
    FromNormal,
}

/// Something to draw.
#[derive(Clone, Debug)]
pub struct Object {
    /// Its name, unique.
    pub name: String,
    /// What it was made from.
    pub shape: Shape,
    /// The mesh, with tangents, in local space.
    pub mesh: Arc<Mesh>,
    /// Index into [`Scene::materials`].
    pub material: usize,
    /// Local to world.
    pub transform: Transform,
    /// The UVs were multiplied by this.
    pub uv_repeat: DVec2,
}

/// The shape of an object, in local space, centred on the origin.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// In the xy plane, facing +z.
    Plane {
        /// Width and height.
        size: DVec2,
        /// Rectangles along u and v.
        segments: [u32; 2],
    },
    /// Axis-aligned.
    Cube {
        /// Edge length.
        size: f64,
    },
    /// A UV sphere.
    Sphere {
        /// Radius.
        radius: f64,
        /// Segments around and along.
        segments: [u32; 2],
    },
    /// A torus around the z axis.
    Torus {
        /// From the centre to the tube's centre.
        major: f64,
        /// Radius of the tube.
        minor: f64,
        /// Segments around the ring and around the tube.
        segments: [u32; 2],
    },
    /// A Wavefront OBJ file.
    Obj {
        /// The file.
        path: PathBuf,
    },
}

/// Scale, then rotate, then translate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Per axis, none zero; negative mirrors.
    pub scale: DVec3,
    /// Rotation, unit.
    pub rotate: DQuat,
    /// Translation.
    pub translate: DVec3,
}

impl Transform {
    /// No transform.
    pub const IDENTITY: Self = Self {
        scale: DVec3::ONE,
        rotate: DQuat::IDENTITY,
        translate: DVec3::ZERO,
    };

    /// World from local.
    #[must_use]
    pub fn matrix(&self) -> DMat4 {
        DMat4::from_scale_rotation_translation(self.scale, self.rotate, self.translate)
    }

    /// The linear part of [`Transform::matrix`].
    #[must_use]
    pub fn linear(&self) -> DMat3 {
        DMat3::from_quat(self.rotate) * DMat3::from_diagonal(self.scale)
    }

    /// Whether the scale has one magnitude on all axes, exactly as authored: then the linear part is a multiple of an
    /// orthogonal matrix, and carries normals as it carries tangents.
    #[must_use]
    pub fn keeps_angles(&self) -> bool {
        let magnitude = self.scale.abs();
        magnitude.x == magnitude.y && magnitude.y == magnitude.z
    }

    /// Whether it mirrors (negative determinant).
    #[must_use]
    pub fn mirrors(&self) -> bool {
        self.scale.x.is_sign_negative() ^ self.scale.y.is_sign_negative() ^ self.scale.z.is_sign_negative()
    }
}

/// What the planner may spend. At least one of error and time is given.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// 99th percentile of the position error of a surface point, pixels.
    pub error_px: Option<f64>,
    /// Time of the relief of all materials in one frame, milliseconds.
    pub time_ms: Option<f64>,
    /// What rays and steps take.
    pub profile: Arc<Profile>,
}
