//! MSL with every slot stated: buffers, textures and samplers are numbered from 0 within an entry point, in the order of
//! group and binding.
//!
//! Metal has one argument table of each sort a stage. After the buffers come, where they are needed, the push constants
//! and the buffer with the sizes of runtime-sized arrays. Vertex buffers share the table with them: an engine puts those
//! at the top, from 30 downwards, as is usual. A binding array is an argument buffer.

use std::collections::BTreeMap;

use naga::back::msl;
use naga::{Expression, SampleLevel};

use crate::diagnostic::{Code, Diagnostic};
use crate::emit::sample_arguments::{self, MSL_GRADIENTS};
use crate::emit::{Contents, Job, Placement, Slot, Written};
use crate::manifest::{BufferSizes, Kind, MslSlot};
use crate::resources::{Resource, is_runtime_sized};

/// Sizes of Metal's argument tables on every device.
const LIMITS: [(Table, u32); 3] = [(Table::Buffer, 31), (Table::Texture, 31), (Table::Sampler, 16)];

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Table {
    Buffer,
    Texture,
    Sampler,
}

impl Table {
    const fn name(self) -> &'static str {
        match self {
            Self::Buffer => "buffer",
            Self::Texture => "texture",
            Self::Sampler => "sampler",
        }
    }

    const fn of(resource: &Resource) -> Self {
        if resource.count.is_some() {
            return Self::Buffer;
        }
        match resource.kind {
            Kind::UniformBuffer | Kind::StorageBuffer | Kind::ReadOnlyStorageBuffer => Self::Buffer,
            Kind::Texture | Kind::DepthTexture | Kind::StorageTexture => Self::Texture,
            Kind::Sampler | Kind::ComparisonSampler => Self::Sampler,
        }
    }
}

/// Hands out the numbers of each table in turn.
#[derive(Default)]
struct Tables(BTreeMap<Table, u32>);

impl Tables {
    fn take(&mut self, table: Table) -> (msl::Slot, MslSlot) {
        let next = self.0.entry(table).or_default();
        let index = *next;
        *next += 1;
        let slot = MslSlot {
            slot: table.name().to_owned(),
            index,
        };
        // Numbers above the limit are refused before anything is written with them.
        (msl::Slot::try_from(index).unwrap_or(msl::Slot::MAX), slot)
    }

    fn check(&self, job: &Job<'_>) -> Result<(), Diagnostic> {
        for (table, limit) in LIMITS {
            let used = self.0.get(&table).copied().unwrap_or_default();
            if used > limit {
                let message = format!("{used} {}s; Metal has {limit} a stage", table.name());
                return Err(job.refuse(Code::Binding, message, None));
            }
        }
        Ok(())
    }
}

pub(super) fn write(job: &Job<'_>) -> Result<Written, Diagnostic> {
    let (resources, placement) = assign(job)?;
    let options = naga_options(job, resources);
    let pipeline = msl::PipelineOptions::default();
    let (text, info) = msl::write_string(&job.unit.module, &job.unit.info, &options, &pipeline)
        .map_err(|error| job.failed(&error))?;
    let entry_point = match info.entry_point_names.into_iter().next() {
        Some(Ok(name)) => name,
        Some(Err(error)) => return Err(job.failed(&error)),
        None => return Err(job.refuse(Code::Internal, "naga wrote no entry point", None)),
    };
    Ok(Written {
        contents: Contents::Text(with_gradients(job, text)?),
        entry_point,
        placement,
    })
}

/// Explicit gradients of the texture's own dimensions.
fn with_gradients(job: &Job<'_>, text: String) -> Result<String, Diagnostic> {
    let has_gradient = |sample: &Expression| {
        matches!(
            sample,
            Expression::ImageSample {
                level: SampleLevel::Gradient { .. },
                ..
            }
        )
    };
    if !sample_arguments::occurs(job.unit, has_gradient) {
        return Ok(text);
    }
    MSL_GRADIENTS.apply(&text).map_err(|what| {
        let message = format!("MSL: naga's code for gradients is not as known: {what}");
        job.refuse(Code::Internal, message, None)
    })
}

fn assign(job: &Job<'_>) -> Result<(msl::EntryPointResources, Placement), Diagnostic> {
    let mut tables = Tables::default();
    let mut map = msl::EntryPointResources::default();
    let mut placement = Placement::default();
    let used = || job.resources.iter().filter(|r| !r.usage.is_empty());
    for resource in used() {
        let table = Table::of(resource);
        let (number, slot) = tables.take(table);
        map.resources
            .insert(resource.naga_key(), target(resource, table, number));
        placement.slots.insert(resource.key(), Slot::Msl(slot));
    }
    if job.immediates.is_some() {
        let (number, slot) = tables.take(Table::Buffer);
        map.immediates_buffer = Some(number);
        placement.msl_immediates = Some(slot);
    }
    let sized = sized_buffers(job);
    if !sized.is_empty() {
        let (number, slot) = tables.take(Table::Buffer);
        map.sizes_buffer = Some(number);
        placement.buffer_sizes = Some(BufferSizes { slot, buffers: sized });
    }
    tables.check(job)?;
    Ok((map, placement))
}

fn target(resource: &Resource, table: Table, number: msl::Slot) -> msl::BindTarget {
    let mut target = msl::BindTarget {
        mutable: matches!(resource.kind, Kind::StorageBuffer | Kind::StorageTexture),
        ..msl::BindTarget::default()
    };
    match table {
        Table::Buffer => target.buffer = Some(number),
        Table::Texture => target.texture = Some(number),
        Table::Sampler => target.sampler = Some(msl::BindSamplerTarget::Resource(number)),
    }
    target
}

/// The used buffers that end in a runtime-sized array, in the order of declaration, which is the order that naga's struct
/// of sizes has.
fn sized_buffers(job: &Job<'_>) -> Vec<String> {
    let mut sized: Vec<&Resource> = job
        .resources
        .iter()
        .filter(|r| !r.usage.is_empty() && is_runtime_sized(job.unit, r.ty))
        .collect();
    sized.sort_by_key(|resource| resource.handle);
    sized.iter().map(|resource| resource.name.clone()).collect()
}

fn naga_options(job: &Job<'_>, resources: msl::EntryPointResources) -> msl::Options {
    let name = job.unit.entry().name.clone();
    msl::Options {
        lang_version: job.options.msl,
        per_entry_point_map: BTreeMap::from([(name, resources)]),
        fake_missing_bindings: false,
        bounds_check_policies: super::bounds_check_policies(job.options.bounds_checks),
        force_loop_bounding: job.options.bound_loops,
        ..msl::Options::default()
    }
}
