//! From bindings to memory, and back.

use crate::bindings::{Bindings, BufferData, Scalar, cell_from_bytes};
use crate::compile::layout::BufferLayout;
use crate::compile::program::{Program, Resource, ResourceKind};
use crate::domain::Domain;
use crate::error::{Error, Result};
use crate::exec::images::mismatch;
use crate::exec::memory::Memory;
use crate::exec::places::zero;
use crate::kind::Kind;
use crate::limits::Limits;
use crate::texture::{Dimension, Sampler, TexelFormat, Texture, storage_kind};
use naga::{ImageClass, ImageDimension, ScalarKind, StorageAccess};

/// Everything a run needs besides the program.
pub(super) struct Prepared<D: Domain> {
    pub(super) memory: Memory<D>,
    pub(super) textures: Vec<Vec<Texture>>,
    pub(super) samplers: Vec<Vec<Sampler>>,
}

pub(super) fn prepare<D: Domain>(
    program: &Program,
    bindings: &Bindings<D>,
    limits: &Limits,
) -> Result<Prepared<D>> {
    let n = program.resources.len();
    let memory = Memory {
        regions: vec![Vec::new(); n],
        workgroup: vec![None; n],
    };
    let mut prepared = Prepared {
        memory,
        textures: vec![Vec::new(); n],
        samplers: vec![Vec::new(); n],
    };
    for (id, resource) in program.resources.iter().enumerate() {
        place(&mut prepared, id, resource, bindings)?;
    }
    let cells: usize = prepared.memory.regions.iter().map(Vec::len).sum();
    let needed = (cells * size_of::<D::Cell>()) as u64;
    if needed > limits.memory {
        return Err(Error::Memory {
            needed,
            limit: limits.memory,
            what: "bind smaller buffers".into(),
        });
    }
    Ok(prepared)
}

fn place<D: Domain>(
    prepared: &mut Prepared<D>,
    id: usize,
    resource: &Resource,
    bindings: &Bindings<D>,
) -> Result<()> {
    match &resource.kind {
        ResourceKind::Buffer { layout, .. } => {
            prepared.memory.regions[id] = buffer(resource, layout, bindings)?
        }
        ResourceKind::Workgroup { kinds } => {
            prepared.memory.workgroup[id] = Some(kinds.iter().map(|&k| zero::<D>(k)).collect());
        }
        ResourceKind::Texture {
            dim,
            arrayed,
            class,
            count,
        } => {
            let list = textures(resource, *dim, count.unwrap_or(1), bindings)?;
            list.iter()
                .try_for_each(|t| fits(resource, t, *arrayed, *class))?;
            prepared.textures[id] = list;
        }
        ResourceKind::StorageTexture { dim, format, .. } => {
            prepared.textures[id] = textures(resource, *dim, 1, bindings)?;
            prepared.memory.regions[id] = storage_texture::<D>(resource, &prepared.textures[id][0], *format)?;
        }
        ResourceKind::Sampler { comparison } => {
            prepared.samplers[id] = samplers(resource, *comparison, bindings)?
        }
    }
    Ok(())
}

fn missing(resource: &Resource, expected: &'static str) -> Error {
    let (group, binding) = resource.binding.unwrap_or_default();
    Error::MissingBinding {
        group,
        binding,
        name: resource.name.clone(),
        expected,
    }
}

fn misfit(resource: &Resource, reason: String) -> Error {
    let (group, binding) = resource.binding.unwrap_or_default();
    Error::Buffer {
        group,
        binding,
        name: resource.name.clone(),
        reason,
    }
}

fn buffer<D: Domain>(
    resource: &Resource,
    layout: &BufferLayout,
    bindings: &Bindings<D>,
) -> Result<Vec<D::Cell>> {
    let key = resource.binding.unwrap_or_default();
    match bindings
        .buffers
        .get(&key)
        .ok_or_else(|| missing(resource, "buffer"))?
    {
        BufferData::Bytes(bytes) => cells_of_bytes::<D>(resource, layout, bytes),
        BufferData::Scalars(list) => cells_of_scalars(resource, layout, list),
    }
}

