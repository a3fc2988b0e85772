//! Statements by which invocations exchange values: atomics and subgroup operations.

use super::builder::{Builder, Frame, Val};
use super::code::{Atomic, AtomicOp, AtomicTarget, Combine, Op, Row, Subgroup, SubgroupOp};
use super::layout::unsupported;
use crate::domain::ops::{FloatBinary, IntBinary};
use crate::error::Result;
use crate::kind::{IntType, Kind};
use naga::{
    AtomicFunction, CollectiveOperation, Direction, Expression, GatherMode, Handle, Span, SubgroupOperation,
};

impl<'m> Builder<'m> {
    pub(crate) fn atomic(
        &mut self,
        frame: &mut Frame<'m>,
        pointer: Handle<Expression>,
        fun: &AtomicFunction,
        value: Handle<Expression>,
        result: Option<Handle<Expression>>,
        span: Span,
    ) -> Result<()> {
        let place = self.value(frame, pointer)?.place(span)?;
        self.note_write(frame, &place);
        let rows = self.atomic_op(
            frame,
            AtomicTarget::Place(place),
            fun,
            value,
            result.is_some(),
            span,
        )?;
        if let Some(result) = result {
            frame.values.insert(result, Val::Rows(rows));
        }
        Ok(())
    }

    pub(crate) fn image_atomic(
        &mut self,
        frame: &mut Frame<'m>,
        (image, coordinate, layer): (Handle<Expression>, Handle<Expression>, Option<Handle<Expression>>),
        fun: &AtomicFunction,
        value: Handle<Expression>,
        span: Span,
    ) -> Result<()> {
        let (image, coordinate, layer) = self.texel(frame, image, coordinate, layer, span)?;
        let region = image.resource;
        frame.effect(|e| {
            e.regions.insert(region);
        });
        self.atomic_op(
            frame,
            AtomicTarget::Texel {
                image,
                coordinate,
                layer,
            },
            fun,
            value,
            false,
            span,
        )?;
        Ok(())
    }

    /// Emits the operation and returns the rows of its result: the old value and, for a comparison, whether it held.
    pub(crate) fn atomic_op(
        &mut self,
        frame: &mut Frame<'m>,
        target: AtomicTarget,
        fun: &AtomicFunction,
        value: Handle<Expression>,
        wants_result: bool,
        span: Span,
    ) -> Result<Vec<Row>> {
        let kind = self.kind_of(frame, value)?;
        let value = self.scalar(frame, value)?;
        let (op, compare) = match fun {
            AtomicFunction::Exchange {
                compare: Some(compare),
            } => (AtomicOp::CompareExchange, Some(self.scalar(frame, *compare)?)),
            AtomicFunction::Exchange { compare: None } => (AtomicOp::Exchange, None),
            AtomicFunction::Add => (arithmetic(kind, AtomicOp::FloatAdd, IntBinary::Add, span)?, None),
            AtomicFunction::Subtract => (
                arithmetic(kind, AtomicOp::FloatSubtract, IntBinary::Subtract, span)?,
                None,
            ),
            AtomicFunction::Min => (arithmetic(kind, AtomicOp::FloatMin, IntBinary::Min, span)?, None),
            AtomicFunction::Max => (arithmetic(kind, AtomicOp::FloatMax, IntBinary::Max, span)?, None),
            AtomicFunction::And => (AtomicOp::Integer(IntBinary::And), None),
            AtomicFunction::ExclusiveOr => (AtomicOp::Integer(IntBinary::Xor), None),
            AtomicFunction::InclusiveOr => (AtomicOp::Integer(IntBinary::Or), None),
        };
        let mut rows = Vec::new();
        if wants_result || compare.is_some() {
            let kinds = [kind, Kind::Bool];
            rows = self.rows(frame, &kinds[..1 + usize::from(compare.is_some())]);
        }
        let (result, exchanged) = (rows.first().copied(), rows.get(1).copied());
        self.push(
            frame,
            Op::Atomic(Box::new(Atomic {
                op,
                kind,
                target,
                value,
                compare,
                result,
                exchanged,
            })),
        )?;
        Ok(rows)
    }

    pub(crate) fn ballot(
        &mut self,
        frame: &mut Frame<'m>,
        result: Handle<Expression>,
        predicate: Option<Handle<Expression>>,
    ) -> Result<()> {
        let argument = match predicate {
            Some(handle) => self.scalar(frame, handle)?,
            None => self.bool(true),
        };
        let kind = Kind::Int(IntType::U32);
        let rows = self.rows(frame, &[kind; 4]);
        self.subgroup(frame, SubgroupOp::Ballot, Kind::Bool, Some(argument), rows[0])?;
        frame.values.insert(result, Val::Rows(rows));
        Ok(())
    }

    pub(crate) fn subgroup(
        &mut self,
        frame: &mut Frame<'m>,
        op: SubgroupOp,
        kind: Kind,
        argument: Option<Row>,
        dst: Row,
    ) -> Result<()> {
        self.code.uses_subgroups = true;
        self.push(
            frame,
            Op::Subgroup(Box::new(Subgroup {
                op,
                kind,
                argument,
                dst,
            })),
        )
    }

