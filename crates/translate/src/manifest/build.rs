//! Builds a manifest from a shader and what was emitted from it.

use std::collections::BTreeMap;

use sha2::{Digest, Sha256};

use crate::cost;
use crate::emit::{Emitted, EmittedFile, Slot};
use crate::ir;
use crate::manifest::{
    Binding, Block, Entry, Immediates, Kind, Manifest, SCHEMA, SpecialConstants, Texture, interface, layout,
};
use crate::options::EmitOptions;
use crate::resources::{self, Resource};
use crate::shader::{Shader, Unit};
use crate::target::Target;
use crate::type_name::{access_name, dimension, sample_type, type_name};

/// The version of naga that this crate is built with; a test compares it with the lock file.
pub(crate) const NAGA_VERSION: &str = "30.0.1";

/// The manifest of a shader and of what was emitted from it. Languages that are missing from `emitted` are missing from
/// the manifest.
#[must_use]
pub fn manifest(shader: &Shader, options: &EmitOptions, emitted: &[Emitted]) -> Manifest {
    let entries = shader
        .units()
        .iter()
        .enumerate()
        .map(|(at, unit)| entry(shader, unit, &files_at(emitted, at)))
        .collect();
    Manifest {
        schema: SCHEMA,
        tools: BTreeMap::from([
            ("naga".to_owned(), NAGA_VERSION.to_owned()),
            (
                "bossage-translate".to_owned(),
                env!("CARGO_PKG_VERSION").to_owned(),
            ),
        ]),
        options: options.clone(),
        entries,
    }
}

/// The files of one entry point. Files and units are in the same order; names alone need not tell them apart.
type Files<'a> = BTreeMap<Target, &'a EmittedFile>;

fn files_at(emitted: &[Emitted], at: usize) -> Files<'_> {
    emitted
        .iter()
        .filter_map(|e| Some((e.target, e.files.get(at)?)))
        .collect()
}

fn entry(shader: &Shader, unit: &Unit, files: &Files<'_>) -> Entry {
    let resources = &unit.resources;
    let by_target = |value: &dyn Fn(&EmittedFile) -> String| -> BTreeMap<String, String> {
        files
            .iter()
            .map(|(target, file)| (target.name().to_owned(), value(file)))
            .collect()
    };
    let blocks = |wanted: &[Kind]| -> Vec<Block> {
        let of_kind = resources.iter().filter(|r| wanted.contains(&r.kind));
        of_kind.map(|r| layout::block(unit, r)).collect()
    };
    Entry {
        shader: shader.name().to_owned(),
        name: unit.entry().name.clone(),
        stage: unit.stage,
        files: by_target(&|file| file.file_name.clone()),
        entry_points: by_target(&|file| file.entry_point.clone()),
        sha256: by_target(&|file| hex(&Sha256::digest(file.contents.bytes()))),
        bindings: resources.iter().map(|r| binding(unit, r, files)).collect(),
        uniforms: blocks(&[Kind::UniformBuffer]),
        storage: blocks(&[Kind::StorageBuffer, Kind::ReadOnlyStorageBuffer]),
        immediates: immediates(unit, files),
        inputs: interface::varyings(unit, false),
        outputs: interface::varyings(unit, true),
        workgroup_size: (unit.stage == crate::Stage::Compute).then(|| unit.entry().workgroup_size),
        overrides: shader.overrides().to_vec(),
        hlsl_special_constants: special_constants(unit, files),
        msl_buffer_sizes: files
            .get(&Target::Msl)
            .and_then(|file| file.placement.buffer_sizes.clone()),
        glsl_first_instance: files
            .get(&Target::Glsl)
            .and_then(|file| file.placement.first_instance.clone()),
        cost: cost::cost(unit),
    }
}

