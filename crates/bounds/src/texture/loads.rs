//! Texel loads by integer coordinates, which may be uncertain or out of bounds.
//!
//! Out of bounds, WGSL allows any texel of the texture or zeros: zeros in point domains, all of them in interval domains.

use super::request::Channels;
use super::{Texture, filter};

/// Bounds of the channels, and whether a coordinate was out of bounds.
pub(crate) fn load_texels(
    texture: &Texture,
    level: (i128, i128),
    index: [(i128, i128); 3],
    layer: (i128, i128),
    limit: u32,
    uncertain: bool,
) -> (Channels, bool) {
    let exact = level.0 == level.1 && layer.0 == layer.1 && index.iter().all(|i| i.0 == i.1);
    let layers = i128::from(texture.layers().max(texture.samples()));
    let valid_level = level.0 >= 0 && level.1 < texture.levels() as i128;
    let last = texture.levels() as i128 - 1;
    let size = texture.size(level.0.clamp(0, last) as usize).map(i128::from);
    let inside = valid_level
        && layer.0 >= 0
        && layer.1 < layers
        && index.iter().zip(size).all(|(i, n)| i.0 >= 0 && i.1 < n);
    let count: i128 = index.iter().map(|i| i.1 - i.0 + 1).product::<i128>() * (layer.1 - layer.0 + 1);
    if exact && inside {
        let texel = texture.texel(level.0 as usize, index.map(|i| i.0 as u32), layer.0 as u32);
        return (texel.map(|x| (x, x)), false);
    }
    if !uncertain {
        return ([(0.0, 0.0); 4], true);
    }
    if !inside || level.0 != level.1 || count > i128::from(limit) {
        let all = (0..texture.levels())
            .map(|l| texture.level_bounds(l))
            .reduce(filter::hull);
        return (all.unwrap_or([(0.0, 1.0); 4]), !inside);
    }
    let mut total: Option<Channels> = None;
    for l in layer.0..=layer.1 {
        for z in index[2].0..=index[2].1 {
            for y in index[1].0..=index[1].1 {
                for x in index[0].0..=index[0].1 {
                    let t = texture
                        .texel(level.0 as usize, [x as u32, y as u32, z as u32], l as u32)
                        .map(|x| (x, x));
                    total = Some(total.map_or(t, |a| filter::hull(a, t)));
                }
            }
        }
    }
    (total.unwrap_or([(0.0, 1.0); 4]), false)
}
