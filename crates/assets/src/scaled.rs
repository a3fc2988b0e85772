//! Length and direction of vectors whose squares leave the range of f32.
//!
//! The cross product of edges of 1e-12 or 1e12 is an ordinary number, its square is 0 or infinite. Dividing by the largest
//! component first costs one division and keeps every length in [1, √3]. Vectors whose largest component is
//! subnormal count as zero: their digits are lost, and GPUs may flush them, so the shader twins do the same.

use glam::Vec3;

/// |v|; NaN where a component is not finite.
pub(crate) fn length(v: Vec3) -> f32 {
    let largest = v.abs().max_element();
    if largest < f32::MIN_POSITIVE {
        return 0.0;
    }
    (v / largest).length() * largest
}

/// v/|v|, or nothing for the zero vector and where a component is not finite.
pub(crate) fn direction(v: Vec3) -> Option<Vec3> {
    let largest = v.abs().max_element();
    (v.is_finite() && largest >= f32::MIN_POSITIVE).then(|| (v / largest).normalize())
}

#[cfg(test)]
mod tests {
    use super::{direction, length};
    use glam::Vec3;
    use proptest::prelude::*;

    #[test]
    fn what_has_no_direction_gets_none() {
        for v in [
            Vec3::ZERO,
            Vec3::splat(f32::MIN_POSITIVE / 2.0),
            -Vec3::ZERO,
            Vec3::new(0.0, f32::NAN, 1.0),
            Vec3::new(f32::INFINITY, 1.0, 0.0),
        ] {
            assert_eq!(direction(v), None);
        }
        assert_eq!(length(Vec3::ZERO), 0.0);
        assert_eq!(
            Vec3::splat(1e-30).try_normalize(),
            None,
            "the control: plain normalising gives up here"
        );
    }

    proptest! {
        #[test]
        fn any_size_is_measured(x in -1.0f32..1.0, y in -1.0f32..1.0, z in 0.1f32..1.0, power in -110i32..110) {
            let v = Vec3::new(x, y, z);
            let scaled = v * 2f32.powi(power);
            // Division, 3 products, 2 sums, root, product: 8 roundings, relative.
            let bound = 8.0 * 2f64.powi(-24);
            let exact = scaled.as_dvec3().length();
            prop_assert!((f64::from(length(scaled)) / exact - 1.0).abs() <= bound);
            let unit = direction(scaled).unwrap().as_dvec3();
            prop_assert!((unit.length() - 1.0).abs() <= bound);
            prop_assert!(unit.cross(scaled.as_dvec3() / exact).length() <= bound);
        }
    }
}
