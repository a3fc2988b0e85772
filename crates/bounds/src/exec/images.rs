//! Texture instructions: sampling, gathering, loading, storing, queries.

use super::machine::Machine;
use crate::compile::code::{HandleRef, ImageLoad, ImageQuery, ImageStore, Level, Query, Row, Sample};
use crate::compile::program::ResourceKind;
use crate::domain::Domain;
use crate::error::{Error, Result};
use crate::kind::{IntType, Kind};
use crate::texture::format::Rounding;
use crate::texture::loads::load_texels;
use crate::texture::request::Request;
use crate::texture::{Bounds, Sampler, Texture};
use crate::width::Width;
use std::ops::RangeInclusive;

impl<'a, D: Domain> Machine<'a, D> {
    fn texture(&self, handle: &HandleRef, lane: u32) -> Option<&'a Texture> {
        let list = &self.context.textures[handle.resource as usize];
        list.get(self.element(handle, lane)?)
    }

    fn sampler(&self, handle: &HandleRef, lane: u32) -> Option<&'a Sampler> {
        let list = &self.context.samplers[handle.resource as usize];
        list.get(self.element(handle, lane)?)
    }

    /// The element of a binding array, zero for plain bindings; `None` when it is uncertain or out of bounds.
    fn element(&self, handle: &HandleRef, lane: u32) -> Option<usize> {
        let Some((row, t)) = handle.index else {
            return Some(0);
        };
        let (lo, hi) = D::int_bounds(t, self.get(row, lane));
        (lo == hi).then(|| usize::try_from(lo).ok()).flatten()
    }

    fn bounds_of(&self, rows: &[Row], lane: u32) -> [Bounds; 3] {
        let mut out = [(0.0, 0.0); 3];
        for (to, &row) in out.iter_mut().zip(rows) {
            *to = D::float_bounds(self.get(row, lane));
        }
        out
    }

    pub(crate) fn sample(&mut self, sample: &Sample, active: &[u32]) -> Result<()> {
        let needs_neighbours = matches!(sample.level, Level::Auto | Level::Bias(_));
        let neighbours: Vec<Vec<Option<D::Cell>>> = if needs_neighbours && self.filters_by_level(sample) {
            sample
                .coordinate
                .iter()
                .map(|&row| self.by_invocation(row, Kind::Float(Width::F32), active))
                .collect()
        } else {
            Vec::new()
        };
        for &lane in active {
            self.sample_lane(sample, lane, &neighbours)?;
        }
        Ok(())
    }

    /// Whether the level of detail can make a difference for any texture of the handle.
    fn filters_by_level(&self, sample: &Sample) -> bool {
        self.context.textures[sample.image.resource as usize]
            .iter()
            .any(|t| t.levels() > 1)
            || self.context.samplers[sample.sampler.resource as usize]
                .iter()
                .any(|s| s.mag != s.min)
    }

    fn sample_lane(&mut self, sample: &Sample, lane: u32, neighbours: &[Vec<Option<D::Cell>>]) -> Result<()> {
        let (Some(texture), Some(sampler)) = (
            self.texture(&sample.image, lane),
            self.sampler(&sample.sampler, lane),
        ) else {
            self.set_all(sample.dst, sample.parts, lane, D::indeterminate(sample.kind));
            return Ok(());
        };
        let mut request = Request {
            texture,
            sampler,
            at: self.bounds_of(&sample.coordinate, lane),
            offset: self.offsets(&sample.offset, lane),
            layers: self.layers(texture, sample.layer, lane),
            reference: sample.reference.map(|row| D::float_bounds(self.get(row, lane))),
            limit: self.context.limits.spread,
        };
        if request.at.iter().chain(&request.reference).any(|b| b.0.is_nan()) {
            self.set_all(sample.dst, sample.parts, lane, D::indeterminate(sample.kind));
            return Ok(());
        }
        if sample.clamp_to_edge {
            request.clamp_to_edge();
        }
        let result = match sample.gather {
            Some(component) => request.gather(component as usize, D::UNCERTAIN),
            None => match self.level_bounds(sample, &request, lane, neighbours) {
                Some(level) => request.sample(level, D::UNCERTAIN),
                None => {
                    self.set_all(sample.dst, sample.parts, lane, D::indeterminate(sample.kind));
                    return Ok(());
                }
            },
        };
        for (k, bounds) in (0..sample.parts).zip(result) {
            self.set(sample.dst + k, lane, channel::<D>(sample.kind, bounds));
        }
        Ok(())
    }

    fn set_all(&mut self, dst: Row, parts: u32, lane: u32, cell: D::Cell) {
        (dst..dst + parts).for_each(|row| self.set(row, lane, cell));
    }

    fn offsets(&self, rows: &[Row], lane: u32) -> [i64; 3] {
        let mut out = [0; 3];
        for (to, &row) in out.iter_mut().zip(rows) {
            *to = D::int_bounds(IntType::I32, self.get(row, lane)).0 as i64;
        }
        out
    }

    fn layers(&self, texture: &Texture, layer: Option<(Row, IntType)>, lane: u32) -> RangeInclusive<u32> {
        let Some((row, t)) = layer else { return 0..=0 };
        let last = i128::from(texture.layers()) - 1;
        let (lo, hi) = D::int_bounds(t, self.get(row, lane));
        lo.clamp(0, last) as u32..=hi.clamp(0, last) as u32
    }

    /// Bounds of the level of detail; `None` when nothing is known and it matters.
    fn level_bounds(
        &self,
        sample: &Sample,
        request: &Request<'_>,
        lane: u32,
        neighbours: &[Vec<Option<D::Cell>>],
    ) -> Option<Bounds> {
        if request.has_one_level() {
            return Some((0.0, 0.0));
        }
        let known = |b: Bounds| (!b.0.is_nan()).then_some(b);
        let of_row = |row: Row| known(D::float_bounds(self.get(row, lane)));
        match &sample.level {
            Level::Zero => Some((0.0, 0.0)),
            Level::Exact(row) => of_row(*row),
            Level::ExactInt(row, t) => {
                let (lo, hi) = D::int_bounds(*t, self.get(*row, lane));
                Some((lo as f64, hi as f64))
            }
            Level::Auto | Level::Bias(_) if neighbours.is_empty() => Some((0.0, 0.0)),
            Level::Auto => self.implicit_level(request, lane, neighbours),
            Level::Bias(row) => {
                let (bias, level) = (of_row(*row)?, self.implicit_level(request, lane, neighbours)?);
                let clamp = |x: f64| x.clamp(-16.0, 15.99);
                Some((level.0 + clamp(bias.0), level.1 + clamp(bias.1)))
            }
            Level::Gradient { x, y } => {
                known(request.level(self.bounds_of(x, lane), self.bounds_of(y, lane), D::UNCERTAIN))
            }
        }
    }

    fn implicit_level(
        &self,
        request: &Request<'_>,
        lane: u32,
        neighbours: &[Vec<Option<D::Cell>>],
    ) -> Option<Bounds> {
        let root = self.lanes.root[lane as usize] as usize;
        let mut gradients = [[(0.0, 0.0); 3]; 2];
        for (gradient, bit) in gradients.iter_mut().zip([1, 2]) {
            for (to, values) in gradient.iter_mut().zip(neighbours) {
                *to = neighbour_difference::<D>(values, root, bit)?;
            }
        }
        let level = request.level(gradients[0], gradients[1], D::UNCERTAIN);
        (!level.0.is_nan()).then_some(level)
    }

    pub(crate) fn image_load(&mut self, load: &ImageLoad, active: &[u32]) {
        for &lane in active {
            let resource = &self.context.program.resources[load.image.resource as usize].kind;
            if let ResourceKind::StorageTexture { .. } = resource {
                self.storage_load(load, lane);
            } else {
                self.sampled_load(load, lane);
            }
        }
    }

    fn int_range(&self, (row, t): (Row, IntType), lane: u32) -> (i128, i128) {
        D::int_bounds(t, self.get(row, lane))
    }

    fn sampled_load(&mut self, load: &ImageLoad, lane: u32) {
        let Some(texture) = self.texture(&load.image, lane) else {
            return self.set_all(load.dst, load.parts, lane, D::indeterminate(load.kind));
        };
        let level = load.level.map_or((0, 0), |l| self.int_range(l, lane));
        let mut index = [(0, 0); 3];
        for (to, &at) in index.iter_mut().zip(&load.coordinate) {
            *to = self.int_range(at, lane);
        }
        // Samples of a multisampled texture are stored as layers.
        let layer = load
            .sample
            .or(load.layer)
            .map_or((0, 0), |l| self.int_range(l, lane));
        let result = load_texels(
            texture,
            level,
            index,
            layer,
            self.context.limits.spread,
            D::UNCERTAIN,
        );
        self.counters.out_of_bounds += u64::from(result.1);
        for (k, bounds) in (0..load.parts).zip(result.0) {
            self.set(load.dst + k, lane, channel::<D>(load.kind, bounds));
        }
    }

    fn storage_load(&mut self, load: &ImageLoad, lane: u32) {
        let region = load.image.resource;
        let cell = self.texel_cell(&load.image, &load.coordinate, load.layer, lane);
        for k in 0..load.parts {
            let value = match cell {
                Some(at) => self.read(region, at + k, lane, load.kind),
                None => super::places::zero::<D>(load.kind),
            };
            let unknown = cell.is_none() && D::UNCERTAIN;
            self.set(
                load.dst + k,
                lane,
                if unknown {
                    D::indeterminate(load.kind)
                } else {
                    value
                },
            );
        }
    }

    /// The first cell of a storage texture's texel; `None` when it is outside or uncertain.
    pub(crate) fn texel_cell(
        &self,
        image: &HandleRef,
        coordinate: &[(Row, IntType)],
        layer: Option<(Row, IntType)>,
        lane: u32,
    ) -> Option<u32> {
        let texture = self.texture(image, lane)?;
        let size = texture.size(0);
        let mut index = [0i128; 3];
        for (to, &at) in index.iter_mut().zip(coordinate) {
            let (lo, hi) = self.int_range(at, lane);
            *to = (lo == hi).then_some(lo)?;
        }
        let layer = layer.map_or(Some(0), |l| {
            let (lo, hi) = self.int_range(l, lane);
            (lo == hi).then_some(lo)
        })?;
        let inside = index
            .iter()
            .zip(size)
            .all(|(&i, n)| (0..i128::from(n)).contains(&i));
        if !inside || !(0..i128::from(texture.layers())).contains(&layer) {
            return None;
        }
        let [w, h, d] = size.map(i128::from);
        Some((4 * (((layer * d + index[2]) * h + index[1]) * w + index[0])) as u32)
    }

    pub(crate) fn image_store(&mut self, store: &ImageStore, active: &[u32]) {
        let region = store.image.resource;
        let uncertain = |machine: &Self, lane| {
            store.coordinate.iter().chain(&store.layer).any(|&at| {
                let (lo, hi) = machine.int_range(at, lane);
                lo != hi
            })
        };
        for &lane in active {
            let Some(at) = self.texel_cell(&store.image, &store.coordinate, store.layer, lane) else {
                if uncertain(self, lane) {
                    let effects = crate::compile::code::Effects {
                        regions: [region].into(),
                        ..Default::default()
                    };
                    self.abandon(lane, &effects);
                } else {
                    self.counters.out_of_bounds += 1;
                }
                continue;
            };
            let Some(texture) = self.texture(&store.image, lane) else {
                continue;
            };
            for (k, &row) in store.values.iter().enumerate() {
                let cell = stored::<D>(texture, k, store.kind, self.get(row, lane));
                self.write(region, at + k as u32, lane, store.kind, cell, false);
            }
        }
    }

    pub(crate) fn image_query(&mut self, query: &ImageQuery, active: &[u32]) {
        for &lane in active {
            let Some(texture) = self.texture(&query.image, lane) else {
                self.set_all(
                    query.dst,
                    query.parts,
                    lane,
                    D::indeterminate(Kind::Int(IntType::U32)),
                );
                continue;
            };
            let level = query.level.map_or((0, 0), |l| self.int_range(l, lane));
            let last = texture.levels() as i128 - 1;
            let (a, b) = (level.0.clamp(0, last) as usize, level.1.clamp(0, last) as usize);
            for k in 0..query.parts {
                // Deeper levels are smaller.
                let (hi, lo) = match query.query {
                    Query::Size => (texture.size(a)[k as usize], texture.size(b)[k as usize]),
                    Query::Levels => (texture.levels() as u32, texture.levels() as u32),
                    Query::Layers => (texture.layers(), texture.layers()),
                    Query::Samples => (texture.samples(), texture.samples()),
                };
                self.set(
                    query.dst + k,
                    lane,
                    D::int_range(IntType::U32, i128::from(lo), i128::from(hi)),
                );
            }
        }
    }
}

