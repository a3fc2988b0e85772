//! Statements: one function an arm.

use super::builder::{Builder, Frame, Val};
use super::code::{
    Atomic, AtomicOp, AtomicTarget, Case, Combine, Effects, ImageStore, Loop, Node, Op, Row, Subgroup,
    SubgroupOp,
};
use super::layout::unsupported;
use crate::domain::ops::{FloatBinary, IntBinary};
use crate::error::Result;
use crate::kind::{IntType, Kind};
use naga::{
    AtomicFunction, Block, CollectiveOperation, Direction, Expression, Function, GatherMode, Handle, Span,
    Statement, SubgroupOperation, SwitchCase, SwitchValue,
};

impl<'m> Builder<'m> {
    /// Compiles the statements of a block into the frame's current block.
    pub(crate) fn statements(&mut self, frame: &mut Frame<'m>, block: &'m Block) -> Result<()> {
        for (statement, span) in block.span_iter() {
            frame.span = self.span(*span);
            self.statement(frame, statement, *span)?;
        }
        Ok(())
    }

    /// Compiles a block on its own.
    fn nested(&mut self, frame: &mut Frame<'m>, block: &'m Block) -> Result<super::code::Block> {
        frame.flush();
        frame.forget();
        let outer = std::mem::take(&mut frame.block);
        self.statements(frame, block)?;
        frame.flush();
        frame.forget();
        Ok(std::mem::replace(&mut frame.block, outer))
    }

    fn statement(&mut self, frame: &mut Frame<'m>, statement: &'m Statement, span: Span) -> Result<()> {
        match statement {
            Statement::Emit(range) => self.emit_range(frame, range.clone()),
            Statement::Block(block) => self.statements(frame, block),
            Statement::If {
                condition,
                accept,
                reject,
            } => self.if_statement(frame, *condition, accept, reject),
            Statement::Switch { selector, cases } => self.switch(frame, *selector, cases),
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => self.loop_statement(frame, body, continuing, *break_if),
            Statement::Break => self.jump(frame, Node::Break),
            Statement::Continue => self.jump(frame, Node::Continue),
            Statement::Return { value } => self.return_statement(frame, *value),
            Statement::Kill => self.kill(frame),
            Statement::ControlBarrier(_) => self.barrier(frame),
            Statement::MemoryBarrier(_) => self.barrier(frame),
            Statement::Store { pointer, value } => self.store_statement(frame, *pointer, *value, span),
            Statement::ImageStore {
                image,
                coordinate,
                array_index,
                value,
            } => self.image_store(frame, *image, *coordinate, *array_index, *value, span),
            Statement::Atomic {
                pointer,
                fun,
                value,
                result,
            } => self.atomic(frame, *pointer, fun, *value, *result, span),
            Statement::ImageAtomic {
                image,
                coordinate,
                array_index,
                fun,
                value,
            } => self.image_atomic(frame, (*image, *coordinate, *array_index), fun, *value, span),
            Statement::WorkGroupUniformLoad { pointer, result } => {
                self.uniform_load(frame, *pointer, *result, span)
            }
            Statement::Call {
                function,
                arguments,
                result,
            } => self.call(frame, *function, arguments, *result, span),
            Statement::RayQuery { .. } => unsupported("ray queries", span),
            Statement::RayPipelineFunction(_) => unsupported("ray tracing pipelines", span),
            Statement::SubgroupBallot { result, predicate } => self.ballot(frame, *result, *predicate),
            Statement::SubgroupGather {
                mode,
                argument,
                result,
            } => self.gather(frame, *mode, *argument, *result),
            Statement::SubgroupCollectiveOperation {
                op,
                collective_op,
                argument,
                result,
            } => self.collective(frame, *op, *collective_op, *argument, *result, span),
            Statement::CooperativeStore { .. } => unsupported("cooperative matrices", span),
        }
    }

    fn emit_range(&mut self, frame: &mut Frame<'m>, range: naga::Range<Expression>) -> Result<()> {
        for handle in range {
            let value = self.expression(frame, handle)?;
            frame.values.insert(handle, value);
        }
        Ok(())
    }

