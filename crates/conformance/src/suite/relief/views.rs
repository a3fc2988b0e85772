//! The view rays of relief cases: from straight above to from below, along the axes and across them.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

/// Angles from the normal, in degrees. Beyond 87° a ray is clamped; beyond 90° the eye is below the polygon.
const DEGREES: [f64; 9] = [0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 88.0, 90.0, 120.0];

/// Where a view ray crosses the polygon, and the direction to the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct View {
    pub(super) uv: [f32; 2],
    pub(super) dir_ts: [f32; 3],
}

impl View {
    /// As the kernel takes it: the direction begins at 16 bytes.
    pub(super) fn packed(&self) -> [f32; 8] {
        let ([u, v], [x, y, z]) = (self.uv, self.dir_ts);
        [u, v, 0.0, 0.0, x, y, z, 0.0]
    }
}

/// At each angle `each` views of any azimuth, and one along each axis: their rays have a component that is exactly zero.
pub(super) fn views(each: usize, rng: &mut Pcg64Mcg) -> Vec<View> {
    let mut views = Vec::new();
    for degrees in DEGREES {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let axes = [(1.0, 0.0), (0.0, -1.0)];
        let any: Vec<(f64, f64)> = (0..each)
            .map(|_| (std::f64::consts::TAU * rng.random::<f64>()).sin_cos())
            .collect();
        for (x, y) in axes.into_iter().chain(any) {
            let uv = [0, 1].map(|_| 4.0 * rng.random::<f32>() - 2.0);
            let dir_ts = [sin * x, sin * y, cos].map(|component| component as f32);
            views.push(View { uv, dir_ts });
        }
    }
    views
}

/// Views and places that are no numbers.
pub(super) fn not_finite() -> Vec<View> {
    let (nan, infinite) = (f32::NAN, f32::INFINITY);
    let place = [0.25, 0.75];
    vec![
        View {
            uv: place,
            dir_ts: [nan, 0.0, 1.0],
        },
        View {
            uv: place,
            dir_ts: [0.6, 0.0, nan],
        },
        View {
            uv: place,
            dir_ts: [nan; 3],
        },
        View {
            uv: place,
            dir_ts: [0.0, -infinite, 0.5],
        },
        View {
            uv: place,
            dir_ts: [0.0, 0.0, infinite],
        },
        View {
            uv: [nan, 0.5],
            dir_ts: [0.0, 0.0, 1.0],
        },
        View {
            uv: [0.5, infinite],
            dir_ts: [0.6, 0.0, 0.8],
        },
    ]
}
