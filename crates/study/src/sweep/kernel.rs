//! The interface of `relief_hits` (`shaders/entry/relief_hits.wesl`), which the library's techniques and users' shaders share: how rays are
//! handed over and answers read.

use bossage_assets::EdgeMode;
use bossage_reference::relief_ray::Status;
use bossage_runner::{AddressMode, ComputeOutput, Filter, SamplerSettings};
use glam::DVec2;

use super::map::Map;
use super::rays::ViewRay;
use super::statistics::Answer;

/// The storage buffer that is read: 32 bytes a ray, uv first, the direction to the eye 16 bytes on.
pub const RAYS: &str = "rays";
/// The storage buffer that is written: 16 bytes a ray, uv, t, status.
pub const HITS: &str = "hits";
/// The heights, in red.
pub const HEIGHT_MAP: &str = "height_map";
/// What a technique reads beside the heights.
pub const RELIEF_MAP: &str = "relief_map";
/// Heights and safe cones, for users' shaders.
pub const CONE_MAP: &str = "cone_map";
/// Heights and relaxed cones, for users' shaders.
pub const RELAXED_CONE_MAP: &str = "relaxed_cone_map";
/// The sampler of all maps.
pub const SAMPLER: &str = "surface_sampler";
/// Bytes of an answer.
pub const HIT_BYTES: usize = 16;

/// The rays as the kernel reads them.
#[must_use]
pub fn pack(rays: &[ViewRay]) -> Vec<u8> {
    let words = rays.iter().flat_map(|ray| {
        let (uv, view) = (ray.uv, ray.view_ts);
        [uv.x, uv.y, 0.0, 0.0, view.x, view.y, view.z, 0.0]
    });
    words.flat_map(f32::to_le_bytes).collect()
}

/// The answers, one a ray. What was never written is no number.
#[must_use]
pub fn answers(output: &ComputeOutput, rays: usize) -> Vec<Answer> {
    let words = output.words(HITS);
    let (hits, _) = words.as_chunks::<4>();
    let answer = |[u, v, _t, status]: &[u32; 4]| Answer {
        uv: DVec2::new(f64::from(f32::from_bits(*u)), f64::from(f32::from_bits(*v))),
        status: status_of(*status),
    };
    let mut answers: Vec<Answer> = hits.iter().map(answer).collect();
    answers.resize(
        rays,
        Answer {
            uv: DVec2::NAN,
            status: None,
        },
    );
    answers
}

/// The statuses of `lib/relief_ray.wesl`.
fn status_of(word: u32) -> Option<Status> {
    match word {
        0 => Some(Status::Hit),
        1 => Some(Status::Clamped),
        2 => Some(Status::CapReached),
        3 => Some(Status::NonFinite),
        _ => None,
    }
}

/// The values of the uniform `search`, by member.
#[must_use]
pub fn search(map: &Map, steps: u32, refinements: u32) -> [(String, Vec<f32>); 7] {
    let layer = &map.layer;
    [
        ("scale", layer.scale as f32),
        ("bias", layer.bias as f32),
        ("v_factor", layer.v_factor as f32),
        ("level", 0.0),
        ("steps", steps as f32),
        ("refinements", refinements as f32),
        ("edge_mode", edge_number(map.edge)),
    ]
    .map(|(name, value)| (format!("search.{name}"), vec![value]))
}

/// The edge modes of `lib/edge.wesl`.
const fn edge_number(edge: EdgeMode) -> f32 {
    match edge {
        EdgeMode::Wrap => 0.0,
        EdgeMode::Mirror => 1.0,
        EdgeMode::Clamp => 2.0,
    }
}

/// A linear sampler with the map's edges, of one level.
#[must_use]
pub fn sampler(edge: EdgeMode) -> SamplerSettings {
    let address = match edge {
        EdgeMode::Wrap => AddressMode::Wrap,
        EdgeMode::Mirror => AddressMode::Mirror,
        EdgeMode::Clamp => AddressMode::Clamp,
    };
    SamplerSettings {
        address,
        filter: Filter::Linear,
        mip_filter: Filter::Nearest,
        anisotropy: 1,
    }
}

#[cfg(test)]
mod tests {
    use bossage_reference::relief_ray::Status;
    use bossage_runner::ComputeOutput;
    use glam::{Vec2, Vec3};

    use super::{HITS, answers, pack};
    use crate::sweep::rays::ViewRay;

    #[test]
    fn a_ray_takes_32_bytes() {
        let ray = ViewRay {
            uv: Vec2::new(0.25, 0.5),
            view_ts: Vec3::new(0.0, 0.6, 0.8),
        };
        let bytes = pack(&[ray, ray]);
        assert_eq!(bytes.len(), 64);
        assert_eq!(bytes[32..36], 0.25_f32.to_le_bytes());
        assert_eq!(bytes[16 + 4..16 + 8], 0.6_f32.to_le_bytes());
    }

    #[test]
    fn answers_that_are_missing_or_unknown_are_no_answers() {
        let words = [
            1.5_f32.to_bits(),
            0.0_f32.to_bits(),
            0.5_f32.to_bits(),
            1,
            0,
            0,
            0,
            9,
        ];
        let mut output = ComputeOutput::default();
        let bytes = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        output.buffers.insert(HITS.to_owned(), bytes);
        let found = answers(&output, 3);
        assert_eq!((found[0].uv.x, found[0].status), (1.5, Some(Status::Clamped)));
        assert_eq!(found[1].status, None);
        assert!(found[2].uv.is_nan() && found[2].status.is_none());
    }
}
