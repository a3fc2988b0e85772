//! Loads and stores.
//!
//! Within a straight line of code a load of a variable whose value is known costs nothing: the value's own rows are used. That
//! also lets an interval domain see that `x * x` squares one value.

use super::builder::{Builder, Frame, Val};
use super::code::{Load, Op, Place, Root, Row, Store};
use crate::error::Result;
use naga::{Expression, Handle, Span};

impl<'m> Builder<'m> {
    pub(crate) fn load(
        &mut self,
        frame: &mut Frame<'m>,
        pointer: Handle<Expression>,
        span: Span,
    ) -> Result<Val> {
        let inner = self.pointee(self.type_of(frame, pointer));
        let place = self.value(frame, pointer)?.place(span)?;
        let kinds = self.types.kinds_of(&inner)?;
        if let (Root::Rows { base, .. }, true) = (place.root, place.dims.is_empty()) {
            let first = base + place.offset;
            return self.load_rows(frame, first..first + kinds.len() as Row);
        }
        // A vector and its first component, or a struct and its first member, stand in one place: the length tells them apart.
        let key = (place.clone(), kinds.len());
        if let Some(rows) = frame.loaded.get(&key) {
            return Ok(Val::Rows(rows.clone()));
        }
        let rows = self.rows(frame, &kinds);
        let dst = rows.first().copied().unwrap_or(0);
        frame.loaded.insert(key, rows.clone());
        self.push(frame, Op::Load(Box::new(Load { dst, kinds, place })))?;
        Ok(Val::Rows(rows))
    }

    fn load_rows(&mut self, frame: &mut Frame<'m>, range: std::ops::Range<Row>) -> Result<Val> {
        let mut out = Vec::with_capacity(range.len());
        for src in range {
            let row = match frame.known.get(&src) {
                Some(&row) => row,
                None => self.emit(frame, self.code.kinds[src as usize], |dst| Op::Copy { dst, src })?,
            };
            frame.known.insert(src, row);
            out.push(row);
        }
        Ok(Val::Rows(out))
    }

    pub(crate) fn store(&mut self, frame: &mut Frame<'m>, place: Place, values: Vec<Row>) -> Result<()> {
        self.note_write(frame, &place);
        if let (Root::Rows { base, .. }, true) = (place.root, place.dims.is_empty()) {
            for (dst, &src) in (base + place.offset..).zip(&values) {
                self.push(frame, Op::Copy { dst, src })?;
                frame.known.insert(dst, src);
            }
            return Ok(());
        }
        let kinds = values.iter().map(|&row| self.code.kinds[row as usize]).collect();
        self.push(frame, Op::Store(Box::new(Store { place, kinds, values })))
    }

    /// Records what a write through a place may change.
    pub(crate) fn note_write(&mut self, frame: &mut Frame<'m>, place: &Place) {
        frame.loaded.clear();
        match place.root {
            Root::Rows { base, len } => {
                frame.known.retain(|row, _| !(base..base + len).contains(row));
                frame.effect(|e| {
                    e.rows.insert((base, len));
                });
            }
            Root::Memory(region) => frame.effect(|e| {
                e.regions.insert(region);
            }),
        }
    }
}
