//! The designs, and what each reads.

use bossage_assets::EdgeMode;
use bossage_runner::{Code, Shader, TextureData};
use bossage_translate::{Contents, EmitOptions, Manifest, Shader as Module, Source, Target, emit, manifest};

use crate::maps::Map;
use crate::{Failure, bakes};

const FRAME: &str = include_str!("designs/frame.wgsl");

/// The kernel's entry point.
const ENTRY: &str = "relief_hits";

/// The maps of a design beside the heights, by binding.
type Bake = fn(&Map) -> Vec<(&'static str, TextureData)>;

pub(crate) struct Design {
    pub(crate) name: &'static str,
    text: &'static str,
    bake: Bake,
    /// Whether it is made for such a map.
    pub(crate) takes: fn(&Map) -> bool,
}

/// The measure first.
pub(crate) const DESIGNS: &[Design] = &[
    Design {
        name: "parallax_occlusion",
        text: include_str!("designs/parallax_occlusion.wgsl"),
        bake: |_| vec![],
        takes: |_| true,
    },
    Design {
        name: "window_maxima",
        text: include_str!("designs/window_maxima.wgsl"),
        bake: |map| vec![("relief_map", bakes::windows(map))],
        takes: |_| true,
    },
    Design {
        name: "window_one_loop",
        text: include_str!("designs/window_one_loop.wgsl"),
        bake: |map| vec![("relief_map", bakes::windows(map))],
        takes: |_| true,
    },
    Design {
        name: "window_patches",
        text: include_str!("designs/window_patches.wgsl"),
        bake: |map| {
            vec![
                ("relief_map", bakes::windows(map)),
                ("patch_map", bakes::patches(map)),
            ]
        },
        takes: |map| map.edge != EdgeMode::Mirror,
    },
    Design {
        name: "two_levels",
        text: include_str!("designs/two_levels.wgsl"),
        bake: |map| vec![("relief_map", bakes::block_tops(map))],
        takes: |map| match map.edge {
            EdgeMode::Wrap => map.field.width % bakes::BLOCK == 0 && map.field.height % bakes::BLOCK == 0,
            EdgeMode::Mirror => false,
            EdgeMode::Clamp => true,
        },
    },
    Design {
        name: "cones",
        text: include_str!("designs/cones.wgsl"),
        bake: |map| vec![("relief_map", bakes::cones(map))],
        takes: |_| true,
    },
    Design {
        name: "cell_walk",
        text: include_str!("designs/cell_walk.wgsl"),
        bake: |_| vec![],
        takes: |_| true,
    },
];

/// The design of that name.
pub(crate) fn find(name: &str) -> Result<&'static Design, String> {
    let names = || {
        DESIGNS
            .iter()
            .map(|design| design.name)
            .collect::<Vec<_>>()
            .join(", ")
    };
    let found = DESIGNS.iter().find(|design| design.name == name);
    found.ok_or_else(|| format!("there is no design `{name}`; there are: {}", names()))
}

/// A design for one map, as the SPIR-V that is emitted.
pub(crate) struct Built {
    pub(crate) name: &'static str,
    code: Vec<u8>,
    manifest: Manifest,
    pub(crate) maps: Vec<(&'static str, TextureData)>,
}

impl Built {
    pub(crate) fn new(design: &Design, map: &Map) -> Result<Self, Failure> {
        let text = format!("{FRAME}\n{}", design.text);
        let module = Module::parse(design.name, &Source::Wgsl(text)).map_err(|why| why.to_string())?;
        let options = EmitOptions::default();
        let emitted = emit(&module, Target::Spirv, &options).map_err(|why| why.to_string())?;
        let Some(Contents::Binary(code)) = emitted.file(ENTRY).map(|file| file.contents.clone()) else {
            return Err(format!("{} has no `{ENTRY}`", design.name).into());
        };
        Ok(Self {
            name: design.name,
            code,
            manifest: manifest(&module, &options, &[emitted]),
            maps: (design.bake)(map),
        })
    }

    pub(crate) fn shader(&self) -> Shader<'_> {
        let entry = self
            .manifest
            .entry(ENTRY)
            .expect("an entry point that was emitted is in the manifest");
        Shader {
            code: Code::Spirv(&self.code),
            entry,
        }
    }
}
