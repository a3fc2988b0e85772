//! Memory that invocations share: buffers, storage textures, workgroup variables.
//!
//! A batch reads the state from before it started and keeps its own writes in pages; pages are merged back in the order of the
//! batches. Invocations of different batches that race with each other thus see one fixed, lawful schedule, and results do not
//! depend on the number of threads.

use crate::compile::code::RegionId;
use crate::domain::Domain;
use std::collections::HashMap;

/// Cells of one page; as many as its mask has bits.
const PAGE: usize = 64;

/// Cells that a batch has written.
pub(crate) struct Page<D: Domain> {
    cells: [D::Cell; PAGE],
    written: u64,
}

/// The shared memory of a whole run.
pub(crate) struct Memory<D: Domain> {
    /// Cells by region; empty for resources that are no memory.
    pub(crate) regions: Vec<Vec<D::Cell>>,
    /// Numbers of cells that every batch gets anew, by region.
    pub(crate) workgroup: Vec<Option<Vec<D::Cell>>>,
}

/// What a batch has written, by region and page.
pub(crate) type Pages<D> = HashMap<(RegionId, u32), Box<Page<D>>>;

/// The memory as one batch sees it.
pub(crate) struct View<'a, D: Domain> {
    base: &'a Memory<D>,
    own: Vec<Option<Vec<D::Cell>>>,
    pages: Pages<D>,
}

impl<'a, D: Domain> View<'a, D> {
    pub(crate) fn new(base: &'a Memory<D>) -> Self {
        Self {
            base,
            own: base.workgroup.clone(),
            pages: HashMap::new(),
        }
    }

    pub(crate) fn len(&self, region: RegionId) -> usize {
        match &self.own[region as usize] {
            Some(cells) => cells.len(),
            None => self.base.regions[region as usize].len(),
        }
    }

    /// Reads a cell, which must exist.
    #[inline(always)]
    pub(crate) fn read(&self, region: RegionId, at: u32) -> D::Cell {
        if let Some(cells) = &self.own[region as usize] {
            return cells[at as usize];
        }
        if !self.pages.is_empty()
            && let Some(page) = self.pages.get(&(region, at / PAGE as u32))
        {
            return page.cells[at as usize % PAGE];
        }
        self.base.regions[region as usize][at as usize]
    }

    /// Writes a cell, which must exist.
    pub(crate) fn write(&mut self, region: RegionId, at: u32, cell: D::Cell) {
        if let Some(cells) = &mut self.own[region as usize] {
            cells[at as usize] = cell;
            return;
        }
        let base = &self.base.regions[region as usize];
        let page = self.pages.entry((region, at / PAGE as u32)).or_insert_with(|| {
            let start = at as usize / PAGE * PAGE;
            let mut cells = [D::Cell::default(); PAGE];
            let n = PAGE.min(base.len() - start);
            cells[..n].copy_from_slice(&base[start..start + n]);
            Box::new(Page { cells, written: 0 })
        });
        page.cells[at as usize % PAGE] = cell;
        page.written |= 1 << (at as usize % PAGE);
    }

    /// Everything the batch has written.
    pub(crate) fn into_pages(self) -> Pages<D> {
        self.pages
    }
}

impl<D: Domain> Memory<D> {
    /// Applies the writes of one batch.
    pub(crate) fn commit(&mut self, pages: Pages<D>) {
        for ((region, number), page) in pages {
            let cells = &mut self.regions[region as usize];
            let start = number as usize * PAGE;
            for k in (0..PAGE).filter(|k| page.written >> k & 1 == 1) {
                cells[start + k] = page.cells[k];
            }
        }
    }
}