    fn if_statement(
        &mut self,
        frame: &mut Frame<'m>,
        condition: Handle<Expression>,
        accept: &'m Block,
        reject: &'m Block,
    ) -> Result<()> {
        let span = frame.span;
        let cond = self.scalar(frame, condition)?;
        let accept = self.nested(frame, accept)?;
        let reject = self.nested(frame, reject)?;
        frame.node(Node::If {
            cond,
            accept,
            reject,
            span,
        });
        Ok(())
    }

    fn switch(
        &mut self,
        frame: &mut Frame<'m>,
        selector: Handle<Expression>,
        cases: &'m [SwitchCase],
    ) -> Result<()> {
        let span = frame.span;
        let (selector, int) = self.integer(frame, selector)?;
        let mut compiled = Vec::with_capacity(cases.len());
        for case in cases {
            let value = match case.value {
                SwitchValue::I32(x) => Some(i128::from(x)),
                SwitchValue::U32(x) => Some(i128::from(x)),
                SwitchValue::Default => None,
            };
            compiled.push(Case {
                value,
                body: self.nested(frame, &case.body)?,
                fall_through: case.fall_through,
            });
        }
        frame.node(Node::Switch {
            selector,
            int,
            cases: compiled,
            span,
        });
        Ok(())
    }

    fn loop_statement(
        &mut self,
        frame: &mut Frame<'m>,
        body: &'m Block,
        continuing: &'m Block,
        break_if: Option<Handle<Expression>>,
    ) -> Result<()> {
        let span = frame.span;
        frame.effects.push(Effects::default());
        let body = self.nested(frame, body)?;
        frame.flush();
        let outer = std::mem::take(&mut frame.block);
        self.statements(frame, continuing)?;
        let break_if = break_if.map(|handle| self.scalar(frame, handle)).transpose()?;
        frame.flush();
        let continuing = std::mem::replace(&mut frame.block, outer);
        let effects = frame.effects.pop().unwrap_or_default();
        frame.node(Node::Loop(Box::new(Loop {
            body,
            continuing,
            break_if,
            effects,
            span,
        })));
        Ok(())
    }

    fn jump(&mut self, frame: &mut Frame<'m>, node: Node) -> Result<()> {
        frame.node(node);
        Ok(())
    }

    fn return_statement(&mut self, frame: &mut Frame<'m>, value: Option<Handle<Expression>>) -> Result<()> {
        if let Some(value) = value {
            let values = self.scalars(frame, value)?;
            for (dst, src) in frame.result.clone().into_iter().zip(values) {
                self.push(frame, Op::Copy { dst, src })?;
            }
        }
        frame.effect(|e| e.returns = true);
        frame.node(Node::Return);
        Ok(())
    }

    fn kill(&mut self, frame: &mut Frame<'m>) -> Result<()> {
        frame.effect(|e| e.kills = true);
        frame.node(Node::Kill);
        Ok(())
    }

    fn barrier(&mut self, frame: &mut Frame<'m>) -> Result<()> {
        self.code.uses_barriers = true;
        frame.node(Node::Barrier);
        Ok(())
    }

    fn store_statement(
        &mut self,
        frame: &mut Frame<'m>,
        pointer: Handle<Expression>,
        value: Handle<Expression>,
        span: Span,
    ) -> Result<()> {
        let values = self.scalars(frame, value)?;
        let place = self.value(frame, pointer)?.place(span)?;
        self.store(frame, place, values)
    }

    fn uniform_load(
        &mut self,
        frame: &mut Frame<'m>,
        pointer: Handle<Expression>,
        result: Handle<Expression>,
        span: Span,
    ) -> Result<()> {
        self.barrier(frame)?;
        let value = self.load(frame, pointer, span)?;
        frame.values.insert(result, value);
        self.barrier(frame)
    }

