//! Meshes: primitives against their promises, OBJ files good and bad.

use std::path::{Path, PathBuf};

use bossage_assets::{Error, Mesh, MeshDefect, obj, primitives};
use glam::{DVec3, Vec3};

fn bodies() -> Vec<(&'static str, Mesh)> {
    vec![
        ("plane", primitives::plane(3.0, 2.0)),
        ("grid", primitives::grid(3.0, 2.0, 7, 5)),
        ("coarsest grid", primitives::grid(3.0, 2.0, 0, 0)),
        ("cube", primitives::cube(2.0)),
        ("sphere", primitives::sphere(1.5, 24, 12)),
        ("coarsest sphere", primitives::sphere(1.0, 0, 0)),
        ("torus", primitives::torus(2.0, 0.5, 24, 12)),
        ("coarsest torus", primitives::torus(2.0, 0.5, 0, 0)),
    ]
}

/// Where the outward side lies at a vertex: away from the middle of the body next to it.
fn outward(name: &str, p: Vec3) -> Vec3 {
    match name {
        "plane" | "grid" | "coarsest grid" => Vec3::Z,
        "torus" | "coarsest torus" => p - Vec3::new(p.x, 0.0, p.z).normalize() * 2.0,
        _ => p,
    }
}

#[test]
fn primitives_are_valid_and_wound_counter_clockwise() {
    for (name, mesh) in bodies() {
        mesh.validate().unwrap();
        assert!(!mesh.has_mirrored_uvs(), "{name}");
        for [a, b, c] in mesh.triangles() {
            let [a, b, c] = [a, b, c].map(|i| mesh.positions[i]);
            let n = (b - a).cross(c - a);
            assert!(n.length() > 1e-3, "{name}: a triangle without area");
            assert!(
                n.dot([a, b, c].map(|p| outward(name, p)).iter().sum::<Vec3>()) > 0.0,
                "{name}: wound the wrong way"
            );
        }
    }
}

#[test]
fn primitives_have_orthonormal_right_handed_frames_along_their_uvs() {
    for (name, mesh) in bodies() {
        for ((n, t), p) in mesh.normals.iter().zip(&mesh.tangents).zip(&mesh.positions) {
            let (n, tangent): (DVec3, DVec3) = (n.as_dvec3(), t.truncate().as_dvec3());
            // Components are rounded once from f64: 3 products of values up to 1, 2⁻²⁵ each.
            let bound = 6.0 * 2f64.powi(-25);
            assert!(
                (n.length() - 1.0).abs() <= bound && (tangent.length() - 1.0).abs() <= bound,
                "{name}"
            );
            assert!(n.dot(tangent).abs() <= bound && t.w == 1.0, "{name} at {p}");
        }
        for [a, b, c] in mesh.triangles() {
            // Along the triangle's own (T; B): the stored tangent must point the same way, within the segment's bend of
            // 180° / 3 at the coarsest: a positive dot product.
            let (p, q) = (
                mesh.positions[b] - mesh.positions[a],
                mesh.positions[c] - mesh.positions[a],
            );
            let (s, t) = (mesh.uvs[b] - mesh.uvs[a], mesh.uvs[c] - mesh.uvs[a]);
            let det = s.x * t.y - t.x * s.y;
            let tangent = (p * t.y - q * s.y) / det;
            let bitangent = (q * s.x - p * t.x) / det;
            let frame =
                mesh.tangents[a].truncate() + mesh.tangents[b].truncate() + mesh.tangents[c].truncate();
            assert!(frame.dot(tangent) > 0.0, "{name}");
            let n = mesh.normals[a] + mesh.normals[b] + mesh.normals[c];
            assert!(
                n.cross(frame).dot(bitangent) > 0.0,
                "{name}: B = cross(N, T) must run along +v"
            );
        }
    }
}

#[test]
fn curved_primitives_close_exactly() {
    for (name, mesh) in bodies() {
        let count = |p: &Vec3| mesh.positions.iter().filter(|q| *q == p).count();
        if name.contains("sphere") || name.contains("torus") {
            let seam = mesh.uvs.iter().zip(&mesh.positions).filter(|(uv, _)| uv.x == 0.0);
            assert!(
                seam.map(|(_, p)| count(p)).all(|n| n >= 2),
                "{name}: the seam is open"
            );
        }
    }
}

