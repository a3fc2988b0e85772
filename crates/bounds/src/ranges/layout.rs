//! What an entry point reads, scalar by scalar, with the path by which the shader reaches it.

use super::pattern::{Step, written};
use crate::bindings::IMMEDIATE;
use crate::compile::layout::{Types, kind, unsupported};
use crate::error::{Error, Result};
use crate::kind::Kind;
use crate::stage::Slot;
use naga::valid::{GlobalUse, ModuleInfo};
use naga::{
    AddressSpace, Binding, EntryPoint, GlobalVariable, Handle, Module, ShaderStage, Span, Type, TypeInner,
};

/// Where a scalar of the input goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The scalar with that number in the buffer's type, in order and without padding.
    Buffer {
        /// Bind group.
        group: u32,
        /// Binding number.
        binding: u32,
        /// Number of the scalar.
        index: usize,
    },
    /// A component of a stage input.
    Stage {
        /// Which input.
        slot: Slot,
        /// Which component.
        component: usize,
    },
}

/// A scalar with its path.
pub(super) struct Leaf {
    pub(super) path: Vec<Step>,
    pub(super) kind: Kind,
    pub(super) target: Target,
}

/// A buffer: its binding and the kinds of its scalars.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BufferInput {
    /// The variable's name.
    pub(crate) name: String,
    pub(crate) binding: (u32, u32),
    pub(crate) kinds: Vec<Kind>,
    /// The first scalar of [`super::Inputs::scalars`] that belongs to it; `None` where the shader only writes it.
    pub(crate) first: Option<usize>,
    /// Elements of its run-time sized array; zero where it has none.
    pub(crate) elements: u32,
}

/// Scalars of one variable that are described one by one; larger ones are refused.
const MAX_INPUT_SCALARS: u64 = 1 << 20;

/// Bytes that a scalar with its path takes, about.
const LEAF_BYTES: u64 = 256;

/// The names of a buffer's scalars, in order: `result[3].x`. A run-time sized array is taken to have that many elements. Empty where the
/// module has no such buffer.
///
/// # Errors
/// [`Error::Unsupported`] and [`Error::Memory`], as for inputs of that type.
pub fn scalar_names(module: &Module, binding: (u32, u32), elements: u32) -> Result<Vec<String>> {
    let is_bound = |variable: &&GlobalVariable| {
        let at = variable.binding.map(|at| (at.group, at.binding));
        at == Some(binding) && is_buffer(variable)
    };
    let Some(variable) = module.global_variables.iter().map(|(_, v)| v).find(is_bound) else {
        return Ok(Vec::new());
    };
    let walk = Walk {
        module,
        leaves: Vec::new(),
        buffers: Vec::new(),
        elements: &|_| elements,
    };
    let mut scalars = Vec::new();
    let name = variable.name.clone().unwrap_or_default();
    walk.walk(variable.ty, &mut vec![Step::Name(name)], &mut scalars)?;
    Ok(scalars.iter().map(|(path, _)| written(path)).collect())
}

/// Walks one entry point.
pub(super) struct Walk<'m> {
    pub(super) module: &'m Module,
    pub(super) leaves: Vec<Leaf>,
    pub(super) buffers: Vec<BufferInput>,
    /// Elements of a run-time sized array, by the variable's name.
    pub(super) elements: &'m dyn Fn(&str) -> u32,
}

impl<'m> Walk<'m> {
    /// Buffers, in the order of the module.
    pub(super) fn buffers(&mut self, info: &ModuleInfo, entry: usize) -> Result<()> {
        let uses = info.get_entry_point(entry);
        for (handle, variable) in self.module.global_variables.iter() {
            if !uses[handle].is_empty() && is_buffer(variable) {
                self.buffer(variable, uses[handle].contains(GlobalUse::READ))?;
            }
        }
        Ok(())
    }

    fn buffer(&mut self, variable: &GlobalVariable, read: bool) -> Result<()> {
        let name = variable.name.clone().unwrap_or_default();
        let binding = match (&variable.binding, variable.space) {
            (Some(at), _) => (at.group, at.binding),
            (None, AddressSpace::Immediate) => IMMEDIATE,
            (None, _) => return Ok(()),
        };
        let mut scalars = Vec::new();
        let elements = if self.is_sized_at_run_time(variable.ty) {
            (self.elements)(&name)
        } else {
            0
        };
        let mut path = vec![Step::Name(name.clone())];
        self.walk(variable.ty, &mut path, &mut scalars)?;
        let kinds = scalars.iter().map(|(_, kind)| *kind).collect();
        let first = read.then_some(self.leaves.len());
        self.buffers.push(BufferInput {
            name,
            binding,
            kinds,
            first,
            elements,
        });
        if read {
            let (group, binding) = binding;
            let leaves = scalars.into_iter().enumerate().map(|(index, (path, kind))| Leaf {
                path,
                kind,
                target: Target::Buffer {
                    group,
                    binding,
                    index,
                },
            });
            self.leaves.extend(leaves);
        }
        Ok(())
    }

