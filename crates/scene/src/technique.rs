//! A relief technique together with its settings, and the list from which `auto` chooses.

use std::collections::BTreeMap;

use bossage_reference::relief_search::Search;
use bossage_shaders::Relief;

use crate::model::{Material, TechniquePin};
use crate::schema;

/// Settings by name, sorted.
pub type Settings = BTreeMap<&'static str, u32>;

/// What a material's relief is drawn by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Technique {
    /// No relief.
    None,
    /// `parallax_slope_ao`.
    ParallaxSlopeAo,
    /// `parallax_slope_ao_directed`.
    ParallaxSlopeAoDirected,
    /// Displaced vertices.
    Displacement,
    /// A search along the view ray.
    Search(Search),
}

impl Technique {
    /// All that `auto` chooses from where the surface can draw it, with settings that lie a factor of two apart. In no order.
    #[must_use]
    pub fn ladder() -> Vec<Self> {
        let mut ladder = vec![
            Self::None,
            Self::Search(Search::ParallaxOffsetLimited),
            Self::Search(Search::ParallaxOffset),
        ];
        for exponent in 2..=8 {
            let layers = 1 << exponent;
            ladder.push(Self::Search(Search::SteepParallax { layers }));
            ladder.push(Self::Search(Search::ParallaxOcclusion { layers }));
            // Halved until a bracket is 1/512 of the layer's thickness, and until 1/4096.
            for refinements in [9 - exponent, 12 - exponent] {
                ladder.push(Self::Search(Search::Relief { layers, refinements }));
            }
        }
        ladder.push(Self::Search(Search::Exact));
        ladder
    }

    /// The id, `none` without relief.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::ParallaxSlopeAo => "parallax_slope_ao",
            Self::ParallaxSlopeAoDirected => "parallax_slope_ao_directed",
            Self::Displacement => "displacement",
            Self::Search(search) => search.id(),
        }
    }

    /// The settings.
    #[must_use]
    pub fn settings(self) -> Settings {
        match self {
            Self::None | Self::ParallaxSlopeAo | Self::ParallaxSlopeAoDirected | Self::Displacement => {
                Settings::new()
            }
            Self::Search(search) => search.settings().into_iter().collect(),
        }
    }

    /// What the surface draws it by; none for a technique that it cannot draw.
    #[must_use]
    pub fn relief(self) -> Option<Relief> {
        match self {
            Self::None => Some(Relief::None),
            Self::ParallaxSlopeAo => Some(Relief::ParallaxSlopeAo),
            Self::ParallaxSlopeAoDirected => Some(Relief::ParallaxSlopeAoDirected),
            Self::Displacement => Some(Relief::Displacement),
            Self::Search(Search::ParallaxOffsetLimited) => Some(Relief::ParallaxOffsetLimited),
            Self::Search(Search::ParallaxOffset) => Some(Relief::ParallaxOffset),
            Self::Search(Search::ParallaxIterative { .. }) => Some(Relief::ParallaxIterative),
            Self::Search(Search::SteepParallax { .. }) => Some(Relief::SteepParallax),
            Self::Search(Search::ParallaxOcclusion { .. }) => Some(Relief::ParallaxOcclusion),
            Self::Search(Search::Relief { .. }) => Some(Relief::Relief),
            Self::Search(Search::ConeStep { .. }) => Some(Relief::ConeStep),
            Self::Search(Search::RelaxedConeStep { .. }) => Some(Relief::RelaxedConeStep),
            Self::Search(Search::Exact) => Some(Relief::Exact),
        }
    }

    /// What a material pins, with the settings that it gives or those of the schema; none where the planner chooses.
    #[must_use]
    pub fn pinned(material: &Material) -> Option<Self> {
        let pin = material.technique;
        match pin {
            TechniquePin::Auto => None,
            TechniquePin::None => Some(Self::None),
            TechniquePin::ParallaxSlopeAo => Some(Self::ParallaxSlopeAo),
            TechniquePin::ParallaxSlopeAoDirected => Some(Self::ParallaxSlopeAoDirected),
            TechniquePin::Displacement => Some(Self::Displacement),
            TechniquePin::ParallaxOffset
            | TechniquePin::ParallaxOffsetLimited
            | TechniquePin::ParallaxIterative
            | TechniquePin::SteepParallax
            | TechniquePin::ParallaxOcclusion
            | TechniquePin::Relief
            | TechniquePin::ConeStep
            | TechniquePin::RelaxedConeStep
            | TechniquePin::Exact => material
                .search
                .filter(|search| search.id() == pin.as_str())
                .or_else(|| schema::search(pin))
                .map(Self::Search),
        }
    }
}

/// The settings as the surface's uniform has them: layers, steps or iterations, and refinements.
pub(crate) fn numbers(settings: &Settings) -> [u32; 2] {
    let of = |name: &str| settings.get(name).copied();
    let steps = of("layers").or_else(|| of("steps")).or_else(|| of("iterations"));
    [steps.unwrap_or(0), of("refinements").unwrap_or(0)]
}
