//! Puts what a compiler of others numbered in its own way at the places of the source.
//!
//! HLSL links stages by semantics, and DXC counts locations in the order of declaration: each `LOCn` goes to location n. Formats of storage
//! images, which it guesses, become those of the source (`formats`); the buffer that stands for push constants becomes them (`push`).
//!
//! GLSL has one number for each of our (group, binding), and joins a texture and its sampler in one variable, which WebGPU's
//! bindings lack: such a variable becomes a texture and a sampler, joined again where they are read; functions that are handed one
//! read it themselves (`parameters`). Code and constants stay as they are.

use std::collections::BTreeMap;

use rspirv::binary::Assemble;
use rspirv::dr::{Instruction, Module, Operand};
use rspirv::spirv::{Decoration, Op, StorageClass, Word};

use crate::manifest::{Binding, Entry};

/// The module of DXC with every `LOCn` at location n, storage images in their formats, and push constants.
pub(super) fn hlsl(bytes: &[u8], entry: &Entry) -> Result<Vec<u8>, String> {
    let mut module = read(bytes)?;
    let locations: BTreeMap<Word, u32> = module.debug_names.iter().filter_map(semantic).collect();
    for annotation in &mut module.annotations {
        let location = target(annotation).and_then(|id| locations.get(&id));
        if let (Some(location), true) = (location, decorates(annotation, Decoration::Location)) {
            annotation.operands[2] = Operand::LiteralBit32(*location);
        }
    }
    super::formats::state(&mut module, entry)?;
    super::push::push(&mut module);
    Ok(bytes_of(&module))
}

/// Variable and n of the name `in.var.LOCn` or `out.var.LOCn`.
fn semantic(name: &Instruction) -> Option<(Word, u32)> {
    let [Operand::IdRef(id), Operand::LiteralString(name)] = &name.operands[..] else {
        return None;
    };
    let semantic = name
        .strip_prefix("in.var.")
        .or_else(|| name.strip_prefix("out.var."))?;
    Some((*id, semantic.strip_prefix("LOC")?.parse().ok()?))
}

/// The module of glslang with every resource at its group and binding.
pub(super) fn glsl(bytes: &[u8], entry: &Entry) -> Result<Vec<u8>, String> {
    let mut module = read(bytes)?;
    let places = places(&module, entry)?;
    move_resources(&mut module, &places);
    super::parameters::inline_textures(&mut module)?;
    Splitter::new(&mut module, entry, &places)?.run();
    Ok(bytes_of(&module))
}

/// The binding that each variable stands for: the one whose unit it has.
fn places<'a>(module: &Module, entry: &'a Entry) -> Result<BTreeMap<Word, &'a Binding>, String> {
    let units = module
        .annotations
        .iter()
        .filter(|one| decorates(one, Decoration::Binding));
    let place = |annotation: &Instruction| {
        let (Some(id), Some(Operand::LiteralBit32(unit))) = (target(annotation), annotation.operands.get(2))
        else {
            return Err("a binding without a number".to_owned());
        };
        let mut all = entry.bindings.iter();
        let found = all.find(|binding| {
            binding
                .glsl
                .as_ref()
                .is_some_and(|slot| slot.unit == *unit && slot.textures.is_empty())
        });
        let found =
            found.ok_or_else(|| format!("the manifest has nothing at unit {unit} of `{}`", entry.name))?;
        Ok((id, found))
    };
    units.map(place).collect()
}

fn move_resources(module: &mut Module, places: &BTreeMap<Word, &Binding>) {
    for annotation in &mut module.annotations {
        let Some(binding) = target(annotation).and_then(|id| places.get(&id)) else {
            continue;
        };
        if decorates(annotation, Decoration::Binding) {
            annotation.operands[2] = Operand::LiteralBit32(binding.binding);
        } else if decorates(annotation, Decoration::DescriptorSet) {
            annotation.operands[2] = Operand::LiteralBit32(binding.group);
        }
    }
}

/// A texture with a sampler, as two variables.
#[derive(Clone, Copy)]
struct Pair {
    /// The type of the two together.
    joined: Word,
    /// The type of the texture.
    image: Word,
    /// The variable of the sampler, where the texture is read with one.
    sampler: Option<Word>,
}

