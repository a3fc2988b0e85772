//! Changes to a module that mean nothing but keep naga's writers from a known fault.
//!
//! **Texture offsets.** naga 30.0.1's GLSL writer prints the offset of a texture sample as a constant expression of the
//! module while it is one of the function: for `vec2i(1)`, a splat, it looks up the type in the wrong table, and panics or
//! prints another type. The same value written out by components is printed right.

use naga::{Expression, Function, Handle, Module, Scalar, Span, Type, TypeInner, VectorSize};

/// Repairs a module; says whether anything was changed, so that it has to be analysed again.
pub(crate) fn repair(module: &mut Module) -> bool {
    let splats = splat_sizes(module);
    if splats.is_empty() {
        return false;
    }
    let types: Vec<(VectorSize, Handle<Type>)> = splats
        .into_iter()
        .map(|size| (size, signed_vector(module, size)))
        .collect();
    for (_, function) in module.functions.iter_mut() {
        spell_out_offsets(function, &types);
    }
    for entry in &mut module.entry_points {
        spell_out_offsets(&mut entry.function, &types);
    }
    true
}

/// The sizes of all offsets that are splats.
fn splat_sizes(module: &Module) -> Vec<VectorSize> {
    let functions = module.functions.iter().map(|(_, function)| function);
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    let mut sizes: Vec<VectorSize> = functions
        .chain(entries)
        .flat_map(|function| {
            splat_offsets(function)
                .map(|(_, size, _)| size)
                .collect::<Vec<_>>()
        })
        .collect();
    sizes.sort_unstable_by_key(|size| *size as u8);
    sizes.dedup();
    sizes
}

/// Offsets that are splats: where, how large, and of what.
fn splat_offsets(
    function: &Function,
) -> impl Iterator<Item = (Handle<Expression>, VectorSize, Handle<Expression>)> {
    function.expressions.iter().filter_map(|(_, expression)| {
        let Expression::ImageSample {
            offset: Some(offset), ..
        } = *expression
        else {
            return None;
        };
        match function.expressions[offset] {
            Expression::Splat { size, value } => Some((offset, size, value)),
            _ => None,
        }
    })
}

fn signed_vector(module: &mut Module, size: VectorSize) -> Handle<Type> {
    let ty = Type {
        name: None,
        inner: TypeInner::Vector {
            size,
            scalar: Scalar::I32,
        },
    };
    module.types.insert(ty, Span::UNDEFINED)
}

fn spell_out_offsets(function: &mut Function, types: &[(VectorSize, Handle<Type>)]) {
    let splats: Vec<_> = splat_offsets(function).collect();
    for (offset, size, value) in splats {
        if let Some((_, ty)) = types.iter().find(|(known, _)| *known == size) {
            function.expressions[offset] = Expression::Compose {
                ty: *ty,
                components: vec![value; size as usize],
            };
        }
    }
}
