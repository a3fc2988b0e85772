//! The compiled entry point, its resources and its interface.

use super::builder::{Builder, Global};
use super::code::{Code, Op, Root, Row};
use super::layout::{BufferLayout, unsupported};
use super::products::products;
use crate::error::{Error, Result};
use crate::kind::Kind;
use naga::back::PipelineConstants;
use naga::back::pipeline_constants::process_overrides;
use naga::valid::ModuleInfo;
use naga::{
    AddressSpace, Binding, BuiltIn, EntryPoint, GlobalVariable, ImageClass, ImageDimension, Module,
    ShaderStage, Span, StorageAccess, StorageFormat, Type, TypeInner,
};

/// One entry point of a module, ready to be evaluated over any domain.
///
/// Compiling once and running many times is the intended use; a program is independent of domains, bindings and inputs.
#[derive(Clone, Debug)]
pub struct Program {
    pub(crate) name: String,
    pub(crate) stage: ShaderStage,
    pub(crate) workgroup_size: [u32; 3],
    pub(crate) code: Code,
    pub(crate) resources: Vec<Resource>,
    pub(crate) inputs: Vec<Port>,
    pub(crate) outputs: Vec<Port>,
}

/// A variable that invocations share, or that is bound from outside.
#[derive(Clone, Debug)]
pub(crate) struct Resource {
    pub(crate) name: String,
    pub(crate) binding: Option<(u32, u32)>,
    pub(crate) kind: ResourceKind,
}

#[derive(Clone, Debug)]
pub(crate) enum ResourceKind {
    Buffer {
        layout: BufferLayout,
        writable: bool,
    },
    Workgroup {
        kinds: Vec<Kind>,
    },
    Texture {
        dim: ImageDimension,
        arrayed: bool,
        class: ImageClass,
        count: Option<u32>,
    },
    StorageTexture {
        dim: ImageDimension,
        format: StorageFormat,
        access: StorageAccess,
    },
    Sampler {
        comparison: bool,
    },
}

/// A stage input or output and the rows that hold it.
#[derive(Clone, Debug)]
pub(crate) struct Port {
    pub(crate) binding: Binding,
    pub(crate) rows: Vec<Row>,
}

impl Program {
    /// Compiles the entry point `name` of a validated module.
    ///
    /// # Errors
    /// [`Error::NoEntryPoint`], or [`Error::Unsupported`] for what the crate documentation lists.
    pub fn new(module: &Module, info: &ModuleInfo, name: &str) -> Result<Self> {
        Self::with_constants(module, info, name, &PipelineConstants::default())
    }

    /// Compiles an entry point with values for pipeline-overridable constants.
    ///
    /// # Errors
    /// As [`Program::new`], and [`Error::Overrides`] for constants that are missing, unknown or out of range.
    pub fn with_constants(
        module: &Module,
        info: &ModuleInfo,
        name: &str,
        constants: &PipelineConstants,
    ) -> Result<Self> {
        let stage = module
            .entry_points
            .iter()
            .find(|e| e.name == name)
            .map(|e| e.stage)
            .ok_or_else(|| no_entry(module, name))?;
        let (module, info) =
            process_overrides(module, info, Some((stage, name)), constants).map_err(Box::new)?;
        let index = module
            .entry_points
            .iter()
            .position(|e| e.name == name)
            .ok_or_else(|| no_entry(&module, name))?;
        compile(&module, &info, index)
    }

    /// The entry point's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The entry point's stage.
    pub fn stage(&self) -> ShaderStage {
        self.stage
    }

    /// Invocations of one workgroup, for compute shaders.
    pub fn workgroup_size(&self) -> [u32; 3] {
        self.workgroup_size
    }

    /// Whether fragments must be evaluated in quads: the program takes derivatives, or samples with an implicit level of detail.
    pub fn uses_derivatives(&self) -> bool {
        self.code.uses_derivatives
    }

    /// Number of scalar instructions, a measure of static size.
    pub fn instructions(&self) -> usize {
        fn block(nodes: &[super::code::Node]) -> usize {
            nodes.iter().map(node).sum()
        }
        fn node(node: &super::code::Node) -> usize {
            use super::code::Node;
            match node {
                Node::Run(run) => run.len(),
                Node::If { accept, reject, .. } => 1 + block(accept) + block(reject),
                Node::Switch { cases, .. } => 1 + cases.iter().map(|c| block(&c.body)).sum::<usize>(),
                Node::Loop(l) => 1 + block(&l.body) + block(&l.continuing),
                Node::Break
                | Node::Continue
                | Node::Return
                | Node::Kill
                | Node::Barrier
                | Node::Call { .. } => 1,
            }
        }
        self.code.functions.iter().map(|f| block(&f.body)).sum()
    }
}