struct Splitter<'m> {
    module: &'m mut Module,
    /// By the variable that was both and is now the texture.
    pairs: BTreeMap<Word, Pair>,
    /// The variable of each sampler, by name: textures may share one.
    samplers: BTreeMap<String, Word>,
    sampler_type: Word,
}

impl<'m> Splitter<'m> {
    fn new(module: &'m mut Module, entry: &Entry, places: &BTreeMap<Word, &Binding>) -> Result<Self, String> {
        let sampler_type = fresh(module);
        let mut splitter = Self {
            module,
            pairs: BTreeMap::new(),
            samplers: BTreeMap::new(),
            sampler_type,
        };
        let joined = splitter.joined();
        if joined.is_empty() {
            return Ok(splitter);
        }
        let pointer = fresh(splitter.module);
        let mut globals = vec![
            instruction(Op::TypeSampler, None, Some(sampler_type), vec![]),
            pointer_to(pointer, sampler_type),
        ];
        for (variable, (joined, image)) in joined {
            let binding = places.get(&variable).ok_or("a texture without a binding")?;
            let sampler = splitter.declare_sampler(entry, binding, pointer, &mut globals)?;
            let texture = fresh(splitter.module);
            globals.push(pointer_to(texture, image));
            splitter.retype(variable, texture);
            let pair = Pair {
                joined,
                image,
                sampler,
            };
            splitter.pairs.insert(variable, pair);
        }
        splitter.declare(globals);
        Ok(splitter)
    }

    /// Every variable that is both a texture and a sampler, with its type and the texture's.
    fn joined(&self) -> BTreeMap<Word, (Word, Word)> {
        let of = |op: Op| {
            self.module
                .types_global_values
                .iter()
                .filter(move |one| one.class.opcode == op)
        };
        let images: BTreeMap<Word, Word> = of(Op::TypeSampledImage)
            .filter_map(|ty| Some((ty.result_id?, id(ty.operands.first()?)?)))
            .collect();
        let pointers: BTreeMap<Word, Word> = of(Op::TypePointer)
            .filter_map(|ty| Some((ty.result_id?, id(ty.operands.get(1)?)?)))
            .collect();
        of(Op::Variable)
            .filter_map(|variable| {
                let joined = *pointers.get(&variable.result_type?)?;
                Some((variable.result_id?, (joined, *images.get(&joined)?)))
            })
            .collect()
    }

    fn declare_sampler(
        &mut self,
        entry: &Entry,
        texture: &Binding,
        pointer: Word,
        globals: &mut Vec<Instruction>,
    ) -> Result<Option<Word>, String> {
        let Some(name) = texture.glsl.as_ref().and_then(|slot| slot.sampler.as_ref()) else {
            return Ok(None);
        };
        if let Some(known) = self.samplers.get(name) {
            return Ok(Some(*known));
        }
        let binding = entry.bindings.iter().find(|binding| &binding.name == name);
        let binding = binding.ok_or_else(|| format!("the manifest has no sampler `{name}`"))?;
        let sampler = fresh(self.module);
        self.samplers.insert(name.clone(), sampler);
        let class = Operand::StorageClass(StorageClass::UniformConstant);
        globals.push(instruction(
            Op::Variable,
            Some(pointer),
            Some(sampler),
            vec![class],
        ));
        for (decoration, number) in [
            (Decoration::DescriptorSet, binding.group),
            (Decoration::Binding, binding.binding),
        ] {
            let operands = vec![
                Operand::IdRef(sampler),
                Operand::Decoration(decoration),
                Operand::LiteralBit32(number),
            ];
            self.module
                .annotations
                .push(instruction(Op::Decorate, None, None, operands));
        }
        Ok(Some(sampler))
    }

    /// Gives a variable another type.
    fn retype(&mut self, variable: Word, pointer: Word) {
        let globals = &mut self.module.types_global_values;
        for global in globals
            .iter_mut()
            .filter(|global| global.result_id == Some(variable))
        {
            global.result_type = Some(pointer);
        }
    }

    /// Puts declarations before the first variable that needs them, behind the types that they need.
    fn declare(&mut self, globals: Vec<Instruction>) {
        let all = &mut self.module.types_global_values;
        let (variables, mut rest): (Vec<_>, Vec<_>) = std::mem::take(all)
            .into_iter()
            .partition(|global| global.result_id.is_some_and(|id| self.pairs.contains_key(&id)));
        rest.extend(globals);
        rest.extend(variables);
        *all = rest;
    }

