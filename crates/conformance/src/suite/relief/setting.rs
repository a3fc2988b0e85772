//! What one dispatch of a relief case is set to, and what the kernel is bound to then.

use bossage_assets::{EdgeMode, HeightField};
use bossage_reference::relief_ray::Layer;
use bossage_runner::{AddressMode, BufferData, Filter, Resources, SamplerSettings, TextureData};
use bossage_shaders::{HeightRead, Kernel, ReliefSearch, ReliefTechnique};

use super::beside::Beside;
use super::views::View;
use crate::dispatch::{Dispatch, Filtering};
use crate::route::Route;

/// What the kernel writes.
pub(super) const HITS: &str = "hits";

/// Floats of a hit record, the status in the last.
pub(super) const HIT_FLOATS: usize = 4;

/// Whose filter is between the shader and the heights: none but the exact one where the evaluator reads the texels, or the shader
/// itself mixes four.
pub(super) fn filtering(route: Route, heights: HeightRead) -> Filtering {
    match (route, heights) {
        (Route::Embedded, _) | (_, HeightRead::FourLoads) => Filtering::Ideal,
        (_, HeightRead::Filtered) => Filtering::OfHardware,
    }
}

/// The uniform of one dispatch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Setting {
    pub(super) edge: EdgeMode,
    pub(super) scale: f32,
    pub(super) bias: f32,
    pub(super) v_factor: f32,
    pub(super) steps: u32,
    pub(super) refinements: u32,
}

/// Every edge mode; layers below, through and above the polygon; tiles wide, square and high; few steps and more, none, and a
/// number whose reciprocal is not exact.
pub(super) const SETTINGS: [Setting; 4] = [
    Setting {
        edge: EdgeMode::Wrap,
        scale: 0.0625,
        bias: -0.0625,
        v_factor: 1.0,
        steps: 16,
        refinements: 5,
    },
    Setting {
        edge: EdgeMode::Mirror,
        scale: 0.1,
        bias: -0.03,
        v_factor: 0.5,
        steps: 11,
        refinements: 3,
    },
    Setting {
        edge: EdgeMode::Clamp,
        scale: 0.04,
        bias: 0.0,
        v_factor: 1.75,
        steps: 24,
        refinements: 8,
    },
    Setting {
        edge: EdgeMode::Wrap,
        scale: 0.05,
        bias: -0.05,
        v_factor: 1.0,
        steps: 0,
        refinements: 0,
    },
];

/// The settings of a technique. Steps that build on each other, by cones or by slopes, let an interval grow from step to step,
/// so that it says little after many: those techniques take few here, and many where properties judge them (`cones`).
pub(super) fn of(technique: ReliefTechnique) -> [Setting; 4] {
    let few = matches!(
        technique,
        ReliefTechnique::ParallaxIterative | ReliefTechnique::ConeStep | ReliefTechnique::RelaxedConeStep
    );
    SETTINGS.map(|setting| Setting {
        steps: if few {
            setting.steps.div_ceil(8)
        } else {
            setting.steps
        },
        ..setting
    })
}

impl Setting {
    pub(super) fn layer(&self) -> Layer {
        Layer {
            scale: f64::from(self.scale),
            bias: f64::from(self.bias),
            v_factor: f64::from(self.v_factor),
        }
    }

    /// A ray as the report has it.
    pub(super) fn item(&self, view: &View) -> Vec<f32> {
        let layer = [self.scale, self.bias, self.v_factor, self.steps as f32];
        [&view.uv[..], &view.dir_ts[..], &layer[..]].concat()
    }

    /// The edge mode as shaders have it.
    pub(super) fn edge_number(&self) -> f32 {
        match self.edge {
            EdgeMode::Wrap => 0.0,
            EdgeMode::Mirror => 1.0,
            EdgeMode::Clamp => 2.0,
        }
    }

    fn uniforms(&self) -> [(&'static str, f32); 7] {
        [
            ("search.scale", self.scale),
            ("search.bias", self.bias),
            ("search.v_factor", self.v_factor),
            ("search.level", 0.0),
            ("search.steps", self.steps as f32),
            ("search.refinements", self.refinements as f32),
            ("search.edge_mode", self.edge_number()),
        ]
    }

    pub(super) fn sampler(&self) -> SamplerSettings {
        SamplerSettings {
            address: match self.edge {
                EdgeMode::Wrap => AddressMode::Wrap,
                EdgeMode::Mirror => AddressMode::Mirror,
                EdgeMode::Clamp => AddressMode::Clamp,
            },
            filter: Filter::Linear,
            mip_filter: Filter::Nearest,
            anisotropy: 1,
        }
    }

    /// The kernel over these rays.
    pub(super) fn dispatch<'a>(
        &self,
        name: &'a str,
        search: ReliefSearch,
        heights: &'a TextureData,
        beside: Option<&'a Beside>,
        rays: &'a [[f32; 8]],
    ) -> Dispatch<'a> {
        let mut resources = Resources::default();
        resources.uniforms.extend(
            self.uniforms()
                .map(|(name, value)| (name.to_owned(), vec![value])),
        );
        if search.technique.reads_height_map() {
            resources.textures.insert("height_map".to_owned(), heights);
        }
        if let Some(beside) = beside {
            resources
                .textures
                .insert("relief_map".to_owned(), &beside.texture);
        }
        resources
            .samplers
            .insert("surface_sampler".to_owned(), self.sampler());
        let inputs = BufferData::Bytes(bytemuck::cast_slice(rays));
        resources.buffers.insert("rays".to_owned(), inputs);
        let outputs = BufferData::Output(4 * HIT_FLOATS * rays.len());
        resources.buffers.insert(HITS.to_owned(), outputs);
        Dispatch {
            name,
            kernel: Kernel::ReliefHits(search),
            resources,
            // One more than there are rays: nothing may come of it.
            invocations: [rays.len() as u32 + 1, 1, 1],
        }
    }
}

/// A map as the kernel reads it.
pub(super) fn texture(field: &HeightField) -> TextureData {
    TextureData::r32f(field.width, field.height, &field.texels)
}

/// The rays as the kernel takes them.
pub(super) fn packed(views: &[View]) -> Vec<[f32; 8]> {
    views.iter().map(View::packed).collect()
}
