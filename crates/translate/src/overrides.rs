//! Pipeline-overridable constants: given values, else defaults, else a diagnostic.
//!
//! No target but SPIR-V knows them, and naga's writers refuse them, so they are compiled in; each set of values is a
//! shader of its own.

use naga::back::PipelineConstants;
use naga::back::pipeline_constants::{PipelineConstantError, process_overrides};
use naga::valid::ModuleInfo;
use naga::{Expression, Literal, Module, Override};

use crate::diagnostic::{Code, Diagnostic};
use crate::front;
use crate::manifest::OverrideValue;
use crate::repairs::repair;
use crate::shader::{Overrides, Unit, unit};
use crate::type_name::type_name;

/// The overrides of a module with the values that will be compiled in.
pub(crate) fn describe(module: &Module, values: &Overrides) -> Vec<OverrideValue> {
    module
        .overrides
        .iter()
        .map(|(_, declared)| OverrideValue {
            name: declared.name.clone().unwrap_or_default(),
            id: declared.id,
            ty: type_name(module, declared.ty),
            value: given(declared, values).or_else(|| default(module, declared)),
        })
        .collect()
}

/// The name under which a value is given: the number, where there is one.
fn key(declared: &Override) -> String {
    match declared.id {
        Some(id) => id.to_string(),
        None => declared.name.clone().unwrap_or_default(),
    }
}

fn given(declared: &Override, values: &Overrides) -> Option<f64> {
    values.get(&key(declared)).copied()
}

/// The default, where it is a literal.
fn default(module: &Module, declared: &Override) -> Option<f64> {
    let Expression::Literal(literal) = module.global_expressions[declared.init?] else {
        return None;
    };
    match literal {
        Literal::F64(v) | Literal::AbstractFloat(v) => Some(v),
        Literal::F32(v) => Some(f64::from(v)),
        Literal::F16(v) => Some(f64::from(v)),
        Literal::U32(v) => Some(f64::from(v)),
        Literal::I32(v) => Some(f64::from(v)),
        Literal::U16(v) => Some(f64::from(v)),
        Literal::I16(v) => Some(f64::from(v)),
        Literal::Bool(v) => Some(f64::from(u8::from(v))),
        // These may not fit an f64, and WGSL has no override of them.
        Literal::U64(_) | Literal::I64(_) | Literal::AbstractInt(_) => None,
    }
}

/// One unit an entry point, with every override replaced by its value.
pub(crate) fn resolve(
    name: &str,
    text: &str,
    module: &Module,
    info: &ModuleInfo,
    values: &Overrides,
) -> Result<Vec<Unit>, Diagnostic> {
    check_names(name, module, values)?;
    let constants: PipelineConstants = values.iter().map(|(k, v)| (k.clone(), *v)).collect();
    module
        .entry_points
        .iter()
        .map(|entry| {
            let selected = Some((entry.stage, entry.name.as_str()));
            let (module, info) = process_overrides(module, info, selected, &constants)
                .map_err(|error| diagnostic(name, text, module, &error))?;
            let (mut module, mut info) = (module.into_owned(), info.into_owned());
            if repair(&mut module) {
                info = front::analyze(name, text, &module)?;
            }
            unit(module, info)
        })
        .collect()
}

/// A value for something that is no override is a mistake.
fn check_names(name: &str, module: &Module, values: &Overrides) -> Result<(), Diagnostic> {
    let known: Vec<String> = module.overrides.iter().map(|(_, o)| key(o)).collect();
    for given in values.keys() {
        if !known.contains(given) {
            let list = if known.is_empty() {
                "the shader has no overrides".to_owned()
            } else {
                format!("overrides of the shader: {}", known.join(", "))
            };
            return Err(
                Diagnostic::new(Code::Override, format!("there is no override `{given}`"))
                    .in_file(name)
                    .with_hint(list),
            );
        }
    }
    Ok(())
}

fn diagnostic(name: &str, text: &str, module: &Module, error: &PipelineConstantError) -> Diagnostic {
    match error {
        PipelineConstantError::MissingValue(missing) => missing_value(name, text, module, missing),
        PipelineConstantError::ValidationError(error) => front::validation_diagnostic(name, text, error),
        PipelineConstantError::NotFound(_)
        | PipelineConstantError::SrcNeedsToBeFinite
        | PipelineConstantError::DstRangeTooSmall
        | PipelineConstantError::ConstantEvaluatorError(_)
        | PipelineConstantError::NegativeWorkgroupSize
        | PipelineConstantError::NegativeMeshOutputMax => {
            Diagnostic::new(Code::Override, front::chain(error)).in_file(name)
        }
    }
}

/// Marks the declaration.
fn missing_value(name: &str, text: &str, module: &Module, missing: &str) -> Diagnostic {
    let place = module
        .overrides
        .iter()
        .find(|(_, declared)| key(declared) == missing)
        .and_then(|(handle, _)| front::range_in(text, module.overrides.get_span(handle)))
        .map(|range| (range, "declared without a default".to_owned()));
    Diagnostic::new(Code::Override, format!("override `{missing}` has no value"))
        .at(name, text, place)
        .with_hint("give it a default in the shader, or pass a value")
}
