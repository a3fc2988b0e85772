//! Objects of a scene file: shape, material, transform, and the mesh with its tangents.

use std::sync::Arc;

use bossage_assets::{Mesh, frame_from_normal, frame_from_uv, frame_mikktspace, primitives};
use bossage_shaders::{Form, LightingSpace};
use glam::{DQuat, DVec2, DVec3};

use crate::fields::{ANY, NOT_ZERO, POSITIVE, Table, Value};
use crate::files::{Files, chain};
use crate::load::{Named, named_list};
use crate::model::{Material, Object, Shape, Tangents, Transform};
use crate::{schema, suggest};

impl Named for Object {
    fn name(&self) -> &str {
        &self.name
    }
}

#[derive(Clone, Copy)]
enum Kind {
    Plane,
    Cube,
    Sphere,
    Torus,
    Obj,
}

const SHAPE: [(&str, Kind); 5] = [
    ("plane", Kind::Plane),
    ("cube", Kind::Cube),
    ("sphere", Kind::Sphere),
    ("torus", Kind::Torus),
    ("obj", Kind::Obj),
];
/// Keys that only some shapes have.
const SHAPE_KEYS: [&str; 6] = ["size", "radius", "major", "minor", "segments", "file"];

/// All `[[objects]]`. `materials` is none when those are wrong already: objects are then checked as far as possible.
pub(crate) fn objects(
    root: &Table<'_>,
    materials: Option<&[Material]>,
    files: &Files,
) -> Option<Vec<Object>> {
    root.need("objects", "at least one `[[objects]]`")?;
    let objects = named_list(root, "objects", |table| object(table, materials, files))?;
    if objects.is_empty() {
        root.get("objects")?
            .note("there are no objects", "add at least one `[[objects]]`");
        return None;
    }
    Some(objects)
}

fn object(table: &Table<'_>, materials: Option<&[Material]>, files: &Files) -> Option<Object> {
    let name = table
        .need("name", "`name`, unique among objects")
        .and_then(|v| v.name());
    let material = table.need("material", "`material`, the name of one");
    let material = material.and_then(|value| material_index(&value, materials?));
    let kind = table
        .need("shape", "`shape`: `plane`, `cube`, `sphere`, `torus` or `obj`")
        .and_then(|v| v.word(&SHAPE));
    let shape = match kind {
        Some(kind) => shape(table, kind, files),
        None => skip_shape_keys(table),
    };
    let uv_repeat = table.or("uv_repeat", schema::UV_REPEAT, |v| {
        v.numbers::<2>(NOT_ZERO).map(DVec2::from_array)
    });
    let transform = transform(table);
    table.finish();
    let (transform, (shape, mesh)) = (transform?, shape?);
    let (index, uv_repeat) = (material?, uv_repeat?);
    let material = &materials?[index];
    check_space(table, material, &transform)?;
    let mesh = Arc::new(with_tangents(table, mesh, uv_repeat, material)?);
    Some(Object {
        name: name?.to_owned(),
        shape,
        mesh,
        material: index,
        transform,
        uv_repeat,
    })
}

fn material_index(value: &Value<'_>, materials: &[Material]) -> Option<usize> {
    let name = value.string()?;
    let found = materials.iter().position(|material| material.name == name);
    if found.is_none() {
        let known: Vec<&str> = materials.iter().map(|material| material.name.as_str()).collect();
        value.note(
            format!("there is no material `{name}`"),
            suggest::hint(name, "materials", &known),
        );
    }
    found
}

/// Where the shape itself is wrong, its keys are neither right nor wrong.
fn skip_shape_keys(table: &Table<'_>) -> Option<(Shape, Mesh)> {
    SHAPE_KEYS.into_iter().for_each(|key| drop(table.get(key)));
    None
}

fn shape(table: &Table<'_>, kind: Kind, files: &Files) -> Option<(Shape, Mesh)> {
    let made = match kind {
        Kind::Plane => plane(table),
        Kind::Cube => cube(table),
        Kind::Sphere => sphere(table),
        Kind::Torus => torus(table),
        Kind::Obj => obj(table, files),
    };
    refuse_other_keys(table, kind);
    made
}

/// The keys that belong to a kind of shape.
fn keys_of(kind: Kind) -> &'static [&'static str] {
    match kind {
        Kind::Plane => &["size", "segments"],
        Kind::Cube => &["size"],
        Kind::Sphere => &["radius", "segments"],
        Kind::Torus => &["major", "minor", "segments"],
        Kind::Obj => &["file"],
    }
}

fn refuse_other_keys(table: &Table<'_>, kind: Kind) {
    let word = SHAPE[kind as usize].0;
    for key in SHAPE_KEYS.into_iter().filter(|key| !keys_of(kind).contains(key)) {
        if let Some(value) = table.get(key) {
            let own = keys_of(kind).join("`, `");
            value.note(
                format!("a {word} has no `{key}`"),
                format!("remove it; a {word} has `{own}`"),
            );
        }
    }
}

fn plane(table: &Table<'_>) -> Option<(Shape, Mesh)> {
    let size = table.or("size", schema::PLANE_SIZE, |v| {
        v.numbers::<2>(POSITIVE).map(DVec2::from_array)
    });
    let segments = table.or("segments", schema::PLANE_SEGMENTS_DEFAULT, |v| {
        segments(v, schema::PLANE_SEGMENTS)
    });
    let (size, segments) = (size?, segments?);
    let mesh = match segments {
        [1, 1] => primitives::plane(size.x as f32, size.y as f32),
        [columns, rows] => primitives::grid(size.x as f32, size.y as f32, columns, rows),
    };
    Some((Shape::Plane { size, segments }, mesh))
}

