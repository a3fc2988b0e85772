//! Camera and object matrices: right-handed, depth 0 to 1, y up in clip space (the convention of wgpu), composed in f64.
//!
//! Rounding to f32 happens once, on the finished product, where the uniforms are filled.

use bossage_shaders::LightingSpace;
use glam::dcamera::rh::{proj::directx, view};
use glam::{DMat3, DMat4, DVec2, DVec3};

use crate::model::{Camera, Light, LightKind, Object};

impl Camera {
    /// Width over height.
    #[must_use]
    pub fn aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1])
    }

    /// Clip space from world space.
    #[must_use]
    pub fn clip_from_world(&self) -> DMat4 {
        let projection = directx::perspective(self.fov_deg.to_radians(), self.aspect(), self.near, self.far);
        projection * view::look_at_mat4(self.position, self.target, self.up.normalize())
    }

    /// Pixels a world unit across the view takes at view depth 1.
    #[must_use]
    pub fn focal_px(&self) -> f64 {
        f64::from(self.size[1]) * 0.5 / (self.fov_deg.to_radians() * 0.5).tan()
    }

    /// Half the image size in pixels: what a clip-space unit is on screen.
    #[must_use]
    pub(crate) fn half_size_px(&self) -> DVec2 {
        DVec2::new(f64::from(self.size[0]), f64::from(self.size[1])) * 0.5
    }
}

/// The matrices of one object in one view, f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrices {
    /// Clip from local.
    pub clip_from_local: DMat4,
    /// World from local.
    pub world_from_local: DMat4,
    /// Local from world.
    pub local_from_world: DMat4,
    /// Cofactor matrix of the linear part of `world_from_local`: (M a) × (M b) = cof(M) (a × b).
    pub cofactor: DMat3,
    /// Sign of the determinant of the linear part, ±1.
    pub handedness: f64,
}

impl Matrices {
    /// For one object.
    #[must_use]
    pub fn new(camera: &Camera, object: &Object) -> Self {
        let world_from_local = object.transform.matrix();
        let linear = object.transform.linear();
        Self {
            clip_from_local: camera.clip_from_world() * world_from_local,
            world_from_local,
            local_from_world: world_from_local.inverse(),
            cofactor: cofactor(linear),
            handedness: if object.transform.mirrors() { -1.0 } else { 1.0 },
        }
    }

    /// Clip from lighting space.
    #[must_use]
    pub fn clip_from(&self, space: LightingSpace) -> DMat4 {
        match space {
            LightingSpace::World => self.clip_from_local * self.local_from_world,
            LightingSpace::Object => self.clip_from_local,
        }
    }

    /// A world-space point in lighting space.
    #[must_use]
    pub fn point(&self, space: LightingSpace, point_ws: DVec3) -> DVec3 {
        match space {
            LightingSpace::World => point_ws,
            LightingSpace::Object => self.local_from_world.transform_point3(point_ws),
        }
    }

    /// A unit world-space direction in lighting space, unit.
    #[must_use]
    pub fn direction(&self, space: LightingSpace, direction_ws: DVec3) -> DVec3 {
        match space {
            LightingSpace::World => direction_ws,
            LightingSpace::Object => self.local_from_world.transform_vector3(direction_ws).normalize(),
        }
    }

    /// The shader's `Light.vector` in lighting space: unit vector toward a directional light with w = 0, position of a
    /// point light with w = 1.
    #[must_use]
    pub fn light_vector(&self, space: LightingSpace, light: &Light) -> [f64; 4] {
        let (vector, w) = match light.kind {
            LightKind::Directional { direction } => (self.direction(space, -direction), 0.0),
            LightKind::Point { position } => (self.point(space, position), 1.0),
        };
        vector.extend(w).to_array()
    }
}

fn cofactor(m: DMat3) -> DMat3 {
    DMat3::from_cols(
        m.y_axis.cross(m.z_axis),
        m.z_axis.cross(m.x_axis),
        m.x_axis.cross(m.y_axis),
    )
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use crate::model::Camera;

    fn camera() -> Camera {
        let (position, target) = (DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO);
        Camera {
            position,
            target,
            up: DVec3::Y,
            fov_deg: 90.0,
            near: 1.0,
            far: 9.0,
            size: [200, 100],
        }
    }

    #[test]
    fn depth_runs_from_0_to_1_and_y_is_up() {
        let clip = camera().clip_from_world();
        let ndc = |point: DVec3| clip.project_point3(point);
        // Rotation entries are exact here; the projection rounds a handful of times at magnitude 1: 10 * 2^-53.
        assert!(ndc(DVec3::new(0.0, 0.0, 3.0)).z.abs() < 1.2e-15);
        assert!((ndc(DVec3::new(0.0, 0.0, -5.0)).z - 1.0).abs() < 1.2e-15);
        // fov 90: the top edge at distance 4 is y = 4; the right edge x = 8 (aspect 2).
        let corner = ndc(DVec3::new(8.0, 4.0, 0.0));
        assert!((corner.x - 1.0).abs() < 1.2e-15 && (corner.y - 1.0).abs() < 1.2e-15);
    }

    #[test]
    fn focal_length_is_half_the_height_at_90_degrees() {
        // tan(45°) in f64 is 1 - 2^-53; one division.
        assert!((camera().focal_px() - 50.0).abs() < 1e-13);
    }
}
