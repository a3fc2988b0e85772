//! `relaxed_cone_map`: over every texel a cone so wide that no ray that begins on its axis crosses the surface in it more than once.
//!
//! Source: Policarpo and Oliveira, *Relaxed cone stepping for relief mapping* (GPU Gems 3, 2007), for the idea. Their bake follows a ray
//! from each texel over each other texel's top, which costs the square of the texels, and knows texel centres only.
//!
//! The condition. A ray comes out of the surface where that falls away from the axis more steeply than the ray does; the first
//! rays to come out are the level ones, so a cone is right exactly if no point that falls away from the axis, seen from p, lies in it:
//! no q with h(q) > h(p) and (q − p)·∇h(q) < 0, its crests included, is nearer to p than r · L · (h(q) − h(p)). Rising flanks may be
//! cut, which makes these cones wider than those of [`cone_map`](crate::cone_map). A narrower cone is right as well, so the same
//! argument as there keeps filtered ratios right.
//!
//! The bounds that make it fast are those of `cone_map`; what surely rises away from a cell is passed over as a whole.

use crate::cone_map::ConeMap;
use crate::slope_search::Rule;
use crate::{EdgeMode, HeightField};

/// The relaxed cones of a field.
#[must_use]
pub fn bake(field: &HeightField, edge: EdgeMode) -> ConeMap {
    ConeMap::from_slopes(field, edge, Rule::CrossedOnce)
}