pub(crate) fn no_entry(module: &Module, name: &str) -> Error {
    let available = module
        .entry_points
        .iter()
        .map(|e| e.name.as_str())
        .collect::<Vec<_>>()
        .join(", ");
    Error::NoEntryPoint {
        name: name.into(),
        available,
    }
}

fn compile(module: &Module, info: &ModuleInfo, index: usize) -> Result<Program> {
    let entry = &module.entry_points[index];
    match entry.stage {
        ShaderStage::Vertex | ShaderStage::Fragment | ShaderStage::Compute => {}
        other => return unsupported(format!("the {other:?} stage"), Span::UNDEFINED),
    }
    let function_info = info.get_entry_point(index);
    let mut builder = Builder::new(module, info);
    let mut resources = Vec::new();
    let mut initial = Vec::new();
    for (handle, variable) in module.global_variables.iter() {
        let used = !function_info[handle].is_empty();
        if let Some(global) = place_global(&mut builder, variable, used, &mut resources, &mut initial)? {
            builder.globals.insert(handle, global);
        }
    }
    let none = vec![None; entry.function.arguments.len()];
    let index = builder.function(&entry.function, function_info, &none)?;
    builder.code.entry = index;
    prepend(&mut builder.code, index, initial);
    builder.code.products = products(&builder.code);
    let (inputs, outputs) = ports(&builder, entry, index)?;
    Ok(Program {
        name: entry.name.clone(),
        stage: entry.stage,
        workgroup_size: entry.workgroup_size,
        code: builder.code,
        resources,
        inputs,
        outputs,
    })
}

/// Initial values of private variables are set before the entry point's first statement.
fn prepend(code: &mut Code, entry: usize, initial: Vec<super::code::Instr>) {
    if !initial.is_empty() {
        code.functions[entry]
            .body
            .insert(0, super::code::Node::Run(initial.into_boxed_slice()));
    }
}

fn place_global(
    builder: &mut Builder<'_>,
    variable: &GlobalVariable,
    used: bool,
    resources: &mut Vec<Resource>,
    initial: &mut Vec<super::code::Instr>,
) -> Result<Option<Global>> {
    if !used {
        return Ok(None);
    }
    let kind = match variable.space {
        AddressSpace::Private => return private(builder, variable, initial).map(Some),
        AddressSpace::WorkGroup => ResourceKind::Workgroup {
            kinds: builder.types.kinds_of(builder.types.inner(variable.ty))?,
        },
        AddressSpace::Uniform => buffer(builder, variable, false)?,
        AddressSpace::Storage { access } => buffer(builder, variable, access.contains(StorageAccess::STORE))?,
        AddressSpace::Immediate => buffer(builder, variable, false)?,
        AddressSpace::Handle => handle(&builder.module.types[variable.ty], builder)?,
        AddressSpace::Function
        | AddressSpace::TaskPayload
        | AddressSpace::RayPayload
        | AddressSpace::IncomingRayPayload => return Ok(None),
    };
    let id = resources.len() as u32;
    let is_handle = variable.space == AddressSpace::Handle;
    let binding = variable.binding.map(|b| (b.group, b.binding));
    // Immediate data has no binding; it is given under the reserved group number of `Bindings::immediate`.
    let binding = if variable.space == AddressSpace::Immediate {
        Some(crate::bindings::IMMEDIATE)
    } else {
        binding
    };
    resources.push(Resource {
        name: variable.name.clone().unwrap_or_default(),
        binding,
        kind,
    });
    Ok(Some(if is_handle {
        Global::Handle(id)
    } else {
        Global::Place(Root::Memory(id))
    }))
}

fn private(
    builder: &mut Builder<'_>,
    variable: &GlobalVariable,
    initial: &mut Vec<super::code::Instr>,
) -> Result<Global> {
    let kinds = builder.types.kinds_of(builder.types.inner(variable.ty))?;
    let values: Vec<Row> = match variable.init {
        Some(init) => builder.global_expression(init)?.rows(Span::UNDEFINED)?,
        None => kinds.iter().map(|&k| builder.zero(k)).collect(),
    };
    let base = builder.code.kinds.len() as Row;
    builder.code.kinds.extend(&kinds);
    builder.code.privates.push((base, kinds.len() as u32));
    let span = builder.span(Span::UNDEFINED);
    initial.extend((base..).zip(values).map(|(dst, src)| super::code::Instr {
        op: Op::Copy { dst, src },
        span,
    }));
    Ok(Global::Place(Root::Rows {
        base,
        len: kinds.len() as u32,
    }))
}