#[test]
fn sizes_are_as_asked() {
    let size = |mesh: Mesh| {
        let (low, high) = mesh.bounds();
        high - low
    };
    assert_eq!(size(primitives::plane(3.0, 2.0)), Vec3::new(3.0, 2.0, 0.0));
    assert_eq!(size(primitives::cube(2.0)), Vec3::splat(2.0));
    assert_eq!(size(primitives::sphere(1.5, 24, 12)), Vec3::splat(3.0));
    assert_eq!(
        size(primitives::torus(2.0, 0.5, 24, 12)),
        Vec3::new(5.0, 1.0, 5.0)
    );
}

#[test]
fn a_grid_is_its_plane_cut_up() {
    let grid = primitives::grid(3.0, 2.0, 7, 5);
    assert_eq!((grid.positions.len(), grid.indices.len()), (8 * 6, 7 * 5 * 6));
    assert_eq!(grid.bounds(), primitives::plane(3.0, 2.0).bounds());
    for (p, uv) in grid.positions.iter().zip(&grid.uvs) {
        // uv and position are both rounded: three roundings of 2⁻²⁴ on numbers up to 3.
        let place = Vec3::new(uv.x - 0.5, uv.y - 0.5, 0.0) * Vec3::new(3.0, 2.0, 0.0);
        assert!((*p - place).length() <= 9.0 * 2f32.powi(-24), "{p} {uv}");
    }
    // The coarsest is the plane itself, up to the order of its corners.
    let (plane, coarse) = (primitives::plane(3.0, 2.0), primitives::grid(3.0, 2.0, 1, 1));
    assert!(plane.positions.iter().all(|p| coarse.positions.contains(p)));
    // Neighbouring quads share their vertices: every triangle's area is that of half a cell.
    let area: f32 = grid
        .triangles()
        .map(|[a, b, c]| {
            let [a, b, c] = [a, b, c].map(|i| grid.positions[i]);
            (b - a).cross(c - a).z / 2.0
        })
        .sum();
    assert!((area - 6.0).abs() <= 70.0 * 6.0 * 2f32.powi(-24), "{area}");
}

#[test]
fn flipping_v_mirrors() {
    let mut plane = primitives::plane(1.0, 1.0);
    plane.flip_v();
    assert!(plane.has_mirrored_uvs() && plane.tangents.iter().all(|t| t.w == -1.0));
    plane.flip_v();
    assert_eq!(plane, primitives::plane(1.0, 1.0));
}

