//! WGSL, as naga prints it: what is left of the source after parsing, with unused things gone.

use naga::back::wgsl;

use crate::diagnostic::Diagnostic;
use crate::emit::{Contents, Job, Placement, Written};

pub(super) fn write(job: &Job<'_>) -> Result<Written, Diagnostic> {
    let module = &job.unit.module;
    let text = wgsl::write_string(module, &job.unit.info, wgsl::WriterFlags::empty())
        .map_err(|error| job.failed(&error))?;
    Ok(Written {
        contents: Contents::Text(text),
        entry_point: job.unit.entry().name.clone(),
        placement: Placement::default(),
    })
}