fn cells_of_bytes<D: Domain>(
    resource: &Resource,
    layout: &BufferLayout,
    bytes: &[u8],
) -> Result<Vec<D::Cell>> {
    let elements = layout.elements(bytes.len());
    // The padding at the end of the last element may be left out.
    let last = layout
        .scalars(elements)
        .checked_sub(1)
        .and_then(|n| layout.scalar(n));
    let needed = last.map_or(0, |(at, kind)| at + kind.bytes());
    if bytes.len() < needed {
        return Err(misfit(
            resource,
            format!(
                "{} bytes are bound, the variable needs {}",
                bytes.len(),
                layout.bytes(elements)
            ),
        ));
    }
    let scalars = (0..layout.scalars(elements)).filter_map(|n| layout.scalar(n));
    Ok(scalars
        .map(|(at, kind)| cell_from_bytes::<D>(kind, &bytes[at..at + kind.bytes()]))
        .collect())
}

fn cells_of_scalars<D: Domain>(
    resource: &Resource,
    layout: &BufferLayout,
    list: &[Scalar<D>],
) -> Result<Vec<D::Cell>> {
    let element = layout.tail.as_ref().map_or(0, |t| t.element.len());
    let rest = list.len().saturating_sub(layout.fixed.len());
    let fits = list.len() >= layout.fixed.len()
        && if element == 0 {
            rest == 0
        } else {
            rest.is_multiple_of(element)
        };
    if !fits {
        let reason = format!(
            "{} scalars are bound; the variable has {} and then a multiple of {element}",
            list.len(),
            layout.fixed.len()
        );
        return Err(misfit(resource, reason));
    }
    let mut cells = Vec::with_capacity(list.len());
    for (n, scalar) in list.iter().enumerate() {
        let (_, kind) = layout
            .scalar(n)
            .ok_or_else(|| misfit(resource, format!("no scalar {n}")))?;
        let cell = scalar.to_cell(kind);
        cells.push(cell.ok_or_else(|| {
            misfit(
                resource,
                format!("scalar {n} is {scalar:?}, but the variable has a {kind:?} there"),
            )
        })?);
    }
    Ok(cells)
}

fn textures<D: Domain>(
    resource: &Resource,
    dim: ImageDimension,
    count: u32,
    bindings: &Bindings<D>,
) -> Result<Vec<Texture>> {
    let key = resource.binding.unwrap_or_default();
    let list = bindings
        .textures
        .get(&key)
        .filter(|l| !l.is_empty())
        .ok_or_else(|| missing(resource, "texture"))?;
    if list.len() > count as usize {
        return Err(mismatch(
            &resource.name,
            format!("{} textures are bound to an array of {count}", list.len()),
        ));
    }
    let wanted = match dim {
        ImageDimension::D1 => Dimension::D1,
        ImageDimension::D2 => Dimension::D2,
        ImageDimension::D3 => Dimension::D3,
        ImageDimension::Cube => Dimension::Cube,
    };
    match list.iter().find(|t| t.dimension() != wanted) {
        Some(other) => Err(mismatch(
            &resource.name,
            format!(
                "a {:?} texture is bound to a {wanted:?} variable",
                other.dimension()
            ),
        )),
        None => Ok(list.clone()),
    }
}

