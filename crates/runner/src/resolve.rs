//! From a job's resources to what stands at each binding of its shaders, by the manifest alone and for any [`Machine`].
//!
//! All that can be wrong without knowing the machine is found here: stages that disagree, a resource that is missing, of another
//! kind or unknown, uniforms without a value. What a machine can't hold is for the machine to say.
//!
//! [`Machine`]: crate::Machine

use std::collections::BTreeMap;

use bossage_translate::Stage;
use bossage_translate::manifest::{Binding, Block, Entry, Kind};

use crate::code::Shader;
use crate::error::Error;
use crate::layout;
use crate::resources::{BufferData, PUSH_CONSTANTS, Resources, slot};
use crate::texture::{SamplerSettings, TextureData};
use crate::uniforms;

/// What a job gives for a binding.
#[derive(Clone, Debug)]
pub enum Value<'a> {
    /// The bytes of a uniform buffer.
    Uniform(Vec<u8>),
    /// A storage buffer: not empty, and of whole words.
    Storage(BufferData<'a>),
    /// A texture of the binding's dimension, whose levels are whole.
    Texture(&'a TextureData),
    /// A texture of one level that the shader loads from or stores to.
    StorageTexture(&'a TextureData),
    /// A sampler; one that compares does so by "less or equal".
    Sampler(SamplerSettings),
}

/// A binding of one or both stages, and what stands there.
#[derive(Clone, Debug)]
pub struct Resolved<'a> {
    /// Group and binding in the code of this route.
    pub place: (u32, u32),
    /// The manifest's word on it.
    pub binding: &'a Binding,
    /// The first entry point that has it.
    pub entry: &'a Entry,
    /// The stages that have it.
    pub stages: Vec<Stage>,
    /// What stands there.
    pub value: Value<'a>,
}

/// A binding that one or both stages have.
struct Slot<'a> {
    binding: &'a Binding,
    entry: &'a Entry,
    stages: Vec<Stage>,
}

/// The bindings of a pipeline, by (group, binding).
type Slots<'a> = BTreeMap<(u32, u32), Slot<'a>>;

/// What these stages of one pipeline bind, sorted by place.
///
/// # Errors
/// The first thing that doesn't fit, by name.
pub fn resolve<'a>(
    job: &str,
    shaders: &[&Shader<'a>],
    resources: &Resources<'a>,
) -> Result<Vec<Resolved<'a>>, Error> {
    let slots = merge(job, shaders)?;
    check_buffers_are_known(job, shaders, &slots, resources)?;
    let resolver = Resolver { job, resources };
    let one = |(place, slot): ((u32, u32), Slot<'a>)| {
        Ok(Resolved {
            place,
            value: resolver.value(&slot)?,
            binding: slot.binding,
            entry: slot.entry,
            stages: slot.stages,
        })
    };
    slots.into_iter().map(one).collect()
}

/// The bytes of the push constants that these stages of one pipeline share; none where they have none.
///
/// # Errors
/// [`Error::Length`] when as many bytes as the larger declaration has are not given.
pub fn push_constants(
    job: &str,
    shaders: &[&Shader<'_>],
    resources: &Resources<'_>,
) -> Result<Vec<u8>, Error> {
    let all = shaders
        .iter()
        .filter_map(|shader| shader.entry.immediates.as_ref());
    let Some(pushed) = all.max_by_key(|pushed| pushed.size) else {
        return Ok(Vec::new());
    };
    let mut keys = [pushed.name.as_str(), PUSH_CONSTANTS].into_iter();
    let given = keys.find_map(|key| resources.buffers.get(key));
    let given = given.map_or_else(Vec::new, |data| data.bytes().into_owned());
    let expected = pushed.size.next_multiple_of(4) as usize;
    if given.len() == expected {
        return Ok(given);
    }
    Err(Error::Length {
        job: job.to_owned(),
        what: format!("push constants `{}` in bytes", pushed.name),
        given: given.len(),
        expected,
    })
}

fn merge<'a>(job: &str, shaders: &[&Shader<'a>]) -> Result<Slots<'a>, Error> {
    let mut slots = Slots::new();
    for shader in shaders {
        for binding in &shader.entry.bindings {
            let new = Slot {
                binding,
                entry: shader.entry,
                stages: Vec::new(),
            };
            let place = shader.place(binding);
            let slot = slots.entry(place).or_insert(new);
            agree(job, place, slot, shader.entry, binding)?;
            slot.stages.push(shader.entry.stage);
        }
    }
    Ok(slots)
}

/// Two stages that share a place must mean the same by it.
fn agree(
    job: &str,
    place: (u32, u32),
    slot: &Slot<'_>,
    entry: &Entry,
    binding: &Binding,
) -> Result<(), Error> {
    let said = |binding: &Binding, entry: &Entry| {
        let layout =
            block(entry, binding).map_or_else(String::new, |block| format!(", {} bytes", block.size));
        format!("{}: {}{layout}", binding.name, binding.ty)
    };
    let first = (&slot.binding.name, slot.binding.kind, &slot.binding.ty);
    let same_type = first == (&binding.name, binding.kind, &binding.ty);
    if same_type && block(slot.entry, slot.binding) == block(entry, binding) {
        return Ok(());
    }
    let (group, binding_index) = place;
    let (first, second) = (said(slot.binding, slot.entry), said(binding, entry));
    Err(Error::StagesDisagree {
        job: job.to_owned(),
        group,
        binding: binding_index,
        first,
        second,
    })
}

