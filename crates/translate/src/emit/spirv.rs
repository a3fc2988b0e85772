//! SPIR-V: set and binding are the group and binding of the source.
//!
//! Names are kept (`OpName`), so that listings and debuggers are readable; those of inputs and outputs are not, since some
//! drivers match interfaces by them.

use naga::back::spv;
use rspirv::binary::Disassemble;

use crate::diagnostic::{Code, Diagnostic};
use crate::emit::{Contents, Job, Placement, Slot, Written};
use crate::manifest::SpirvSlot;
use crate::resources::Resource;

pub(super) fn write(job: &Job<'_>) -> Result<Written, Diagnostic> {
    let options = naga_options(job);
    let module = &job.unit.module;
    let words = spv::write_vec(module, &job.unit.info, &options, None).map_err(|error| job.failed(&error))?;
    Ok(Written {
        contents: Contents::Binary(words.iter().flat_map(|w| w.to_le_bytes()).collect()),
        entry_point: job.unit.entry().name.clone(),
        placement: place(job.resources),
    })
}

fn place(resources: &[Resource]) -> Placement {
    let slot = |resource: &Resource| {
        Slot::Spirv(SpirvSlot {
            set: resource.group,
            binding: resource.binding,
        })
    };
    Placement {
        slots: resources.iter().map(|r| (r.key(), slot(r))).collect(),
        ..Placement::default()
    }
}

fn naga_options(job: &Job<'_>) -> spv::Options<'static> {
    let mut flags = spv::WriterFlags::DEBUG | spv::WriterFlags::CLAMP_FRAG_DEPTH;
    flags.set(
        spv::WriterFlags::ADJUST_COORDINATE_SPACE,
        job.options.adjust_clip_space,
    );
    spv::Options {
        lang_version: job.options.spirv,
        flags,
        bounds_check_policies: super::bounds_check_policies(job.options.bounds_checks),
        force_loop_bounding: job.options.bound_loops,
        ..spv::Options::default()
    }
}

/// A readable listing of a SPIR-V module. Equal bytes give equal text.
///
/// # Errors
/// When the bytes are not SPIR-V.
pub fn listing(bytes: &[u8]) -> Result<String, Diagnostic> {
    if !bytes.len().is_multiple_of(4) {
        return Err(Diagnostic::new(Code::Parse, "no whole number of SPIR-V words"));
    }
    let words: Vec<u32> = bytes
        .as_chunks::<4>()
        .0
        .iter()
        .map(|word| u32::from_le_bytes(*word))
        .collect();
    let module = rspirv::dr::load_words(&words)
        .map_err(|error| Diagnostic::new(Code::Parse, format!("not a SPIR-V module: {error}")))?;
    let mut text = module.disassemble();
    text.push('\n');
    Ok(text)
}
