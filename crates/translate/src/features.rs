//! What a shader uses that not every target has: found in one pass when the shader is split, so that asking costs
//! nothing; where it is used is looked up only for a message.

use naga::proc::TypeResolution;
use naga::valid::FunctionInfo;
use naga::{
    BuiltIn, Expression, ImageClass, Interpolation, Scalar, ScalarKind, Span, Statement, StorageAccess,
    TypeInner,
};

use crate::ir;
use crate::shader::Unit;

/// A thing that a shader may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Feature {
    Float16,
    Float64,
    Int16,
    Int64,
    NestedArray,
    BindingArray,
    SamplerArray,
    ExternalTexture,
    RayQuery,
    CooperativeMatrix,
    /// Subgroup operations and built-in values.
    Subgroup,
    /// Subgroup built-in values in a shader without a subgroup operation.
    LoneSubgroupValue,
    TextureGather,
    TextureAtomic,
    /// Loading, sampling or gathering from a depth texture without a reference.
    DepthRead,
    /// A storage texture format that OpenGL ES has no name for.
    StorageFormat,
    PerVertex,
    EarlyDepthTest,
    ClipDistances,
    SampleMask,
    Barycentric,
    PrimitiveIndex,
    ViewIndex,
    Immediates,
    InvariantPosition,
}

