//! How the camera sees an object: its visible parts in pixels, how near they come, and rays through them.
//!
//! Triangles are clipped against the view volume in clip space (f64), so the nearest distance is that of what is seen, not
//! of a bounding volume. Rays are equally dense per pixel.
//!
//! Limits. Objects do not hide each other or themselves here: a hidden part counts as if it were seen, so footprints err on
//! the side of keeping an effect. Parts seen from behind (V·N ≤ 0) give no rays.

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, Vec4Swizzles};
use serde::Serialize;

use crate::camera::Matrices;
use crate::model::{Camera, Object};

/// How large an object is on screen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Footprint {
    /// Visible area, pixels; hidden parts included.
    pub area_px: f64,
    /// View depth of the nearest visible point, world units.
    pub nearest_depth: f64,
    /// Largest number of pixels that one tile of the texture spans along an axis, seen from straight above at the place
    /// where it is largest.
    pub tile_px: f64,
}

/// A visible triangle: a piece of a mesh triangle inside the view volume.
#[derive(Clone, Copy, Debug)]
struct Facet {
    triangle: usize,
    /// Barycentric coordinates in the mesh triangle, of each corner.
    bary: [DVec3; 3],
    depth: [f64; 3],
    /// Sum of the areas up to and including this facet.
    area_to_here_px: f64,
}

/// One object in one view.
#[derive(Clone, Debug)]
pub(crate) struct View {
    camera: Camera,
    matrices: Matrices,
    normal_matrix: DMat3,
    triangles: Vec<Triangle>,
    facets: Vec<Facet>,
}

/// A mesh triangle in world space.
#[derive(Clone, Copy, Debug)]
struct Triangle {
    position: [DVec3; 3],
    normal: [DVec3; 3],
    tangent: [DVec4; 3],
    uv: [DVec2; 3],
    /// World vector per UV unit along u and v; none where the UVs have no area.
    per_uv: Option<[DVec3; 2]>,
}

/// A view ray where it meets the polygon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ViewRay {
    /// UV of the polygon there.
    pub(crate) uv: DVec2,
    /// Unit vector to the eye in tangent space, z > 0.
    pub(crate) view_ts: DVec3,
    /// Unit vector against the camera's viewing direction, in tangent space.
    pub(crate) backward_ts: DVec3,
    /// The corners of the mesh triangle: their UVs, and their shares in the point.
    pub(crate) corners: [(DVec2, f64); 3],
    /// Pixels a UV unit spans along u and v (columns), on the polygon.
    pub(crate) px_per_uv: [DVec2; 2],
}

impl View {
    pub(crate) fn new(camera: &Camera, object: &Object) -> Self {
        let matrices = Matrices::new(camera, object);
        let normal_matrix = matrices.cofactor * matrices.handedness;
        let triangles: Vec<Triangle> = object
            .mesh
            .triangles()
            .map(|corners| Triangle::new(object, &matrices, corners))
            .collect();
        let clip = camera.clip_from_world();
        let mut view = Self {
            camera: *camera,
            matrices,
            normal_matrix,
            triangles,
            facets: Vec::new(),
        };
        for index in 0..view.triangles.len() {
            view.add_facets(&clip, index);
        }
        view
    }

    /// Clips one triangle and appends what is left of it as a fan.
    fn add_facets(&mut self, clip_from_world: &DMat4, triangle: usize) {
        let corners = self.triangles[triangle].position;
        let barys = [DVec3::X, DVec3::Y, DVec3::Z];
        let start: Vec<(DVec4, DVec3)> = corners
            .iter()
            .zip(barys)
            .map(|(corner, bary)| (*clip_from_world * corner.extend(1.0), bary))
            .collect();
        let polygon = clip(start);
        for second in 1..polygon.len().saturating_sub(1) {
            self.push_facet(triangle, [polygon[0], polygon[second], polygon[second + 1]]);
        }
    }

    fn push_facet(&mut self, triangle: usize, corners: [(DVec4, DVec3); 3]) {
        let half = self.camera.half_size_px();
        let screen_px = corners.map(|(clip, _)| clip.xy() / clip.w * half);
        let area = 0.5
            * (screen_px[1] - screen_px[0])
                .perp_dot(screen_px[2] - screen_px[0])
                .abs();
        if area > 0.0 {
            let area_to_here_px = self.area_px() + area;
            let (bary, depth) = (corners.map(|(_, bary)| bary), corners.map(|(clip, _)| clip.w));
            self.facets.push(Facet {
                triangle,
                bary,
                depth,
                area_to_here_px,
            });
        }
    }

    pub(crate) fn area_px(&self) -> f64 {
        self.facets.last().map_or(0.0, |facet| facet.area_to_here_px)
    }