    /// Whether a type is, or ends in, a run-time sized array.
    fn is_sized_at_run_time(&self, ty: Handle<Type>) -> bool {
        match &self.module.types[ty].inner {
            TypeInner::Struct { members, .. } => members
                .last()
                .is_some_and(|member| self.is_sized_at_run_time(member.ty)),
            inner => inner.is_dynamically_sized(&self.module.types),
        }
    }

    /// All scalars of a type, with their paths.
    fn walk(&self, ty: Handle<Type>, path: &mut Vec<Step>, out: &mut Vec<(Vec<Step>, Kind)>) -> Result<()> {
        let types = Types { module: self.module };
        let n = u64::from(types.scalars(types.inner(ty))?) + out.len() as u64;
        if n > MAX_INPUT_SCALARS {
            return Err(Error::Memory {
                needed: n * LEAF_BYTES,
                limit: MAX_INPUT_SCALARS * LEAF_BYTES,
                what: format!(
                    "`{}` has {n} scalars, and each gets a range of its own",
                    head(path)
                ),
            });
        }
        match *types.inner(ty) {
            TypeInner::Scalar(scalar) | TypeInner::Atomic(scalar) => out.push((path.clone(), kind(scalar)?)),
            TypeInner::Vector { size, scalar } => components(path, size as u8, kind(scalar)?, out),
            TypeInner::Matrix {
                columns,
                rows,
                scalar,
            } => {
                for column in 0..columns as u32 {
                    path.push(Step::Index(column));
                    components(path, rows as u8, kind(scalar)?, out);
                    path.pop();
                }
            }
            TypeInner::Array { base, size, .. } => {
                let n = types.length(size)?.unwrap_or_else(|| (self.elements)(head(path)));
                for index in 0..n {
                    path.push(Step::Index(index));
                    self.walk(base, path, out)?;
                    path.pop();
                }
            }
            TypeInner::Struct { ref members, .. } => {
                for (at, member) in members.iter().enumerate() {
                    let name = member.name.clone().unwrap_or_else(|| format!("member_{at}"));
                    path.push(Step::Name(name));
                    self.walk(member.ty, path, out)?;
                    path.pop();
                }
            }
            TypeInner::Pointer { .. }
            | TypeInner::ValuePointer { .. }
            | TypeInner::Image { .. }
            | TypeInner::Sampler { .. }
            | TypeInner::CooperativeMatrix { .. }
            | TypeInner::AccelerationStructure { .. }
            | TypeInner::RayQuery { .. }
            | TypeInner::BindingArray { .. } => {
                return unsupported("an input of this type", Span::UNDEFINED);
            }
        }
        Ok(())
    }

    /// Stage inputs of a vertex or fragment entry point.
    pub(super) fn stage_inputs(&mut self, entry: &EntryPoint) -> Result<()> {
        if entry.stage == ShaderStage::Compute {
            return Ok(());
        }
        for argument in &entry.function.arguments {
            let name = argument.name.clone().unwrap_or_default();
            self.stage_input(argument.ty, argument.binding.as_ref(), &name)?;
        }
        Ok(())
    }

    fn stage_input(&mut self, ty: Handle<Type>, binding: Option<&Binding>, name: &str) -> Result<()> {
        if let (None, TypeInner::Struct { members, .. }) = (binding, &self.module.types[ty].inner) {
            for member in members {
                let name = member.name.clone().unwrap_or_default();
                self.stage_input(member.ty, member.binding.as_ref(), &name)?;
            }
            return Ok(());
        }
        let Some(slot) = binding.and_then(crate::run::slot_of) else {
            return Ok(());
        };
        let mut scalars = Vec::new();
        self.walk(ty, &mut vec![Step::Name(name.to_owned())], &mut scalars)?;
        let leaves = scalars
            .into_iter()
            .enumerate()
            .map(|(component, (path, kind))| Leaf {
                path,
                kind,
                target: Target::Stage { slot, component },
            });
        self.leaves.extend(leaves);
        Ok(())
    }
}

fn is_buffer(variable: &GlobalVariable) -> bool {
    matches!(
        variable.space,
        AddressSpace::Uniform | AddressSpace::Storage { .. } | AddressSpace::Immediate
    )
}

fn head(path: &[Step]) -> &str {
    match path.first() {
        Some(Step::Name(name)) => name,
        Some(Step::Index(_) | Step::Component(_)) | None => "",
    }
}

fn components(path: &mut Vec<Step>, n: u8, kind: Kind, out: &mut Vec<(Vec<Step>, Kind)>) {
    for component in 0..n {
        path.push(Step::Component(component));
        out.push((path.clone(), kind));
        path.pop();
    }
}
