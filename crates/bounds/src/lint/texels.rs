//! What packed words and textures give in a walk: anything within their ranges.

use super::state::{State, float_cell};
use super::step::whole;
use super::table::Vn;
use super::walk::Walk;
use crate::compile::code::{ImageLoad, ImageQuery, Pack, Packing, Query, Sample};
use crate::compile::program::ResourceKind;
use crate::domain::Domain;
use crate::interval::{Range, WideCell};
use crate::kind::{IntType, Kind};
use crate::ranges::TextureInput;
use crate::texture::Bounds;

impl<'p> Walk<'p> {
    pub(super) fn unpack(&mut self, pack: &Pack, state: &mut State) {
        let word = self.value(state, pack.word);
        for &dst in &pack.parts {
            let kind = self.code.kinds[dst as usize];
            let cell = match pack.packing {
                Packing::Unorm { .. } => float_cell((0.0, 1.0)),
                Packing::Snorm { .. } => float_cell((-1.0, 1.0)),
                Packing::Half => float_cell((-65504.0, 65504.0)),
                Packing::Int { signed: true, .. } => Range::int_range(IntType::I32, -128, 127),
                Packing::Int { signed: false, .. } => Range::int_range(IntType::U32, 0, 255),
            };
            state.rows[dst as usize] = self.opaque(kind, cell, vec![word.vn], state);
        }
    }

    fn texture(&self, resource: u32) -> Option<&'p TextureInput> {
        let resource = &self.program.resources[resource as usize];
        let written = matches!(resource.kind, ResourceKind::StorageTexture { access, .. } if access.contains(naga::StorageAccess::STORE));
        self.inputs
            .textures
            .iter()
            .find(|t| Some(t.binding) == resource.binding && !written)
    }

    fn channel(kind: Kind, (lo, hi): Bounds) -> WideCell {
        match kind {
            Kind::Float(_) => float_cell((lo, hi)),
            Kind::Int(t) => Range::int_range(t, (lo as i128).max(t.min()), (hi as i128).min(t.max())),
            Kind::Bool => Range::undecided(Kind::Bool),
        }
    }

    pub(super) fn sample(&mut self, sample: &Sample, state: &mut State) {
        let texture = self.texture(sample.image.resource);
        let parents: Vec<Vn> = sample
            .coordinate
            .iter()
            .map(|&row| self.value(state, row).vn)
            .collect();
        for k in 0..sample.parts {
            let cell = match (texture, sample.reference, sample.gather) {
                (None, ..) => Range::undecided(sample.kind),
                (Some(_), Some(_), _) => float_cell((0.0, 1.0)),
                (Some(texture), None, Some(c)) => {
                    Self::channel(sample.kind, texture.channels[usize::from(c) % 4])
                }
                (Some(texture), None, None) => Self::channel(sample.kind, texture.channels[k as usize % 4]),
            };
            state.rows[(sample.dst + k) as usize] = self.opaque(sample.kind, cell, parents.clone(), state);
        }
    }

    pub(super) fn image_load(&mut self, load: &ImageLoad, state: &mut State) {
        let texture = self.texture(load.image.resource);
        let parents: Vec<Vn> = load
            .coordinate
            .iter()
            .map(|&(row, _)| self.value(state, row).vn)
            .collect();
        for k in 0..load.parts {
            let cell = match texture {
                None => Range::undecided(load.kind),
                Some(texture) => Self::channel(load.kind, texture.channels[k as usize % 4]),
            };
            state.rows[(load.dst + k) as usize] = self.opaque(load.kind, cell, parents.clone(), state);
        }
    }

    pub(super) fn image_query(&mut self, query: &ImageQuery, state: &mut State) {
        let resource = &self.program.resources[query.image.resource as usize];
        let texture = self
            .inputs
            .textures
            .iter()
            .find(|t| Some(t.binding) == resource.binding);
        for k in 0..query.parts {
            let kind = self.code.kinds[(query.dst + k) as usize];
            let known = texture.map(|t| match query.query {
                Query::Size => t.size[k as usize % 3],
                Query::Levels => 1,
                Query::Layers => (t.layers
                    / if t.dimension == crate::texture::Dimension::Cube {
                        6
                    } else {
                        1
                    })
                .max(1),
                Query::Samples => t.samples,
            });
            let cell = match (known, kind, query.level) {
                (Some(n), Kind::Int(t), None) => Range::int(t, i128::from(n)),
                (Some(n), Kind::Int(t), Some(_)) => Range::int_range(t, 1, i128::from(n)),
                (_, kind, _) => whole(kind),
            };
            state.rows[(query.dst + k) as usize] = self.opaque(kind, cell, Vec::new(), state);
        }
    }
}