fn buffer(builder: &Builder<'_>, variable: &GlobalVariable, writable: bool) -> Result<ResourceKind> {
    Ok(ResourceKind::Buffer {
        layout: builder.types.buffer(variable.ty)?,
        writable,
    })
}

fn handle(ty: &Type, builder: &Builder<'_>) -> Result<ResourceKind> {
    match ty.inner {
        TypeInner::Image {
            dim,
            class: ImageClass::Storage { format, access },
            ..
        } => Ok(ResourceKind::StorageTexture { dim, format, access }),
        TypeInner::Image { dim, arrayed, class } => Ok(ResourceKind::Texture {
            dim,
            arrayed,
            class,
            count: None,
        }),
        TypeInner::Sampler { comparison } => Ok(ResourceKind::Sampler { comparison }),
        TypeInner::BindingArray { base, size } => match builder.types.inner(base) {
            TypeInner::Image { dim, arrayed, class } => {
                let count = Some(builder.types.length(size)?.unwrap_or(u32::MAX));
                Ok(ResourceKind::Texture {
                    dim: *dim,
                    arrayed: *arrayed,
                    class: *class,
                    count,
                })
            }
            TypeInner::Sampler { comparison } => Ok(ResourceKind::Sampler {
                comparison: *comparison,
            }),
            TypeInner::Scalar(_)
            | TypeInner::Vector { .. }
            | TypeInner::Matrix { .. }
            | TypeInner::Atomic(_)
            | TypeInner::Array { .. }
            | TypeInner::Struct { .. }
            | TypeInner::Pointer { .. }
            | TypeInner::ValuePointer { .. }
            | TypeInner::CooperativeMatrix { .. }
            | TypeInner::AccelerationStructure { .. }
            | TypeInner::RayQuery { .. }
            | TypeInner::BindingArray { .. } => unsupported("a binding array of buffers", Span::UNDEFINED),
        },
        TypeInner::Scalar(_)
        | TypeInner::Vector { .. }
        | TypeInner::Matrix { .. }
        | TypeInner::Atomic(_)
        | TypeInner::Array { .. }
        | TypeInner::Struct { .. }
        | TypeInner::Pointer { .. }
        | TypeInner::ValuePointer { .. }
        | TypeInner::CooperativeMatrix { .. }
        | TypeInner::AccelerationStructure { .. }
        | TypeInner::RayQuery { .. } => unsupported("a handle of this type", Span::UNDEFINED),
    }
}

fn ports(builder: &Builder<'_>, entry: &EntryPoint, index: usize) -> Result<(Vec<Port>, Vec<Port>)> {
    let code = &builder.code.functions[index];
    let mut inputs = Vec::new();
    for (argument, &(base, len)) in entry.function.arguments.iter().zip(&code.variables) {
        let rows: Vec<Row> = (base..base + len).collect();
        split(
            builder,
            argument.ty,
            argument.binding.as_ref(),
            &rows,
            &mut inputs,
        )?;
    }
    let mut outputs = Vec::new();
    if let Some(result) = &entry.function.result {
        split(
            builder,
            result.ty,
            result.binding.as_ref(),
            &code.result,
            &mut outputs,
        )?;
    }
    Ok((inputs, outputs))
}

/// One port for a bound value, one for every member of a struct.
fn split(
    builder: &Builder<'_>,
    ty: naga::Handle<Type>,
    binding: Option<&Binding>,
    rows: &[Row],
    out: &mut Vec<Port>,
) -> Result<()> {
    let inner = builder.types.inner(ty);
    if let (None, TypeInner::Struct { members, .. }) = (binding, inner) {
        let mut at = 0;
        for member in members {
            let n = builder.types.scalars(builder.types.inner(member.ty))? as usize;
            split(
                builder,
                member.ty,
                member.binding.as_ref(),
                &rows[at..at + n],
                out,
            )?;
            at += n;
        }
        return Ok(());
    }
    let binding = binding
        .cloned()
        .unwrap_or(Binding::BuiltIn(BuiltIn::PrimitiveIndex));
    out.push(Port {
        binding,
        rows: rows.to_vec(),
    });
    Ok(())
}