impl Feature {
    pub(crate) const ALL: [Self; 25] = [
        Self::Float16,
        Self::Float64,
        Self::Int16,
        Self::Int64,
        Self::NestedArray,
        Self::BindingArray,
        Self::SamplerArray,
        Self::ExternalTexture,
        Self::RayQuery,
        Self::CooperativeMatrix,
        Self::Subgroup,
        Self::LoneSubgroupValue,
        Self::TextureGather,
        Self::TextureAtomic,
        Self::DepthRead,
        Self::StorageFormat,
        Self::PerVertex,
        Self::EarlyDepthTest,
        Self::ClipDistances,
        Self::SampleMask,
        Self::Barycentric,
        Self::PrimitiveIndex,
        Self::ViewIndex,
        Self::Immediates,
        Self::InvariantPosition,
    ];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Float16 => "16-bit floats (f16)",
            Self::Float64 => "64-bit floats (f64)",
            Self::Int16 => "16-bit integers",
            Self::Int64 => "64-bit integers",
            Self::NestedArray => "arrays of arrays",
            Self::BindingArray => "binding arrays",
            Self::SamplerArray => "arrays of samplers",
            Self::ExternalTexture => "external textures",
            Self::RayQuery => "ray queries",
            Self::CooperativeMatrix => "cooperative matrices",
            Self::Subgroup => "subgroup operations",
            Self::LoneSubgroupValue => "subgroup values without a subgroup operation",
            Self::TextureGather => "textureGather",
            Self::TextureAtomic => "texture atomics",
            Self::DepthRead => "reading a depth texture without comparison",
            Self::StorageFormat => "storage textures of this format",
            Self::PerVertex => "per-vertex interpolation",
            Self::EarlyDepthTest => "forced early depth tests",
            Self::ClipDistances => "clip distances",
            Self::SampleMask => "sample masks",
            Self::Barycentric => "barycentric coordinates",
            Self::PrimitiveIndex => "the primitive index",
            Self::ViewIndex => "the view index",
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
            Self::NestedArray => ir::find_type(unit, |t| is_nested_array(unit, t)),
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
            Self::Subgroup => find_subgroup(unit).or_else(|| find_builtin(unit, is_subgroup_value)),
            Self::LoneSubgroupValue if find_subgroup(unit).is_some() => None,
            Self::LoneSubgroupValue => find_builtin(unit, is_subgroup_value),
            Self::TextureGather => ir::find_expression(unit, |e| {
                matches!(e, Expression::ImageSample { gather: Some(_), .. })
            }),
            Self::TextureAtomic => ir::find_statement(unit, |s| matches!(s, Statement::ImageAtomic { .. })),
            Self::DepthRead => find_depth_read(unit),
            Self::StorageFormat => ir::find_type(unit, has_format_beyond_es),
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
            Self::ClipDistances => find_builtin(unit, |b| b == BuiltIn::ClipDistances),
            Self::SampleMask => find_builtin(unit, |b| b == BuiltIn::SampleMask),
            Self::Barycentric => find_builtin(unit, |b| matches!(b, BuiltIn::Barycentric { .. })),
            Self::PrimitiveIndex => find_builtin(unit, |b| b == BuiltIn::PrimitiveIndex),
            Self::ViewIndex => find_builtin(unit, |b| b == BuiltIn::ViewIndex),
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
    /// Features that are found by looking through little: inputs, outputs, a variable.
    const OF_THE_INTERFACE: [Feature; 9] = [
        Feature::PerVertex,
        Feature::EarlyDepthTest,
        Feature::ClipDistances,
        Feature::SampleMask,
        Feature::Barycentric,
        Feature::PrimitiveIndex,
        Feature::ViewIndex,
        Feature::Immediates,
        Feature::InvariantPosition,
    ];

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
                if is_depth_read(unit, info, expression) {
                    used.insert(Feature::DepthRead);
                }
                // Types that are not values of their own are in the arena, which has been looked through.
                if let TypeResolution::Value(inner) = &info[handle].ty {
                    used.add_type(unit, inner);
                }
            }
        }
        for feature in Self::OF_THE_INTERFACE {
            if feature.find(unit).is_some() {
                used.insert(feature);
            }
        }
        used.add_subgroup_values(unit);
        used
    }

    fn add_subgroup_values(&mut self, unit: &Unit) {
        if find_builtin(unit, is_subgroup_value).is_none() {
            return;
        }
        if !self.contains(Feature::Subgroup) {
            self.insert(Feature::LoneSubgroupValue);
        }
        self.insert(Feature::Subgroup);
    }

    fn add_type(&mut self, unit: &Unit, inner: &TypeInner) {
        if let Some(scalar) = ir::scalar_of(inner) {
            self.add_scalar(scalar);
        }
        if is_nested_array(unit, inner) {
            self.insert(Feature::NestedArray);
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
            TypeInner::Image {
                class: ImageClass::Storage { access, .. },
                ..
            } => {
                if has_format_beyond_es(inner) {
                    self.insert(Feature::StorageFormat);
                }
                if access.contains(StorageAccess::ATOMIC) {
                    self.insert(Feature::TextureAtomic);
                }
            }
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

/// Built-in values have no place of their own in the IR.
fn find_builtin(unit: &Unit, wanted: impl Fn(BuiltIn) -> bool) -> Option<Span> {
    let read = ir::interface(unit, false);
    let written = ir::interface(unit, true);
    let mut all = read.iter().chain(&written);
    all.any(|(_, _, binding)| matches!(*binding, naga::Binding::BuiltIn(builtin) if wanted(builtin)))
        .then_some(Span::UNDEFINED)
}

const fn is_subgroup_value(builtin: BuiltIn) -> bool {
    matches!(
        builtin,
        BuiltIn::SubgroupId | BuiltIn::SubgroupSize | BuiltIn::SubgroupInvocationId | BuiltIn::NumSubgroups
    )
}

fn is_nested_array(unit: &Unit, inner: &TypeInner) -> bool {
    matches!(*inner, TypeInner::Array { base, .. }
        if matches!(unit.module.types[base].inner, TypeInner::Array { .. }))
}

/// OpenGL ES 3.1 names thirteen formats; the others come with an extension of one vendor.
const fn has_format_beyond_es(inner: &TypeInner) -> bool {
    use naga::StorageFormat as F;
    let TypeInner::Image {
        class: ImageClass::Storage { format, .. },
        ..
    } = inner
    else {
        return false;
    };
    !matches!(
        format,
        F::Rgba32Float
            | F::Rgba16Float
            | F::R32Float
            | F::Rgba8Unorm
            | F::Rgba8Snorm
            | F::Rgba32Sint
            | F::Rgba16Sint
            | F::Rgba8Sint
            | F::R32Sint
            | F::Rgba32Uint
            | F::Rgba16Uint
            | F::Rgba8Uint
            | F::R32Uint
    )
}

fn find_invariant(unit: &Unit) -> Option<Span> {
    ir::interface(unit, true)
        .iter()
        .any(|(_, _, b)| *b == naga::Binding::BuiltIn(BuiltIn::Position { invariant: true }))
        .then_some(Span::UNDEFINED)
}

fn is_depth_read(unit: &Unit, info: &FunctionInfo, expression: &Expression) -> bool {
    let (Expression::ImageLoad { image, .. }
    | Expression::ImageSample {
        image,
        depth_ref: None,
        ..
    }) = *expression
    else {
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

fn find_depth_read(unit: &Unit) -> Option<Span> {
    ir::functions(unit).find_map(|(function, info)| {
        let mut all = function.expressions.iter();
        all.find(|(_, expression)| is_depth_read(unit, info, expression))
            .map(|(handle, _)| function.expressions.get_span(handle))
    })
}
