//! Types in WGSL's words, for the manifest.

use naga::common::wgsl::{ToWgsl, TryToWgsl};
use naga::{
    ArraySize, Handle, ImageClass, ImageDimension, Module, Scalar, ScalarKind, Type, TypeInner, VectorSize,
};

/// The name of a type as it would be written in WGSL; structs by their own name.
pub(crate) fn type_name(module: &Module, handle: Handle<Type>) -> String {
    let ty = &module.types[handle];
    match ty.inner {
        TypeInner::Scalar(scalar) => scalar_name(scalar),
        TypeInner::Atomic(scalar) => format!("atomic<{}>", scalar_name(scalar)),
        TypeInner::Vector { size, scalar } => vector_name(size, scalar),
        TypeInner::Matrix {
            columns,
            rows,
            scalar,
        } => format!("mat{}x{}<{}>", columns as u8, rows as u8, scalar_name(scalar)),
        TypeInner::Array { base, size, .. } => array_name("array", module, base, size),
        TypeInner::BindingArray { base, size } => array_name("binding_array", module, base, size),
        TypeInner::Struct { .. } => ty.name.clone().unwrap_or_else(|| "struct".to_owned()),
        TypeInner::Image { dim, arrayed, class } => image_name(dim, arrayed, class),
        TypeInner::Sampler { comparison: false } => "sampler".to_owned(),
        TypeInner::Sampler { comparison: true } => "sampler_comparison".to_owned(),
        TypeInner::Pointer { .. }
        | TypeInner::ValuePointer { .. }
        | TypeInner::CooperativeMatrix { .. }
        | TypeInner::AccelerationStructure { .. }
        | TypeInner::RayQuery { .. } => format!("{:?}", ty.inner),
    }
}

/// `f32`, `u32`, …
pub(crate) fn scalar_name(scalar: Scalar) -> String {
    let bits = u32::from(scalar.width) * 8;
    match scalar.kind {
        ScalarKind::Bool => "bool".to_owned(),
        ScalarKind::Float => format!("f{bits}"),
        ScalarKind::Sint => format!("i{bits}"),
        ScalarKind::Uint => format!("u{bits}"),
        ScalarKind::AbstractInt => "abstract-int".to_owned(),
        ScalarKind::AbstractFloat => "abstract-float".to_owned(),
    }
}

fn vector_name(size: VectorSize, scalar: Scalar) -> String {
    format!("vec{}<{}>", size as u8, scalar_name(scalar))
}

fn array_name(word: &str, module: &Module, base: Handle<Type>, size: ArraySize) -> String {
    let element = type_name(module, base);
    match size {
        ArraySize::Constant(count) => format!("{word}<{element}, {count}>"),
        ArraySize::Pending(_) | ArraySize::Dynamic => format!("{word}<{element}>"),
    }
}

fn image_name(dim: ImageDimension, arrayed: bool, class: ImageClass) -> String {
    let shape = format!("{}{}", dimension(dim), if arrayed { "_array" } else { "" });
    match class {
        ImageClass::Sampled { kind, multi } => {
            let multisampled = if multi { "multisampled_" } else { "" };
            format!("texture_{multisampled}{shape}<{}>", sample_type(kind))
        }
        ImageClass::Depth { multi: false } => format!("texture_depth_{shape}"),
        ImageClass::Depth { multi: true } => format!("texture_depth_multisampled_{shape}"),
        ImageClass::External => "texture_external".to_owned(),
        ImageClass::Storage { format, access } => {
            format!(
                "texture_storage_{shape}<{}, {}>",
                format.to_wgsl(),
                access_name(access)
            )
        }
    }
}

/// `1d`, `2d`, `3d` or `cube`.
pub(crate) const fn dimension(dim: ImageDimension) -> &'static str {
    match dim {
        ImageDimension::D1 => "1d",
        ImageDimension::D2 => "2d",
        ImageDimension::D3 => "3d",
        ImageDimension::Cube => "cube",
    }
}

/// The 32-bit type that texels of this kind are read as.
pub(crate) const fn sample_type(kind: ScalarKind) -> &'static str {
    match kind {
        ScalarKind::Sint => "i32",
        ScalarKind::Uint => "u32",
        ScalarKind::Float | ScalarKind::Bool | ScalarKind::AbstractInt | ScalarKind::AbstractFloat => "f32",
    }
}

/// WGSL's word for how a storage texture is used.
pub(crate) const fn access_name(access: naga::StorageAccess) -> &'static str {
    use naga::StorageAccess as A;
    if access.contains(A::ATOMIC) {
        "atomic"
    } else if access.contains(A::LOAD.union(A::STORE)) {
        "read_write"
    } else if access.contains(A::STORE) {
        "write"
    } else {
        "read"
    }
}

/// WGSL's name of a built-in value, or naga's where WGSL has none.
pub(crate) fn builtin_name(builtin: naga::BuiltIn) -> String {
    builtin
        .try_to_wgsl()
        .map_or_else(|| format!("{builtin:?}"), str::to_owned)
}
