//! What a shader uses that not every target has: found in one pass when the shader is split, so that asking costs
//! nothing; where it is used is looked up only for a message.

use naga::proc::TypeResolution;
use naga::valid::FunctionInfo;
use naga::{Expression, ImageClass, Interpolation, Scalar, ScalarKind, Span, Statement, TypeInner};

use crate::ir;
use crate::shader::Unit;

/// A thing that a shader may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Feature {
    Float16,
    Float64,
    Int16,
    Int64,
    BindingArray,
    SamplerArray,
    ExternalTexture,
    RayQuery,
    CooperativeMatrix,
    Subgroup,
    TextureGather,
    DepthLoad,
    PerVertex,
    EarlyDepthTest,
    ClipDistances,
    Immediates,
    InvariantPosition,
}

impl Feature {
    pub(crate) const ALL: [Self; 17] = [
        Self::Float16,
        Self::Float64,
        Self::Int16,
        Self::Int64,
        Self::BindingArray,
        Self::SamplerArray,
        Self::ExternalTexture,
        Self::RayQuery,
        Self::CooperativeMatrix,
        Self::Subgroup,
        Self::TextureGather,
        Self::DepthLoad,
        Self::PerVertex,
        Self::EarlyDepthTest,
        Self::ClipDistances,
        Self::Immediates,
        Self::InvariantPosition,
    ];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Float16 => "16-bit floats (f16)",
            Self::Float64 => "64-bit floats (f64)",
            Self::Int16 => "16-bit integers",
            Self::Int64 => "64-bit integers",
            Self::BindingArray => "binding arrays",
            Self::SamplerArray => "arrays of samplers",
            Self::ExternalTexture => "external textures",
            Self::RayQuery => "ray queries",
            Self::CooperativeMatrix => "cooperative matrices",
            Self::Subgroup => "subgroup operations",
            Self::TextureGather => "textureGather",
            Self::DepthLoad => "textureLoad from depth textures",
            Self::PerVertex => "per-vertex interpolation",
            Self::EarlyDepthTest => "forced early depth tests",
            Self::ClipDistances => "clip distances",
            Self::Immediates => "push constants",
            Self::InvariantPosition => "an invariant position",
        }
    }

    const fn bit(self) -> u32 {
        1 << self as u32
    }

    /// Where the shader uses it first, as far as that can be said.
    pub(crate) fn find(self, unit: &Unit) -> Option<Span> {
        match self {
            Self::Float16 => find_scalar(unit, ScalarKind::Float, 2),
            Self::Float64 => find_scalar(unit, ScalarKind::Float, 8),
            Self::Int16 => find_integer(unit, 2),
            Self::Int64 => find_integer(unit, 8),
            Self::BindingArray => ir::find_type(unit, |t| matches!(t, TypeInner::BindingArray { .. })),
            Self::SamplerArray => find_sampler_array(unit),
            Self::ExternalTexture => ir::find_type(unit, |t| {
                matches!(
                    t,
                    TypeInner::Image {
                        class: ImageClass::External,
                        ..
                    }
                )
            }),
            Self::RayQuery => ir::find_type(unit, |t| {
                matches!(
                    t,
                    TypeInner::RayQuery { .. } | TypeInner::AccelerationStructure { .. }
                )
            }),
            Self::CooperativeMatrix => {
                ir::find_type(unit, |t| matches!(t, TypeInner::CooperativeMatrix { .. }))
            }
            Self::Subgroup => find_subgroup(unit),
            Self::TextureGather => ir::find_expression(unit, |e| {
                matches!(e, Expression::ImageSample { gather: Some(_), .. })
            }),
            Self::DepthLoad => find_depth_load(unit),
            Self::PerVertex => find_input(unit, |binding| {
                matches!(
                    binding,
                    naga::Binding::Location {
                        interpolation: Some(Interpolation::PerVertex),
                        ..
                    }
                )
            }),
            Self::EarlyDepthTest => unit.entry().early_depth_test.map(|_| Span::UNDEFINED),
            Self::ClipDistances => find_clip_distances(unit),
            Self::Immediates => crate::resources::immediates(unit)
                .map(|(handle, _)| unit.module.global_variables.get_span(handle)),
            Self::InvariantPosition => find_invariant(unit),
        }
    }
}

/// The features that an entry point uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Features(u32);

impl Features {
    pub(crate) const fn contains(self, feature: Feature) -> bool {
        self.0 & feature.bit() != 0
    }

    const fn insert(&mut self, feature: Feature) {
        self.0 |= feature.bit();
    }