fn binding(unit: &Unit, resource: &Resource, files: &Files<'_>) -> Binding {
    let mut binding = Binding {
        name: resource.name.clone(),
        kind: resource.kind,
        group: resource.group,
        binding: resource.binding,
        ty: type_name(&unit.module, resource.ty),
        count: resource.count,
        texture: texture(unit, resource),
        spirv: None,
        hlsl: None,
        msl: None,
        glsl: None,
    };
    for file in files.values() {
        match file.placement.slots.get(&resource.key()) {
            Some(Slot::Spirv(slot)) => binding.spirv = Some(*slot),
            Some(Slot::Hlsl(slot)) => binding.hlsl = Some(slot.clone()),
            Some(Slot::Msl(slot)) => binding.msl = Some(slot.clone()),
            Some(Slot::Glsl(slot)) => binding.glsl = Some(slot.clone()),
            None => {}
        }
    }
    binding
}

fn texture(unit: &Unit, resource: &Resource) -> Option<Texture> {
    let naga::TypeInner::Image { dim, arrayed, class } = unit.module.types[resource.ty].inner else {
        return None;
    };
    let mut texture = Texture {
        dimension: dimension(dim).to_owned(),
        arrayed,
        multisampled: class.is_multisampled(),
        sample_type: "f32".to_owned(),
        format: None,
        access: None,
    };
    match class {
        naga::ImageClass::Sampled { kind, .. } => sample_type(kind).clone_into(&mut texture.sample_type),
        naga::ImageClass::Storage { format, access } => {
            sample_type(naga::Scalar::from(format).kind).clone_into(&mut texture.sample_type);
            texture.format = Some(naga::common::wgsl::ToWgsl::to_wgsl(format).to_owned());
            texture.access = Some(access_name(access).to_owned());
        }
        naga::ImageClass::Depth { .. } | naga::ImageClass::External => {}
    }
    Some(texture)
}

fn immediates(unit: &Unit, files: &Files<'_>) -> Option<Immediates> {
    let (_, variable) = resources::immediates(unit)?;
    let (size, members) = layout::members(unit, variable.ty);
    Some(Immediates {
        name: variable.name.clone().unwrap_or_default(),
        size,
        members,
        hlsl: files
            .get(&Target::Hlsl)
            .and_then(|file| file.placement.hlsl_immediates.clone()),
        msl: files
            .get(&Target::Msl)
            .and_then(|file| file.placement.msl_immediates.clone()),
        glsl: files
            .get(&Target::Glsl)
            .map(|file| file.placement.glsl_immediates.clone())
            .unwrap_or_default(),
    })
}

/// The three values mean something else to each of naga's uses.
fn special_constants(unit: &Unit, files: &Files<'_>) -> Option<SpecialConstants> {
    let slot = files.get(&Target::Hlsl)?.placement.special_constants.clone()?;
    let counts_workgroups = ir::interface(unit, false)
        .iter()
        .any(|(_, _, b)| *b == naga::Binding::BuiltIn(naga::BuiltIn::NumWorkGroups));
    let fields = if counts_workgroups {
        ["workgroups_x", "workgroups_y", "workgroups_z"]
    } else {
        ["first_vertex", "first_instance", "unused"]
    };
    Some(SpecialConstants {
        slot,
        fields: fields.map(str::to_owned).to_vec(),
    })
}

/// Lower-case hexadecimal digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    const DIGITS: [char; 16] = [
        '0', '1', '2', '3', '4', '5', '6', '7', '8', '9', 'a', 'b', 'c', 'd', 'e', 'f',
    ];
    bytes
        .iter()
        .flat_map(|byte| [DIGITS[usize::from(byte >> 4)], DIGITS[usize::from(byte & 15)]])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stated_naga_is_the_one_in_the_lock_file() {
        let lock = concat!(env!("CARGO_MANIFEST_DIR"), "/../../Cargo.lock");
        let lock = std::fs::read_to_string(lock).unwrap();
        let entry = format!("name = \"naga\"\nversion = \"{NAGA_VERSION}\"");
        assert!(lock.contains(&entry), "NAGA_VERSION is stale");
    }

    #[test]
    fn hexadecimal_digits() {
        assert_eq!(hex(&[0x00, 0x9f, 0xa0]), "009fa0");
        // FIPS 180-4's example: the hash of "abc".
        assert!(hex(&Sha256::digest(b"abc")).starts_with("ba7816bf8f01cfea"));
    }
}
