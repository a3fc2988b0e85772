//! Dispatches.

use bossage_runner::{ComputeJob, ComputeOutput, Error};
use bossage_translate::Stage;

use crate::groups::{groups, stage};
use crate::machine::Remote;
use crate::message::{Data, Request};

/// Runs a dispatch; gives back all buffers that it may write.
pub(crate) fn run(remote: &Remote, job: &ComputeJob<'_>) -> Result<ComputeOutput, Error> {
    job.shader.expect(Stage::Compute)?;
    let mut data = Data::default();
    let (groups, written) = groups(remote, job.name, &[&job.shader], &job.resources, &mut data)?;
    let request = Request::Compute {
        shader: stage(remote, job.name, &job.shader)?,
        groups,
        workgroups: job.workgroups,
    };
    let parts = remote.ask(job.name, &request, &data)?;
    if parts.len() != written.len() {
        return Err(Error::Internal {
            job: job.name.to_owned(),
            message: format!("{} buffers came back instead of {}", parts.len(), written.len()),
        });
    }
    Ok(ComputeOutput {
        buffers: written.into_iter().zip(parts).collect(),
        ..ComputeOutput::default()
    })
}
