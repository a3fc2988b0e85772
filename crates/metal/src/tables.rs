//! The argument tables of a stage, by the slots that the manifest states.

use bossage_runner::{
    AddressMode, Error, Filter, Resolved, SamplerSettings, Shader, TextureData, TextureDimension, Value,
    within,
};
use bossage_translate::manifest::{Binding, Kind};

use crate::job::Words;
use crate::machine::NAME;
use crate::texels;

/// Bytes of a buffer: what WebGPU promises everywhere.
pub(crate) const MAX_BUFFER_BYTES: u64 = 128 << 20;
/// Levels of a texture.
const MAX_LEVELS: u64 = 16;

/// What a stage binds, as words, and what of it comes back.
pub(crate) struct Tables {
    pub(crate) words: Words,
    /// Names and sizes of the buffers that come back, by slot.
    pub(crate) written: Vec<(String, usize)>,
}

/// A table that is being filled.
#[derive(Default)]
struct Table {
    count: u32,
    words: Words,
}

impl Table {
    fn row(&mut self, slot: u32) -> &mut Words {
        self.count += 1;
        self.words.word(slot);
        &mut self.words
    }
}

impl Tables {
    /// Fills the tables of one stage.
    pub(crate) fn of(
        job: &str,
        shader: &Shader<'_>,
        resolved: &[Resolved<'_>],
        pushed: &[u8],
    ) -> Result<Self, Error> {
        let entry = shader.entry;
        let (mut buffers, mut textures, mut samplers) =
            (Table::default(), Table::default(), Table::default());
        let mut written = Vec::new();
        let immediates = entry.immediates.as_ref();
        if let Some(slot) = immediates.and_then(|pushed| pushed.msl.as_ref()) {
            buffer(&mut buffers, job, slot.index, false, pushed)?;
        }
        for binding in &entry.bindings {
            let place = shader.place(binding);
            let Some(one) = resolved.iter().find(|one| one.place == place) else {
                continue;
            };
            let Some(slot) = slot(binding) else { continue };
            match &one.value {
                Value::Uniform(bytes) => buffer(&mut buffers, job, slot, false, bytes)?,
                Value::Storage(data) => {
                    let kept = binding.kind == Kind::StorageBuffer;
                    buffer(&mut buffers, job, slot, kept, &data.bytes())?;
                    if kept {
                        written.push((slot, binding.name.clone(), data.len()));
                    }
                }
                Value::Texture(data) => texture(&mut textures, job, slot, data)?,
                Value::StorageTexture(_) => {
                    return Err(Error::unsupported(
                        job,
                        NAME,
                        format!("storage textures (`{}`)", binding.name),
                    ));
                }
                Value::Sampler(settings) => sampler(&mut samplers, job, slot, settings)?,
            }
        }
        if let Some(sizes) = &entry.msl_buffer_sizes {
            let size = |name: &String| {
                let of = resolved.iter().find(|one| one.binding.name == *name);
                match of.map(|one| &one.value) {
                    Some(Value::Storage(data)) => Ok((data.len() as u32).to_le_bytes()),
                    _ => Err(Error::misfit(
                        entry,
                        name,
                        "its size is asked for, but it is no buffer".to_owned(),
                    )),
                }
            };
            let bytes = sizes.buffers.iter().map(size).collect::<Result<Vec<_>, _>>()?;
            buffer(&mut buffers, job, sizes.slot.index, false, bytes.as_flattened())?;
        }
        written.sort();
        let mut words = Words::default();
        for table in [buffers, textures, samplers] {
            words.word(table.count);
            words.append(&table.words);
        }
        Ok(Self {
            words,
            written: written
                .into_iter()
                .map(|(_, name, bytes)| (name, bytes))
                .collect(),
        })
    }
}

/// The number of a binding in its table; none where the stage does not use it.
fn slot(binding: &Binding) -> Option<u32> {
    binding.msl.as_ref().map(|slot| slot.index)
}

fn buffer(table: &mut Table, job: &str, slot: u32, kept: bool, bytes: &[u8]) -> Result<(), Error> {
    within(
        job,
        "a buffer's size in bytes",
        bytes.len() as u64,
        MAX_BUFFER_BYTES,
    )?;
    let row = table.row(slot);
    row.word(u32::from(kept));
    row.bytes(bytes);
    Ok(())
}

fn texture(table: &mut Table, job: &str, slot: u32, data: &TextureData) -> Result<(), Error> {
    within(
        job,
        "a texture's number of levels",
        data.levels.len() as u64,
        MAX_LEVELS,
    )?;
    let row = table.row(slot);
    // Six faces are one layer of a cube.
    let layers = match data.dimension {
        TextureDimension::Line
        | TextureDimension::Plane
        | TextureDimension::Cube
        | TextureDimension::Volume(_) => 1,
        TextureDimension::Array(layers) | TextureDimension::CubeArray(layers) => layers,
    };
    let depth = data.dimension.slices(0);
    for number in [data.width, data.height, depth, layers, data.levels.len() as u32] {
        row.word(number);
    }
    for level in &data.levels {
        let bytes: Vec<[u8; 4]> = texels::words(data, level)
            .into_iter()
            .map(u32::to_le_bytes)
            .collect();
        row.bytes(bytes.as_flattened());
    }
    Ok(())
}

fn sampler(table: &mut Table, job: &str, slot: u32, settings: &SamplerSettings) -> Result<(), Error> {
    if settings.anisotropy > 1 {
        return Err(Error::unsupported(job, NAME, "anisotropic filtering"));
    }
    let address = match settings.address {
        AddressMode::Clamp => 0,
        AddressMode::Wrap => 1,
        AddressMode::Mirror => 2,
    };
    let linear = |filter: Filter| u32::from(filter == Filter::Linear);
    let (inside, between) = (linear(settings.filter), linear(settings.mip_filter));
    let row = table.row(slot);
    // A comparison is by "less or equal", as on every machine.
    for number in [address, address, address, inside, inside, between, 3] {
        row.word(number);
    }
    row.float(0.0);
    row.float(32.0);
    Ok(())
}
