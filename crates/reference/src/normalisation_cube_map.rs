//! `normalisation_cube_map`: a cube map whose texels hold their own direction, normalised, so that a lookup with a vector of
//! any length gives back about its unit vector.
//!
//! Source: the third article, *Bumpmapping with DOT3 and normalisation cube maps*. Texel = c(normalise(centre)) with
//! `codec_unorm` c = 0.5 n + 0.5 in 8 or 16 bits, rounded to nearest; lookup = n(bilinear filter of the texels), n = 2 c − 1.
//! Faces and axes: [`crate::cube`]. Filtering stays within a face ([`Seams::Face`]) unless asked otherwise.
//!
//! The result is **not** unit length: filtering shortens (the chord of neighbouring directions), quantising scatters.
//! Errors have two parts: the chord and the uneven spacing of directions, which fall with the square of the size but for the
//! clamp at face borders (half a texel there, first order); and the code's, which do not fall at all: at 8 bits they are the
//! larger part from 64² on.

use glam::{DVec2, DVec3, DVec4};

use crate::codec_unorm::{decode, encode};
use crate::cube::{self, Seams};
use crate::sphere::angle_deg;
use crate::vector::normalize;

/// How a component is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// Unsigned normalised bytes.
    Eight,
    /// Unsigned normalised 16-bit integers.
    Sixteen,
    /// Not rounded at all: shows what filtering alone does.
    Exact,
}

impl Depth {
    /// A colour in [0, 1] as the format keeps it, rounded to nearest.
    #[must_use]
    pub fn store(self, color: f64) -> f64 {
        match self {
            Depth::Eight => (color * 255.0).round() / 255.0,
            Depth::Sixteen => (color * 65535.0).round() / 65535.0,
            Depth::Exact => color,
        }
    }
}

/// A normalisation cube map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Map {
    /// Texels along an edge of a face.
    pub size: u32,
    /// How components are stored.
    pub depth: Depth,
    /// Filtering at the borders of faces.
    pub seams: Seams,
}

impl Map {
    /// A map filtered within its faces.
    #[must_use]
    pub fn new(size: u32, depth: Depth) -> Self {
        Self {
            size,
            depth,
            seams: Seams::Face,
        }
    }

    /// The stored colour of a texel, in [0, 1].
    #[must_use]
    pub fn texel(&self, face: usize, x: u32, y: u32) -> DVec3 {
        let n = normalize(cube::texel_centre(face, i64::from(x), i64::from(y), self.size));
        DVec3::from_array(n.to_array().map(|component| self.depth.store(encode(component))))
    }

    /// The filtered colour that a direction of any length gives, in [0, 1]; NaN for the zero vector.
    #[must_use]
    pub fn color(&self, direction: DVec3) -> DVec3 {
        let texel = |face, x, y| DVec4::from((self.texel(face, x, y), 1.0));
        cube::sample(direction, self.size, self.seams, texel).truncate()
    }

    /// The vector that a direction of any length gives: about its unit vector.
    #[must_use]
    pub fn lookup(&self, direction: DVec3) -> DVec3 {
        DVec3::from_array(self.color(direction).to_array().map(decode))
    }

    /// Errors over directions, by angle and by length. What is meant by root mean square depends on their spread: see
    /// [`fibonacci`](crate::sphere::fibonacci) for even by solid angle and [`faces_evenly`] for even over the faces.
    #[must_use]
    pub fn errors(&self, directions: impl IntoIterator<Item = DVec3>) -> Errors {
        let mut errors = Errors {
            rms_deg: 0.0,
            max_deg: 0.0,
            shortest: f64::INFINITY,
            longest: 0.0,
        };
        let mut count = 0.0;
        for direction in directions {
            let found = self.lookup(direction);
            let angle = angle_deg(found, direction);
            count += 1.0;
            errors.rms_deg += angle * angle;
            errors.max_deg = errors.max_deg.max(angle);
            errors.shortest = errors.shortest.min(found.length());
            errors.longest = errors.longest.max(found.length());
        }
        Errors {
            rms_deg: (errors.rms_deg / count).sqrt(),
            ..errors
        }
    }
}

/// Points spread evenly over the cube's faces, `count` each, on the lattice of the R2 sequence (Roberts 2018).
pub fn faces_evenly(count: u32) -> impl Iterator<Item = DVec3> {
    // The plastic number: the root of x³ = x + 1.
    let plastic = 1.324_717_957_244_746;
    let step = DVec2::new(1.0 / plastic, 1.0 / (plastic * plastic));
    let place = move |i: u32| (0.5 + f64::from(i) * step).fract();
    (0..6).flat_map(move |face| (0..count).map(move |i| cube::point(face, place(i))))
}

/// What a lookup gets wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Root mean square angle to the true direction, degrees.
    pub rms_deg: f64,
    /// Largest angle found, degrees.
    pub max_deg: f64,
    /// Shortest vector found.
    pub shortest: f64,
    /// Longest vector found.
    pub longest: f64,
}

#[cfg(test)]
mod tests;
