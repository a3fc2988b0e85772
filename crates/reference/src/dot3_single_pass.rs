//! `dot3_single_pass`: diffuse bump mapping in one pass of three texture units: normal map, normalisation cube map, colour.
//!
//! Source: the third article: unit 0 gives the normal's colour, unit 1 the light's colour through the cube map, the combiner
//! `DOT3_RGB` their dot product saturate(4·Σ(a − ½)(b − ½)), and unit 2 modulates it with the surface's colour.
//!
//! Spaces: normal and light in tangent space, as colours in [0, 1]. The light vector has any length but 0. N is used as it
//! comes from the map.

use glam::DVec3;

use crate::dot3::combiner;
use crate::normalisation_cube_map::Map;
use crate::vector::{normalize, normalize_or_zero};

/// What makes the interpolated light vector a unit vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normaliser {
    /// Division by the length; the zero vector gives NaN.
    Arithmetic,
    /// Division by the length; the zero vector stays zero, the colour of no direction.
    Guarded,
    /// A lookup in a normalisation cube map.
    Cube(Map),
}

impl Normaliser {
    /// The light's colour in [0, 1].
    #[must_use]
    pub fn color(self, light_ts: DVec3) -> DVec3 {
        match self {
            Normaliser::Arithmetic => 0.5 * normalize(light_ts) + 0.5,
            Normaliser::Guarded => 0.5 * normalize_or_zero(light_ts) + 0.5,
            Normaliser::Cube(map) => map.color(light_ts),
        }
    }
}

/// The dot product of the two colours, saturated.
#[must_use]
pub fn intensity(normal_color: DVec3, light_color: DVec3) -> f64 {
    combiner(normal_color, light_color)
}

/// The pass' colour, before the target rounds it.
#[must_use]
pub fn shade(normal_color: DVec3, light_color: DVec3, surface: DVec3) -> DVec3 {
    intensity(normal_color, light_color) * surface
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{Normaliser, intensity, shade};
    use crate::normalisation_cube_map::{Depth, Map};
    use crate::sphere::fibonacci;

    const UP: DVec3 = DVec3::new(0.5, 0.5, 1.0);

    #[test]
    fn known_answers() {
        assert_eq!(
            shade(UP, UP, DVec3::new(1.0, 0.5, 0.25)),
            DVec3::new(1.0, 0.5, 0.25)
        );
        assert_eq!(shade(UP, DVec3::new(1.0, 0.5, 0.5), DVec3::ONE), DVec3::ZERO);
        // L = (0.6, 0, 0.8)·7 on N = z.
        let light = Normaliser::Arithmetic.color(DVec3::new(4.2, 0.0, 5.6));
        assert!((intensity(UP, light) - 0.8).abs() < 1e-15);
    }

    #[test]
    fn the_cube_and_the_division_agree_to_the_map_s_error() {
        let cube = Normaliser::Cube(Map::new(64, Depth::Eight));
        for l in fibonacci(2000).map(|d| 3.0 * d) {
            let (a, b) = (
                intensity(UP, cube.color(l)),
                intensity(UP, Normaliser::Arithmetic.color(l)),
            );
            // 8 bits: 1/255 in n.z; filtering: half a texel clamped at a border, 1/64 of slope at most 1.
            assert!((a - b).abs() <= 1.0 / 255.0 + 1.0 / 64.0, "{l}");
        }
    }

    #[test]
    fn no_light_vector() {
        assert!(intensity(UP, Normaliser::Arithmetic.color(DVec3::ZERO)).is_nan());
        assert_eq!(intensity(UP, Normaliser::Guarded.color(DVec3::ZERO)), 0.0);
    }

    #[test]
    fn bytes_of_a_flat_normal_are_dimmer_or_brighter_than_flat() {
        // (128, 128, 255)/255 leans toward (1, 1): a light from there is N·L = 0.0039·√2 where it should be 0.
        let flat = DVec3::new(128.0, 128.0, 255.0) / 255.0;
        let grazing = Normaliser::Arithmetic.color(DVec3::new(1.0, 1.0, 0.0));
        assert!((intensity(flat, grazing) - 2f64.sqrt() / 255.0).abs() < 1e-15);
    }
}
