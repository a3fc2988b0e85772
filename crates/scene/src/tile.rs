//! How large a tile of the texture is on a mesh, in the mesh's own units.
//!
//! Lengths of ∂P/∂u and ∂P/∂v, averaged over the triangles by area: exact where the mapping is affine (planes, cubes), a mean
//! where it stretches (spheres). Triangles without UV area do not count.

use bossage_assets::Mesh;
use glam::DVec2;

use crate::views::world_per_uv;

/// A tile's sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tile {
    /// Mean lengths along u and v.
    pub(crate) side: DVec2,
    /// Largest length of a triangle over the smallest, along u or v: 1 where all tiles are alike.
    pub(crate) stretch: f64,
}

impl Tile {
    /// Of a mesh; none where no triangle has UV area.
    pub(crate) fn of(mesh: &Mesh) -> Option<Self> {
        let mut sum = DVec2::ZERO;
        let (mut area, mut least, mut most) = (0.0, DVec2::INFINITY, DVec2::ZERO);
        for corners in mesh.triangles() {
            let position = corners.map(|i| mesh.positions[i].as_dvec3());
            let uv = corners.map(|i| mesh.uvs[i].as_dvec2());
            let Some(per_uv) = world_per_uv(position, uv) else {
                continue;
            };
            let side = DVec2::from_array(per_uv.map(|along| along.length()));
            let weight = (position[1] - position[0])
                .cross(position[2] - position[0])
                .length();
            if weight > 0.0 {
                sum += weight * side;
                area += weight;
                (least, most) = (least.min(side), most.max(side));
            }
        }
        (area > 0.0).then(|| Self {
            side: sum / area,
            stretch: (most / least).max_element(),
        })
    }
}

#[cfg(test)]
mod tests {
    use bossage_assets::primitives;
    use glam::{DVec2, Vec2};

    use super::Tile;

    #[test]
    fn a_plane_s_tiles_are_known_and_a_sphere_s_differ() {
        let mut plane = primitives::grid(4.0, 2.0, 3, 5);
        plane.uvs.iter_mut().for_each(|uv| *uv *= Vec2::new(2.0, 4.0));
        let tile = Tile::of(&plane).unwrap();
        // Vertices in f32: a few units of 2^-23 on a length of 2.
        assert!((tile.side - DVec2::new(2.0, 0.5)).length() < 1e-6 && tile.stretch < 1.0 + 1e-5);
        assert!(Tile::of(&primitives::sphere(1.0, 24, 12)).unwrap().stretch > 2.0);
        plane.uvs.iter_mut().for_each(|uv| *uv = Vec2::ZERO);
        assert_eq!(Tile::of(&plane), None);
    }
}
