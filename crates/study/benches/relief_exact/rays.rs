//! The view rays of a job: 65,536 of one angle from the normal.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

pub(crate) struct View {
    pub(crate) uv: [f32; 2],
    pub(crate) dir_ts: [f32; 3],
}

const SIDE: u32 = 256;

/// The azimuth of a picture's rays: no multiple of an eighth of a turn, so that both axes count.
const AZIMUTH: f64 = 0.6;

/// A grid over the tile that looks one way, or places and azimuths by lot.
pub(crate) fn views(angle_deg: f64, scatter: bool) -> Vec<View> {
    let mut lot = Pcg64Mcg::seed_from_u64(5);
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    let mut view = |x: u32, y: u32| {
        let (place, azimuth) = if scatter {
            let place = [lot.random::<f32>(), lot.random::<f32>()];
            (place, std::f64::consts::TAU * lot.random::<f64>())
        } else {
            let at = |i: u32, within: f32| (i as f32 + within) / SIDE as f32;
            ([at(x, 0.37), at(y, 0.61)], AZIMUTH)
        };
        let toward = [-sin * azimuth.cos(), -sin * azimuth.sin(), cos];
        View {
            uv: place,
            dir_ts: toward.map(|value| value as f32),
        }
    };
    let places = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    places.map(|(x, y)| view(x, y)).collect()
}

/// As the kernel reads them: 32 bytes a ray.
pub(crate) fn bytes(views: &[View]) -> Vec<u8> {
    let words = views.iter().flat_map(|view| {
        let ([u, v], [x, y, z]) = (view.uv, view.dir_ts);
        [u, v, 0.0, 0.0, x, y, z, 0.0]
    });
    words.flat_map(f32::to_le_bytes).collect()
}
