//! The view ray through a relief layer, and how a search along it may end: what all relief techniques share.
//!
//! Elevation over the polygon z(h) = scale · h + bias in widths of the tile (1 = one tile along u), scale ≥ 0. A tile that is not
//! square has the same elevation in other units along v: [`Layer::v_factor`] is the tile's width over its height. V is the unit
//! vector from the surface to the eye in tangent space.
//!
//! The ray enters the layer at its top, z = scale + bias, where t = 0, and leaves it at z = bias, where t = 1:
//! uv(t) = uv_top + t · delta, delta = −scale · V.xy / V.z per axis. At t the ray is at the height 1 − t, and it has met a height
//! field h where h(uv(t)) ≥ 1 − t. The layer has a floor: at t = 1 every ray has met the surface.
//!
//! Every view has an answer, which [`Entry`] states: a view flatter than [`MIN_VIEW_Z`], from the side or from below counts as
//! one at that V.z, with the same V.xy ([`Status::Clamped`]); what is not finite shifts nothing ([`Status::NonFinite`]).

use glam::{DVec2, DVec3};

use crate::parallax_offset;

/// The smallest V.z that a ray is traced with, about 87° from the normal: a ray crosses at most 20 thicknesses of the layer.
pub const MIN_VIEW_Z: f64 = parallax_offset::MIN_VIEW_Z;

/// The most layers or steps that a search takes.
pub const MAX_STEPS: u32 = 4096;

/// How many layers or steps a search takes that is asked for so many: at least one, at most [`MAX_STEPS`].
#[must_use]
pub fn step_count(wanted: u32) -> u32 {
    wanted.clamp(1, MAX_STEPS)
}

/// Where the relief lies over the polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Thickness, in widths of the tile; not negative.
    pub scale: f64,
    /// Elevation of the layer's bottom over the polygon, in widths of the tile. The bottom lies below for negative values.
    pub bias: f64,
    /// Width of a tile over its height: what an elevation in widths is to be multiplied with along v.
    pub v_factor: f64,
}

impl Layer {
    /// A layer on square tiles that hangs below the polygon, its top at the polygon.
    #[must_use]
    pub fn below(scale: f64) -> Self {
        Self {
            scale,
            bias: -scale,
            v_factor: 1.0,
        }
    }

    /// What an elevation of one tile's width is in UV units along u and along v.
    #[must_use]
    pub fn per_axis(&self) -> DVec2 {
        DVec2::new(1.0, self.v_factor)
    }

    fn is_finite(&self) -> bool {
        [self.scale, self.bias, self.v_factor]
            .iter()
            .all(|value| value.is_finite())
    }
}

/// A ray through the relief layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// uv where the ray enters the layer (t = 0).
    pub uv_top: DVec2,
    /// uv travelled while crossing the layer (t from 0 to 1).
    pub delta: DVec2,
}

impl Ray {
    /// The view ray that crosses the polygon at `uv`, on square tiles. `None` where the view direction does not look down on the
    /// polygon (V.z ≤ 0), is not finite, or is so flat that the shift overflows.
    #[must_use]
    pub fn through(uv: DVec2, view_ts: DVec3, scale: f64, bias: f64) -> Option<Self> {
        let slope = view_ts.truncate() / view_ts.z;
        let ray = Self {
            uv_top: uv + (scale + bias) * slope,
            delta: -scale * slope,
        };
        (view_ts.z > 0.0 && ray.uv_top.is_finite() && ray.delta.is_finite()).then_some(ray)
    }

    /// The uv at parameter t.
    #[must_use]
    pub fn at(&self, t: f64) -> DVec2 {
        self.uv_top + t * self.delta
    }
}

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Status {
    /// The surface was met.
    Hit,
    /// The surface was met by a ray steeper than the view: V.z counted as [`MIN_VIEW_Z`].
    Clamped,
    /// The search gave up after its greatest number of steps; t and uv are where it stood.
    CapReached,
    /// An input was NaN or infinite: nothing was searched, t is 0 and uv the one given.
    NonFinite,
}

impl Status {
    /// The number that stands for it in a shader's hit record.
    #[must_use]
    pub fn number(self) -> u32 {
        match self {
            Self::Hit => 0,
            Self::Clamped => 1,
            Self::CapReached => 2,
            Self::NonFinite => 3,
        }
    }
}

/// What every relief technique answers, and what colour, depth and shadow are made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitRecord {
    /// Where the surface was met, in UV, not wrapped.
    pub uv: DVec2,
    /// Depth below the layer's top as a share of its thickness.
    pub t: f64,
    /// How the search ended.
    pub status: Status,
}

/// A ray that is ready to be searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The ray. Without length where nothing is to be searched.
    pub ray: Ray,
    /// [`Status::Hit`], [`Status::Clamped`] or [`Status::NonFinite`].
    pub status: Status,
}

