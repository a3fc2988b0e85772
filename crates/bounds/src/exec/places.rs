//! Pointers at run time: loads, stores, run-time indices, the length of arrays.
//!
//! Out of bounds, WGSL lets a read give any value of the same resource and a write go anywhere in it or be dropped. Here a read
//! is clamped to the last element in point domains and adds *indeterminate* in interval domains; a write is dropped; both are
//! counted.

use super::machine::Machine;
use crate::compile::code::{Count, Dim, Load, Pick, Place, RegionId, Root, Row, Store};
use crate::compile::layout::BufferLayout;
use crate::compile::program::ResourceKind;
use crate::domain::Domain;
use crate::kind::{IntType, Kind};
use crate::width::Width;

/// Where a place points for one lane.
pub(crate) enum Target {
    /// One offset, in bounds.
    One(u32),
    /// Several possible offsets, and whether some indices are out of bounds.
    Several { offsets: Vec<u32>, outside: bool },
    /// More possible offsets than the limit.
    Unknown,
    /// No offset in bounds; the clamped one, if the array has elements at all.
    Outside(Option<u32>),
}

/// The kinds of a region's cells.
pub(crate) enum RegionKinds<'a> {
    Buffer(&'a BufferLayout),
    Workgroup(&'a [Kind]),
    Texels(Kind),
}

impl RegionKinds<'_> {
    pub(crate) fn kind(&self, at: u32) -> Kind {
        let found = match self {
            Self::Buffer(layout) => layout.scalar(at as usize).map(|(_, kind)| kind),
            Self::Workgroup(kinds) => kinds.get(at as usize).copied(),
            Self::Texels(kind) => Some(*kind),
        };
        found.unwrap_or(Kind::Float(Width::F32))
    }
}

