//! The keys of the two stages of a permutation, and every permutation that exists.
//!
//! A stage key is the part of a [`FeatureSet`] that its code depends on; equal keys mean the same module.

use std::collections::BTreeSet;

use crate::feature_set::{
    Albedo, Alpha, FeatureSet, Form, LightingSpace, Lights, NormalSource, Relief, Transform,
};

/// A stage of the surface shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// `surface_vertex`.
    Vertex,
    /// `surface_fragment`.
    Fragment,
    /// `surface_fragment` that also writes its interpolated inputs, for numeric conformance.
    FragmentCapture,
}

/// What the vertex module depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct VertexKey {
    /// The position crosses to the fragment stage.
    pub position: bool,
    /// The normal does.
    pub normal: bool,
    /// The tangent does.
    pub tangent: bool,
    /// The handedness comes from the mesh (`tangent.w`).
    pub mirrored_uv: bool,
    /// The texture coordinate crosses.
    pub uv: bool,
    /// How directions are transformed.
    pub transform: Transform,
    /// The space of position, normal and tangent.
    pub space: LightingSpace,
}

/// What the fragment module depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FragmentKey {
    /// How the texture coordinate is displaced.
    pub relief: Relief,
    /// Where the normal comes from.
    pub normal: NormalSource,
    /// How many lights of which kind.
    pub lights: Lights,
    /// Whether there is a specular lobe.
    pub specular: bool,
    /// Where the diffuse colour comes from.
    pub albedo: Albedo,
    /// What alpha means.
    pub alpha: Alpha,
    /// The tangent carries a handedness.
    pub handedness: bool,
    /// Which form of the formulas.
    pub form: Form,
}

impl FeatureSet {
    /// The key of this permutation's vertex module.
    #[must_use]
    pub fn vertex(&self) -> VertexKey {
        let set = self.canonical();
        VertexKey {
            position: set.has_position(),
            normal: set.has_normal(),
            tangent: set.has_tangent(),
            mirrored_uv: set.mirrored_uv,
            uv: set.has_uv(),
            transform: set.transform,
            space: set.space,
        }
    }

    /// The key of this permutation's fragment module.
    #[must_use]
    pub fn fragment(&self) -> FragmentKey {
        let set = self.canonical();
        FragmentKey {
            relief: set.relief,
            normal: set.normal,
            lights: set.lights,
            specular: set.specular,
            albedo: set.albedo,
            alpha: set.alpha,
            handedness: set.has_handedness(),
            form: set.form,
        }
    }

    /// Every canonical feature set, in order.
    #[must_use]
    pub fn reachable() -> Vec<FeatureSet> {
        let mut sets = BTreeSet::new();
        for relief in [
            Relief::None,
            Relief::ParallaxOffset,
            Relief::ParallaxOffsetLimited,
        ] {
            for normal in [NormalSource::Geometric, NormalSource::Map] {
                for lights in [Lights::None, Lights::Directional, Lights::Point, Lights::Many] {
                    for albedo in [Albedo::Constant, Albedo::Map] {
                        let set = FeatureSet {
                            relief,
                            normal,
                            lights,
                            albedo,
                            ..FeatureSet::default()
                        };
                        vary_the_rest(set, &mut sets);
                    }
                }
            }
        }
        sets.into_iter().collect()
    }
}

fn vary_the_rest(set: FeatureSet, sets: &mut BTreeSet<FeatureSet>) {
    for bits in 0_u32..64 {
        let bit = |n: u32| bits >> n & 1 == 1;
        sets.insert(
            FeatureSet {
                specular: bit(0),
                alpha: if bit(1) { Alpha::Mask } else { Alpha::Opaque },
                transform: if bit(2) {
                    Transform::General
                } else {
                    Transform::Rigid
                },
                mirrored_uv: bit(3),
                space: if bit(4) {
                    LightingSpace::Object
                } else {
                    LightingSpace::World
                },
                form: if bit(5) { Form::Published } else { Form::Hardened },
                ..set
            }
            .canonical(),
        );
    }
}