impl Entry {
    /// The view ray that crosses the polygon at `uv`, for any input.
    #[must_use]
    pub fn new(uv: DVec2, view_ts: DVec3, layer: &Layer) -> Self {
        if !(uv.is_finite() && view_ts.is_finite() && layer.is_finite()) {
            let ray = Ray {
                uv_top: uv,
                delta: DVec2::ZERO,
            };
            return Self {
                ray,
                status: Status::NonFinite,
            };
        }
        let slope = layer.per_axis() * view_ts.truncate() / view_ts.z.max(MIN_VIEW_Z);
        let ray = Ray {
            uv_top: uv + (layer.scale + layer.bias) * slope,
            delta: -layer.scale * slope,
        };
        let status = if view_ts.z < MIN_VIEW_Z {
            Status::Clamped
        } else {
            Status::Hit
        };
        Self { ray, status }
    }

    /// The record of a search along this ray, which answers t and whether it found the surface before its cap.
    #[must_use]
    pub fn search(&self, find: impl FnOnce(&Ray) -> (f64, bool)) -> HitRecord {
        if self.status == Status::NonFinite {
            return HitRecord {
                uv: self.ray.uv_top,
                t: 0.0,
                status: self.status,
            };
        }
        let (t, found) = find(&self.ray);
        HitRecord {
            uv: self.ray.at(t),
            t,
            status: if found { self.status } else { Status::CapReached },
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::{Entry, Layer, MIN_VIEW_Z, Ray, Status};

    #[test]
    fn a_view_from_the_side_or_below_has_no_plain_ray() {
        for view_ts in [
            DVec3::X,
            -DVec3::Z,
            DVec3::new(1.0, 0.0, -1e-9),
            DVec3::NAN,
            DVec3::new(1.0, 0.0, 5e-324),
        ] {
            assert!(Ray::through(DVec2::ZERO, view_ts, 0.05, -0.05).is_none());
        }
    }

    #[test]
    fn flat_views_and_views_from_below_count_as_the_flattest_that_is_traced() {
        let layer = Layer::below(0.05);
        let flattest = Entry::new(DVec2::ZERO, DVec3::new(0.6, 0.8, MIN_VIEW_Z), &layer);
        assert_eq!(flattest.status, Status::Hit);
        for z in [0.0, -0.0, 5e-324, -1.0, MIN_VIEW_Z - 1e-12] {
            let entry = Entry::new(DVec2::ZERO, DVec3::new(0.6, 0.8, z), &layer);
            assert_eq!((entry.ray, entry.status), (flattest.ray, Status::Clamped), "{z}");
        }
        // 20 thicknesses, along V.xy and away from the eye.
        assert!((flattest.ray.delta + 20.0 * 0.05 * DVec2::new(0.6, 0.8)).length() < 1e-15);
    }

    #[test]
    fn what_is_not_finite_shifts_nothing_and_searches_nothing() {
        let (uv, view, layer) = (DVec2::new(0.25, 0.5), DVec3::Z, Layer::below(0.05));
        let infinite = Layer {
            scale: f64::INFINITY,
            ..layer
        };
        for entry in [
            Entry::new(uv, DVec3::NAN, &layer),
            Entry::new(uv, DVec3::new(f64::INFINITY, 0.0, 1.0), &layer),
            Entry::new(uv, view, &infinite),
        ] {
            let record = entry.search(|_| unreachable!("nothing is searched"));
            assert_eq!((record.uv, record.t, record.status), (uv, 0.0, Status::NonFinite));
        }
        let lost = Entry::new(DVec2::NAN, view, &layer).search(|_| unreachable!("nothing is searched"));
        assert!(lost.uv.is_nan() && lost.status == Status::NonFinite);
    }

    #[test]
    fn a_tile_that_is_not_square_has_its_own_travel_along_v() {
        // Two wide, one high: an elevation is twice as long, told in heights of the tile.
        let layer = Layer {
            scale: 0.1,
            bias: -0.05,
            v_factor: 2.0,
        };
        let ray = Entry::new(DVec2::ZERO, DVec3::new(0.6, 0.6, 0.5), &layer).ray;
        assert!((ray.delta - DVec2::new(-0.12, -0.24)).length() < 1e-16);
        assert!(
            (ray.at(0.5) - DVec2::ZERO).length() < 1e-16,
            "the middle lies on the polygon"
        );
    }

    #[test]
    fn a_capped_search_says_so_whatever_the_view() {
        let entry = Entry::new(DVec2::ZERO, DVec3::X, &Layer::below(0.05));
        assert_eq!(entry.search(|_| (0.5, false)).status, Status::CapReached);
        assert_eq!(entry.search(|_| (0.5, true)).status, Status::Clamped);
    }
}