    fn run(mut self) {
        let mut functions = std::mem::take(&mut self.module.functions);
        let blocks = functions.iter_mut().flat_map(|function| &mut function.blocks);
        for block in blocks {
            let instructions = std::mem::take(&mut block.instructions);
            let mut textures = BTreeMap::new();
            for one in instructions {
                self.rewrite(one, &mut textures, &mut block.instructions);
            }
        }
        self.module.functions = functions;
    }

    /// Writes an instruction again; `textures` maps what was loaded as both to the loaded texture.
    fn rewrite(&mut self, one: Instruction, textures: &mut BTreeMap<Word, Word>, to: &mut Vec<Instruction>) {
        let source = one.operands.first().and_then(id);
        let pair = source.and_then(|variable| self.pairs.get(&variable).copied());
        match (
            one.class.opcode,
            pair,
            source.and_then(|both| textures.get(&both).copied()),
        ) {
            (Op::Load, Some(pair), _) => {
                let texture = fresh(self.module);
                to.push(load(pair.image, texture, source));
                textures.extend(one.result_id.map(|both| (both, texture)));
                if pair.sampler.is_some() {
                    let sampler = fresh(self.module);
                    to.push(load(self.sampler_type, sampler, pair.sampler));
                    let operands = vec![Operand::IdRef(texture), Operand::IdRef(sampler)];
                    to.push(instruction(
                        Op::SampledImage,
                        Some(pair.joined),
                        one.result_id,
                        operands,
                    ));
                }
            }
            (Op::Image, _, Some(texture)) => {
                let operands = vec![Operand::IdRef(texture)];
                to.push(instruction(
                    Op::CopyObject,
                    one.result_type,
                    one.result_id,
                    operands,
                ));
            }
            _ => to.push(one),
        }
    }
}

fn load(ty: Word, result: Word, variable: Option<Word>) -> Instruction {
    let operands = variable.into_iter().map(Operand::IdRef).collect();
    instruction(Op::Load, Some(ty), Some(result), operands)
}

pub(super) fn pointer_to(result: Word, pointee: Word) -> Instruction {
    let class = Operand::StorageClass(StorageClass::UniformConstant);
    instruction(
        Op::TypePointer,
        None,
        Some(result),
        vec![class, Operand::IdRef(pointee)],
    )
}

pub(super) fn instruction(
    op: Op,
    ty: Option<Word>,
    result: Option<Word>,
    operands: Vec<Operand>,
) -> Instruction {
    Instruction::new(op, ty, result, operands)
}

pub(super) fn fresh(module: &mut Module) -> Word {
    module.header.as_mut().map_or(0, |header| {
        header.bound += 1;
        header.bound - 1
    })
}

pub(super) fn id(operand: &Operand) -> Option<Word> {
    match operand {
        Operand::IdRef(id) => Some(*id),
        _ => None,
    }
}

/// What an annotation is about.
pub(super) fn target(annotation: &Instruction) -> Option<Word> {
    annotation.operands.first().and_then(id)
}

pub(super) fn decorates(annotation: &Instruction, decoration: Decoration) -> bool {
    annotation.class.opcode == Op::Decorate
        && annotation.operands.get(1) == Some(&Operand::Decoration(decoration))
}

/// The group and binding that a variable is decorated with.
pub(super) fn place(module: &Module, variable: Word) -> Option<(u32, u32)> {
    let number = |decoration: Decoration| {
        let mut all = module.annotations.iter();
        let found = all.find(|one| target(one) == Some(variable) && decorates(one, decoration))?;
        match found.operands.get(2) {
            Some(Operand::LiteralBit32(number)) => Some(*number),
            _ => None,
        }
    };
    Some((number(Decoration::DescriptorSet)?, number(Decoration::Binding)?))
}

fn read(bytes: &[u8]) -> Result<Module, String> {
    let module = rspirv::dr::load_bytes(bytes)
        .map_err(|error| format!("what the compiler wrote is no SPIR-V: {error}"))?;
    if module.header.is_none() {
        return Err("what the compiler wrote has no header".to_owned());
    }
    Ok(module)
}

fn bytes_of(module: &Module) -> Vec<u8> {
    module
        .assemble()
        .iter()
        .flat_map(|word| word.to_le_bytes())
        .collect()
}
