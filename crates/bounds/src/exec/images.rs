//! Texture instructions: sampling, gathering, loading, storing, queries.

use super::machine::Machine;
use crate::compile::code::{HandleRef, ImageLoad, ImageQuery, ImageStore, Level, Query, Row, Sample};
use crate::compile::program::ResourceKind;
use crate::domain::{Domain, Truth};
use crate::error::{Error, Result};
use crate::interval::integers;
use crate::kind::{IntType, Kind};
use crate::texture::cube::{self, OnFace};
use crate::texture::filter::{self, Axis, TooWide, filtered};
use crate::texture::lod::{self, Tap};
use crate::texture::{Bounds, CompareFunction, Dimension, Filter, Sampler, Texture};
use crate::width::Width;
use std::ops::RangeInclusive;

type Channels = [Bounds; 4];

/// What one lane asks of a texture.
struct Request<'a> {
    texture: &'a Texture,
    sampler: &'a Sampler,
    /// Normalised coordinates; a direction for cubes.
    at: [Bounds; 3],
    offset: [i64; 3],
    layers: RangeInclusive<u32>,
    /// Bounds of the depth reference.
    reference: Option<Bounds>,
    limit: u32,
}

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
            clamp_to_edge(&mut request);
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

    /// Bounds of the level of detail; `None` when nothing is known.
    fn level_bounds(
        &self,
        sample: &Sample,
        request: &Request<'_>,
        lane: u32,
        neighbours: &[Vec<Option<D::Cell>>],
    ) -> Option<Bounds> {
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
            let slack = if D::UNCERTAIN && format.is_normalised() {
                f64::from(f32::EPSILON)
            } else {
                0.0
            };
            D::real(w, format.quantize(k, lo - slack), format.quantize(k, hi + slack))
        }
        Kind::Int(t) if missing => D::int(t, i128::from(k == 3)),
        Kind::Int(t) => {
            let (lo, hi) = D::int_bounds(t, cell);
            let q = |x: i128| {
                if format.bytes() / format.channels() >= 4 {
                    x
                } else {
                    format.quantize(k, x as f64) as i128
                }
            };
            D::int_range(t, q(lo).clamp(t.min(), t.max()), q(hi).clamp(t.min(), t.max()))
        }
        Kind::Bool => cell,
    }
}