    /// Everything that an entry point uses.
    pub(crate) fn of(unit: &Unit) -> Self {
        let mut used = Self::default();
        for (_, ty) in unit.module.types.iter() {
            used.add_type(unit, &ty.inner);
        }
        for (function, info) in ir::functions(unit) {
            for (handle, expression) in function.expressions.iter() {
                used.add_expression(expression);
                if is_depth_load(unit, info, expression) {
                    used.insert(Feature::DepthLoad);
                }
                // Types that are not values of their own are in the arena, which has been looked through.
                if let TypeResolution::Value(inner) = &info[handle].ty {
                    used.add_type(unit, inner);
                }
            }
        }
        for feature in [
            Feature::PerVertex,
            Feature::EarlyDepthTest,
            Feature::ClipDistances,
            Feature::Immediates,
            Feature::InvariantPosition,
        ] {
            if feature.find(unit).is_some() {
                used.insert(feature);
            }
        }
        used
    }

    fn add_type(&mut self, unit: &Unit, inner: &TypeInner) {
        if let Some(scalar) = ir::scalar_of(inner) {
            self.add_scalar(scalar);
        }
        match *inner {
            TypeInner::BindingArray { base, .. } => {
                self.insert(Feature::BindingArray);
                if matches!(unit.module.types[base].inner, TypeInner::Sampler { .. }) {
                    self.insert(Feature::SamplerArray);
                }
            }
            TypeInner::Image {
                class: ImageClass::External,
                ..
            } => self.insert(Feature::ExternalTexture),
            TypeInner::RayQuery { .. } | TypeInner::AccelerationStructure { .. } => {
                self.insert(Feature::RayQuery);
            }
            TypeInner::CooperativeMatrix { .. } => self.insert(Feature::CooperativeMatrix),
            _ => {}
        }
    }

    const fn add_scalar(&mut self, scalar: Scalar) {
        match (scalar.kind, scalar.width) {
            (ScalarKind::Float, 2) => self.insert(Feature::Float16),
            (ScalarKind::Float, 8) => self.insert(Feature::Float64),
            (ScalarKind::Sint | ScalarKind::Uint, 2) => self.insert(Feature::Int16),
            (ScalarKind::Sint | ScalarKind::Uint, 8) => self.insert(Feature::Int64),
            _ => {}
        }
    }

    const fn add_expression(&mut self, expression: &Expression) {
        match expression {
            Expression::ImageSample { gather: Some(_), .. } => self.insert(Feature::TextureGather),
            Expression::SubgroupBallotResult | Expression::SubgroupOperationResult { .. } => {
                self.insert(Feature::Subgroup);
            }
            _ => {}
        }
    }
}

fn find_scalar(unit: &Unit, kind: ScalarKind, width: u8) -> Option<Span> {
    ir::find_type(unit, |t| {
        ir::scalar_of(t).is_some_and(|s| s.kind == kind && s.width == width)
    })
}

fn find_integer(unit: &Unit, width: u8) -> Option<Span> {
    find_scalar(unit, ScalarKind::Sint, width).or_else(|| find_scalar(unit, ScalarKind::Uint, width))
}

fn find_sampler_array(unit: &Unit) -> Option<Span> {
    ir::find_type(unit, |t| {
        matches!(*t, TypeInner::BindingArray { base, .. }
            if matches!(unit.module.types[base].inner, TypeInner::Sampler { .. }))
    })
}

fn find_subgroup(unit: &Unit) -> Option<Span> {
    ir::find_statement(unit, |statement| {
        matches!(
            statement,
            Statement::SubgroupBallot { .. }
                | Statement::SubgroupGather { .. }
                | Statement::SubgroupCollectiveOperation { .. }
        )
    })
}

fn find_input(unit: &Unit, wanted: impl Fn(&naga::Binding) -> bool) -> Option<Span> {
    ir::interface(unit, false)
        .iter()
        .any(|(_, _, binding)| wanted(binding))
        .then_some(Span::UNDEFINED)
}

fn find_clip_distances(unit: &Unit) -> Option<Span> {
    ir::interface(unit, true)
        .iter()
        .any(|(_, _, b)| *b == naga::Binding::BuiltIn(naga::BuiltIn::ClipDistances))
        .then_some(Span::UNDEFINED)
}

fn find_invariant(unit: &Unit) -> Option<Span> {
    ir::interface(unit, true)
        .iter()
        .any(|(_, _, b)| *b == naga::Binding::BuiltIn(naga::BuiltIn::Position { invariant: true }))
        .then_some(Span::UNDEFINED)
}

fn is_depth_load(unit: &Unit, info: &FunctionInfo, expression: &Expression) -> bool {
    let Expression::ImageLoad { image, .. } = *expression else {
        return false;
    };
    matches!(
        info[image].ty.inner_with(&unit.module.types),
        TypeInner::Image {
            class: ImageClass::Depth { .. },
            ..
        }
    )
}

fn find_depth_load(unit: &Unit) -> Option<Span> {
    ir::functions(unit).find_map(|(function, info)| {
        let mut all = function.expressions.iter();
        all.find(|(_, expression)| is_depth_load(unit, info, expression))
            .map(|(handle, _)| function.expressions.get_span(handle))
    })
}
