//! The resources of an entry point: what each back end assigns slots to and the manifest lists.

use naga::valid::GlobalUse;
use naga::{AddressSpace, ArraySize, GlobalVariable, Handle, ImageClass, StorageAccess, Type, TypeInner};

use crate::manifest::Kind;
use crate::shader::Unit;

/// A variable with a group and a binding.
#[derive(Clone, Debug)]
pub(crate) struct Resource {
    pub(crate) handle: Handle<GlobalVariable>,
    pub(crate) name: String,
    pub(crate) group: u32,
    pub(crate) binding: u32,
    pub(crate) kind: Kind,
    /// The type of the variable, or of one element of a binding array.
    pub(crate) ty: Handle<Type>,
    /// Number of elements of a binding array, 0 if it is unsized.
    pub(crate) count: Option<u32>,
    /// How the entry point uses it; empty if it only mentions it.
    pub(crate) usage: GlobalUse,
}

impl Resource {
    pub(crate) const fn key(&self) -> (u32, u32) {
        (self.group, self.binding)
    }

    pub(crate) const fn naga_key(&self) -> naga::ResourceBinding {
        naga::ResourceBinding {
            group: self.group,
            binding: self.binding,
        }
    }
}

/// All resources of a unit, by group and binding.
pub(crate) fn resources(unit: &Unit) -> Vec<Resource> {
    let mut found: Vec<Resource> = unit
        .module
        .global_variables
        .iter()
        .filter_map(|(handle, variable)| resource(unit, handle, variable))
        .collect();
    found.sort_by_key(Resource::key);
    found
}

fn resource(unit: &Unit, handle: Handle<GlobalVariable>, variable: &GlobalVariable) -> Option<Resource> {
    let at = variable.binding?;
    let (ty, count) = element(unit, variable.ty);
    Some(Resource {
        handle,
        name: variable.name.clone().unwrap_or_default(),
        group: at.group,
        binding: at.binding,
        kind: kind(unit, variable.space, ty)?,
        ty,
        count,
        usage: unit.entry_info()[handle],
    })
}

fn element(unit: &Unit, ty: Handle<Type>) -> (Handle<Type>, Option<u32>) {
    match unit.module.types[ty].inner {
        TypeInner::BindingArray { base, size } => {
            let count = match size {
                ArraySize::Constant(count) => count.get(),
                ArraySize::Pending(_) | ArraySize::Dynamic => 0,
            };
            (base, Some(count))
        }
        _ => (ty, None),
    }
}

fn kind(unit: &Unit, space: AddressSpace, ty: Handle<Type>) -> Option<Kind> {
    match space {
        AddressSpace::Uniform => Some(Kind::UniformBuffer),
        AddressSpace::Storage { access } if access.contains(StorageAccess::STORE) => {
            Some(Kind::StorageBuffer)
        }
        AddressSpace::Storage { .. } => Some(Kind::ReadOnlyStorageBuffer),
        AddressSpace::Handle => match unit.module.types[ty].inner {
            TypeInner::Sampler { comparison: false } => Some(Kind::Sampler),
            TypeInner::Sampler { comparison: true } => Some(Kind::ComparisonSampler),
            TypeInner::Image { class, .. } => Some(image_kind(class)),
            _ => None,
        },
        AddressSpace::Function
        | AddressSpace::Private
        | AddressSpace::WorkGroup
        | AddressSpace::Immediate
        | AddressSpace::TaskPayload
        | AddressSpace::RayPayload
        | AddressSpace::IncomingRayPayload => None,
    }
}

const fn image_kind(class: ImageClass) -> Kind {
    match class {
        ImageClass::Sampled { .. } | ImageClass::External => Kind::Texture,
        ImageClass::Depth { .. } => Kind::DepthTexture,
        ImageClass::Storage { .. } => Kind::StorageTexture,
    }
}

/// The push constants of a unit.
pub(crate) fn immediates(unit: &Unit) -> Option<(Handle<GlobalVariable>, &GlobalVariable)> {
    unit.module
        .global_variables
        .iter()
        .find(|(_, variable)| variable.space == AddressSpace::Immediate)
}

/// Whether the size of a buffer of this type is known only when it is bound.
pub(crate) fn is_runtime_sized(unit: &Unit, ty: Handle<Type>) -> bool {
    match &unit.module.types[ty].inner {
        TypeInner::Array { size, .. } => matches!(size, ArraySize::Dynamic),
        TypeInner::Struct { members, .. } => {
            members.last().is_some_and(|last| is_runtime_sized(unit, last.ty))
        }
        _ => false,
    }
}
