//! Push constants, which HLSL holds in a constant buffer.
//!
//! In Direct3D a root signature puts the constants of a register into the command list, and no shader says so. DXC gives the register a
//! uniform buffer, which here becomes what SPIR-V calls push constants.

use std::collections::BTreeMap;

use rspirv::dr::{Module, Operand};
use rspirv::spirv::{Decoration, Op, StorageClass, Word};

use super::relocate::{decorates, fresh, id, place, target};

/// The group and binding that the buffer gets for the while: a group that no entry point has.
pub(super) const PLACE: (u32, u32) = (31, 0);

/// Makes push constants of the uniform buffer at [`PLACE`]; nothing where there is none.
pub(super) fn push(module: &mut Module) {
    let globals = module.types_global_values.iter();
    let mut variables = globals
        .filter(|one| one.class.opcode == Op::Variable)
        .filter_map(|one| one.result_id);
    let Some(variable) = variables.find(|variable| place(module, *variable) == Some(PLACE)) else {
        return;
    };
    module.annotations.retain(|one| {
        let places = decorates(one, Decoration::DescriptorSet) || decorates(one, Decoration::Binding);
        target(one) != Some(variable) || !places
    });
    let pointers = pointers(module);
    let globals = &mut module.types_global_values;
    if let Some(at) = globals.iter().position(|one| one.result_id == Some(variable)) {
        let mut moved = globals.remove(at);
        moved.operands[0] = Operand::StorageClass(StorageClass::PushConstant);
        moved.result_type = moved.result_type.and_then(|ty| pointers.get(&ty).copied());
        globals.push(moved);
    }
    follow(module, variable, &pointers);
}

/// For each type of a pointer to uniforms one of a pointer to push constants, which is declared.
fn pointers(module: &mut Module) -> BTreeMap<Word, Word> {
    let uniform = Operand::StorageClass(StorageClass::Uniform);
    let all: Vec<_> = module
        .types_global_values
        .iter()
        .filter(|one| one.class.opcode == Op::TypePointer && one.operands.first() == Some(&uniform))
        .cloned()
        .collect();
    let mut twins = BTreeMap::new();
    for mut pointer in all {
        let twin = fresh(module);
        twins.extend(pointer.result_id.map(|known| (known, twin)));
        pointer.result_id = Some(twin);
        pointer.operands[0] = Operand::StorageClass(StorageClass::PushConstant);
        module.types_global_values.push(pointer);
    }
    twins
}

/// Gives what points into the variable the types that its own has. Blocks stand in an order in which nothing is used before it is defined.
fn follow(module: &mut Module, variable: Word, pointers: &BTreeMap<Word, Word>) {
    let mut within = vec![variable];
    let functions = module.functions.iter_mut();
    let blocks = functions.flat_map(|function| &mut function.blocks);
    for one in blocks.flat_map(|block| &mut block.instructions) {
        let points = matches!(
            one.class.opcode,
            Op::AccessChain | Op::InBoundsAccessChain | Op::CopyObject
        );
        let base = one.operands.first().and_then(id);
        if points && base.is_some_and(|base| within.contains(&base)) {
            one.result_type = one.result_type.and_then(|ty| pointers.get(&ty).copied());
            within.extend(one.result_id);
        }
    }
}
