//! Statements: one function an arm.

use super::builder::{Builder, Frame, Val};
use super::code::{Case, Effects, ImageStore, Loop, Node, Op, Row};
use super::layout::unsupported;
use crate::error::Result;
use crate::kind::IntType;
use naga::{Block, Expression, Function, Handle, Span, Statement, SwitchCase, SwitchValue};

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