    /// The footprint, none when nothing is inside the view volume.
    pub(crate) fn footprint(&self) -> Option<Footprint> {
        let nearest_depth = self
            .facets
            .iter()
            .flat_map(|facet| facet.depth)
            .min_by(f64::total_cmp)?;
        let tile_px = self
            .facets
            .iter()
            .map(|facet| self.tile_px(facet).max_element())
            .fold(0.0, f64::max);
        Some(Footprint {
            area_px: self.area_px(),
            nearest_depth,
            tile_px,
        })
    }

    /// Pixels that a tile spans along u and v at the facet's nearest corner, seen from straight above.
    fn tile_px(&self, facet: &Facet) -> DVec2 {
        let Some([along_u, along_v]) = self.triangles[facet.triangle].per_uv else {
            return DVec2::ZERO;
        };
        let nearest = facet.depth.into_iter().fold(f64::INFINITY, f64::min);
        DVec2::new(along_u.length(), along_v.length()) * self.camera.focal_px() / nearest
    }

    /// An upper bound, in pixels, of how far a point raised or sunk by `elevation_uv` (UV units, by axis) can move on screen:
    /// the elevation in world units, over the depth that is left when it moves toward the eye, times the stretch of a
    /// pinhole image away from its centre.
    pub(crate) fn displacement_px(&self, elevation_uv: DVec2) -> f64 {
        let stretch = (1.0 + (self.camera.half_size_px() / self.camera.focal_px()).length_squared()).sqrt();
        let one = |facet: &Facet| {
            let Some([along_u, along_v]) = self.triangles[facet.triangle].per_uv else {
                return 0.0;
            };
            let raised =
                (elevation_uv.x.abs() * along_u.length()).max(elevation_uv.y.abs() * along_v.length());
            let nearest = facet.depth.into_iter().fold(f64::INFINITY, f64::min);
            if raised < nearest {
                self.camera.focal_px() * stretch * raised / (nearest - raised)
            } else {
                f64::INFINITY
            }
        };
        self.facets.iter().map(one).fold(0.0, f64::max)
    }

    /// The ray at a point of the unit cube: evenly drawn points give rays that are equally dense per pixel. None where the part
    /// is seen from behind or has no UV area, or nothing is seen at all.
    pub(crate) fn ray_at(&self, [along_area, a, b]: [f64; 3]) -> Option<ViewRay> {
        let target = along_area * self.area_px();
        let facet = self.facets.get(
            self.facets
                .partition_point(|facet| facet.area_to_here_px <= target),
        )?;
        self.ray(facet, in_triangle(a, b))
    }

    /// The ray through a point of a facet given by its barycentric coordinates on screen.
    fn ray(&self, facet: &Facet, on_screen: DVec3) -> Option<ViewRay> {
        let weight = DVec3::new(
            on_screen.x / facet.depth[0],
            on_screen.y / facet.depth[1],
            on_screen.z / facet.depth[2],
        );
        let weight = weight / weight.element_sum();
        let bary = facet.bary[0] * weight.x + facet.bary[1] * weight.y + facet.bary[2] * weight.z;
        let triangle = &self.triangles[facet.triangle];
        let at = triangle.at(bary);
        let normal = (self.normal_matrix * at.normal).try_normalize()?;
        let tangent = (self.matrices.world_from_local.transform_vector3(at.tangent.xyz())).try_normalize()?;
        let bitangent = normal.cross(tangent) * at.tangent.w.signum() * self.matrices.handedness;
        let view = (self.camera.position - at.position).try_normalize()?;
        let to_tangent = |v: DVec3| DVec3::new(tangent.dot(v), bitangent.dot(v), normal.dot(v));
        let view_ts = to_tangent(view).try_normalize()?;
        let backward = (self.camera.position - self.camera.target).normalize();
        let shares = bary.to_array();
        let px_per_uv = triangle
            .per_uv?
            .map(|along| self.screen_derivative(at.position, along));
        (view_ts.z > 0.0).then_some(ViewRay {
            uv: at.uv,
            view_ts,
            backward_ts: to_tangent(backward),
            corners: [0, 1, 2].map(|corner| (triangle.uv[corner], shares[corner])),
            px_per_uv,
        })
    }

    /// d(screen)/d(world) along a world vector, pixels.
    fn screen_derivative(&self, at: DVec3, along: DVec3) -> DVec2 {
        let clip_from_world = self.camera.clip_from_world();
        let (point, step) = (
            clip_from_world * at.extend(1.0),
            clip_from_world * along.extend(0.0),
        );
        let ndc = point.xy() / point.w;
        (step.xy() - ndc * step.w) / point.w * self.camera.half_size_px()
    }
}