    fn call(
        &mut self,
        frame: &mut Frame<'m>,
        function: Handle<Function>,
        arguments: &[Handle<Expression>],
        result: Option<Handle<Expression>>,
        span: Span,
    ) -> Result<()> {
        let mut values = Vec::with_capacity(arguments.len());
        for &argument in arguments {
            values.push(self.value(frame, argument)?);
        }
        let fixed = values
            .iter()
            .map(|v| (!matches!(v, Val::Rows(_))).then(|| v.clone()))
            .collect();
        let index = self.instance(function, fixed, span)?;
        let parameters = self.parameter_rows(index, function);
        for (rows, value) in parameters
            .into_iter()
            .zip(values.iter().filter(|v| matches!(v, Val::Rows(_))))
        {
            for (dst, src) in rows.into_iter().zip(value.clone().rows(span)?) {
                self.push(frame, Op::Copy { dst, src })?;
            }
        }
        let (effects, returned) = (
            self.code.functions[index].effects.clone(),
            self.code.functions[index].result.clone(),
        );
        frame.effect(|e| {
            let returns = e.returns;
            e.absorb(&effects);
            e.returns = returns;
        });
        let span = frame.span;
        frame.node(Node::Call {
            function: index,
            span,
        });
        if let Some(result) = result {
            let out = self.copies(frame, &returned)?;
            frame.values.insert(result, Val::Rows(out));
        }
        Ok(())
    }

    /// The rows of the parameters that are passed by value: the first variables of the instance.
    fn parameter_rows(&self, index: usize, function: Handle<Function>) -> Vec<Vec<Row>> {
        let by_value = self.module.functions[function]
            .arguments
            .iter()
            .filter(|a| self.types.scalars(self.types.inner(a.ty)).is_ok_and(|n| n > 0))
            .count();
        self.code.functions[index].variables[..by_value]
            .iter()
            .map(|&(base, len)| (base..base + len).collect())
            .collect()
    }

    fn copies(&mut self, frame: &mut Frame<'m>, rows: &[Row]) -> Result<Vec<Row>> {
        let mut out = Vec::with_capacity(rows.len());
        for &src in rows {
            out.push(self.emit(frame, self.code.kinds[src as usize], |dst| Op::Copy { dst, src })?);
        }
        Ok(out)
    }

    fn image_store(
        &mut self,
        frame: &mut Frame<'m>,
        image: Handle<Expression>,
        coordinate: Handle<Expression>,
        layer: Option<Handle<Expression>>,
        value: Handle<Expression>,
        span: Span,
    ) -> Result<()> {
        let kind = self.kind_of(frame, value)?;
        let (image, coordinate, layer) = self.texel(frame, image, coordinate, layer, span)?;
        let values = self.scalars(frame, value)?;
        let region = image.resource;
        frame.effect(|e| {
            e.regions.insert(region);
        });
        self.push(
            frame,
            Op::ImageStore(Box::new(ImageStore {
                image,
                coordinate,
                layer,
                values,
                kind,
            })),
        )
    }

    fn atomic(
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

    fn image_atomic(
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
    fn atomic_op(
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

    fn ballot(
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

    fn subgroup(
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

    fn gather(
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

    fn with_index(
        &mut self,
        frame: &mut Frame<'m>,
        index: Handle<Expression>,
        op: fn(Row, IntType) -> SubgroupOp,
    ) -> Result<SubgroupOp> {
        let (row, int) = self.integer(frame, index)?;
        Ok(op(row, int))
    }

    fn per_component(
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

    fn collective(
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

    /// The parts of a texel access.
    pub(crate) fn texel(
        &mut self,
        frame: &mut Frame<'m>,
        image: Handle<Expression>,
        coordinate: Handle<Expression>,
        layer: Option<Handle<Expression>>,
        span: Span,
    ) -> Result<Texel> {
        let handle = self.value(frame, image)?.handle(span)?;
        let t = self.int_type(frame, coordinate)?;
        let coordinate = self
            .scalars(frame, coordinate)?
            .into_iter()
            .map(|row| (row, t))
            .collect();
        let layer = layer.map(|l| self.integer(frame, l)).transpose()?;
        Ok((handle, coordinate, layer))
    }
}

/// Image, coordinate, layer.
pub(crate) type Texel = (
    super::code::HandleRef,
    Vec<(Row, IntType)>,
    Option<(Row, IntType)>,
);

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