#[test]
fn every_defect_is_found() {
    let broken = |change: fn(&mut Mesh)| {
        let mut mesh = primitives::cube(1.0);
        assert!(mesh.validate().is_ok(), "the control");
        change(&mut mesh);
        mesh.validate().unwrap_err()
    };
    assert_eq!(broken(|m| m.indices.clear()), MeshDefect::NoFaces);
    assert_eq!(
        broken(|m| _ = m.indices.pop()),
        MeshDefect::PartialTriangle { count: 35 }
    );
    assert_eq!(broken(|m| m.uvs.clear()), MeshDefect::NoUvs);
    assert_eq!(
        broken(|m| m.indices[7] = 24),
        MeshDefect::IndexOutOfRange {
            triangle: 2,
            index: 24,
            vertices: 24
        }
    );
    assert!(matches!(
        broken(|m| _ = m.uvs.pop()),
        MeshDefect::AttributeCount {
            attribute: "UVs",
            count: 23,
            ..
        }
    ));
    assert!(matches!(
        broken(|m| _ = m.normals.pop()),
        MeshDefect::AttributeCount {
            attribute: "normals",
            ..
        }
    ));
    let nan = broken(|m| m.positions[3].y = f32::NAN);
    assert!(matches!(
        nan,
        MeshDefect::NonFinite {
            attribute: "position",
            vertex: 3,
            ..
        }
    ));
    assert!(matches!(
        broken(|m| m.uvs[5].x = f32::INFINITY),
        MeshDefect::NonFinite {
            attribute: "UV",
            vertex: 5,
            ..
        }
    ));
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

fn parse(text: &str) -> Result<Mesh, Error> {
    obj::parse(Path::new("m.obj"), text.as_bytes())
}

fn chain(error: &Error) -> String {
    let source = std::error::Error::source(error)
        .map(|s| format!(": {s}"))
        .unwrap_or_default();
    format!("{error}{source}")
}

#[test]
fn an_obj_triangle_turns_v_round_and_gets_normals() {
    let mesh = parse(TRIANGLE).unwrap();
    assert_eq!(mesh.indices, [0, 1, 2]);
    assert_eq!(mesh.uvs[0].to_array(), [0.0, 1.0]);
    assert_eq!(mesh.normals, [Vec3::Z; 3]);
}

#[test]
fn obj_objects_quads_negative_indices_and_forward_references_are_read() {
    let quad =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf -4/-4 -3/-3 -2/-2 -1/-1\n";
    assert_eq!(parse(quad).unwrap().indices.len(), 6);
    let two = format!("o a\n{TRIANGLE}o b\nf 1/1 3/3 2/2\n");
    assert_eq!(parse(&two).unwrap().indices, [0, 1, 2, 3, 4, 5]);
}

#[test]
fn bad_obj_files_are_told_what_and_where() {
    let cases: [(&str, &str, &[&str]); 14] = [
        ("no faces", "v 0 0 0\nv 1 0 0\n", &["m.obj", "no faces"]),
        ("not OBJ at all", "hello\nworld\n", &["m.obj"]),
        (
            "no UVs",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            &["m.obj", "UVs", "vt"],
        ),
        (
            "UVs on one face only",
            &format!("{TRIANGLE}v 2 2 2\nf 1 2 4\n"),
            &["some faces have texture coordinates"],
        ),
        (
            "normals on one face only",
            &format!("{TRIANGLE}vn 0 0 1\nf 1/1/1 3/3/1 2/2/1\n"),
            &["some faces have normals"],
        ),
        (
            "vertex out of range",
            &format!("{TRIANGLE}f 1/1 2/2 9/3\n"),
            &["m.obj:8", "v 9", "3"],
        ),
        (
            "UV out of range",
            &format!("{TRIANGLE}f 1/1 2/2 3/7\n"),
            &["m.obj:8", "vt 7"],
        ),
        (
            "normal out of range",
            &format!("{TRIANGLE}f 1/1/1 2/2/1 3/3/1\n"),
            &["m.obj:8", "vn 1"],
        ),
        (
            "index zero",
            &format!("{TRIANGLE}f 0/1 2/2 3/3\n"),
            &["m.obj:8", "v 0"],
        ),
        (
            "far behind",
            &format!("{TRIANGLE}f 1/-99 2/2 3/3\n"),
            &["m.obj:8", "vt -99"],
        ),
        (
            "a word for a number",
            "v 0 zero 0\n",
            &["m.obj:1", "three numbers"],
        ),
        (
            "two numbers for three",
            "v 0 0 0\nv 1 1\n",
            &["m.obj:2", "three numbers"],
        ),
        (
            "a broken corner",
            &format!("{TRIANGLE}f a/b c d\n"),
            &["m.obj:8", "1/1/1"],
        ),
        (
            "not a number",
            "v 0 0 0\nv 0 nan 0\n",
            &["m.obj:2", "not finite", "nan"],
        ),
    ];
    assert!(parse(TRIANGLE).is_ok(), "the control");
    for (name, text, expected) in cases {
        let message = chain(&parse(text).expect_err(name));
        assert!(expected.iter().all(|e| message.contains(e)), "{name}: {message}");
    }
}

#[test]
fn obj_bytes_that_are_not_text_do_not_panic() {
    for bytes in [
        b"\xff\xfe\0v\0".as_slice(),
        b"f\n",
        b"f 1/1/1/1 2 3\n",
        b"v 1 2 3 0\n",
        b"o\n",
        b"\n\n",
        b"usemtl x\nf 1 2 3",
    ] {
        assert!(obj::parse(Path::new("m.obj"), bytes).is_err(), "{bytes:?}");
    }
}

#[test]
fn missing_and_empty_obj_files_are_named() {
    assert!(matches!(
        obj::load(Path::new("no/such.obj")),
        Err(Error::Read { .. })
    ));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("empty.obj");
    std::fs::write(&path, b"").unwrap();
    assert!(matches!(obj::load(&path), Err(Error::EmptyFile { .. })));
}

#[test]
fn the_example_vase_is_sound() {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/meshes/vase.obj");
    let vase = obj::load(&path).unwrap();
    assert_eq!(vase.indices.len() / 3, 11 * 24 * 2 + 24);
    // Walls face away from the axis, the bottom down.
    for [a, b, c] in vase.triangles() {
        let [a, b, c] = [a, b, c].map(|i| vase.positions[i]);
        let (n, center) = ((b - a).cross(c - a).normalize(), (a + b + c) / 3.0);
        let out = Vec3::new(center.x, 0.0, center.z).normalize();
        assert!(if center.y == 0.0 {
            n.y < -0.9
        } else {
            n.dot(out) > 0.0
        });
    }
    // Smooth normals do not know the texture seam: both sides of it agree.
    let of = |p: Vec3| {
        vase.positions
            .iter()
            .zip(&vase.normals)
            .filter(move |(q, _)| **q == p)
            .map(|(_, n)| *n)
    };
    for p in &vase.positions {
        let first = of(*p).next().unwrap();
        assert!(of(*p).all(|n| n == first));
    }
}