/// What the rasteriser would interpolate; normal and tangent in local space.
struct At {
    position: DVec3,
    normal: DVec3,
    tangent: DVec4,
    uv: DVec2,
}

impl Triangle {
    fn new(object: &Object, matrices: &Matrices, corners: [usize; 3]) -> Self {
        let mesh = &object.mesh;
        let position = corners.map(|i| {
            matrices
                .world_from_local
                .transform_point3(mesh.positions[i].as_dvec3())
        });
        let uv = corners.map(|i| mesh.uvs[i].as_dvec2());
        Self {
            position,
            normal: corners.map(|i| mesh.normals[i].as_dvec3()),
            tangent: corners.map(|i| mesh.tangents[i].as_dvec4()),
            uv,
            per_uv: world_per_uv(position, uv),
        }
    }

    fn at(&self, bary: DVec3) -> At {
        let b = bary.to_array();
        let mut at = At {
            position: DVec3::ZERO,
            normal: DVec3::ZERO,
            tangent: DVec4::ZERO,
            uv: DVec2::ZERO,
        };
        for (corner, &weight) in b.iter().enumerate() {
            at.position += weight * self.position[corner];
            at.normal += weight * self.normal[corner];
            at.tangent += weight * self.tangent[corner];
            at.uv += weight * self.uv[corner];
        }
        at
    }
}

/// dP/du and dP/dv of the affine map from UV to the triangle.
pub(crate) fn world_per_uv(position: [DVec3; 3], uv: [DVec2; 3]) -> Option<[DVec3; 2]> {
    let (p, q) = (position[1] - position[0], position[2] - position[0]);
    let (s, t) = (uv[1] - uv[0], uv[2] - uv[0]);
    let area = s.perp_dot(t);
    let per_uv = [(p * t.y - q * s.y) / area, (q * s.x - p * t.x) / area];
    (area != 0.0 && per_uv.iter().all(|v| v.is_finite())).then_some(per_uv)
}

/// Clips a convex polygon against the view volume −w ≤ x, y ≤ w, 0 ≤ z ≤ w (Sutherland and Hodgman).
fn clip(polygon: Vec<(DVec4, DVec3)>) -> Vec<(DVec4, DVec3)> {
    let planes: [fn(DVec4) -> f64; 6] = [
        |p| p.w + p.x,
        |p| p.w - p.x,
        |p| p.w + p.y,
        |p| p.w - p.y,
        |p| p.z,
        |p| p.w - p.z,
    ];
    planes.into_iter().fold(polygon, clip_plane)
}

fn clip_plane(polygon: Vec<(DVec4, DVec3)>, distance: fn(DVec4) -> f64) -> Vec<(DVec4, DVec3)> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (index, &(to, to_bary)) in polygon.iter().enumerate() {
        let (from, from_bary) = polygon[(index + polygon.len() - 1) % polygon.len()];
        let (d_from, d_to) = (distance(from), distance(to));
        if (d_from < 0.0) != (d_to < 0.0) {
            let share = d_from / (d_from - d_to);
            kept.push((from.lerp(to, share), from_bary.lerp(to_bary, share)));
        }
        if d_to >= 0.0 {
            kept.push((to, to_bary));
        }
    }
    kept
}

/// A uniform point of a triangle from a uniform point of the square, folding the square along its diagonal.
fn in_triangle(a: f64, b: f64) -> DVec3 {
    let (a, b) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
    DVec3::new(1.0 - a - b, a, b)
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3, DVec4};

    use super::{clip, world_per_uv};

    #[test]
    fn clipping_cuts_at_the_near_plane() {
        // One corner behind the eye: the triangle becomes a quadrilateral, all of it at w > 0.
        let corner = |x, y, w: f64| (DVec4::new(x, y, w - 1.0, w), DVec3::X);
        let kept = clip(vec![
            corner(0.0, 0.5, 2.0),
            corner(0.0, -0.5, 2.0),
            corner(0.0, 0.0, -2.0),
        ]);
        assert_eq!(kept.len(), 4);
        assert!(kept.iter().all(|(p, _)| p.z >= 0.0 && p.w > 0.0));
        assert!(
            clip(vec![
                corner(9.0, 0.0, 2.0),
                corner(9.0, 1.0, 2.0),
                corner(8.0, 0.0, 2.0)
            ])
            .is_empty()
        );
    }

    #[test]
    fn uv_axes_of_a_stretched_triangle() {
        let position = [DVec3::ZERO, DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, 0.0, 2.0)];
        let uv = [DVec2::ZERO, DVec2::X, DVec2::Y];
        assert_eq!(world_per_uv(position, uv), Some([DVec3::X * 4.0, DVec3::Z * 2.0]));
        assert_eq!(world_per_uv(position, [DVec2::ZERO; 3]), None);
    }
}
