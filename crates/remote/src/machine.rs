//! The machine: jobs in, results out, one process for all of them.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use bossage_runner::{
    AdapterInfo, ComputeJob, ComputeOutput, DispatchLimits, Error, Machine, RenderJob, RenderOutput,
};

use crate::answer::{self, Answer, Capacity, Hello};
use crate::kind::Kind;
use crate::message::{Data, Request};
use crate::process::{Limits, Process, Stopped};
use crate::script::Script;
use crate::{compute, render};

/// An adapter through another process. It can be shared between threads; its jobs run one after the other.
#[derive(Debug)]
pub struct Remote {
    pub(crate) kind: Kind,
    info: AdapterInfo,
    program: PathBuf,
    script: Script,
    limits: Limits,
    pub(crate) capacity: Capacity,
    features: Vec<String>,
    process: Mutex<Option<Process>>,
}

impl Remote {
    /// Opens the adapter of that name through a program.
    ///
    /// # Errors
    /// [`Error::Unsupported`] with the reason where the kind does not take that adapter, [`Error::GaveUp`] where the program ends,
    /// does not answer, or is another one.
    pub fn open(kind: Kind, program: &Path, info: &AdapterInfo, limits: Limits) -> Result<Self, Error> {
        let failed = |message: String| answer::stopped(kind, &info.name, Stopped(message));
        let script = Script::write(kind)
            .map_err(|error| failed(format!("its script could not be written: {error}")))?;
        let (process, hello) = start(kind, program, &script, info, limits)
            .map_err(|why| answer::stopped(kind, &info.name, why))?;
        let (features, capacity) = match hello {
            Hello::Open { features, capacity } => (features, capacity),
            Hello::Refused { message } => {
                let what = format!("what {} needs: {}", kind.name(), one_line(&message));
                return Err(Error::unsupported(kind.name(), &info.name, what));
            }
        };
        Ok(Self {
            kind,
            info: info.clone(),
            program: program.to_owned(),
            script,
            limits,
            capacity,
            features,
            process: Mutex::new(Some(process)),
        })
    }

    /// Whether the device has a feature, by WebGPU's name.
    pub(crate) fn has(&self, feature: &str) -> bool {
        self.features.iter().any(|own| own == feature)
    }

    /// Fails when the device lacks the feature.
    pub(crate) fn require(&self, job: &str, feature: &str, what: &str) -> Result<(), Error> {
        if self.has(feature) {
            return Ok(());
        }
        Err(self.lacks(job, what.to_owned()))
    }

    /// Something that this machine lacks.
    pub(crate) fn lacks(&self, job: &str, what: String) -> Error {
        let adapter = format!("{} through {}", self.info.name, self.kind.name());
        Error::unsupported(job, &adapter, what)
    }

    /// Has a job done: the parts of its answer.
    pub(crate) fn ask(&self, job: &str, request: &Request, data: &Data) -> Result<Vec<Vec<u8>>, Error> {
        let internal = |message: String| answer::error(self.kind, job, "internal", message);
        let json = serde_json::to_vec(request).map_err(|error| internal(error.to_string()))?;
        let mut held = self.process.lock().unwrap_or_else(PoisonError::into_inner);
        // Taken out while it works: after a failure it is gone, and the next job gets a new one.
        let mut process = match held.take() {
            Some(process) => process,
            None => self.restart(job)?,
        };
        let (said, bytes) = process
            .ask(&json, &data.0)
            .map_err(|why| answer::stopped(self.kind, job, why))?;
        let parsed: Answer = serde_json::from_slice(&said)
            .map_err(|error| internal(format!("its answer is not understood: {error}")))?;
        match parsed {
            Answer::Done { lengths } => {
                *held = Some(process);
                split(&bytes, &lengths).ok_or_else(|| internal("its answer's parts do not fit".to_owned()))
            }
            Answer::Failed { failure, message } => {
                if failure != "lost" {
                    *held = Some(process);
                }
                Err(answer::error(self.kind, job, &failure, message))
            }
        }
    }

    fn restart(&self, job: &str) -> Result<Process, Error> {
        let (process, hello) = start(self.kind, &self.program, &self.script, &self.info, self.limits)
            .map_err(|why| answer::stopped(self.kind, job, why))?;
        match hello {
            Hello::Open { .. } => Ok(process),
            Hello::Refused { message } => Err(answer::error(self.kind, job, "lost", message)),
        }
    }
}

fn start(
    kind: Kind,
    program: &Path,
    script: &Script,
    info: &AdapterInfo,
    limits: Limits,
) -> Result<(Process, Hello), Stopped> {
    let mut process = Process::start(program, &kind.arguments(&script.main(), &info.name), limits)?;
    let (said, _) = process.answer()?;
    let hello = serde_json::from_slice(&said)
        .map_err(|error| Stopped(format!("its first word is not understood: {error}")))?;
    Ok((process, hello))
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The parts of these lengths, if they are the whole.
fn split(bytes: &[u8], lengths: &[usize]) -> Option<Vec<Vec<u8>>> {
    let mut rest = bytes;
    let mut parts = Vec::with_capacity(lengths.len());
    for length in lengths {
        let (part, after) = rest.split_at_checked(*length)?;
        parts.push(part.to_vec());
        rest = after;
    }
    rest.is_empty().then_some(parts)
}

impl Machine for Remote {
    fn info(&self) -> &AdapterInfo {
        &self.info
    }

    fn dispatch_limits(&self) -> DispatchLimits {
        DispatchLimits {
            workgroups: self.capacity.workgroups,
            buffer_bytes: self.capacity.buffer_bytes,
        }
    }

    fn compute(&self, job: &ComputeJob<'_>) -> Result<ComputeOutput, Error> {
        compute::run(self, job)
    }

    fn render(&self, job: &RenderJob<'_>) -> Result<RenderOutput, Error> {
        render::run(self, job)
    }
}

#[cfg(test)]
mod tests {
    use super::split;

    #[test]
    fn parts_are_the_whole_or_nothing() {
        assert_eq!(split(b"abc", &[1, 2]), Some(vec![b"a".to_vec(), b"bc".to_vec()]));
        assert_eq!(split(b"abc", &[1]), None);
        assert_eq!(split(b"abc", &[1, 3]), None);
        assert_eq!(split(b"", &[]), Some(Vec::new()));
    }
}
