//! The relief techniques that the kernel `relief_hits` runs, and how they read heights: one module each.

/// How a ray is searched for its hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ReliefTechnique {
    /// One height, at the polygon; divided by V.z.
    ParallaxOffset,
    /// One height, at the polygon; not divided.
    ParallaxOffsetLimited,
    /// Steps along the view, by the height and the slope at the place.
    ParallaxIterative,
    /// So many layers; the first sample under the surface.
    SteepParallax,
    /// The same, and a secant.
    ParallaxOcclusion,
    /// The same, and bisection.
    Relief,
    /// From place to place by free cones.
    ConeStep,
    /// By wider cones, and bisection.
    RelaxedConeStep,
    /// Every cell's quadratic.
    Exact,
}

impl ReliefTechnique {
    /// Every technique.
    pub const ALL: [ReliefTechnique; 9] = [
        ReliefTechnique::ParallaxOffset,
        ReliefTechnique::ParallaxOffsetLimited,
        ReliefTechnique::ParallaxIterative,
        ReliefTechnique::SteepParallax,
        ReliefTechnique::ParallaxOcclusion,
        ReliefTechnique::Relief,
        ReliefTechnique::ConeStep,
        ReliefTechnique::RelaxedConeStep,
        ReliefTechnique::Exact,
    ];

    /// The technique's name, as in [`TECHNIQUES`](crate::TECHNIQUES).
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            ReliefTechnique::ParallaxOffset => "parallax_offset",
            ReliefTechnique::ParallaxOffsetLimited => "parallax_offset_limited",
            ReliefTechnique::SteepParallax => "steep_parallax",
            ReliefTechnique::ParallaxOcclusion => "parallax_occlusion",
            ReliefTechnique::Relief => "relief",
            ReliefTechnique::ParallaxIterative => "parallax_iterative",
            ReliefTechnique::ConeStep => "cone_step",
            ReliefTechnique::RelaxedConeStep => "relaxed_cone_step",
            ReliefTechnique::Exact => "exact",
        }
    }

    /// The technique of that name.
    #[must_use]
    pub fn find(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|technique| technique.id() == id)
    }

    /// Whether its module binds `height_map`: cones and slopes have the height beside what they are.
    #[must_use]
    pub fn reads_height_map(self) -> bool {
        !matches!(
            self,
            ReliefTechnique::ParallaxIterative | ReliefTechnique::ConeStep | ReliefTechnique::RelaxedConeStep
        )
    }

    /// Whether its module binds `relief_map`, which is baked from the heights.
    #[must_use]
    pub fn reads_relief_map(self) -> bool {
        !self.reads_height_map() || self == ReliefTechnique::Exact
    }

    /// The feature that stands for it in the sources: its name, but where that is the one of all relief.
    fn feature(self) -> &'static str {
        match self {
            ReliefTechnique::Relief => "relief_mapping",
            other => other.id(),
        }
    }

    fn is_offset(self) -> bool {
        matches!(
            self,
            ReliefTechnique::ParallaxOffset | ReliefTechnique::ParallaxOffsetLimited
        )
    }
}

/// How heights between texels are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum HeightRead {
    /// By the sampler's filter.
    Filtered,
    /// By four loads and our own interpolation.
    FourLoads,
}

impl HeightRead {
    /// Both ways.
    pub const ALL: [HeightRead; 2] = [HeightRead::Filtered, HeightRead::FourLoads];

    /// A short name.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            HeightRead::Filtered => "filtered",
            HeightRead::FourLoads => "four_loads",
        }
    }
}

/// One module of the kernel `relief_hits`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ReliefSearch {
    /// What searches.
    pub technique: ReliefTechnique,
    /// How it reads heights.
    pub heights: HeightRead,
}

impl ReliefSearch {
    /// Every technique with every way to read heights.
    pub fn all() -> impl Iterator<Item = Self> {
        let with = |technique| HeightRead::ALL.map(|heights| Self { technique, heights });
        ReliefTechnique::ALL.into_iter().flat_map(with)
    }

    /// What is on in the sources, sorted.
    pub(crate) fn features(self) -> Vec<&'static str> {
        let mut on = vec![self.technique.feature()];
        if self.technique.is_offset() {
            on.push("elevation");
        }
        if self.heights == HeightRead::FourLoads {
            on.push("four_loads");
        }
        on.sort_unstable();
        on
    }
}

#[cfg(test)]
mod tests {
    use super::{ReliefSearch, ReliefTechnique};
    use crate::Technique;

    #[test]
    fn every_search_is_a_technique_of_the_table() {
        for technique in ReliefTechnique::ALL {
            assert!(Technique::find(technique.id()).is_some(), "{technique:?}");
            assert_eq!(ReliefTechnique::find(technique.id()), Some(technique));
        }
        assert_eq!(ReliefTechnique::find("no_such"), None);
    }

    #[test]
    fn modules_bind_what_is_said() {
        let library = crate::Library::embedded().unwrap();
        for search in ReliefSearch::all() {
            let module = library
                .assemble_kernel(crate::Kernel::ReliefHits(search))
                .unwrap();
            let binds = |name: &str| module.wgsl.contains(&format!("var {name}:"));
            assert_eq!(
                binds("height_map"),
                search.technique.reads_height_map(),
                "{search:?}"
            );
            assert_eq!(
                binds("relief_map"),
                search.technique.reads_relief_map(),
                "{search:?}"
            );
            assert!(binds("surface_sampler"), "{search:?}");
        }
    }

    #[test]
    fn each_module_has_its_own_features() {
        let sets: std::collections::BTreeSet<_> = ReliefSearch::all().map(ReliefSearch::features).collect();
        assert_eq!(sets.len(), ReliefSearch::all().count());
    }
}
