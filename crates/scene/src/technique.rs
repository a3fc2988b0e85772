//! A relief technique together with its settings, and the list from which `auto` chooses.

use std::collections::BTreeMap;

use bossage_reference::relief_search::Search;
use bossage_shaders::Relief;

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
    /// All that `auto` chooses from once the surface can draw it, with settings that lie a factor of two apart. In no order.
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
            Self::Search(
                Search::ParallaxIterative { .. }
                | Search::SteepParallax { .. }
                | Search::ParallaxOcclusion { .. }
                | Search::Relief { .. }
                | Search::ConeStep { .. }
                | Search::RelaxedConeStep { .. }
                | Search::Exact,
            ) => None,
        }
    }
}

impl From<Relief> for Technique {
    fn from(relief: Relief) -> Self {
        match relief {
            Relief::None => Self::None,
            Relief::ParallaxOffset => Self::Search(Search::ParallaxOffset),
            Relief::ParallaxOffsetLimited => Self::Search(Search::ParallaxOffsetLimited),
            Relief::ParallaxSlopeAo => Self::ParallaxSlopeAo,
            Relief::ParallaxSlopeAoDirected => Self::ParallaxSlopeAoDirected,
            Relief::Displacement => Self::Displacement,
        }
    }
}
