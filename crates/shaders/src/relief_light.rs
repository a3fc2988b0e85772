//! How light on the relief is judged, by the kernel `relief_light`: one module a technique and way to read heights.

use crate::relief_search::HeightRead;

/// What is asked of the relief on the way to a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum LightTechnique {
    /// Whether anything stands over the ray to the light.
    SelfShadow,
    /// How much of a light with an extent stands over the relief's horizon.
    SoftShadow,
}

impl LightTechnique {
    /// Both.
    pub const ALL: [LightTechnique; 2] = [LightTechnique::SelfShadow, LightTechnique::SoftShadow];

    /// The technique's name, as in [`TECHNIQUES`](crate::TECHNIQUES), which is that of its feature too.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            LightTechnique::SelfShadow => "self_shadow",
            LightTechnique::SoftShadow => "soft_shadow",
        }
    }
}

/// One module of the kernel `relief_light`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ReliefLight {
    /// What is asked.
    pub technique: LightTechnique,
    /// How heights are read.
    pub heights: HeightRead,
}

impl ReliefLight {
    /// Both techniques with every way to read heights.
    pub fn all() -> impl Iterator<Item = Self> {
        let with = |technique| HeightRead::ALL.map(|heights| Self { technique, heights });
        LightTechnique::ALL.into_iter().flat_map(with)
    }

    /// What is on in the sources, sorted.
    pub(crate) fn features(self) -> Vec<&'static str> {
        let loads = (self.heights == HeightRead::FourLoads).then_some("four_loads");
        loads.into_iter().chain([self.technique.id()]).collect()
    }
}
