//! Wavefront OBJ in, through the maintained crate `tobj`; errors with file and line.
//!
//! All objects of the file become one mesh; polygons become triangle fans; points and lines are left out; materials are
//! ignored (a scene states them). OBJ puts v = 0 at the **bottom** of the image, this project puts row 0 at v = 0: v is turned
//! round on the way in, so images stand as they do in the modelling tool. Missing normals are made smooth.
//!
//! `tobj` reports no lines, takes index 0 for "none", and does not guard all index arithmetic: `scan` reads the face
//! lines first and refuses what points nowhere.

mod scan;

use std::io::{BufRead, Cursor, Read};
use std::path::Path;

use glam::{Vec2, Vec3};

use crate::{Error, Mesh, MeshDefect};

/// Reads a mesh.
///
/// # Errors
/// [`Error::Read`], [`Error::EmptyFile`], [`Error::ObjSyntax`] or [`Error::ObjMesh`], with path and, where one line is to
/// blame, its number.
pub fn load(path: &Path) -> Result<Mesh, Error> {
    let bytes = std::fs::read(path).map_err(|source| Error::Read {
        path: path.into(),
        source,
    })?;
    if bytes.is_empty() {
        return Err(Error::EmptyFile { path: path.into() });
    }
    parse(path, &bytes)
}

/// Reads a mesh from the bytes of an OBJ file; `path` serves for messages.
///
/// # Errors
/// As [`load`], but for reading.
pub fn parse(path: &Path, bytes: &[u8]) -> Result<Mesh, Error> {
    let defect = |(line, source)| Error::ObjMesh {
        path: path.into(),
        line,
        source,
    };
    scan::check(bytes).map_err(|(line, source)| defect((Some(line), source)))?;
    let models = read_models(path, bytes)?;
    let mut mesh = Mesh::default();
    for model in &models {
        append(&mut mesh, &model.mesh).map_err(|source| defect((None, source)))?;
    }
    if mesh.normals.is_empty() && mesh.validate().is_ok() {
        mesh.smooth_normals();
    }
    mesh.validate().map_err(|source| defect((None, source)))?;
    Ok(mesh)
}

fn read_models(path: &Path, bytes: &[u8]) -> Result<Vec<tobj::Model>, Error> {
    let options = tobj::LoadOptions {
        single_index: true,
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
    };
    let mut reader = CountLines {
        inner: Cursor::new(bytes),
        line: 0,
    };
    let no_materials = |_: &Path| Ok((Vec::new(), Default::default()));
    match tobj::load_obj_buf(&mut reader, &options, no_materials) {
        Ok((models, _)) => Ok(models),
        Err(source) => Err(Error::ObjSyntax {
            path: path.into(),
            line: reader.line,
            what: expectation(source).into(),
            source,
        }),
    }
}

fn expectation(error: tobj::LoadError) -> &'static str {
    use tobj::LoadError as E;
    match error {
        E::PositionParseError => "a `v` line needs three numbers",
        E::NormalParseError => "a `vn` line needs three numbers",
        E::TexcoordParseError => "a `vt` line needs two numbers",
        E::FaceParseError | E::InvalidPolygon => "an `f` line needs three or more corners such as `1/1/1`",
        E::ReadError | E::UnrecognizedCharacter => "not readable text; is this an OBJ file?",
        E::ScalingByZeroError => "the fourth number of a `v` line divides the others and must not be zero",
        E::ColorParseError => "a `v` line with a colour needs six numbers",
        E::InvalidObjectName => "an `o` or `g` line needs a name",
        _ => "not valid in an OBJ file",
    }
}

/// Adds a part; normals count only when all parts have them.
fn append(mesh: &mut Mesh, part: &tobj::Mesh) -> Result<(), MeshDefect> {
    let vertices = part.positions.len() / 3;
    let is_first = mesh.positions.is_empty();
    if vertices == 0 {
        return Ok(());
    }
    let (uvs, normals) = (part.texcoords.len() / 2, part.normals.len() / 3);
    if uvs == 0 {
        return Err(MeshDefect::NoUvs);
    }
    if uvs != vertices {
        return Err(MeshDefect::PartialUvs);
    }
    let with_normals = normals != 0;
    if (with_normals && normals != vertices) || (!is_first && with_normals == mesh.normals.is_empty()) {
        return Err(MeshDefect::PartialNormals);
    }
    let base = mesh.positions.len() as u32;
    mesh.positions
        .extend(part.positions.chunks_exact(3).map(Vec3::from_slice));
    mesh.uvs.extend(
        part.texcoords
            .chunks_exact(2)
            .map(|t| Vec2::new(t[0], 1.0 - t[1])),
    );
    mesh.normals.extend(
        part.normals
            .chunks_exact(3)
            .map(|n| Vec3::from_slice(n).normalize_or(Vec3::Z)),
    );
    mesh.indices.extend(part.indices.iter().map(|i| base + i));
    Ok(())
}

/// Counts the lines that the parser has taken, so that its error has one.
struct CountLines<'a> {
    inner: Cursor<&'a [u8]>,
    line: usize,
}

impl Read for CountLines<'_> {
    fn read(&mut self, buf: &mut [u8]) -> std::io::Result<usize> {
        self.inner.read(buf)
    }
}

impl BufRead for CountLines<'_> {
    fn fill_buf(&mut self) -> std::io::Result<&[u8]> {
        self.inner.fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        self.inner.consume(amount);
        // The line reader takes one line at a time; the last one may lack its newline.
        self.line += usize::from(amount > 0);
    }
}