fn block<'a>(entry: &'a Entry, binding: &Binding) -> Option<&'a Block> {
    entry
        .uniforms
        .iter()
        .find(|block| (block.group, block.binding) == (binding.group, binding.binding))
}

/// A storage buffer that goes nowhere is a mistake; values, textures and samplers beyond what is asked for are not.
fn check_buffers_are_known(
    job: &str,
    shaders: &[&Shader<'_>],
    slots: &Slots<'_>,
    resources: &Resources<'_>,
) -> Result<(), Error> {
    let is_pushed = |key: &String| {
        let mut all = shaders
            .iter()
            .filter_map(|shader| shader.entry.immediates.as_ref());
        all.any(|pushed| pushed.name == *key || key == PUSH_CONSTANTS)
    };
    let is_known =
        |key: &String| is_pushed(key) || slots.values().any(|slot| keys(slot.binding).contains(key));
    match resources.buffers.keys().find(|key| !is_known(key)) {
        None => Ok(()),
        Some(name) => Err(Error::UnknownResource {
            job: job.to_owned(),
            name: name.clone(),
            known: slots.values().map(|slot| slot.binding.name.clone()).collect(),
        }),
    }
}

/// The keys under which a resource of this binding is looked for.
fn keys(binding: &Binding) -> [String; 2] {
    [binding.name.clone(), slot(binding.group, binding.binding)]
}

fn look_up<T: Copy>(table: &BTreeMap<String, T>, binding: &Binding) -> Option<T> {
    keys(binding).iter().find_map(|key| table.get(key)).copied()
}

struct Resolver<'r, 'a> {
    job: &'r str,
    resources: &'r Resources<'a>,
}

impl<'a> Resolver<'_, 'a> {
    fn value(&self, slot: &Slot<'a>) -> Result<Value<'a>, Error> {
        match slot.binding.kind {
            Kind::UniformBuffer => self.uniform(slot),
            Kind::ReadOnlyStorageBuffer | Kind::StorageBuffer => self.storage(slot),
            Kind::Texture | Kind::DepthTexture => self.texture(slot).map(Value::Texture),
            Kind::StorageTexture => self.texture(slot).map(Value::StorageTexture),
            Kind::Sampler | Kind::ComparisonSampler => look_up(&self.resources.samplers, slot.binding)
                .map(Value::Sampler)
                .ok_or_else(|| self.missing(slot)),
        }
    }

    fn uniform(&self, slot: &Slot<'a>) -> Result<Value<'a>, Error> {
        if let Some(data) = look_up(&self.resources.buffers, slot.binding) {
            self.check_length(slot, data.len())?;
            return Ok(Value::Uniform(data.bytes().into_owned()));
        }
        let block = block(slot.entry, slot.binding).ok_or_else(|| {
            let problem = "the manifest doesn't describe its members".to_owned();
            Error::misfit(slot.entry, &slot.binding.name, problem)
        })?;
        let bytes = uniforms::pack(self.job, block, &self.resources.uniforms)?;
        self.check_length(slot, bytes.len())?;
        Ok(Value::Uniform(bytes))
    }

    fn storage(&self, slot: &Slot<'a>) -> Result<Value<'a>, Error> {
        let data = look_up(&self.resources.buffers, slot.binding).ok_or_else(|| self.missing(slot))?;
        if let (BufferData::Output(_), Kind::ReadOnlyStorageBuffer) = (data, slot.binding.kind) {
            return Err(self.wrong(slot, "an output".to_owned()));
        }
        self.check_length(slot, data.len())?;
        Ok(Value::Storage(data))
    }

    fn check_length(&self, slot: &Slot<'_>, given: usize) -> Result<(), Error> {
        if given > 0 && given.is_multiple_of(4) {
            return Ok(());
        }
        Err(Error::Length {
            job: self.job.to_owned(),
            what: format!("buffer `{}` in bytes", slot.binding.name),
            given,
            expected: given.next_multiple_of(4).max(4),
        })
    }

    fn texture(&self, slot: &Slot<'a>) -> Result<&'a TextureData, Error> {
        let data: &TextureData =
            look_up(&self.resources.textures, slot.binding).ok_or_else(|| self.missing(slot))?;
        if let Some(given) = layout::misfit_of_texture(slot.entry, slot.binding, data)? {
            return Err(self.wrong(slot, given));
        }
        data.validate(&slot.binding.name)?;
        Ok(data)
    }

    fn missing(&self, slot: &Slot<'_>) -> Error {
        Error::MissingResource {
            job: self.job.to_owned(),
            name: slot.binding.name.clone(),
            group: slot.binding.group,
            binding: slot.binding.binding,
            kind: layout::describe(slot.binding),
        }
    }

    fn wrong(&self, slot: &Slot<'_>, given: String) -> Error {
        let (job, name) = (self.job.to_owned(), slot.binding.name.clone());
        Error::WrongResource {
            job,
            name,
            expected: layout::describe(slot.binding),
            given,
        }
    }
}
