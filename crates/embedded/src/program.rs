//! Shaders as programs of the evaluator, each compiled once.
//!
//! Found by the whole of their code, not by a hash: a collision would run the wrong shader.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use bossage_bounds::Program;
use bossage_runner::{Code, Error, Shader};
use bossage_translate::{Shader as Parsed, Source};
use naga::{Block, Module, Statement};

use crate::failure;
use crate::select::NAME;

/// A program, and what the rasteriser has to know of it.
#[derive(Debug)]
pub(crate) struct Compiled {
    pub(crate) program: Program,
    /// Whether an invocation may end without a result.
    pub(crate) may_discard: bool,
}

/// Route, code and entry point.
type Key = (&'static str, Box<[u8]>, String);

/// The programs that have been compiled.
#[derive(Debug, Default)]
pub(crate) struct Programs(Mutex<HashMap<Key, Arc<Compiled>>>);

impl Programs {
    /// The program of a shader's entry point.
    pub(crate) fn get(&self, job: &str, shader: &Shader<'_>) -> Result<Arc<Compiled>, Error> {
        let entry = shader.entry_point();
        let key = (shader.code.route(), shader.code.bytes().into(), entry.to_owned());
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = lock().get(&key) {
            return Ok(Arc::clone(found));
        }
        // Made without the lock: compiling takes long.
        let made = Arc::new(compile(job, shader.code, entry)?);
        Ok(Arc::clone(lock().entry(key).or_insert(made)))
    }
}

fn compile(job: &str, code: Code<'_>, entry: &str) -> Result<Compiled, Error> {
    let invalid = |message: String| Error::invalid(job, message);
    let source = match code {
        Code::Wgsl(text) => Source::Wgsl(text.to_owned()),
        Code::Spirv(bytes) => Source::Spirv(bytes.to_vec()),
        Code::Glsl(_) => return Err(Error::unsupported(job, NAME, "a reader of GLSL")),
        Code::Msl(_) => return Err(Error::unsupported(job, NAME, "a reader of MSL")),
    };
    let parsed = Parsed::parse(job, &source).map_err(|diagnostic| invalid(diagnostic.to_string()))?;
    let (module, info) = parsed
        .module(entry)
        .ok_or_else(|| invalid(format!("the code has no entry point `{entry}`")))?;
    let program = Program::new(module, info, entry).map_err(|refusal| failure::of_job(job, refusal))?;
    Ok(Compiled {
        program,
        may_discard: may_discard(module),
    })
}

/// Whether any function of the module, which holds one entry point's alone, discards.
fn may_discard(module: &Module) -> bool {
    let functions = module.functions.iter().map(|(_, function)| function);
    let entries = module.entry_points.iter().map(|entry| &entry.function);
    functions
        .chain(entries)
        .any(|function| block_discards(&function.body))
}

fn block_discards(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Kill => true,
        Statement::Block(block) => block_discards(block),
        Statement::If { accept, reject, .. } => block_discards(accept) || block_discards(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|case| block_discards(&case.body)),
        Statement::Loop { body, continuing, .. } => block_discards(body) || block_discards(continuing),
        Statement::Emit(_)
        | Statement::Break
        | Statement::Continue
        | Statement::Return { .. }
        | Statement::ControlBarrier(_)
        | Statement::MemoryBarrier(_)
        | Statement::Store { .. }
        | Statement::ImageStore { .. }
        | Statement::Atomic { .. }
        | Statement::ImageAtomic { .. }
        | Statement::WorkGroupUniformLoad { .. }
        | Statement::Call { .. }
        | Statement::RayQuery { .. }
        | Statement::RayPipelineFunction(_)
        | Statement::SubgroupBallot { .. }
        | Statement::SubgroupGather { .. }
        | Statement::SubgroupCollectiveOperation { .. }
        | Statement::CooperativeStore { .. } => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn module(text: &str) -> Module {
        let parsed = Parsed::parse("test", &Source::Wgsl(text.to_owned())).unwrap();
        parsed.module("main").unwrap().0.clone()
    }

    #[test]
    fn a_discard_is_found_however_deep() {
        let deep = "
            fn cut(x: f32) { loop { switch i32(x) { case 1: { if x > 0.5 { discard; } } default: {} } break; } }
            @fragment fn main(@location(0) x: f32) -> @location(0) vec4f { cut(x); return vec4f(x); }";
        assert!(may_discard(&module(deep)));
        let none = "@fragment fn main(@location(0) x: f32) -> @location(0) vec4f { return vec4f(x); }";
        assert!(!may_discard(&module(none)));
    }

    #[test]
    fn the_same_code_is_compiled_once_and_other_code_again() {
        let text = "@compute @workgroup_size(1) fn main() {}";
        let parsed = Parsed::parse("test", &Source::Wgsl(text.to_owned())).unwrap();
        let manifest = bossage_translate::manifest(&parsed, &Default::default(), &[]);
        let shader = |text| Shader {
            code: Code::Wgsl(text),
            entry: &manifest.entries[0],
        };
        let programs = Programs::default();
        let first = programs.get("test", &shader(text)).unwrap();
        assert!(Arc::ptr_eq(&first, &programs.get("test", &shader(text)).unwrap()));
        let other = "@compute @workgroup_size(2) fn main() {}";
        assert!(!Arc::ptr_eq(
            &first,
            &programs.get("test", &shader(other)).unwrap()
        ));
    }
}
