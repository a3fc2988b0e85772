//! The keys of the two stages of a permutation, and every permutation that exists.
//!
//! A stage key is the part of a [`FeatureSet`] that its code depends on; equal keys mean the same module.

use std::collections::BTreeSet;

use crate::feature_set::{
    Albedo, Alpha, FeatureSet, Form, LightingSpace, Lights, NormalSource, Normaliser, Relief, Shading,
    Shadow, Transform,
};

/// A stage of the surface shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// `surface_vertex`.
    Vertex,
    /// `surface_fragment`: of the only pass, or of the first of two.
    Fragment,
    /// `surface_fragment` of the second of two passes: the colour alone, to be multiplied in by blending. It is drawn with the
    /// vertex module of the first, so that depths agree to the bit.
    SecondPass,
    /// `surface_fragment` that also writes its interpolated inputs, for numeric conformance.
    FragmentCapture,
    /// `surface_fragment` of `exact` whose hit is an input in place of the walk, and which writes the ray. It is judged in the place of
    /// the module with the walk, and never drawn.
    FragmentGivenHit,
}

/// Which of a permutation's draws a fragment module is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Pass {
    /// There is one only.
    #[default]
    Only,
    /// Light to the target.
    First,
    /// Colour multiplied in.
    Second,
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
    /// The vertices are displaced by the height map.
    pub displacement: bool,
}

/// What the fragment module depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FragmentKey {
    /// How the texture coordinate is displaced.
    pub relief: Relief,
    /// What of the relief stands before the lights.
    pub shadow: Shadow,
    /// Whether the depth of the place on the relief is written.
    pub pixel_depth: bool,
    /// Where the normal comes from.
    pub normal: NormalSource,
    /// How many lights of which kind.
    pub lights: Lights,
    /// What light does on the surface.
    pub shading: Shading,
    /// What normalises the light vector of `dot3`.
    pub normaliser: Normaliser,
    /// Which draw it is for.
    pub pass: Pass,
    /// Whether there is a specular lobe.
    pub specular: bool,
    /// Whether the surface mirrors a cube map.
    pub environment: bool,
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
            displacement: set.relief == Relief::Displacement,
        }
    }

    /// The key of this permutation's fragment module: of the first, where there are two passes.
    #[must_use]
    pub fn fragment(&self) -> FragmentKey {
        let set = self.canonical();
        let first = set.shading == Shading::Dot3TwoPass;
        FragmentKey {
            // Displaced vertices leave nothing to do for the fragment stage.
            relief: if set.relief == Relief::Displacement {
                Relief::None
            } else {
                set.relief
            },
            shadow: set.shadow,
            pixel_depth: set.pixel_depth,
            normal: set.normal,
            lights: set.lights,
            shading: set.shading,
            normaliser: set.normaliser,
            pass: if first { Pass::First } else { Pass::Only },
            specular: set.specular,
            environment: set.environment,
            // The first pass writes light, and knows no colour.
            albedo: if first { Albedo::Constant } else { set.albedo },
            alpha: set.alpha,
            handedness: set.has_handedness(),
            form: set.form,
        }
    }

    /// The key of the second pass' fragment module, where there is one.
    #[must_use]
    pub fn second_pass(&self) -> Option<FragmentKey> {
        let set = self.canonical();
        (set.shading == Shading::Dot3TwoPass).then_some(FragmentKey {
            relief: Relief::None,
            shadow: Shadow::None,
            pixel_depth: false,
            normal: NormalSource::Geometric,
            lights: Lights::None,
            shading: set.shading,
            normaliser: Normaliser::Arithmetic,
            pass: Pass::Second,
            specular: false,
            environment: false,
            albedo: set.albedo,
            alpha: Alpha::Opaque,
            handedness: false,
            form: Form::Hardened,
        })
    }

    /// The stages of this permutation, in the order of their use.
    #[must_use]
    pub fn stages(&self) -> &'static [Stage] {
        if self.canonical().shading == Shading::Dot3TwoPass {
            &[Stage::Vertex, Stage::Fragment, Stage::SecondPass]
        } else {
            &[Stage::Vertex, Stage::Fragment]
        }
    }

    /// The name of a stage's module. A permutation of one pass has no second, and one that walks to no exact hit none that is given one; the
    /// name is then that of the first.
    #[must_use]
    pub fn module_name(&self, stage: Stage) -> String {
        match stage {
            Stage::Vertex => self.vertex().name(),
            Stage::Fragment => self.fragment().name(),
            Stage::SecondPass => self.second_pass().unwrap_or_else(|| self.fragment()).name(),
            Stage::FragmentCapture => format!("{}-capture", self.fragment().name()),
            Stage::FragmentGivenHit if self.canonical().relief == Relief::Exact => {
                format!("{}-given_hit", self.fragment().name())
            }
            Stage::FragmentGivenHit => self.fragment().name(),
        }
    }

    /// Every canonical feature set, in order.
    #[must_use]
    pub fn reachable() -> Vec<FeatureSet> {
        let mut sets = vec![FeatureSet::default()];
        vary(&mut sets, &Relief::ALL, |set, relief| set.relief = relief);
        vary(&mut sets, &Shading::ALL, |set, shading| set.shading = shading);
        vary(
            &mut sets,
            &[Normaliser::Arithmetic, Normaliser::Cube],
            |set, it| {
                set.normaliser = it;
            },
        );
        vary(
            &mut sets,
            &[NormalSource::Geometric, NormalSource::Map],
            |set, it| {
                set.normal = it;
            },
        );
        let lights = [Lights::None, Lights::Directional, Lights::Point, Lights::Many];
        vary(&mut sets, &lights, |set, it| set.lights = it);
        vary(&mut sets, &[Albedo::Constant, Albedo::Map], |set, it| {
            set.albedo = it
        });
        vary(&mut sets, &[Alpha::Opaque, Alpha::Mask], |set, it| set.alpha = it);
        vary(&mut sets, &[Transform::Rigid, Transform::General], |set, it| {
            set.transform = it;
        });
        vary(
            &mut sets,
            &[LightingSpace::World, LightingSpace::Object],
            |set, it| {
                set.space = it;
            },
        );
        vary(&mut sets, &[Form::Hardened, Form::Published], |set, it| {
            set.form = it
        });
        vary(&mut sets, &[false, true], |set, it| set.specular = it);
        vary(&mut sets, &[false, true], |set, it| set.environment = it);
        vary(&mut sets, &[false, true], |set, it| set.mirrored_uv = it);
        let canonical: BTreeSet<FeatureSet> = sets.into_iter().map(FeatureSet::canonical).collect();
        let mut sets: Vec<FeatureSet> = canonical.into_iter().collect();
        // Few sets have shadows or depth, so they are looked for among those that remain.
        vary(&mut sets, &Shadow::ALL, |set, shadow| set.shadow = shadow);
        vary(&mut sets, &[false, true], |set, it| set.pixel_depth = it);
        let canonical: BTreeSet<FeatureSet> = sets.into_iter().map(FeatureSet::canonical).collect();
        canonical.into_iter().collect()
    }
}

/// Every set with every value of one field.
fn vary<T: Copy>(sets: &mut Vec<FeatureSet>, values: &[T], change: impl Fn(&mut FeatureSet, T)) {
    let before = std::mem::take(sets);
    for one in before {
        for &value in values {
            let mut set = one;
            change(&mut set, value);
            sets.push(set);
        }
    }
}
