//! `dot3`: the diffuse term of one light on a perturbed normal, I = saturate(N · L) · M_d.
//!
//! Source: the third article, *Bumpmapping with DOT3 and normalisation cube maps*; the `arithmetic` normaliser divides by
//! the length, where the article looks the direction up in a cube map.
//!
//! Spaces: N and L in the same space (tangent space in the article). L need not be unit length: it is the interpolated
//! vector toward the light. N is used as it is, since the article does not renormalise what comes from the normal map.

use glam::DVec3;

use crate::vector::{normalize, normalize_or_zero, saturate};

/// As published: `normalize(L)` without a guard, so the zero vector gives NaN.
#[must_use]
pub fn published(normal: DVec3, light: DVec3, diffuse: DVec3) -> DVec3 {
    saturate(normal.dot(normalize(light))) * diffuse
}

/// Hardened: the zero light vector lights nothing, and vectors of any finite length keep their direction.
#[must_use]
pub fn hardened(normal: DVec3, light: DVec3, diffuse: DVec3) -> DVec3 {
    saturate(normal.dot(normalize_or_zero(light))) * diffuse
}

/// With a normalisation cube map in place of the division: `light_color` is what the lookup found, in [0, 1].
#[must_use]
pub fn through_cube(normal: DVec3, light_color: DVec3, diffuse: DVec3) -> DVec3 {
    saturate(normal.dot(2.0 * light_color - 1.0)) * diffuse
}

/// The texture combiner's form of the dot product on colours in [0, 1]: saturate(4 · Σ (a − ½)(b − ½)).
#[must_use]
pub fn combiner(a: DVec3, b: DVec3) -> f64 {
    saturate(4.0 * (a - 0.5).dot(b - 0.5))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{combiner, hardened, published, through_cube};

    #[test]
    fn the_combiner_is_the_dot_product_of_decoded_colours() {
        assert_eq!(
            combiner(DVec3::new(0.5, 0.5, 1.0), DVec3::new(0.5, 0.5, 1.0)),
            1.0
        );
        assert_eq!(
            combiner(DVec3::new(0.5, 0.5, 1.0), DVec3::new(0.5, 0.5, 0.0)),
            0.0
        );
        assert_eq!(
            combiner(DVec3::new(0.75, 0.5, 1.0), DVec3::new(1.0, 0.5, 0.5)),
            0.5
        );
    }

    #[test]
    fn the_cube_s_colour_stands_for_the_light() {
        // The colour of (0.6, 0, 0.8).
        let color = DVec3::new(0.8, 0.5, 0.9);
        assert!((through_cube(DVec3::Z, color, DVec3::ONE).x - 0.8).abs() < 1e-15);
        assert_eq!(through_cube(-DVec3::Z, color, DVec3::ONE), DVec3::ZERO);
    }

    #[test]
    fn facing_grazing_and_behind() {
        let white = DVec3::ONE;
        assert_eq!(published(DVec3::Z, 3.0 * DVec3::Z, white), DVec3::ONE);
        assert_eq!(published(DVec3::Z, DVec3::X, white), DVec3::ZERO);
        assert_eq!(published(DVec3::Z, -DVec3::Z, white), DVec3::ZERO);
    }

    #[test]
    fn zero_light_is_the_defect_and_its_cure() {
        assert!(published(DVec3::Z, DVec3::ZERO, DVec3::ONE).is_nan());
        assert_eq!(hardened(DVec3::Z, DVec3::ZERO, DVec3::ONE), DVec3::ZERO);
        assert_eq!(hardened(DVec3::Z, 1e-23 * DVec3::Z, DVec3::ONE), DVec3::ONE);
        assert_eq!(hardened(DVec3::Z, 2e19 * DVec3::Z, DVec3::ONE), DVec3::ONE);
    }
}
