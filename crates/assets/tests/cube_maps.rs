//! Cube maps: orientation, what six files make, and what is said of files that make none.

use std::path::{Path, PathBuf};

use bossage_assets::{ColorMap, CubeFace, CubeMap, Error, encode};
use glam::DVec3;

const NAMES: [&str; 6] = ["sky_px", "sky_nx", "sky_py", "sky_ny", "sky_pz", "sky_nz"];

fn examples() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/textures");
    NAMES.map(|name| folder.join(format!("{name}.png"))).to_vec()
}

fn face(width: u32, height: u32) -> ColorMap {
    ColorMap {
        width,
        height,
        texels: vec![[9, 9, 9, 255]; (width * height) as usize],
    }
}

fn assembled(faces: Vec<ColorMap>) -> Result<CubeMap, Error> {
    CubeMap::from_faces(faces, |face| Path::new(NAMES[face as usize]))
}

#[test]
fn faces_follow_the_table() {
    // s = 1 and t = 1 lie toward these corners, by the tables of the graphics interfaces.
    let far = [
        DVec3::new(1.0, -1.0, -1.0),
        DVec3::new(-1.0, -1.0, 1.0),
        DVec3::new(1.0, 1.0, 1.0),
        DVec3::new(1.0, -1.0, -1.0),
        DVec3::new(1.0, -1.0, 1.0),
        DVec3::new(-1.0, -1.0, -1.0),
    ];
    assert_eq!(CubeFace::ALL.map(|face| face.point(1.0, 1.0)), far);
    let middle = CubeFace::ALL.map(|face| face.point(0.5, 0.5));
    assert_eq!(
        middle,
        [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z]
    );
}

#[test]
fn a_function_is_seen_where_it_points() {
    // Light from +y only: the walls are lit in their upper halves, that is, in their first rows.
    let cube = CubeMap::from_fn(4, 2, |d| DVec3::splat(if d.y > 0.0 { 1.0 } else { 0.0 }));
    let rows = |face: CubeFace| [0, 1, 2, 3].map(|y| cube.faces[face as usize].texels[4 * y][0]);
    for wall in [
        CubeFace::PositiveX,
        CubeFace::NegativeX,
        CubeFace::PositiveZ,
        CubeFace::NegativeZ,
    ] {
        assert_eq!(rows(wall), [255, 255, 0, 0], "{wall}");
    }
    assert_eq!(rows(CubeFace::PositiveY), [255; 4]);
    assert_eq!(rows(CubeFace::NegativeY), [0; 4]);
}

#[test]
fn the_example_sky_is_a_cube_map_whose_faces_meet() {
    let sky = CubeMap::load(&examples()).unwrap();
    assert_eq!(sky.size, 128);
    // The brightest texel lies on the +Z face, toward the sun.
    let light = |map: &ColorMap| {
        map.texels
            .iter()
            .map(|t| u32::from(t[0]) + u32::from(t[1]) + u32::from(t[2]))
            .max()
    };
    let brightest = (0..6).max_by_key(|&i| light(&sky.faces[i])).unwrap();
    assert_eq!(CubeFace::ALL[brightest], CubeFace::PositiveZ);
    // Across the edge of +X and +Z the last column of +Z and the first of +X are neighbours, row by row.
    let [x, z] = [&sky.faces[0], &sky.faces[4]];
    let apart = |y: usize| {
        (0..3)
            .map(|c| x.texels[128 * y][c].abs_diff(z.texels[128 * y + 127][c]))
            .max()
            .unwrap()
    };
    // Above the horizon. The two columns' centres are 0.9° apart at most; the steepest the sky gets is the glow's flank, cos⁶⁴ with
    // 64·cos⁶³·sin < 5 of light a radian, half of that as painted: 0.04 of light, 10 bytes where the curve has slope 1.
    assert!(
        (0..64).all(|y| apart(y) <= 10),
        "{:?}",
        (0..64).map(apart).collect::<Vec<_>>()
    );
    // The control: a face turned upside down is seen, at twice that bound.
    let turned = (0..64)
        .map(|y| x.texels[128 * (127 - y)][0].abs_diff(z.texels[128 * y + 127][0]))
        .max()
        .unwrap();
    assert!(turned > 20, "{turned}");
}

#[test]
fn other_than_six_faces_are_refused_before_any_file_is_read() {
    for count in [0, 5, 7] {
        let paths = vec!["no/such/file.png"; count];
        let error = CubeMap::load(&paths).unwrap_err();
        assert!(
            matches!(error, Error::CubeFaceCount { found } if found == count),
            "{error}"
        );
    }
    let error = assembled(vec![face(2, 2); 5]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "a cube map has six faces, in the order +X, −X, +Y, −Y, +Z, −Z; 5 given"
    );
}

#[test]
fn faces_that_do_not_fit_are_named() {
    let mut faces = vec![face(4, 4); 6];
    faces[3] = face(4, 2);
    let error = assembled(faces.clone()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "sky_ny: the −Y face of the cube map is 4x2; faces must be square"
    );
    faces[3] = face(8, 8);
    let error = assembled(faces).unwrap_err();
    assert_eq!(
        error.to_string(),
        "sky_ny: the −Y face of the cube map is 8x8, but sky_px is 4x4; all six must be of one size"
    );
    let mut short = vec![face(4, 4); 6];
    short[5].texels.pop();
    assert!(matches!(
        assembled(short).unwrap_err(),
        Error::TexelCount { found: 15, .. }
    ));
    assert!(assembled(vec![face(0, 0); 6]).is_err());
}

#[test]
fn files_of_unequal_sizes_are_named_with_their_paths() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, side: u32| {
        let path = folder.path().join(name);
        std::fs::write(&path, encode::color_png(&face(side, side)).unwrap()).unwrap();
        path
    };
    let mut paths: Vec<PathBuf> = (0..6).map(|i| write(&format!("{i}.png"), 4)).collect();
    assert_eq!(CubeMap::load(&paths).unwrap().size, 4);
    paths[2] = write("wide.png", 5);
    let text = CubeMap::load(&paths).unwrap_err().to_string();
    assert!(
        text.contains("wide.png") && text.contains("+Y") && text.contains("0.png"),
        "{text}"
    );
    paths[2] = folder.path().join("absent.png");
    assert!(matches!(CubeMap::load(&paths).unwrap_err(), Error::Read { .. }));
}