fn cube(table: &Table<'_>) -> Option<(Shape, Mesh)> {
    let size = table.or("size", schema::CUBE_SIZE, |v| v.number(POSITIVE))?;
    Some((Shape::Cube { size }, primitives::cube(size as f32)))
}

fn sphere(table: &Table<'_>) -> Option<(Shape, Mesh)> {
    let radius = table.or("radius", schema::RADIUS, |v| v.number(POSITIVE));
    let segments = table.or("segments", schema::SEGMENTS_DEFAULT, |v| {
        segments(v, schema::SEGMENTS)
    });
    let (radius, segments) = (radius?, segments?);
    Some((
        Shape::Sphere { radius, segments },
        primitives::sphere(radius as f32, segments[0], segments[1]),
    ))
}

fn torus(table: &Table<'_>) -> Option<(Shape, Mesh)> {
    let major = table.or("major", schema::TORUS_MAJOR, |v| v.number(POSITIVE));
    let minor = table.or("minor", schema::TORUS_MINOR, |v| v.number(POSITIVE));
    let segments = table.or("segments", schema::SEGMENTS_DEFAULT, |v| {
        segments(v, schema::SEGMENTS)
    });
    let (major, minor, segments) = (major?, minor?, segments?);
    if minor >= major {
        let message =
            format!("minor ({minor}) is not less than major ({major}): the tube would cross itself");
        let hint = "make `minor` smaller or `major` larger";
        match table.get("minor").or_else(|| table.get("major")) {
            Some(value) => value.note(message, hint),
            None => table.note(message, hint),
        }
        return None;
    }
    let mesh = primitives::torus(major as f32, minor as f32, segments[0], segments[1]);
    Some((
        Shape::Torus {
            major,
            minor,
            segments,
        },
        mesh,
    ))
}

fn segments(value: &Value<'_>, range: std::ops::RangeInclusive<u32>) -> Option<[u32; 2]> {
    let items = value.items()?;
    let [around, along] = items.as_slice() else {
        value.note(
            format!("expected 2 numbers, found {}", items.len()),
            "write `segments = [a, b]`",
        );
        return None;
    };
    let (around, along) = (around.whole(range.clone()), along.whole(range));
    Some([around?, along?])
}

fn obj(table: &Table<'_>, files: &Files) -> Option<(Shape, Mesh)> {
    let (path, mesh) = files.mesh(&table.need("file", "`file`, the OBJ file")?)?;
    Some((Shape::Obj { path }, mesh))
}

fn transform(table: &Table<'_>) -> Option<Transform> {
    let translate = table.or("translate", DVec3::ZERO, |v| v.vec3(ANY));
    let rotate = table.or("rotate", DQuat::IDENTITY, rotations);
    let scale = table.or("scale", DVec3::ONE, |v| {
        if v.is_array() {
            v.vec3(NOT_ZERO)
        } else {
            v.number(NOT_ZERO).map(DVec3::splat)
        }
    });
    Some(Transform {
        scale: scale?,
        rotate: rotate?,
        translate: translate?,
    })
}

/// One rotation, or several applied first to last.
fn rotations(value: &Value<'_>) -> Option<DQuat> {
    if !value.is_array() {
        return rotation(value);
    }
    let each: Vec<Option<DQuat>> = value.items()?.iter().map(rotation).collect();
    let each: Option<Vec<DQuat>> = each.into_iter().collect();
    Some(
        each?
            .into_iter()
            .fold(DQuat::IDENTITY, |sum, next| next * sum)
            .normalize(),
    )
}

fn rotation(value: &Value<'_>) -> Option<DQuat> {
    let table = value.table()?;
    let axis_value = table.need("axis", "`axis = [x, y, z]`");
    let axis = axis_value.as_ref().and_then(|v| v.vec3(ANY));
    let angle_deg = table
        .need(
            "angle_deg",
            "`angle_deg`, counter-clockwise seen from the axis' tip",
        )
        .and_then(|v| v.number(ANY));
    table.finish();
    let unit = axis?.try_normalize();
    if unit.is_none() {
        axis_value?.note(
            "an axis of length 0",
            "give an axis that is not 0, such as [0, 1, 0]",
        );
    }
    Some(DQuat::from_axis_angle(unit?, angle_deg?.to_radians()))
}

/// Lighting in object space measures angles there: the transform must keep them.
fn check_space(table: &Table<'_>, material: &Material, transform: &Transform) -> Option<()> {
    if material.lighting_space == LightingSpace::World || transform.keeps_angles() {
        return Some(());
    }
    let place = table.get("scale")?;
    place.note(
        format!(
            "material `{}` is lit in object space, where a scale that differs by axis bends angles",
            material.name
        ),
        "use one scale for all axes, or set the material's `lighting_space` to `world`",
    );
    None
}

fn with_tangents(table: &Table<'_>, mut mesh: Mesh, uv_repeat: DVec2, material: &Material) -> Option<Mesh> {
    for uv in &mut mesh.uvs {
        *uv = (uv.as_dvec2() * uv_repeat).as_vec2();
    }
    let made = match (material.tangents, material.form) {
        (Tangents::MikkTSpace, _) => frame_mikktspace::generate(&mut mesh),
        (Tangents::FromUv, Form::Published) => frame_from_uv::published(&mut mesh),
        (Tangents::FromUv, Form::Hardened) => frame_from_uv::hardened(&mut mesh),
        (Tangents::FromNormal, Form::Published) => frame_from_normal::generate_published(&mut mesh),
        (Tangents::FromNormal, Form::Hardened) => frame_from_normal::generate_hardened(&mut mesh),
    };
    made.map_err(|error| {
        table.note(
            chain(&error),
            "use sizes that a 32-bit float holds, and a mesh with UVs",
        )
    })
    .ok()?;
    Some(mesh)
}
