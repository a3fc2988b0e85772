//! The one place of this workspace that needs `unsafe`: SPIR-V goes to the driver without being looked at.
//!
//! What is checked first, in safe code: that the bytes are words, that they begin as a SPIR-V module does, and that its
//! instructions, by their own lengths, end exactly at the end of the bytes. What is *not* checked is what spirv-val
//! checks: a driver given an ill-formed module may do anything, so run untrusted modules in a process of their own.

use std::borrow::Cow;

use crate::error::Error;

const MAGIC: u32 = 0x0723_0203;
const HEADER_WORDS: usize = 5;
const OP_ENTRY_POINT: u32 = 15;

/// The words of a module and the names of its entry points.
pub(crate) struct Module {
    pub(crate) words: Vec<u32>,
    pub(crate) entries: Vec<String>,
}

/// Reads the outer form of a SPIR-V module.
pub(crate) fn read(job: &str, bytes: &[u8]) -> Result<Module, Error> {
    let wrong = |problem: String| Error::NotSpirv {
        job: job.to_owned(),
        problem,
    };
    let (chunks, rest) = bytes.as_chunks::<4>();
    if !rest.is_empty() {
        return Err(wrong(format!("{} bytes are no whole words", bytes.len())));
    }
    let words: Vec<u32> = chunks.iter().map(|chunk| u32::from_le_bytes(*chunk)).collect();
    if words.first() != Some(&MAGIC) || words.len() < HEADER_WORDS {
        return Err(wrong(
            "it doesn't begin with the header of a little-endian module".to_owned(),
        ));
    }
    let entries = entry_points(&words).map_err(wrong)?;
    Ok(Module { words, entries })
}

fn entry_points(words: &[u32]) -> Result<Vec<String>, String> {
    let mut names = Vec::new();
    let mut at = HEADER_WORDS;
    while at < words.len() {
        let (opcode, length) = (words[at] & 0xffff, (words[at] >> 16) as usize);
        let operands = words.get(at + 1..at + length).filter(|_| length > 0);
        let operands = operands.ok_or_else(|| format!("the instruction at word {at} runs past the end"))?;
        if opcode == OP_ENTRY_POINT {
            names.push(literal(operands.get(2..).unwrap_or_default()));
        }
        at += length;
    }
    Ok(names)
}

/// A string of SPIR-V: UTF-8, ended by a zero byte.
fn literal(words: &[u32]) -> String {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    let text: Vec<u8> = bytes.take_while(|byte| *byte != 0).collect();
    String::from_utf8_lossy(&text).into_owned()
}

/// Hands the words to the driver.
#[allow(
    unsafe_code,
    reason = "wgpu offers no safe way to run SPIR-V as it was emitted, which is what is to be tested"
)]
pub(crate) fn create(device: &wgpu::Device, label: &str, module: &Module) -> wgpu::ShaderModule {
    let entry = |name: &String| wgpu::PassthroughShaderEntryPoint {
        name: Cow::Owned(name.clone()),
        workgroup_size: (0, 0, 0),
    };
    let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
        label: Some(label),
        entry_points: module.entries.iter().map(entry).collect(),
        spirv: Some(Cow::Borrowed(&module.words)),
        ..Default::default()
    };
    // SAFETY: the module must be valid for the driver and must match the layout that it is bound by. The first is what
    // emitting from a validated module (and spirv-val) gives; the second comes from the same module's manifest.
    unsafe { device.create_shader_module_passthrough(descriptor) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(words: &[u32]) -> Vec<u8> {
        words.iter().flat_map(|word| word.to_le_bytes()).collect()
    }

    #[test]
    fn entry_points_are_found_by_name() {
        let name = u32::from_le_bytes(*b"main");
        let words = [
            MAGIC,
            0x1_0000,
            0,
            9,
            0,
            (2 << 16) | 17,
            1,
            (5 << 16) | OP_ENTRY_POINT,
            5,
            3,
            name,
            0,
        ];
        assert_eq!(read("test", &bytes(&words)).unwrap().entries, ["main"]);
    }

    #[test]
    fn what_is_no_module_is_refused_before_a_driver_sees_it() {
        let header = [MAGIC, 0x1_0000, 0, 9, 0];
        let overrun = [&header[..], &[(7 << 16) | 17, 1]].concat();
        let endless = [&header[..], &[17]].concat();
        let swapped = [MAGIC.swap_bytes(), 0, 0, 0, 0];
        for words in [&header[..4], &overrun, &endless, &swapped, &[]] {
            assert!(
                matches!(read("test", &bytes(words)), Err(Error::NotSpirv { .. })),
                "{words:?}"
            );
        }
        assert!(matches!(read("test", &[3, 2, 0x23]), Err(Error::NotSpirv { .. })));
    }
}
