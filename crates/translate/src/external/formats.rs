//! Storage images in the formats that the source states.
//!
//! HLSL has no words for them: in Direct3D the format is that of the view which is bound. DXC's SPIR-V has to state one, and guesses it from
//! the components, so that texels of four bytes are written as four floats. Here each variable gets an image type of its own format.

use std::collections::BTreeMap;

use rspirv::dr::{Instruction, Module, Operand};
use rspirv::spirv::{Capability, ImageFormat, Op, Word};

use super::relocate::{fresh, id, instruction, place, pointer_to};
use crate::manifest::Entry;

/// Where the format stands among the operands of an image type.
const FORMAT: usize = 6;

/// States the format of every storage image that the manifest describes.
pub(super) fn state(module: &mut Module, entry: &Entry) -> Result<(), String> {
    for (variable, format) in stated(module, entry) {
        let pointer = defined(module, variable).and_then(|variable| variable.result_type);
        let image = pointer
            .and_then(|pointer| defined(module, pointer))
            .and_then(|pointer| pointer.operands.get(1).and_then(id))
            .and_then(|pointee| defined(module, pointee))
            .filter(|pointee| pointee.class.opcode == Op::TypeImage)
            .cloned()
            .ok_or("a storage image that is no single image")?;
        if image.operands.get(FORMAT) != Some(&Operand::ImageFormat(format)) {
            let image = with_format(module, &image, format);
            retype(module, variable, image);
            demand(module, format);
        }
    }
    Ok(())
}

/// Variables with the formats of their bindings.
fn stated(module: &Module, entry: &Entry) -> BTreeMap<Word, ImageFormat> {
    let variables = module.types_global_values.iter();
    variables
        .filter(|one| one.class.opcode == Op::Variable)
        .filter_map(|one| {
            let variable = one.result_id?;
            let place = place(module, variable)?;
            let mut bindings = entry.bindings.iter();
            let binding = bindings.find(|binding| (binding.group, binding.binding) == place)?;
            let name = binding.texture.as_ref()?.format.as_deref()?;
            Some((variable, format(name)?))
        })
        .collect()
}

fn defined(module: &Module, id: Word) -> Option<&Instruction> {
    let mut all = module.types_global_values.iter();
    all.find(|one| one.result_id == Some(id))
}

/// The image type with another format: the module's own, where it has one, since no type may be declared twice.
fn with_format(module: &mut Module, image: &Instruction, format: ImageFormat) -> Word {
    let mut wanted = image.clone();
    wanted.operands[FORMAT] = Operand::ImageFormat(format);
    let mut all = module.types_global_values.iter();
    let known = all.find(|one| one.class.opcode == Op::TypeImage && one.operands == wanted.operands);
    if let Some(known) = known.and_then(|known| known.result_id) {
        return known;
    }
    let made = fresh(module);
    wanted.result_id = Some(made);
    let globals = &mut module.types_global_values;
    let at = globals
        .iter()
        .position(|one| one.result_id == image.result_id)
        .map_or(globals.len(), |at| at + 1);
    globals.insert(at, wanted);
    made
}

/// Gives a variable, and what is loaded from it, another image type. Nothing else among the globals names a variable, so it may stand last.
fn retype(module: &mut Module, variable: Word, image: Word) {
    let pointer = fresh(module);
    let globals = &mut module.types_global_values;
    globals.push(pointer_to(pointer, image));
    if let Some(at) = globals.iter().position(|one| one.result_id == Some(variable)) {
        let mut moved = globals.remove(at);
        moved.result_type = Some(pointer);
        globals.push(moved);
    }
    let functions = module.functions.iter_mut();
    let blocks = functions.flat_map(|function| &mut function.blocks);
    for one in blocks.flat_map(|block| &mut block.instructions) {
        if one.class.opcode == Op::Load && one.operands.first() == Some(&Operand::IdRef(variable)) {
            one.result_type = Some(image);
        }
    }
}

/// The capability that a format needs, if the module has not got it.
fn demand(module: &mut Module, format: ImageFormat) {
    let capability = Operand::Capability(Capability::StorageImageExtendedFormats);
    let is_there = module
        .capabilities
        .iter()
        .any(|one| one.operands.first() == Some(&capability));
    if !is_basic(format) && !is_there {
        let declared = instruction(Op::Capability, None, None, vec![capability]);
        module.capabilities.push(declared);
    }
}

/// Whether every shader may use it.
fn is_basic(format: ImageFormat) -> bool {
    use ImageFormat as F;
    matches!(
        format,
        F::Rgba32f
            | F::Rgba16f
            | F::R32f
            | F::Rgba8
            | F::Rgba8Snorm
            | F::Rgba32i
            | F::Rgba16i
            | F::Rgba8i
            | F::R32i
            | F::Rgba32ui
            | F::Rgba16ui
            | F::Rgba8ui
            | F::R32ui
    )
}

/// The format of WGSL's name; none for those that SPIR-V has no word for.
fn format(name: &str) -> Option<ImageFormat> {
    use ImageFormat as F;
    Some(match name {
        "r8unorm" => F::R8,
        "r8snorm" => F::R8Snorm,
        "r8uint" => F::R8ui,
        "r8sint" => F::R8i,
        "r16unorm" => F::R16,
        "r16snorm" => F::R16Snorm,
        "r16uint" => F::R16ui,
        "r16sint" => F::R16i,
        "r16float" => F::R16f,
        "rg8unorm" => F::Rg8,
        "rg8snorm" => F::Rg8Snorm,
        "rg8uint" => F::Rg8ui,
        "rg8sint" => F::Rg8i,
        "r32uint" => F::R32ui,
        "r32sint" => F::R32i,
        "r32float" => F::R32f,
        "rg16unorm" => F::Rg16,
        "rg16snorm" => F::Rg16Snorm,
        "rg16uint" => F::Rg16ui,
        "rg16sint" => F::Rg16i,
        "rg16float" => F::Rg16f,
        "rgba8unorm" => F::Rgba8,
        "rgba8snorm" => F::Rgba8Snorm,
        "rgba8uint" => F::Rgba8ui,
        "rgba8sint" => F::Rgba8i,
        "rgb10a2uint" => F::Rgb10a2ui,
        "rgb10a2unorm" => F::Rgb10A2,
        "rg11b10ufloat" => F::R11fG11fB10f,
        "rg32uint" => F::Rg32ui,
        "rg32sint" => F::Rg32i,
        "rg32float" => F::Rg32f,
        "rgba16unorm" => F::Rgba16,
        "rgba16snorm" => F::Rgba16Snorm,
        "rgba16uint" => F::Rgba16ui,
        "rgba16sint" => F::Rgba16i,
        "rgba16float" => F::Rgba16f,
        "rgba32uint" => F::Rgba32ui,
        "rgba32sint" => F::Rgba32i,
        "rgba32float" => F::Rgba32f,
        _ => return None,
    })
}
