//! Changes to SPIR-V that mean nothing but keep naga's reader from a known fault.
//!
//! **Layers.** naga 30.0.1 takes the layer off the coordinates of an array of images, and panics where the module lacks the type of what
//! is left. It declares that type for floats; of integers, with which storage images are addressed, compilers declare no more than the
//! whole coordinates. A type that nothing else uses changes nothing.

use rspirv::binary::Assemble;
use rspirv::dr::{Instruction, Module, Operand};
use rspirv::spirv::{Dim, Op, Word};

/// The module with the types that naga's reader looks for; `None` where it lacks none, or is no module at all, which the reader will say.
pub(crate) fn repaired(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut module = rspirv::dr::load_bytes(bytes).ok()?;
    let lacking = lacking(&module);
    if lacking.is_empty() {
        return None;
    }
    for (scalar, size) in lacking {
        let header = module.header.as_mut()?;
        let made = header.bound;
        header.bound += 1;
        let operands = vec![Operand::IdRef(scalar), Operand::LiteralBit32(size)];
        let vector = Instruction::new(Op::TypeVector, None, Some(made), operands);
        module.types_global_values.push(vector);
    }
    let words = module.assemble();
    Some(words.iter().flat_map(|word| word.to_le_bytes()).collect())
}

/// Vectors of integers without a type: scalar and size, for each shape of which there are arrays.
fn lacking(module: &Module) -> Vec<(Word, u32)> {
    let of = |op: Op| {
        let all = module.types_global_values.iter();
        all.filter(move |one| one.class.opcode == op)
    };
    let mut sizes: Vec<u32> = of(Op::TypeImage).filter_map(without_layer).collect();
    sizes.sort_unstable();
    sizes.dedup();
    let is_declared = |scalar: Word, size: u32| {
        let operands = [Operand::IdRef(scalar), Operand::LiteralBit32(size)];
        of(Op::TypeVector).any(|vector| vector.operands == operands)
    };
    let scalars = of(Op::TypeInt).filter(|int| int.operands.first() == Some(&Operand::LiteralBit32(32)));
    scalars
        .filter_map(|int| int.result_id)
        .flat_map(|scalar| sizes.iter().map(move |size| (scalar, *size)))
        .filter(|(scalar, size)| !is_declared(*scalar, *size))
        .collect()
}

/// How many coordinates an array of images has besides the layer, where that is a vector.
fn without_layer(image: &Instruction) -> Option<u32> {
    match (image.operands.get(1)?, image.operands.get(3)?) {
        (Operand::Dim(Dim::Dim2D), Operand::LiteralBit32(1)) => Some(2),
        (Operand::Dim(Dim::DimCube), Operand::LiteralBit32(1)) => Some(3),
        _ => None,
    }
}
