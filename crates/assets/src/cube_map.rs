//! Cube maps: six square images of one size around the origin.
//!
//! Faces in the order +X, −X, +Y, −Y, +Z, −Z. On each, columns (s) and rows (t) run as the graphics interfaces have it:
//!
//! | face | s grows along | t grows along |
//! |---|---|---|
//! | +X | −z | −y |
//! | −X | +z | −y |
//! | +Y | +x | +z |
//! | −Y | +x | −z |
//! | +Z | +x | −y |
//! | −Z | −x | −y |
//!
//! With y up, the four walls stand upright in their files, row 0 at the top. Seen from inside, the faces are mirrored: the cube
//! map's space is left-handed by convention, and directions are used in it as they are.
//!
//! Colours are those of a [`ColorMap`]: 8-bit sRGB, light up to 1. Bright skies belong in floats, which are not read here yet.

use std::path::Path;

use glam::DVec3;

use crate::{ColorMap, Error, load_image, srgb_from_linear};

/// A side of the cube.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CubeFace {
    /// +X.
    PositiveX,
    /// −X.
    NegativeX,
    /// +Y.
    PositiveY,
    /// −Y.
    NegativeY,
    /// +Z.
    PositiveZ,
    /// −Z.
    NegativeZ,
}

impl CubeFace {
    /// All six, in the order of layers and files.
    pub const ALL: [CubeFace; 6] = [
        CubeFace::PositiveX,
        CubeFace::NegativeX,
        CubeFace::PositiveY,
        CubeFace::NegativeY,
        CubeFace::PositiveZ,
        CubeFace::NegativeZ,
    ];

    /// As people write it.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["+X", "−X", "+Y", "−Y", "+Z", "−Z"][self as usize]
    }

    /// The point of the cube [−1, 1]³ at (s, t), each in [0, 1]: the direction that meets it, not normalised.
    #[must_use]
    pub fn point(self, s: f64, t: f64) -> DVec3 {
        let (a, b) = (2.0 * s - 1.0, 2.0 * t - 1.0);
        match self {
            CubeFace::PositiveX => DVec3::new(1.0, -b, -a),
            CubeFace::NegativeX => DVec3::new(-1.0, -b, a),
            CubeFace::PositiveY => DVec3::new(a, 1.0, b),
            CubeFace::NegativeY => DVec3::new(a, -1.0, -b),
            CubeFace::PositiveZ => DVec3::new(a, -b, 1.0),
            CubeFace::NegativeZ => DVec3::new(-a, -b, -1.0),
        }
    }
}

impl std::fmt::Display for CubeFace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// An environment: six faces of `size`² texels.
#[derive(Debug, Clone, PartialEq)]
pub struct CubeMap {
    /// Texels along an edge.
    pub size: u32,
    /// In the order of [`CubeFace::ALL`].
    pub faces: [ColorMap; 6],
}

impl CubeMap {
    /// Reads six image files, in the order of [`CubeFace::ALL`].
    ///
    /// # Errors
    /// [`Error::CubeFaceCount`] for another number of files, before any is opened; whatever [`load_image`] says of one;
    /// [`Error::CubeFaceNotSquare`] and [`Error::CubeFaceSize`] naming file and face.
    pub fn load<P: AsRef<Path>>(paths: &[P]) -> Result<Self, Error> {
        let paths: &[P; 6] = paths
            .try_into()
            .map_err(|_| Error::CubeFaceCount { found: paths.len() })?;
        let faces = paths
            .iter()
            .map(|path| ColorMap::from_image(&load_image(path.as_ref())?))
            .collect::<Result<Vec<_>, Error>>()?;
        Self::from_faces(faces, |face| paths[face as usize].as_ref())
    }

    /// Puts six faces together, in the order of [`CubeFace::ALL`]; `name_of` says what to call one in messages.
    ///
    /// # Errors
    /// [`Error::CubeFaceCount`], [`Error::CubeFaceNotSquare`], [`Error::CubeFaceSize`], and [`Error::TexelCount`] for a face
    /// whose list does not fit its sides.
    pub fn from_faces<'a>(
        faces: Vec<ColorMap>,
        name_of: impl Fn(CubeFace) -> &'a Path,
    ) -> Result<Self, Error> {
        let found = faces.len();
        let faces: [ColorMap; 6] = faces.try_into().map_err(|_| Error::CubeFaceCount { found })?;
        let size = faces[0].width;
        for (face, map) in CubeFace::ALL.into_iter().zip(&faces) {
            check_face(face, map, size, name_of(face), name_of(CubeFace::PositiveX))?;
        }
        Ok(CubeMap { size, faces })
    }

    /// A cube map of a function from unit direction to linear light, `samples`² directions a texel averaged. Light above 1
    /// is cut off; a size or number of samples of 0 becomes 1.
    #[must_use]
    pub fn from_fn(size: u32, samples: u32, light: impl Fn(DVec3) -> DVec3) -> Self {
        let (size, samples) = (size.max(1), samples.max(1));
        let fine = f64::from(size * samples);
        let texel = |face: CubeFace, x: u32, y: u32| {
            let places =
                (0..samples * samples).map(|i| (x * samples + i % samples, y * samples + i / samples));
            let at = |i: u32| (f64::from(i) + 0.5) / fine;
            let sum: DVec3 = places
                .map(|(i, j)| light(face.point(at(i), at(j)).normalize()))
                .sum();
            encode(sum / f64::from(samples * samples))
        };
        let faces = CubeFace::ALL.map(|face| ColorMap {
            width: size,
            height: size,
            texels: (0..size * size)
                .map(|i| texel(face, i % size, i / size))
                .collect(),
        });
        CubeMap { size, faces }
    }
}

fn encode(light: DVec3) -> [u8; 4] {
    let [r, g, b] = light
        .to_array()
        .map(|c| (srgb_from_linear(c.clamp(0.0, 1.0) as f32) * 255.0 + 0.5) as u8);
    [r, g, b, 255]
}

fn check_face(face: CubeFace, map: &ColorMap, size: u32, path: &Path, first: &Path) -> Result<(), Error> {
    let (width, height) = (map.width, map.height);
    if width != height {
        return Err(Error::CubeFaceNotSquare {
            path: path.into(),
            face,
            width,
            height,
        });
    }
    if width != size {
        return Err(Error::CubeFaceSize {
            path: path.into(),
            face,
            side: width,
            first: first.into(),
            expected: size,
        });
    }
    let expected = width as usize * height as usize;
    if expected == 0 || map.texels.len() != expected {
        let found = map.texels.len();
        return Err(Error::TexelCount {
            what: "cube map face",
            width,
            height,
            expected,
            found,
        });
    }
    Ok(())
}
