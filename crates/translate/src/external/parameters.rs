//! Takes textures out of the parameters of functions, where each is always called with the same one.
//!
//! glslang hands a texture that is joined with its sampler to a function as a pointer. Taken apart, it would be two parameters; but
//! what our shaders hand on is always a resource of the module, so that the function may as well read that. Where one function is
//! called with different textures, that is an error.

use std::collections::{BTreeMap, BTreeSet};

use rspirv::dr::{Function, Instruction, Module, Operand};
use rspirv::spirv::{Op, Word};

/// A function's parameter: the function and which one.
type Place = (Word, usize);

/// Replaces every parameter that is a pointer to a joined texture by the variable that it always is.
pub(super) fn inline_textures(module: &mut Module) -> Result<(), String> {
    let parameters = texture_parameters(module);
    let variables = variables(module, &parameters)?;
    if variables.is_empty() {
        return Ok(());
    }
    let gone: BTreeSet<Place> = variables.keys().map(|id| parameters[id]).collect();
    let mut functions = std::mem::take(&mut module.functions);
    for function in &mut functions {
        drop_parameters(module, function, &variables);
        for one in function
            .blocks
            .iter_mut()
            .flat_map(|block| &mut block.instructions)
        {
            rewrite(one, &variables, &gone);
        }
    }
    module.functions = functions;
    let named = |one: &Instruction| {
        one.operands
            .first()
            .and_then(id)
            .is_some_and(|id| variables.contains_key(&id))
    };
    module.debug_names.retain(|one| !named(one));
    module.annotations.retain(|one| !named(one));
    Ok(())
}

/// The parameters that point to a texture joined with its sampler.
fn texture_parameters(module: &Module) -> BTreeMap<Word, Place> {
    let declared = |op: Op| {
        module
            .types_global_values
            .iter()
            .filter(move |one| one.class.opcode == op)
    };
    let joined: BTreeSet<Word> = declared(Op::TypeSampledImage)
        .filter_map(|one| one.result_id)
        .collect();
    let pointers: BTreeSet<Word> = declared(Op::TypePointer)
        .filter(|one| {
            one.operands
                .get(1)
                .and_then(id)
                .is_some_and(|to| joined.contains(&to))
        })
        .filter_map(|one| one.result_id)
        .collect();
    let of = |function: &Function| {
        let number = function.def.as_ref().and_then(|def| def.result_id);
        let all = function.parameters.iter().enumerate();
        all.filter(|(_, one)| one.result_type.is_some_and(|ty| pointers.contains(&ty)))
            .filter_map(|(at, one)| Some((one.result_id?, (number?, at))))
            .collect::<Vec<_>>()
    };
    module.functions.iter().flat_map(of).collect()
}

/// The variable that each of these parameters always is; nothing for those of functions that nobody calls.
fn variables(module: &Module, parameters: &BTreeMap<Word, Place>) -> Result<BTreeMap<Word, Word>, String> {
    let calls: Vec<&Instruction> = module
        .functions
        .iter()
        .flat_map(|function| &function.blocks)
        .flat_map(|block| &block.instructions)
        .filter(|one| one.class.opcode == Op::FunctionCall)
        .collect();
    let mut found = BTreeMap::new();
    // SPIR-V has no recursion: what a parameter is follows from the callers in as many rounds as calls nest.
    for _ in 0..=parameters.len() {
        for (parameter, (function, at)) in parameters {
            for call in calls
                .iter()
                .filter(|call| call.operands.first().and_then(id) == Some(*function))
            {
                let Some(argument) = call.operands.get(at + 1).and_then(id) else {
                    continue;
                };
                let root = if parameters.contains_key(&argument) {
                    found.get(&argument).copied()
                } else {
                    Some(argument)
                };
                let Some(root) = root else { continue };
                if found.insert(*parameter, root).is_some_and(|other| other != root) {
                    return Err(
                        "a function is called with different textures, which one binding cannot stand for"
                            .to_owned(),
                    );
                }
            }
        }
    }
    Ok(found)
}

/// Gives a function the type that it has without them.
fn drop_parameters(module: &mut Module, function: &mut Function, variables: &BTreeMap<Word, Word>) {
    let stays = |one: &Instruction| one.result_id.is_none_or(|id| !variables.contains_key(&id));
    if function.parameters.iter().all(stays) {
        return;
    }
    function.parameters.retain(stays);
    let Some(def) = &mut function.def else { return };
    let types = def
        .result_type
        .into_iter()
        .chain(function.parameters.iter().filter_map(|one| one.result_type));
    let operands: Vec<Operand> = types.map(Operand::IdRef).collect();
    let same = |one: &&Instruction| one.class.opcode == Op::TypeFunction && one.operands == operands;
    let known = module
        .types_global_values
        .iter()
        .find(same)
        .and_then(|one| one.result_id);
    let ty = known.unwrap_or_else(|| {
        let fresh = super::relocate::fresh(module);
        module.types_global_values.push(Instruction::new(
            Op::TypeFunction,
            None,
            Some(fresh),
            operands.clone(),
        ));
        fresh
    });
    if let Some(last) = def.operands.last_mut() {
        *last = Operand::IdRef(ty);
    }
}

/// Reads the variable, and hands nothing on that is no longer taken.
fn rewrite(one: &mut Instruction, variables: &BTreeMap<Word, Word>, gone: &BTreeSet<Place>) {
    if one.class.opcode == Op::FunctionCall {
        let function = one.operands.first().and_then(id);
        let mut at = 0;
        one.operands.retain(|_| {
            at += 1;
            at == 1 || function.is_none_or(|function| !gone.contains(&(function, at - 2)))
        });
    }
    for operand in &mut one.operands {
        if let Some(variable) = id(operand).and_then(|id| variables.get(&id)) {
            *operand = Operand::IdRef(*variable);
        }
    }
}

fn id(operand: &Operand) -> Option<Word> {
    match operand {
        Operand::IdRef(id) => Some(*id),
        _ => None,
    }
}
