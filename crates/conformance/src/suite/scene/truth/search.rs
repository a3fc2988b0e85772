//! A draw's search along the view ray in the words of the f64 surface: which technique with which settings, and the maps that it reads.

use bossage_assets::HeightField;
use bossage_assets::cone_map::ConeMap;
use bossage_reference::relief_search::Search;
use bossage_reference::surface::{DepthRows, SearchMaps, Shadow};
use bossage_reference::texture::Texture;
use bossage_scene::Draw;
use bossage_shaders::{FeatureSet, Relief, Shadow as Feature};
use glam::DVec4;

use super::{plane, uniform};

/// The search, with the settings of the draw's uniform; none where the shader does not search.
pub(super) fn of(draw: &Draw, features: &FeatureSet) -> Option<Search> {
    let [steps, refinements, ..] = uniform::<4>(draw, "material.search").map(|number| number as u32);
    match features.relief {
        Relief::ParallaxIterative => Some(Search::ParallaxIterative { iterations: steps }),
        Relief::SteepParallax => Some(Search::SteepParallax { layers: steps }),
        Relief::ParallaxOcclusion => Some(Search::ParallaxOcclusion { layers: steps }),
        Relief::Relief => Some(Search::Relief {
            layers: steps,
            refinements,
        }),
        Relief::ConeStep => Some(Search::ConeStep { steps }),
        Relief::RelaxedConeStep => Some(Search::RelaxedConeStep { steps, refinements }),
        Relief::Exact => Some(Search::Exact),
        Relief::None
        | Relief::ParallaxOffset
        | Relief::ParallaxOffsetLimited
        | Relief::ParallaxSlopeAo
        | Relief::ParallaxSlopeAoDirected
        | Relief::Displacement => None,
    }
}

/// What stands before the lights, with the settings of the draw's uniforms.
pub(super) fn shadow(draw: &Draw, features: &FeatureSet) -> Shadow {
    let [_, _, _, samples] = uniform::<4>(draw, "material.search").map(|number| number as u32);
    let [half_width] = uniform(draw, "material.light_half_width").map(f64::from);
    match features.shadow {
        Feature::None => Shadow::None,
        Feature::Hard => Shadow::Hard { samples },
        Feature::Soft => Shadow::Soft { samples, half_width },
    }
}

/// What makes a depth of the place that is found, where the shader writes it.
pub(super) fn depth(draw: &Draw, features: &FeatureSet) -> Option<DepthRows> {
    let row = |name| DVec4::from_array(uniform(draw, name).map(f64::from));
    let [tile_width] = uniform(draw, "material.tile_width").map(f64::from);
    features.pixel_depth.then(|| DepthRows {
        clip_z: row("view.clip_z"),
        clip_w: row("view.clip_w"),
        tile_width,
    })
}

/// The maps as the shader reads them: heights from their own map or from the red of the baked one, the rest from its green.
pub(in super::super) fn maps(draw: &Draw, features: &FeatureSet) -> Option<SearchMaps> {
    if !features.relief.is_search() {
        return None;
    }
    let name = if features.relief.reads_heights() {
        "height_map"
    } else {
        "relief_map"
    };
    let baked = plane(draw, "relief_map").filter(|_| !features.relief.reads_heights());
    Some(SearchMaps {
        heights: heights(&plane(draw, name)?),
        cones: baked.as_ref().map(cones),
        normal_z: baked,
    })
}

fn heights(map: &Texture) -> HeightField {
    HeightField {
        width: map.width,
        height: map.height,
        texels: map.texels.iter().map(|texel| texel.x as f32).collect(),
    }
}

fn cones(map: &Texture) -> ConeMap {
    ConeMap {
        width: map.width,
        height: map.height,
        ratios: map.texels.iter().map(|texel| texel.y as f32).collect(),
    }
}
