//! `environment_bump`: the direction of view mirrored in the perturbed normal, R = 2 (N·V) N − V, looked up in a cube map.
//!
//! Source: named by the third article (environment-map bump mapping; no formula printed there); the reflection is that of the
//! shading languages' `reflect(−V, N)`. Spaces: N and V in the cube map's space (world); V unit, from the surface to the eye.
//!
//! Known fault of using N as it comes from the map: the formula mirrors only for unit N. A filtered N of length r gives
//! 2r² (N̂·V) N̂ − V: for r² < ½ a reflection **into** the surface. Hardened: unit N; for the zero
//! vector R = −V, the view going on through the surface.

use glam::{DVec3, DVec4};

use crate::cube::{self, Seams};
use crate::vector::normalize_or_zero;

/// R as published, for N as it is.
#[must_use]
pub fn reflected_published(view: DVec3, normal: DVec3) -> DVec3 {
    2.0 * normal.dot(view) * normal - view
}

/// R for the unit vector of N; for N = 0, −V.
#[must_use]
pub fn reflected_hardened(view: DVec3, normal: DVec3) -> DVec3 {
    reflected_published(view, normalize_or_zero(normal))
}

/// An environment: texels of a cube map with filtering.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// Texels along an edge of a face.
    pub size: u32,
    /// Linear colours, face by face in the order of [`crate::cube`], row by row.
    pub texels: Vec<DVec4>,
    /// Filtering at the borders of faces.
    pub seams: Seams,
}

impl Environment {
    /// The filtered colour in a direction of any length; NaN for the zero vector.
    #[must_use]
    pub fn sample(&self, direction: DVec3) -> DVec4 {
        let n = self.size as usize;
        let texel = |face: usize, x: u32, y: u32| self.texels[(face * n + y as usize) * n + x as usize];
        cube::sample(direction, self.size, self.seams, texel)
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, DVec4};

    use super::{Environment, reflected_hardened, reflected_published};
    use crate::cube::Seams;
    use crate::sphere::fibonacci;

    #[test]
    fn known_answers() {
        let view = DVec3::new(0.6, 0.0, 0.8);
        assert_eq!(reflected_published(DVec3::Z, DVec3::Z), DVec3::Z);
        assert!((reflected_published(view, DVec3::Z) - DVec3::new(-0.6, 0.0, 0.8)).length() < 1e-15);
        // Seen edge on, nothing turns.
        assert_eq!(reflected_published(DVec3::X, DVec3::Z), -DVec3::X);
    }

    #[test]
    fn mirrors_keep_the_length_and_the_angle() {
        let n = DVec3::new(1.0, 2.0, 2.0) / 3.0;
        for v in fibonacci(1000) {
            let r = reflected_hardened(v, 5.0 * n);
            // About ten roundings of 2^-53 on numbers up to 2.
            assert!((r.length() - 1.0).abs() < 3e-15 && (r.dot(n) - v.dot(n)).abs() < 3e-15);
        }
    }

    #[test]
    fn witness_short_normals_reflect_into_the_surface() {
        let view = DVec3::new(0.6, 0.0, 0.8);
        let r = reflected_published(view, 0.5 * DVec3::Z);
        // 2·0.25·0.8 − 0.8 = −0.4.
        assert!((r.z + 0.4).abs() < 1e-15, "{r}");
        assert!((reflected_hardened(view, 0.5 * DVec3::Z).z - 0.8).abs() < 1e-15);
        assert_eq!(reflected_hardened(view, DVec3::ZERO), -view);
    }

    #[test]
    fn faces_come_from_their_directions() {
        let colors = (0..6).flat_map(|face| [DVec4::splat(f64::from(face)); 4]);
        let cube = Environment {
            size: 2,
            texels: colors.collect(),
            seams: Seams::Face,
        };
        let axes = [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z];
        assert_eq!(
            axes.map(|d| cube.sample(3.0 * d).x),
            [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]
        );
    }
}