impl<'a, D: Domain> Machine<'a, D> {
    pub(crate) fn region_kinds(&self, region: RegionId) -> RegionKinds<'a> {
        let program = self.context.program;
        match &program.resources[region as usize].kind {
            ResourceKind::Buffer { layout, .. } => RegionKinds::Buffer(layout),
            ResourceKind::Workgroup { kinds } => RegionKinds::Workgroup(kinds),
            ResourceKind::StorageTexture { format, .. } => {
                RegionKinds::Texels(crate::texture::storage_kind(*format))
            }
            ResourceKind::Texture { .. } | ResourceKind::Sampler { .. } => {
                RegionKinds::Texels(Kind::Float(Width::F32))
            }
        }
    }

    /// Elements that an index of a place may select.
    fn extent(&self, place: &Place, dim: &Dim) -> u32 {
        match (dim.count, place.root) {
            (Count::Fixed(n), _) => n,
            (Count::Runtime { start }, Root::Memory(region)) => {
                (self.view.len(region) as u32).saturating_sub(start) / dim.stride.max(1)
            }
            (Count::Runtime { .. }, Root::Rows { .. }) => 0,
        }
    }

    pub(crate) fn target(&self, place: &Place, lane: u32) -> Target {
        let mut offset = place.offset;
        let mut inside = true;
        for dim in &place.dims {
            let (lo, hi) = D::int_bounds(dim.int, self.get(dim.index, lane));
            if lo != hi {
                return self.spread(place, lane);
            }
            let count = self.extent(place, dim);
            let index = lo.clamp(0, i128::from(count) - 1);
            if count == 0 {
                return Target::Outside(None);
            }
            inside &= index == lo;
            offset += index as u32 * dim.stride;
        }
        if inside {
            Target::One(offset)
        } else {
            Target::Outside(Some(offset))
        }
    }

    /// All offsets of a place with uncertain indices.
    fn spread(&self, place: &Place, lane: u32) -> Target {
        let mut offsets = vec![place.offset];
        let mut outside = false;
        for dim in &place.dims {
            let (lo, hi) = D::int_bounds(dim.int, self.get(dim.index, lane));
            let last = i128::from(self.extent(place, dim)) - 1;
            outside |= lo < 0 || hi > last;
            let (lo, hi) = (lo.max(0), hi.min(last));
            if lo > hi {
                return Target::Outside((last >= 0).then_some(place.offset));
            }
            if (hi - lo + 1) * offsets.len() as i128 > i128::from(self.context.limits.spread) {
                return Target::Unknown;
            }
            offsets = (lo..=hi)
                .flat_map(|i| offsets.iter().map(move |o| o + i as u32 * dim.stride))
                .collect();
        }
        Target::Several { offsets, outside }
    }

    /// The cell at an offset from a root, as a lane sees it.
    #[inline(always)]
    pub(crate) fn peek(&self, root: Root, at: u32, lane: u32, kind: Kind) -> D::Cell {
        match root {
            Root::Rows { base, .. } => self.get(base + at, lane),
            Root::Memory(region) => self.read(region, at, lane, kind),
        }
    }

    fn poke(&mut self, root: Root, at: u32, lane: u32, kind: Kind, cell: D::Cell, weak: bool) {
        match root {
            Root::Rows { base, .. } => {
                let cell = if weak {
                    D::hull(kind, self.get(base + at, lane), cell)
                } else {
                    cell
                };
                self.set(base + at, lane, cell);
            }
            Root::Memory(region) => self.write(region, at, lane, kind, cell, weak),
        }
    }

    /// Whether the region can hold that many cells from an offset on.
    fn fits(&self, root: Root, at: u32, len: usize) -> bool {
        match root {
            Root::Rows { .. } => true,
            Root::Memory(region) => at as usize + len <= self.view.len(region),
        }
    }

    pub(crate) fn load(&mut self, load: &Load, active: &[u32]) {
        for &lane in active {
            let target = self.target(&load.place, lane);
            for (k, &kind) in (0u32..).zip(&load.kinds) {
                let cell = self.load_cell(&load.place, &target, k, lane, kind);
                self.set(load.dst + k, lane, cell);
            }
            self.note_outside(&target);
        }
    }

    fn note_outside(&mut self, target: &Target) {
        if matches!(target, Target::Outside(_) | Target::Several { outside: true, .. }) {
            self.counters.out_of_bounds += 1;
        }
    }

    #[inline(always)]
    fn load_cell(&self, place: &Place, target: &Target, k: u32, lane: u32, kind: Kind) -> D::Cell {
        match target {
            Target::One(at) if self.fits(place.root, *at + k, 1) => self.peek(place.root, at + k, lane, kind),
            Target::One(_) | Target::Outside(None) => outside_value::<D>(kind, None),
            Target::Outside(Some(at)) => {
                outside_value::<D>(kind, Some(self.peek(place.root, at + k, lane, kind)))
            }
            Target::Unknown => D::undecided(kind),
            Target::Several { offsets, outside } => {
                let mut cells = offsets.iter().map(|at| self.peek(place.root, at + k, lane, kind));
                let first = cells.next().unwrap_or_else(|| D::indeterminate(kind));
                let all = cells.fold(first, |a, b| D::hull(kind, a, b));
                if *outside {
                    D::hull(kind, all, D::indeterminate(kind))
                } else {
                    all
                }
            }
        }
    }

    pub(crate) fn store(&mut self, store: &Store, active: &[u32]) {
        for &lane in active {
            let target = self.target(&store.place, lane);
            self.note_outside(&target);
            match target {
                Target::One(at) => {
                    if self.fits(store.place.root, at, store.values.len()) {
                        self.store_at(store, at, lane, false);
                    }
                }
                Target::Several { offsets, .. } => {
                    let weak = offsets.len() > 1;
                    offsets
                        .into_iter()
                        .for_each(|at| self.store_at(store, at, lane, weak));
                }
                Target::Outside(_) => {}
                Target::Unknown => self.store_anywhere(store, lane),
            }
        }
    }

    fn store_at(&mut self, store: &Store, at: u32, lane: u32, weak: bool) {
        for (k, (&row, &kind)) in (0u32..).zip(store.values.iter().zip(&store.kinds)) {
            let cell = self.get(row, lane);
            self.poke(store.place.root, at + k, lane, kind, cell, weak);
        }
    }

    /// A store whose index may be anything: everything it could reach is unknown.
    fn store_anywhere(&mut self, store: &Store, lane: u32) {
        let mut effects = crate::compile::code::Effects::default();
        match store.place.root {
            Root::Rows { base, len } => effects.rows.insert((base, len)),
            Root::Memory(region) => effects.regions.insert(region),
        };
        self.abandon(lane, &effects);
    }

    pub(crate) fn pick(&mut self, pick: &Pick, active: &[u32]) {
        let last = pick.groups.len() as i128 - 1;
        for &lane in active {
            let (lo, hi) = D::int_bounds(pick.int, self.get(pick.index, lane));
            let outside = lo < 0 || hi > last;
            self.counters.out_of_bounds += u64::from(outside);
            for (k, &kind) in pick.kinds.iter().enumerate() {
                let (a, b) = (lo.clamp(0, last) as usize, hi.clamp(0, last) as usize);
                let first = self.get(pick.groups[a][k], lane);
                let all = pick.groups[a..=b]
                    .iter()
                    .skip(1)
                    .fold(first, |c, g| D::hull(kind, c, self.get(g[k], lane)));
                let cell = if outside {
                    outside_value::<D>(kind, Some(all))
                } else {
                    all
                };
                self.set(pick.dst + k as u32, lane, cell);
            }
        }
    }

    pub(crate) fn array_length(
        &mut self,
        dst: Row,
        region: RegionId,
        (start, stride): (u32, u32),
        active: &[u32],
    ) {
        let n = (self.view.len(region) as u32).saturating_sub(start) / stride.max(1);
        for &lane in active {
            self.set(dst, lane, D::int(IntType::U32, i128::from(n)));
        }
    }
}

/// What a read out of bounds gives.
fn outside_value<D: Domain>(kind: Kind, clamped: Option<D::Cell>) -> D::Cell {
    match clamped {
        Some(cell) if D::UNCERTAIN => D::hull(kind, cell, D::indeterminate(kind)),
        Some(cell) => cell,
        None if D::UNCERTAIN => D::indeterminate(kind),
        None => zero::<D>(kind),
    }
}

/// Zero of a kind.
pub(crate) fn zero<D: Domain>(kind: Kind) -> D::Cell {
    match kind {
        Kind::Float(w) => D::float(w, 0.0),
        Kind::Int(t) => D::int(t, 0),
        Kind::Bool => D::bool(false),
    }
}
