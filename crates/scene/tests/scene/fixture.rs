//! Scenes written to a temporary folder, with small maps made on the spot.

use std::path::{Path, PathBuf};

use bossage_assets::{ColorMap, HeightField, NormalCodec, NormalMap, encode};
use bossage_scene::{Error, MaterialPlan, Plan, Scene};
use tempfile::TempDir;

/// A folder for one scene and its files.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(TempDir::new().expect("a temporary folder"))
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: &[u8]) -> &Self {
        std::fs::write(self.path(name), bytes).expect("a writable temporary folder");
        self
    }

    /// An 8x8 colour map, each texel by column and row.
    pub(crate) fn color(&self, name: &str, texel: impl Fn(u32, u32) -> [u8; 4]) -> &Self {
        let texels = (0..64).map(|i| texel(i % 8, i / 8)).collect();
        let png = encode::color_png(&ColorMap {
            width: 8,
            height: 8,
            texels,
        })
        .expect("8x8 texels");
        self.write(name, &png)
    }

    /// An 8x8 height map in 16 bits.
    pub(crate) fn height(&self, name: &str, height: impl Fn(u32, u32) -> f32) -> &Self {
        let png = encode::height_png(&HeightField::from_fn(8, 8, height)).expect("8x8 texels");
        self.write(name, &png)
    }

    /// An 8x8 normal map, raw codes.
    pub(crate) fn normal(&self, name: &str, texel: impl Fn(u32, u32) -> [u8; 3]) -> &Self {
        let rgba = |[r, g, b]: [u8; 3]| [r, g, b, 255];
        let texels = (0..64).map(|i| rgba(texel(i % 8, i / 8))).collect();
        let png = encode::normal_png(&NormalMap {
            width: 8,
            height: 8,
            codec: NormalCodec::Unorm,
            texels,
        });
        self.write(name, &png.expect("8x8 texels"))
    }

    pub(crate) fn load(&self, text: &str) -> Result<Scene, Error> {
        self.write("scene.toml", text.as_bytes());
        bossage_scene::load(&self.path("scene.toml"))
    }

    pub(crate) fn scene(&self, text: &str) -> Scene {
        self.load(text).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// A camera 2 units in front of the origin, 100 px high.
pub(crate) const CAMERA: &str = "schema = 1
[camera]
position = [0.0, 0.0, 2.0]
target = [0.0, 0.0, 0.0]
fov_deg = 60.0
near = 0.1
far = 50.0
size = [150, 100]
";

/// One directional light.
pub(crate) const SUN: &str = "[[lights]]
name = \"sun\"
kind = \"directional\"
direction = [0.0, -0.6, -0.8]
";

/// One point light.
pub(crate) const LAMP: &str = "[[lights]]
name = \"lamp\"
kind = \"point\"
position = [0.5, 1.0, 1.5]
";

/// A scene of one tilted plane with one material of the given keys, plus further text (lights, mostly).
pub(crate) fn one_plane(lights: &str, material: &str, object: &str) -> String {
    format!(
        "{CAMERA}{lights}[[materials]]\nname = \"m\"\n{material}\n[[objects]]\nname = \"o\"\nshape = \"plane\"\n\
         material = \"m\"\nrotate = {{ axis = [1.0, 0.0, 0.0], angle_deg = -50.0 }}\n{object}\n"
    )
}

/// The plan of a scene's only material.
pub(crate) fn only(plan: &Plan) -> &MaterialPlan {
    assert_eq!(plan.materials.len(), 1);
    &plan.materials[0]
}

/// An example scene of the repository.
pub(crate) fn example(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples")
        .join(name);
    bossage_scene::load(&path).unwrap_or_else(|error| panic!("{error}"))
}
