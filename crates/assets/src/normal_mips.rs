//! `normal_mips`: the mip chain of a normal map.
//!
//! Published (the article on height and normal maps leaves it to `glGenerateMipmap`): bytes are averaged, nothing is
//! normalised. Here the decoded vectors are averaged from level to level ([`means`]), and only what is written is
//! normalised ([`chain`]): the average of averages stays the average of the base.
//!
//! Fault of the naive rule: the average of differing normals is shorter than 1, and that length says how rough the surface is
//! below the texel. Normalised maps have lost it; [`lengths`] keeps it for those who need it (Toksvig 2005).

use glam::{Vec3, Vec4};

use crate::NormalMap;
use crate::mips::{self, Level};

/// How normal maps are filtered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum NormalMips {
    /// Averaged and renormalised; where the average vanishes, (0, 0, 1).
    #[default]
    Naive,
    /// As published: averaged, and not normalised. Interfaces round at every level, here only what is written is rounded.
    Averaged,
}

/// The averages of the decoded normals, level by level, the base first: not normalised, alpha in w.
#[must_use]
pub fn means(map: &NormalMap) -> Vec<Level> {
    let decode = |&[r, g, b, a]: &[u8; 4]| {
        let [x, y, z] = [r, g, b].map(|byte| map.codec.decode(byte));
        Vec4::new(x, y, z, f32::from(a) / 255.0)
    };
    mips::chain(Level {
        width: map.width,
        height: map.height,
        texels: map.texels.iter().map(decode).collect(),
    })
}

/// The length of each average of a level of [`means`]: 1 where the normals below agree, less where they differ.
#[must_use]
pub fn lengths(level: &Level) -> Vec<f32> {
    level.texels.iter().map(|t| t.truncate().length()).collect()
}

/// The chain of a normal map; the base level is the map itself, untouched. Alpha is averaged.
#[must_use]
pub fn chain(map: &NormalMap, rule: NormalMips) -> Vec<NormalMap> {
    let mut levels: Vec<NormalMap> = means(map).iter().map(|level| encode(level, map, rule)).collect();
    if let Some(base) = levels.first_mut() {
        base.texels.clone_from(&map.texels);
    }
    levels
}

fn encode(level: &Level, map: &NormalMap, rule: NormalMips) -> NormalMap {
    let texel = |t: &Vec4| {
        let n = match rule {
            NormalMips::Naive => t.truncate().try_normalize().unwrap_or(Vec3::Z),
            NormalMips::Averaged => t.truncate(),
        };
        let [r, g, b] = n.to_array().map(|c| map.codec.encode(c));
        [r, g, b, (t.w * 255.0 + 0.5) as u8]
    };
    NormalMap {
        width: level.width,
        height: level.height,
        codec: map.codec,
        texels: level.texels.iter().map(texel).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NormalCodec;

    #[test]
    fn averaged_chains_keep_the_short_normals_that_naive_ones_stretch() {
        let byte = |c: f32| NormalCodec::Biased.encode(c);
        let texels = [0.8, -0.8].map(|x| [byte(x), byte(0.0), byte(0.6), 255]).to_vec();
        let map = NormalMap {
            width: 2,
            height: 1,
            codec: NormalCodec::Biased,
            texels,
        };
        let top = |rule| chain(&map, rule)[1].decode(0, 0);
        // 0.6 is written as 76/127 = 0.5984.
        assert_eq!(top(NormalMips::Averaged), Vec3::new(0.0, 0.0, 76.0 / 127.0));
        assert_eq!(top(NormalMips::Naive), Vec3::Z);
        assert_eq!(chain(&map, NormalMips::Averaged)[0], map);
    }

    #[test]
    fn lengths_tell_rough_from_smooth_where_normals_do_not() {
        let row = |normals: [Vec3; 2]| NormalMap {
            width: 2,
            height: 1,
            codec: NormalCodec::Biased,
            texels: normals
                .map(|n| n.to_array().map(|c| NormalCodec::Biased.encode(c)))
                .map(|[r, g, b]| [r, g, b, 255])
                .to_vec(),
        };
        let rough = row([Vec3::new(0.8, 0.0, 0.6), Vec3::new(-0.8, 0.0, 0.6)]);
        let smooth = row([Vec3::Z; 2]);
        let top = |map: &NormalMap| chain(map, NormalMips::Naive)[1].clone();
        assert_eq!(
            top(&rough).texels,
            top(&smooth).texels,
            "the naive chain has lost the difference"
        );
        let length = |map: &NormalMap| lengths(&means(map)[1])[0];
        // 0.6 within half a step of 1/127, and exactly 1.
        assert!((length(&rough) - 0.6).abs() <= 0.5 / 127.0 + 1e-6);
        assert_eq!(length(&smooth), 1.0);
    }
}