    pub(crate) fn gather(
        &mut self,
        frame: &mut Frame<'m>,
        mode: GatherMode,
        argument: Handle<Expression>,
        result: Handle<Expression>,
    ) -> Result<()> {
        let op = match mode {
            GatherMode::BroadcastFirst => SubgroupOp::BroadcastFirst,
            GatherMode::Broadcast(index) => self.with_index(frame, index, SubgroupOp::Broadcast)?,
            GatherMode::Shuffle(index) => self.with_index(frame, index, SubgroupOp::Shuffle)?,
            GatherMode::ShuffleDown(index) => self.with_index(frame, index, SubgroupOp::ShuffleDown)?,
            GatherMode::ShuffleUp(index) => self.with_index(frame, index, SubgroupOp::ShuffleUp)?,
            GatherMode::ShuffleXor(index) => self.with_index(frame, index, SubgroupOp::ShuffleXor)?,
            GatherMode::QuadBroadcast(index) => self.with_index(frame, index, SubgroupOp::QuadBroadcast)?,
            GatherMode::QuadSwap(Direction::X) => SubgroupOp::QuadSwap(1),
            GatherMode::QuadSwap(Direction::Y) => SubgroupOp::QuadSwap(2),
            GatherMode::QuadSwap(Direction::Diagonal) => SubgroupOp::QuadSwap(3),
        };
        self.per_component(frame, op, argument, result)
    }

    pub(crate) fn with_index(
        &mut self,
        frame: &mut Frame<'m>,
        index: Handle<Expression>,
        op: fn(Row, IntType) -> SubgroupOp,
    ) -> Result<SubgroupOp> {
        let (row, int) = self.integer(frame, index)?;
        Ok(op(row, int))
    }

    pub(crate) fn per_component(
        &mut self,
        frame: &mut Frame<'m>,
        op: SubgroupOp,
        argument: Handle<Expression>,
        result: Handle<Expression>,
    ) -> Result<()> {
        let mut out = Vec::new();
        for row in self.scalars(frame, argument)? {
            let kind = self.code.kinds[row as usize];
            let dst = self.rows(frame, &[kind])[0];
            self.subgroup(frame, op, kind, Some(row), dst)?;
            out.push(dst);
        }
        frame.values.insert(result, Val::Rows(out));
        Ok(())
    }

    pub(crate) fn collective(
        &mut self,
        frame: &mut Frame<'m>,
        op: SubgroupOperation,
        collective: CollectiveOperation,
        argument: Handle<Expression>,
        result: Handle<Expression>,
        span: Span,
    ) -> Result<()> {
        let op = match (op, self.kind_of(frame, argument)?) {
            (SubgroupOperation::All, _) => SubgroupOp::All,
            (SubgroupOperation::Any, _) => SubgroupOp::Any,
            (op, Kind::Float(_)) => scan(collective, Combine::Float(float_combine(op, span)?)),
            (op, Kind::Int(_)) => scan(collective, Combine::Int(int_combine(op, span)?)),
            (_, Kind::Bool) => return unsupported("this subgroup operation on truth values", span),
        };
        self.per_component(frame, op, argument, result)
    }
}

fn arithmetic(kind: Kind, float: AtomicOp, int: IntBinary, span: Span) -> Result<AtomicOp> {
    match kind {
        Kind::Float(_) => Ok(float),
        Kind::Int(_) => Ok(AtomicOp::Integer(int)),
        Kind::Bool => unsupported("atomic truth values", span),
    }
}

fn scan(collective: CollectiveOperation, combine: Combine) -> SubgroupOp {
    match collective {
        CollectiveOperation::Reduce => SubgroupOp::Reduce(combine),
        CollectiveOperation::InclusiveScan => SubgroupOp::Inclusive(combine),
        CollectiveOperation::ExclusiveScan => SubgroupOp::Exclusive(combine),
    }
}

fn float_combine(op: SubgroupOperation, span: Span) -> Result<FloatBinary> {
    match op {
        SubgroupOperation::Add => Ok(FloatBinary::Add),
        SubgroupOperation::Mul => Ok(FloatBinary::Multiply),
        SubgroupOperation::Min => Ok(FloatBinary::Min),
        SubgroupOperation::Max => Ok(FloatBinary::Max),
        SubgroupOperation::All
        | SubgroupOperation::Any
        | SubgroupOperation::And
        | SubgroupOperation::Or
        | SubgroupOperation::Xor => unsupported("this subgroup operation on floats", span),
    }
}

fn int_combine(op: SubgroupOperation, span: Span) -> Result<IntBinary> {
    match op {
        SubgroupOperation::Add => Ok(IntBinary::Add),
        SubgroupOperation::Mul => Ok(IntBinary::Multiply),
        SubgroupOperation::Min => Ok(IntBinary::Min),
        SubgroupOperation::Max => Ok(IntBinary::Max),
        SubgroupOperation::And => Ok(IntBinary::And),
        SubgroupOperation::Or => Ok(IntBinary::Or),
        SubgroupOperation::Xor => Ok(IntBinary::Xor),
        SubgroupOperation::All | SubgroupOperation::Any => {
            unsupported("this subgroup operation on integers", span)
        }
    }
}