/// The change of a coordinate to the neighbour along one axis: of the own line for a perfect machine, of either line otherwise.
fn neighbour_difference<D: Domain>(values: &[Option<D::Cell>], root: usize, bit: usize) -> Option<Bounds> {
    let line = |k: usize| -> Option<Bounds> {
        let at = |i: usize| values.get(i).copied().flatten().map(D::float_bounds);
        let (a, b) = (at(k & !bit)?, at(k | bit)?);
        Some((b.0 - a.1, b.1 - a.0))
    };
    let own = line(root);
    if !D::UNCERTAIN {
        return Some(own.unwrap_or((0.0, 0.0)));
    }
    let (a, b) = (own?, line(root ^ 3 ^ bit)?);
    Some((a.0.min(b.0), a.1.max(b.1)))
}

/// A channel's bounds as a cell.
fn channel<D: Domain>(kind: Kind, (lo, hi): Bounds) -> D::Cell {
    match kind {
        Kind::Float(w) => D::real(w, lo, hi),
        Kind::Int(t) => D::int_range(
            t,
            (lo as i128).clamp(t.min(), t.max()),
            (hi as i128).clamp(t.min(), t.max()),
        ),
        Kind::Bool => D::bool(lo != 0.0),
    }
}

/// A value as a storage texture keeps it. Conversion may round to either neighbour.
fn stored<D: Domain>(texture: &Texture, k: usize, kind: Kind, cell: D::Cell) -> D::Cell {
    let format = texture.format();
    let missing = k >= format.channels();
    match kind {
        Kind::Float(w) if missing => D::float(w, if k == 3 { 1.0 } else { 0.0 }),
        Kind::Float(w) => {
            let (lo, hi) = D::float_bounds(cell);
            if lo.is_nan() {
                return cell;
            }
            let (down, up) = if D::UNCERTAIN {
                (Rounding::Down, Rounding::Up)
            } else {
                (Rounding::Nearest, Rounding::Nearest)
            };
            D::real(w, format.quantize(k, lo, down), format.quantize(k, hi, up))
        }
        Kind::Int(t) if missing => D::int(t, i128::from(k == 3)),
        Kind::Int(t) => {
            let (lo, hi) = D::int_bounds(t, cell);
            let q = |x: i128| {
                if format.bytes() / format.channels() >= 4 {
                    x
                } else {
                    format.quantize(k, x as f64, Rounding::Nearest) as i128
                }
            };
            D::int_range(t, q(lo).clamp(t.min(), t.max()), q(hi).clamp(t.min(), t.max()))
        }
        Kind::Bool => cell,
    }
}

/// The error for a texture whose shape is not the variable's.
pub(crate) fn mismatch(name: &str, reason: String) -> Error {
    Error::Texture {
        reason: format!("`{name}`: {reason}"),
    }
}
