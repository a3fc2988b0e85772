//! Entry points as programs, each compiled once.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use bossage_runner::{Code, Error, Shader};
use bossage_translate::external::{Native, Validator, compile_native};
use bossage_translate::manifest::{Entry, Varying};

use crate::caller;
use crate::machine::NAME;
use crate::signature::{Declared, Role, Signature};

/// Headers of the caller.
const HEADERS: [(&str, &str); 2] = [
    ("call.h", include_str!("../native/call.h")),
    ("caller.h", include_str!("../native/caller.h")),
];
/// The rest of each program.
const HOST: &str = include_str!("../native/host.cpp");

/// A program of an entry point.
#[derive(Debug)]
pub(crate) struct Program {
    pub(crate) path: PathBuf,
    pub(crate) signature: Signature,
    /// Whether a fragment may end without a result.
    pub(crate) may_discard: bool,
}

/// The programs that have been asked for, by text and entry point.
#[derive(Debug)]
pub(crate) struct Programs {
    tools: Vec<Validator>,
    folder: PathBuf,
    made: Mutex<HashMap<(String, String), Arc<Program>>>,
}

impl Programs {
    /// None yet; they are kept in this folder.
    pub(crate) fn new(tools: &[Validator], folder: &Path) -> Self {
        Self {
            tools: tools.to_vec(),
            folder: folder.to_owned(),
            made: Mutex::default(),
        }
    }

    /// The program of a shader's entry point.
    pub(crate) fn get(&self, job: &str, shader: &Shader<'_>) -> Result<Arc<Program>, Error> {
        let Code::Msl(text) = shader.code else {
            let what = format!("a compiler for the route `{}`: it takes MSL", shader.code.route());
            return Err(Error::unsupported(job, NAME, what));
        };
        let key = (text.to_owned(), shader.entry_point().to_owned());
        let lock = || self.made.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = lock().get(&key) {
            return Ok(Arc::clone(found));
        }
        // Made without the lock: compiling takes long.
        let made = self
            .compile(shader, text)
            .map_err(|problem| Error::invalid(job, problem))?;
        Ok(Arc::clone(lock().entry(key).or_insert(Arc::new(made))))
    }

    fn compile(&self, shader: &Shader<'_>, text: &str) -> Result<Program, String> {
        let entry = shader.entry;
        let signature = Signature::read(text, entry.stage, shader.entry_point())?;
        let workgroup = entry.workgroup_size.unwrap_or([1; 3]);
        let caller = caller::text(&signature, workgroup, |declared, gives| {
            components(entry, declared, gives)
        });
        let native = Native {
            msl: text,
            caller: &caller,
            headers: &HEADERS,
            host: HOST,
        };
        let path = compile_native(&native, &self.tools, &self.folder)?;
        Ok(Program {
            path,
            signature,
            may_discard: text.contains("discard_fragment("),
        })
    }
}

/// How many scalars a value of a stage has by the manifest; the compiler holds the text to it. 0 for what the manifest lacks.
pub(crate) fn components(entry: &Entry, declared: &Declared, gives: bool) -> usize {
    let list = if gives { &entry.outputs } else { &entry.inputs };
    match declared.role {
        Role::Location(location) => {
            let found = list.iter().find(|varying| varying.location == Some(location));
            found.map_or(0, scalars)
        }
        Role::Position => 4,
        Role::Buffer(_)
        | Role::Texture(_)
        | Role::Sampler(_)
        | Role::Workgroup
        | Role::StageIn
        | Role::GridPosition
        | Role::WorkgroupPosition
        | Role::PositionInWorkgroup
        | Role::IndexInWorkgroup
        | Role::Workgroups
        | Role::VertexIndex
        | Role::InstanceIndex
        | Role::FrontFacing
        | Role::PrimitiveIndex
        | Role::SampleIndex
        | Role::SampleMask
        | Role::Depth => 1,
    }
}

fn scalars(varying: &Varying) -> usize {
    let size = varying
        .ty
        .strip_prefix("vec")
        .and_then(|rest| rest.chars().next());
    size.and_then(|digit| digit.to_digit(10)).unwrap_or(1) as usize
}
