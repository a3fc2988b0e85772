//! `normalisation_cube_map`: each texel holds its own direction, normalised, so that looking up a vector of any length gives
//! about its unit vector (the article on bump mapping with DOT3).
//!
//! Texel = round(max·(0.5·n + 0.5)) with n the unit vector to the texel's centre, max = 255 or 65535; computed in f64, so each is
//! the nearest code (ties, which only n = 0 has, go up). Faces and axes: [`CubeFace`]. Reading: n = 2c − 1 (`codec_unorm`); not
//! of unit length. Neither mip levels nor filtering across faces are this module's business: hardware does the latter.
//!
//! Angle errors of a bilinear lookup at 8 bits, rms and largest, over directions spread evenly over the cube: 16² 0.39° and
//! 2.1°, 32² 0.18° and 1.1°, 64² 0.13° and 0.7°, 256² 0.13° and 0.4°. At 64² the rounding to 8 bits is the larger part.

use rayon::prelude::*;

use crate::{CubeFace, Error, MAX_DECODED_BYTES, MAX_SIDE, Texels};

/// Bits a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Depth {
    /// As the article has it.
    #[default]
    Eight,
    /// 257 times finer.
    Sixteen,
}

/// A normalisation cube map.
#[derive(Debug, Clone, PartialEq)]
pub struct NormalisationCubeMap {
    /// Texels along an edge.
    pub size: u32,
    /// In the order of [`CubeFace::ALL`]: red, green, blue and full alpha, row by row, in the integers of the depth.
    pub faces: [Texels; 6],
}

impl NormalisationCubeMap {
    /// Makes the map.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a size of 0, above [`MAX_SIDE`], or whose faces together would exceed [`MAX_DECODED_BYTES`].
    pub fn generate(size: u32, depth: Depth) -> Result<Self, Error> {
        Self::check_size(size, depth)?;
        let faces = CubeFace::ALL.map(|face| match depth {
            Depth::Eight => Texels::Unorm8(texels(face, size, |c| (c * 255.0).round() as u8)),
            Depth::Sixteen => Texels::Unorm16(texels(face, size, |c| (c * 65535.0).round() as u16)),
        });
        Ok(NormalisationCubeMap { size, faces })
    }

    /// Whether there is a map of this size.
    ///
    /// # Errors
    /// As [`NormalisationCubeMap::generate`].
    pub fn check_size(size: u32, depth: Depth) -> Result<(), Error> {
        let bytes_a_texel = match depth {
            Depth::Eight => 4,
            Depth::Sixteen => 8,
        };
        let side = u64::from(size.min(MAX_SIDE));
        if size == 0 || size > MAX_SIDE || 6 * side * side * bytes_a_texel > MAX_DECODED_BYTES {
            return Err(Error::Parameter {
                parameter: "size of the normalisation cube map",
                value: size.to_string(),
                expected: "at least 1 texel, and no more than 1 GiB for the six faces (6688 at 8 bits, 4729 at 16)",
            });
        }
        Ok(())
    }

    /// A face as floats in [0, 1], four a texel: for textures whose format has no 16-bit integers.
    #[must_use]
    pub fn face_floats(&self, face: CubeFace) -> Vec<f32> {
        let texels = &self.faces[face as usize];
        (0..texels.len()).map(|i| texels.sample(i)).collect()
    }
}

fn texels<T: Send>(face: CubeFace, size: u32, store: impl Fn(f64) -> T + Sync + Send) -> Vec<T> {
    let place = |i: u32| (f64::from(i) + 0.5) / f64::from(size);
    let row = |y: u32| {
        let direction = move |x: u32| face.point(place(x), place(y)).normalize();
        (0..size).flat_map(move |x| (direction(x).extend(1.0) * 0.5 + 0.5).to_array())
    };
    (0..size).into_par_iter().flat_map_iter(row).map(store).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, DVec4};

    fn decoded(map: &NormalisationCubeMap, face: CubeFace, x: u32, y: u32) -> DVec3 {
        let texels = map.face_floats(face);
        let at = 4 * (y * map.size + x) as usize;
        let c = DVec4::from_array([0, 1, 2, 3].map(|k| f64::from(texels[at + k])));
        assert_eq!(c.w, 1.0);
        c.truncate() * 2.0 - 1.0
    }

    #[test]
    fn one_texel_a_face_is_the_face_s_direction() {
        let map = NormalisationCubeMap::generate(1, Depth::Eight).unwrap();
        let axes = [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z];
        for (face, axis) in CubeFace::ALL.into_iter().zip(axes) {
            // 0 is written as 128: 1/255 off.
            assert!(
                (decoded(&map, face, 0, 0) - axis).abs().max_element() <= 1.0 / 255.0 + 1e-6,
                "{face}"
            );
        }
    }

    #[test]
    fn texels_are_the_nearest_codes_of_unit_vectors() {
        for (depth, half_step) in [(Depth::Eight, 1.0 / 255.0), (Depth::Sixteen, 1.0 / 65535.0)] {
            for size in [2, 5, 16] {
                let map = NormalisationCubeMap::generate(size, depth).unwrap();
                for face in CubeFace::ALL {
                    for i in 0..size * size {
                        let (x, y) = (i % size, i / size);
                        let at = |k: u32| (f64::from(k) + 0.5) / f64::from(size);
                        let error = decoded(&map, face, x, y) - face.point(at(x), at(y)).normalize();
                        // Half a step, and the f32 quotient doubled: 2⁻²⁴.
                        assert!(
                            error.abs().max_element() <= half_step + 1e-7,
                            "{depth:?} {face} {x} {y}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn sizes_that_cannot_be_are_refused() {
        for (size, depth) in [
            (0, Depth::Eight),
            (6689, Depth::Eight),
            (4730, Depth::Sixteen),
            (u32::MAX, Depth::Eight),
        ] {
            let error = NormalisationCubeMap::generate(size, depth).unwrap_err();
            assert!(error.to_string().contains(&size.to_string()), "{error}");
        }
    }
}