/// Whether a texture has the layers, samples and kind of texel that the variable is declared with.
fn fits(resource: &Resource, texture: &Texture, arrayed: bool, class: ImageClass) -> Result<()> {
    let (multi, kind) = match class {
        ImageClass::Sampled { kind, multi } => (multi, kind),
        ImageClass::Depth { multi } => (multi, ScalarKind::Float),
        ImageClass::External | ImageClass::Storage { .. } => (false, ScalarKind::Float),
    };
    let found = match texture.format().kind() {
        Kind::Float(_) => ScalarKind::Float,
        Kind::Int(t) if t.signed => ScalarKind::Sint,
        Kind::Int(_) => ScalarKind::Uint,
        Kind::Bool => ScalarKind::Bool,
    };
    if found != kind {
        return Err(mismatch(
            &resource.name,
            format!(
                "the variable holds {kind:?} texels, the texture is {:?}",
                texture.format()
            ),
        ));
    }
    if !arrayed && texture.layers() != 1 {
        return Err(mismatch(
            &resource.name,
            format!(
                "{} layers are bound to a variable that is no array",
                texture.layers()
            ),
        ));
    }
    if multi != (texture.samples() > 1) {
        return Err(mismatch(
            &resource.name,
            format!(
                "multisampled is {multi}, but the texture has {} samples",
                texture.samples()
            ),
        ));
    }
    Ok(())
}

fn samplers<D: Domain>(
    resource: &Resource,
    comparison: bool,
    bindings: &Bindings<D>,
) -> Result<Vec<Sampler>> {
    let key = resource.binding.unwrap_or_default();
    let list = bindings
        .samplers
        .get(&key)
        .filter(|l| !l.is_empty())
        .ok_or_else(|| missing(resource, "sampler"))?;
    if list.iter().any(|s| s.compare.is_some() != comparison) {
        let wanted = if comparison {
            "a comparison sampler"
        } else {
            "a sampler without comparison"
        };
        return Err(mismatch(&resource.name, format!("the variable wants {wanted}")));
    }
    Ok(list.clone())
}

/// The texels of a storage texture as cells, four to a texel.
fn storage_texture<D: Domain>(
    resource: &Resource,
    texture: &Texture,
    format: naga::StorageFormat,
) -> Result<Vec<D::Cell>> {
    if texture.format() != TexelFormat::of_storage(format) {
        return Err(mismatch(
            &resource.name,
            format!(
                "a {:?} texture is bound to a {format:?} variable",
                texture.format()
            ),
        ));
    }
    let [w, h, d] = texture.size(0);
    let mut cells = Vec::new();
    for layer in 0..texture.layers() {
        for (z, y, x) in (0..d).flat_map(|z| (0..h).flat_map(move |y| (0..w).map(move |x| (z, y, x)))) {
            for value in texture.texel(0, [x, y, z], layer) {
                cells.push(match storage_kind(format) {
                    Kind::Float(width) => D::real(width, value, value),
                    Kind::Int(t) => D::int(t, value as i128),
                    Kind::Bool => D::bool(value != 0.0),
                });
            }
        }
    }
    Ok(cells)
}

/// Leaves what the shader may have written in the bindings.
pub(super) fn write_back<D: Domain>(program: &Program, prepared: Prepared<D>, bindings: &mut Bindings<D>) {
    for (resource, cells) in program.resources.iter().zip(prepared.memory.regions) {
        let key = resource.binding.unwrap_or_default();
        match &resource.kind {
            ResourceKind::Buffer {
                layout,
                writable: true,
            } => {
                let kinds = (0..cells.len()).filter_map(|n| layout.scalar(n));
                let list = cells
                    .iter()
                    .zip(kinds)
                    .map(|(&c, (_, kind))| Scalar::from_cell(kind, c))
                    .collect();
                bindings.buffers.insert(key, BufferData::Scalars(list));
            }
            ResourceKind::StorageTexture { format, access, .. } if access.contains(StorageAccess::STORE) => {
                let kind = storage_kind(*format);
                bindings
                    .written_textures
                    .insert(key, cells.iter().map(|&c| Scalar::from_cell(kind, c)).collect());
            }
            ResourceKind::Buffer { .. }
            | ResourceKind::StorageTexture { .. }
            | ResourceKind::Workgroup { .. }
            | ResourceKind::Texture { .. }
            | ResourceKind::Sampler { .. } => {}
        }
    }
}
