//! The depth of the place on the relief that a search found.

use glam::{DMat4, DVec4};

use super::{Interpolants, Material, Relief, Viewer, shifted_uv, unit};
use crate::{Form, light_to_tangent, pixel_depth};

/// What makes a depth of a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthRows {
    /// The rows that make z and w of the matrix from the space of [`Interpolants`] to clip space.
    pub clip_z: DVec4,
    /// See `clip_z`.
    pub clip_w: DVec4,
    /// The length of a tile along u in that space.
    pub tile_width: f64,
}

/// The depth that is written at one fragment, in [0, 1], whether or not the alpha test cuts it out; none where the polygon's stays.
#[must_use]
pub fn depth(material: &Material, viewer: &Viewer, at: &Interpolants, form: Form) -> Option<f64> {
    let rows = material.depth?;
    let Relief::Search { layer, .. } = material.relief else {
        return None;
    };
    let hit = shifted_uv(material, at, viewer, form).hit?;
    let view = unit(viewer.eye - at.position, form);
    let view_ts = unit(light_to_tangent::world(at.normal, at.tangent, view), form);
    let place = pixel_depth::place(at.position, view, view_ts.z, &hit, &layer, rows.tile_width);
    let clip = DMat4::from_cols(DVec4::X, DVec4::Y, rows.clip_z, rows.clip_w).transpose();
    Some(pixel_depth::depth(place, &clip).clamp(0.0, 1.0))
}
