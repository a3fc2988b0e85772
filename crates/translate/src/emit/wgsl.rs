//! WGSL, as naga prints it: what is left of the source after parsing, with unused things gone.

use naga::back::wgsl;

use crate::diagnostic::Diagnostic;
use crate::emit::{Contents, Job, Placement, Written};
use crate::target::Stage;

pub(super) fn write(job: &Job<'_>) -> Result<Written, Diagnostic> {
    let module = &job.unit.module;
    let text = wgsl::write_string(module, &job.unit.info, wgsl::WriterFlags::empty())
        .map_err(|error| job.failed(&error))?;
    let entry_point = entry_point(&text, job.unit.stage).unwrap_or(&job.unit.entry().name);
    Ok(Written {
        entry_point: entry_point.to_owned(),
        contents: Contents::Text(text),
        placement: Placement::default(),
    })
}

/// What the entry point, the only one of its stage, is called in the text: naga gives a name that ends in a digit an underscore.
fn entry_point(text: &str, stage: Stage) -> Option<&str> {
    let attribute = match stage {
        Stage::Vertex => "@vertex",
        Stage::Fragment => "@fragment",
        Stage::Compute => "@compute",
    };
    let (_, after) = text.split_once(attribute)?;
    let (_, name) = after.split_once("fn ")?;
    Some(name.split_once('(')?.0.trim())
}

#[cfg(test)]
mod tests {
    use super::{Stage, entry_point};

    #[test]
    fn the_entry_point_is_found_behind_its_attributes() {
        let text =
            "fn other() {\n}\n\n@compute @workgroup_size(1, 1, 1) \nfn dot3_(@builtin(x) id: u32) {\n}\n";
        assert_eq!(entry_point(text, Stage::Compute), Some("dot3_"));
        assert_eq!(entry_point(text, Stage::Vertex), None);
    }
}