fn load_texels(
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

/// `textureSampleBaseClampToEdge`: coordinates stay half a texel inside.
fn clamp_to_edge(request: &mut Request<'_>) {
    let size = request.texture.size(0);
    for (u, n) in request.at.iter_mut().zip(size) {
        let half = 0.5 / f64::from(n);
        *u = (u.0.clamp(half, 1.0 - half), u.1.clamp(half, 1.0 - half));
    }
}

impl Request<'_> {
    /// The level of detail for a change of the coordinate along x and along y.
    fn level(&self, dx: [Bounds; 3], dy: [Bounds; 3], uncertain: bool) -> Bounds {
        if self.texture.dimension() == Dimension::Cube {
            return self.cube_level(dx, dy, uncertain);
        }
        let n = self.axes();
        let size = self.texture.size(0);
        let scaled = |d: [Bounds; 3]| -> Vec<Bounds> {
            (0..n)
                .map(|k| (d[k].0 * f64::from(size[k]), d[k].1 * f64::from(size[k])))
                .collect()
        };
        lod::from_gradients(&scaled(dx), &scaled(dy), uncertain)
    }

    /// On a cube the direction's change, seen from the centre, over the length of its major component, in texels of a face.
    fn cube_level(&self, dx: [Bounds; 3], dy: [Bounds; 3], uncertain: bool) -> Bounds {
        let half = f64::from(self.texture.size(0)[0]) / 2.0;
        let magnitude = |b: Bounds| {
            (
                if b.0 <= 0.0 && b.1 >= 0.0 {
                    0.0
                } else {
                    b.0.abs().min(b.1.abs())
                },
                b.0.abs().max(b.1.abs()),
            )
        };
        let at = self.at.map(magnitude);
        let major = (
            at[0].0.max(at[1].0).max(at[2].0),
            at[0].1.max(at[1].1).max(at[2].1),
        );
        let scaled = |d: [Bounds; 3]| -> Vec<Bounds> {
            d.map(|b| {
                let ends = [
                    b.0 * half / major.0,
                    b.0 * half / major.1,
                    b.1 * half / major.0,
                    b.1 * half / major.1,
                ];
                (
                    ends.into_iter().fold(f64::INFINITY, f64::min),
                    ends.into_iter().fold(f64::NEG_INFINITY, f64::max),
                )
            })
            .to_vec()
        };
        let (lo, hi) = lod::from_gradients(&scaled(dx), &scaled(dy), uncertain);
        // The projection onto the face can lengthen or shorten a change by up to a factor of two.
        if uncertain { (lo - 1.0, hi + 1.0) } else { (lo, hi) }
    }

    fn axes(&self) -> usize {
        match self.texture.dimension() {
            Dimension::D1 => 1,
            Dimension::D2 => 2,
            Dimension::D3 | Dimension::Cube => 3,
        }
    }

    /// The hull over everything a level of detail may select.
    fn sample(&self, level: Bounds, uncertain: bool) -> Channels {
        if level.1 <= 0.0 && f64::from(self.sampler.lod.0) <= 0.0 && self.layers.start() == self.layers.end()
        {
            return self.one_level(0, *self.layers.start(), self.sampler.mag, uncertain);
        }
        let taps = lod::taps(self.sampler, self.texture.levels(), level);
        let mut total: Option<Channels> = None;
        for tap in taps {
            for layer in self.layers.clone() {
                let value = self.tap(tap, layer, uncertain);
                total = Some(total.map_or(value, |t| filter::hull(t, value)));
            }
        }
        total.unwrap_or([(0.0, 0.0); 4])
    }

    fn tap(&self, tap: Tap, layer: u32, uncertain: bool) -> Channels {
        let lower = self.one_level(tap.level, layer, tap.filter, uncertain);
        if tap.weight == 0.0 || tap.level + 1 >= self.texture.levels() {
            return lower;
        }
        let upper = self.one_level(tap.level + 1, layer, tap.filter, uncertain);
        std::array::from_fn(|c| filter::lerp(lower[c], upper[c], (tap.weight, tap.weight)))
    }

    fn one_level(&self, level: usize, layer: u32, filter: Filter, uncertain: bool) -> Channels {
        let result = if self.texture.dimension() == Dimension::Cube {
            self.cube_level_value(level, layer, filter, uncertain)
        } else {
            self.axes_at(level, filter, uncertain)
                .map(|axes| filtered(&axes, uncertain, &mut |at| self.fetch(level, layer, at)))
        };
        result.unwrap_or_else(|_| self.anything(level))
    }

    fn axes_at(&self, level: usize, filter: Filter, uncertain: bool) -> Result<[Axis; 3], TooWide> {
        let size = self.texture.size(level);
        let axis = |k: usize| {
            if k < self.axes() {
                Axis::new(self.at[k], size[k], self.offset[k], filter, uncertain, self.limit)
            } else {
                Ok(Axis::flat())
            }
        };
        let axes = [axis(0)?, axis(1)?, axis(2)?];
        let cells: usize = axes.iter().map(Axis::len).product();
        if cells > self.limit as usize {
            Err(TooWide)
        } else {
            Ok(axes)
        }
    }

    fn cube_level_value(
        &self,
        level: usize,
        layer: u32,
        filter: Filter,
        uncertain: bool,
    ) -> Result<Channels, TooWide> {
        let mut total: Option<Channels> = None;
        for (face, coordinates) in cube::faces(self.at, uncertain) {
            let value = self.on_face(level, layer, (face, coordinates), filter, uncertain)?;
            total = Some(total.map_or(value, |t| filter::hull(t, value)));
        }
        total.ok_or(TooWide)
    }

    fn on_face(
        &self,
        level: usize,
        layer: u32,
        (face, at): OnFace,
        filter: Filter,
        uncertain: bool,
    ) -> Result<Channels, TooWide> {
        let n = self.texture.size(level)[0];
        let axis = |k: usize| Axis::new(at[k], n, 0, filter, uncertain, self.limit);
        let axes = [axis(0)?, axis(1)?, Axis::flat()];
        Ok(filtered(&axes, uncertain, &mut |[i, j, _]| {
            self.cube_texel(level, layer, (face, i, j), n, uncertain)
        }))
    }

    fn cube_texel(
        &self,
        level: usize,
        layer: u32,
        (face, i, j): (u32, i64, i64),
        n: u32,
        uncertain: bool,
    ) -> Channels {
        let list = cube::across(face, i, j, n);
        let texels = list
            .iter()
            .map(|&(f, x, y)| self.compared(self.texture.texel(level, [x, y, 0], 6 * layer + f)));
        if uncertain {
            return texels.reduce(filter::hull).unwrap_or([(0.0, 0.0); 4]);
        }
        let count = list.len() as f64;
        texels.fold([(0.0, 0.0); 4], |sum, t| {
            std::array::from_fn(|c| (sum[c].0 + t[c].0 / count, sum[c].1 + t[c].1 / count))
        })
    }

    /// A texel by unwrapped index, after the depth comparison.
    fn fetch(&self, level: usize, layer: u32, at: [i64; 3]) -> Channels {
        let size = self.texture.size(level);
        let mut index = [0; 3];
        for k in 0..3 {
            match filter::address(self.sampler.address[k], at[k], size[k]) {
                Some(i) => index[k] = i,
                None => return self.compared(self.sampler.border.map(f64::from)),
            }
        }
        self.compared(self.texture.texel(level, index, layer))
    }

    /// A texel, or 0 or 1 by the sampler's comparison with the reference.
    fn compared(&self, texel: [f64; 4]) -> Channels {
        let (Some(mut reference), Some(function)) = (self.reference, self.sampler.compare) else {
            return texel.map(|x| (x, x));
        };
        if self.texture.format().clamps_reference() {
            reference = (reference.0.clamp(0.0, 1.0), reference.1.clamp(0.0, 1.0));
        }
        let one = match compare(function, reference, texel[0]) {
            Truth::True => (1.0, 1.0),
            Truth::False => (0.0, 0.0),
            Truth::Maybe => (0.0, 1.0),
        };
        [one; 4]
    }

    /// A component of the four texels that bilinear filtering would blend, in WGSL's order.
    fn gather(&self, component: usize, uncertain: bool) -> Channels {
        let mut out: Option<Channels> = None;
        for layer in self.layers.clone() {
            match self.gather_layer(component, layer, uncertain) {
                Ok(value) => out = Some(out.map_or(value, |t| filter::hull(t, value))),
                Err(TooWide) => return [self.anything(0)[component]; 4],
            }
        }
        out.unwrap_or([(0.0, 0.0); 4])
    }

    fn gather_layer(&self, component: usize, layer: u32, uncertain: bool) -> Result<Channels, TooWide> {
        if self.texture.dimension() == Dimension::Cube {
            let n = self.texture.size(0)[0];
            let mut total: Option<Channels> = None;
            for (face, at) in cube::faces(self.at, uncertain) {
                let axis = |k: usize| Axis::new(at[k], n, 0, Filter::Linear, uncertain, self.limit);
                let fetch = |i, j| self.cube_texel(0, layer, (face, i, j), n, uncertain)[component];
                let value = four(&axis(0)?, &axis(1)?, &fetch);
                total = Some(total.map_or(value, |t| filter::hull(t, value)));
            }
            return total.ok_or(TooWide);
        }
        let axes = self.axes_at(0, Filter::Linear, uncertain)?;
        Ok(four(&axes[0], &axes[1], &|i, j| {
            self.fetch(0, layer, [i, j, 0])[component]
        }))
    }

    /// Every value of a level, or of a comparison.
    fn anything(&self, level: usize) -> Channels {
        if self.reference.is_some() {
            [(0.0, 1.0); 4]
        } else {
            self.texture.level_bounds(level)
        }
    }
}

