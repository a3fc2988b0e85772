//! Small walks over naga's IR that several parts share.

use naga::valid::FunctionInfo;
use naga::{Block, Expression, Function, Handle, Module, Scalar, Span, Statement, Type, TypeInner};

use crate::shader::Unit;

/// Every function of a unit with naga's findings about it, the entry point last.
pub(crate) fn functions(unit: &Unit) -> impl Iterator<Item = (&Function, &FunctionInfo)> {
    unit.module
        .functions
        .iter()
        .map(|(handle, function)| (function, &unit.info[handle]))
        .chain(std::iter::once((&unit.entry().function, unit.entry_info())))
}

/// Every expression of a unit with its place.
pub(crate) fn expressions(unit: &Unit) -> impl Iterator<Item = (&Expression, Span)> {
    functions(unit).flat_map(|(function, _)| {
        function
            .expressions
            .iter()
            .map(|(handle, expression)| (expression, function.expressions.get_span(handle)))
    })
}

/// Calls `visit` for every statement of a block, outer ones before inner ones.
pub(crate) fn each_statement(block: &Block, visit: &mut impl FnMut(&Statement, Span)) {
    for (statement, span) in block.span_iter() {
        visit(statement, *span);
        for inner in inner_blocks(statement) {
            each_statement(inner, visit);
        }
    }
}

/// The blocks inside a statement.
pub(crate) fn inner_blocks(statement: &Statement) -> Vec<&Block> {
    match statement {
        Statement::Block(block) => vec![block],
        Statement::If { accept, reject, .. } => vec![accept, reject],
        Statement::Switch { cases, .. } => cases.iter().map(|case| &case.body).collect(),
        Statement::Loop { body, continuing, .. } => vec![body, continuing],
        _ => Vec::new(),
    }
}

/// The place of the first statement of a unit that is as asked for.
pub(crate) fn find_statement(unit: &Unit, wanted: impl Fn(&Statement) -> bool) -> Option<Span> {
    let mut found = None;
    for (function, _) in functions(unit) {
        each_statement(&function.body, &mut |statement, span| {
            if found.is_none() && wanted(statement) {
                found = Some(span);
            }
        });
    }
    found
}

/// The place of the first expression of a unit that is as asked for.
pub(crate) fn find_expression(unit: &Unit, wanted: impl Fn(&Expression) -> bool) -> Option<Span> {
    expressions(unit)
        .find(|(expression, _)| wanted(expression))
        .map(|(_, span)| span)
}

/// Whether a type is as asked for, or holds a type that is.
pub(crate) fn type_contains(
    module: &Module,
    handle: Handle<Type>,
    wanted: &impl Fn(&TypeInner) -> bool,
) -> bool {
    let inner = &module.types[handle].inner;
    wanted(inner)
        || match inner {
            TypeInner::Array { base, .. }
            | TypeInner::BindingArray { base, .. }
            | TypeInner::Pointer { base, .. } => type_contains(module, *base, wanted),
            TypeInner::Struct { members, .. } => members
                .iter()
                .any(|member| type_contains(module, member.ty, wanted)),
            _ => false,
        }
}

/// The place of the first thing that is of such a type: a resource, a local variable, an expression, else the type's
/// declaration. `None` if nothing is.
pub(crate) fn find_type(unit: &Unit, wanted: impl Fn(&TypeInner) -> bool) -> Option<Span> {
    let module = &unit.module;
    let global = module
        .global_variables
        .iter()
        .find(|(_, variable)| type_contains(module, variable.ty, &wanted))
        .map(|(handle, _)| module.global_variables.get_span(handle));
    let declared = || {
        let mut types = module.types.iter();
        types
            .find(|(_, ty)| wanted(&ty.inner))
            .map(|(handle, _)| module.types.get_span(handle))
    };
    global
        .or_else(|| find_local(unit, &wanted))
        .or_else(|| find_value(unit, &wanted))
        .or_else(declared)
}

fn find_local(unit: &Unit, wanted: &impl Fn(&TypeInner) -> bool) -> Option<Span> {
    functions(unit).find_map(|(function, _)| {
        function
            .local_variables
            .iter()
            .find(|(_, local)| type_contains(&unit.module, local.ty, wanted))
            .map(|(handle, _)| function.local_variables.get_span(handle))
    })
}

fn find_value(unit: &Unit, wanted: &impl Fn(&TypeInner) -> bool) -> Option<Span> {
    functions(unit).find_map(|(function, info)| {
        function
            .expressions
            .iter()
            .find(|(handle, _)| wanted(info[*handle].ty.inner_with(&unit.module.types)))
            .map(|(handle, _)| function.expressions.get_span(handle))
    })
}

/// The scalar of a scalar, vector, matrix or atomic.
pub(crate) const fn scalar_of(inner: &TypeInner) -> Option<Scalar> {
    match *inner {
        TypeInner::Scalar(scalar)
        | TypeInner::Atomic(scalar)
        | TypeInner::Vector { scalar, .. }
        | TypeInner::Matrix { scalar, .. }
        | TypeInner::ValuePointer { scalar, .. } => Some(scalar),
        _ => None,
    }
}

/// Everything that comes into or goes out of an entry point: name, type and binding, structs taken apart.
pub(crate) fn interface(unit: &Unit, output: bool) -> Vec<(String, Handle<Type>, naga::Binding)> {
    let function = &unit.entry().function;
    let mut found = Vec::new();
    if output {
        if let Some(result) = &function.result {
            flatten(&unit.module, "", result.ty, result.binding.as_ref(), &mut found);
        }
    } else {
        for argument in &function.arguments {
            let name = argument.name.as_deref().unwrap_or_default();
            flatten(
                &unit.module,
                name,
                argument.ty,
                argument.binding.as_ref(),
                &mut found,
            );
        }
    }
    found
}

fn flatten(
    module: &Module,
    name: &str,
    ty: Handle<Type>,
    binding: Option<&naga::Binding>,
    found: &mut Vec<(String, Handle<Type>, naga::Binding)>,
) {
    if let Some(binding) = binding {
        found.push((name.to_owned(), ty, binding.clone()));
    } else if let TypeInner::Struct { members, .. } = &module.types[ty].inner {
        for member in members {
            let name = member.name.as_deref().unwrap_or_default();
            flatten(module, name, member.ty, member.binding.as_ref(), found);
        }
    }
}
