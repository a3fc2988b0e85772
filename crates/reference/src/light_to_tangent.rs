//! `light_to_tangent`: a direction expressed in the tangent frame, L_t = (T·L, B·L, N·L).
//!
//! Sources: the first article works in world space, the third in object space, bringing the light through the inverse of
//! the model-view matrix. For a rigid transform the two agree to rounding.
//!
//! Spaces: the frame and the direction in the same space. Nothing is normalised here. The order matters: normal maps hold
//! the component along N last.

use glam::{DMat4, DVec3, DVec4};

/// The three dot products, in the order T, B, N.
#[must_use]
pub fn to_tangent(tangent: DVec3, bitangent: DVec3, normal: DVec3, light: DVec3) -> DVec3 {
    DVec3::new(tangent.dot(light), bitangent.dot(light), normal.dot(light))
}

/// World space: the frame is in world space already, B = w · (N × T).
#[must_use]
pub fn world(normal_ws: DVec3, tangent_ws: DVec4, light_ws: DVec3) -> DVec3 {
    let tangent = tangent_ws.truncate();
    to_tangent(
        tangent,
        tangent_ws.w * normal_ws.cross(tangent),
        normal_ws,
        light_ws,
    )
}

/// Object space: a light position in world space is brought to object space first, then the vector from the vertex to it
/// is expressed in the vertex' own frame.
#[must_use]
pub fn object(
    normal_os: DVec3,
    tangent_os: DVec4,
    position_os: DVec3,
    light_ws: DVec3,
    local_from_world: DMat4,
) -> DVec3 {
    let light_os = (local_from_world * light_ws.extend(1.0)).truncate();
    world(normal_os, tangent_os, light_os - position_os)
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, DMat4, DVec3};

    use super::{object, world};

    #[test]
    fn order_is_tangent_bitangent_normal() {
        assert_eq!(
            world(DVec3::Z, DVec3::X.extend(1.0), DVec3::new(1.0, 2.0, 3.0)),
            DVec3::new(1.0, 2.0, 3.0)
        );
        assert_eq!(
            world(DVec3::Z, DVec3::X.extend(-1.0), DVec3::new(1.0, 2.0, 3.0)),
            DVec3::new(1.0, -2.0, 3.0)
        );
    }

    #[test]
    fn the_two_spaces_agree_for_a_rigid_transform() {
        let rotation = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7);
        let shift = DVec3::new(1.0, -2.0, 0.5);
        let world_from_local = DMat4::from_mat3_translation(rotation, shift);
        let (position, light) = (DVec3::new(0.3, 0.2, 0.1), DVec3::new(3.0, 4.0, 5.0));
        let in_object = object(
            DVec3::Z,
            DVec3::X.extend(1.0),
            position,
            light,
            world_from_local.inverse(),
        );
        let to_light = light - world_from_local.transform_point3(position);
        let in_world = world(rotation * DVec3::Z, (rotation * DVec3::X).extend(1.0), to_light);
        // About 40 operations on numbers below 16: 40 * 16 * 2^-53 = 7e-14.
        assert!((in_object - in_world).length() < 7e-14);
    }
}