/// The four texels of every cell, in the order (min, max), (max, max), (max, min), (min, min).
fn four(x: &Axis, y: &Axis, fetch: &impl Fn(i64, i64) -> Bounds) -> Channels {
    let mut total: Option<Channels> = None;
    for (i, _) in x.cells() {
        for (j, _) in y.cells() {
            let cell = [fetch(i, j + 1), fetch(i + 1, j + 1), fetch(i + 1, j), fetch(i, j)];
            total = Some(total.map_or(cell, |t| filter::hull(t, cell)));
        }
    }
    total.unwrap_or([(0.0, 0.0); 4])
}

fn compare(function: CompareFunction, reference: Bounds, texel: f64) -> Truth {
    use crate::domain::ops::Compare;
    let op = match function {
        CompareFunction::Never => return Truth::False,
        CompareFunction::Always => return Truth::True,
        CompareFunction::Less => Compare::Less,
        CompareFunction::Equal => Compare::Equal,
        CompareFunction::LessEqual => Compare::LessEqual,
        CompareFunction::Greater => Compare::Greater,
        CompareFunction::NotEqual => Compare::NotEqual,
        CompareFunction::GreaterEqual => Compare::GreaterEqual,
    };
    integers::compare(op, reference, (texel, texel))
}

/// The error for a texture whose shape is not the variable's.
pub(crate) fn mismatch(name: &str, reason: String) -> Error {
    Error::Texture {
        reason: format!("`{name}`: {reason}"),
    }
}
