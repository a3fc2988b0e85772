//! Allocation of rows, emission of instructions, and the table of function instances.

use super::chains::Chains;
use super::code::{
    Block, Code, Constant, Effects, FunctionCode, HandleRef, Instr, Node, Op, Place, Root, Row,
};
use super::facts;
use super::layout::{Types, unsupported};
use super::units::Units;
use crate::error::{Error, Result};
use crate::kind::Kind;
use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{Expression, Function, Handle, Module, Span, TypeInner};
use std::collections::{BTreeMap, HashMap};

/// More instructions than this are refused: the module's calls multiply beyond reason.
const MAX_INSTRUCTIONS: usize = 1 << 22;

/// A compiled expression.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Val {
    /// The scalars of a value, in order.
    Rows(Vec<Row>),
    /// A pointer.
    Place(Place),
    /// A texture or sampler.
    Handle(HandleRef),
}

/// What a global variable became.
#[derive(Clone, Debug)]
pub(crate) enum Global {
    Place(Root),
    Handle(u32),
}

/// Compiles one module for one entry point.
pub(crate) struct Builder<'m> {
    pub(crate) module: &'m Module,
    pub(crate) info: &'m ModuleInfo,
    pub(crate) types: Types<'m>,
    pub(crate) code: Code,
    pub(crate) globals: BTreeMap<Handle<naga::GlobalVariable>, Global>,
    constants: HashMap<Constant, Row>,
    instances: HashMap<(Handle<Function>, Vec<Option<Val>>), usize>,
    spans: HashMap<(usize, usize), u32>,
    pub(crate) chains: Chains,
    pub(crate) units: Units,
    instructions: usize,
    depth: u32,
    /// The constant expressions met on the way, for the module's own arena.
    pub(crate) global_values: HashMap<Handle<Expression>, Val>,
}

/// One function being compiled.
pub(crate) struct Frame<'m> {
    pub(crate) function: &'m Function,
    pub(crate) info: &'m FunctionInfo,
    pub(crate) arguments: Vec<Val>,
    pub(crate) values: HashMap<Handle<Expression>, Val>,
    pub(crate) locals: Vec<(Row, u32)>,
    pub(crate) result: Vec<Row>,
    pub(crate) pending: Vec<Instr>,
    pub(crate) block: Block,
    pub(crate) variables: Vec<(Row, u32)>,
    pub(crate) owned: Vec<(Row, u32)>,
    /// Effects of the loops that enclose the current statement, innermost last; the first entry is the whole function's.
    pub(crate) effects: Vec<Effects>,
    /// Which value row holds what a variable row holds, in the current straight line of code.
    pub(crate) known: HashMap<Row, Row>,
    /// Values of that many scalars loaded through other places in the current straight line of code.
    pub(crate) loaded: HashMap<(Place, usize), Vec<Row>>,
    pub(crate) span: u32,
}

impl<'m> Builder<'m> {
    pub(crate) fn new(module: &'m Module, info: &'m ModuleInfo) -> Self {
        Self {
            module,
            info,
            types: Types { module },
            code: Code::default(),
            globals: BTreeMap::new(),
            constants: HashMap::new(),
            instances: HashMap::new(),
            spans: HashMap::new(),
            chains: Chains::default(),
            units: Units::default(),
            instructions: 0,
            depth: 0,
            global_values: HashMap::new(),
        }
    }

    /// A row outside of any function.
    pub(crate) fn fresh(&mut self, kind: Kind) -> Row {
        self.code.kinds.push(kind);
        (self.code.kinds.len() - 1) as Row
    }

    /// The row that holds a constant.
    pub(crate) fn constant(&mut self, constant: Constant) -> Row {
        if let Some(&row) = self.constants.get(&constant) {
            return row;
        }
        let row = self.fresh(constant.kind);
        self.constants.insert(constant, row);
        self.code.constants.push((row, constant));
        row
    }

    pub(crate) fn float(&mut self, w: crate::width::Width, x: f64) -> Row {
        self.constant(Constant {
            kind: Kind::Float(w),
            bits: w.round(x).to_bits(),
        })
    }

    pub(crate) fn int(&mut self, t: crate::kind::IntType, x: i128) -> Row {
        self.constant(Constant {
            kind: Kind::Int(t),
            bits: x as u64,
        })
    }

    pub(crate) fn bool(&mut self, b: bool) -> Row {
        self.constant(Constant {
            kind: Kind::Bool,
            bits: u64::from(b),
        })
    }

    pub(crate) fn zero(&mut self, kind: Kind) -> Row {
        self.constant(Constant { kind, bits: 0 })
    }

    pub(crate) fn span(&mut self, span: Span) -> u32 {
        let next = self.code.spans.len() as u32;
        let range = span.to_range().unwrap_or(0..0);
        let id = *self.spans.entry((range.start, range.end)).or_insert(next);
        if id == next {
            self.code.spans.push(span);
        }
        id
    }

    /// The instance of a function for the given pointer and texture arguments, compiled on first use.
    pub(crate) fn instance(
        &mut self,
        function: Handle<Function>,
        fixed: Vec<Option<Val>>,
        span: Span,
    ) -> Result<usize> {
        let key = (function, fixed);
        if let Some(&index) = self.instances.get(&key) {
            return Ok(index);
        }
        self.depth += 1;
        if self.depth > 128 {
            return Err(Error::Depth { limit: 128, span });
        }
        let index = self.function(&self.module.functions[function], &self.info[function], &key.1)?;
        self.depth -= 1;
        self.instances.insert(key, index);
        Ok(index)
    }

    /// Compiles a function; arguments without a fixed value get rows.
    pub(crate) fn function(
        &mut self,
        function: &'m Function,
        info: &'m FunctionInfo,
        fixed: &[Option<Val>],
    ) -> Result<usize> {
        let mut frame = Frame::new(function, info);
        self.parameters(&mut frame, fixed)?;
        self.locals(&mut frame)?;
        self.statements(&mut frame, &function.body)?;
        self.code.functions.push(frame.finish());
        Ok(self.code.functions.len() - 1)
    }

    fn parameters(&mut self, frame: &mut Frame<'m>, fixed: &[Option<Val>]) -> Result<()> {
        for (argument, fixed) in frame.function.arguments.iter().zip(fixed) {
            let value = match fixed {
                Some(value) => value.clone(),
                None => Val::Rows(self.variable(frame, self.types.inner(argument.ty))?),
            };
            frame.arguments.push(value);
        }
        if let Some(result) = &frame.function.result {
            frame.result = self.variable(frame, self.types.inner(result.ty))?;
        }
        Ok(())
    }

    /// Rows for a variable of the frame.
    pub(crate) fn variable(&mut self, frame: &mut Frame<'m>, inner: &TypeInner) -> Result<Vec<Row>> {
        let rows = self.rows(frame, &self.types.kinds_of(inner)?);
        if let Some(&base) = rows.first() {
            frame.variables.push((base, rows.len() as u32));
        }
        Ok(rows)
    }

    /// Consecutive rows owned by the frame.
    pub(crate) fn rows(&mut self, frame: &mut Frame<'m>, kinds: &[Kind]) -> Vec<Row> {
        let base = self.code.kinds.len() as Row;
        self.code.kinds.extend_from_slice(kinds);
        let len = kinds.len() as u32;
        match frame.owned.last_mut() {
            Some((start, n)) if *start + *n == base => *n += len,
            Some(_) | None => frame.owned.push((base, len)),
        }
        (base..base + len).collect()
    }

    fn locals(&mut self, frame: &mut Frame<'m>) -> Result<()> {
        for (_, local) in frame.function.local_variables.iter() {
            let inner = self.types.inner(local.ty);
            let rows = self.variable(frame, inner)?;
            frame
                .locals
                .push((rows.first().copied().unwrap_or(0), rows.len() as u32));
        }
        for (handle, local) in frame.function.local_variables.iter() {
            let (base, len) = frame.locals[handle.index()];
            let values = match local.init {
                Some(init) => self.value(frame, init)?.rows(Span::UNDEFINED)?,
                None => (base..base + len)
                    .map(|row| self.zero(self.code.kinds[row as usize]))
                    .collect(),
            };
            for (dst, src) in (base..base + len).zip(values) {
                self.push(frame, Op::Copy { dst, src })?;
                frame.known.insert(dst, src);
            }
        }
        Ok(())
    }

    /// Emits an instruction that computes one scalar into a new row.
    pub(crate) fn emit(
        &mut self,
        frame: &mut Frame<'m>,
        kind: Kind,
        op: impl FnOnce(Row) -> Op,
    ) -> Result<Row> {
        let dst = self.rows(frame, &[kind])[0];
        self.push(frame, op(dst))?;
        Ok(dst)
    }

    /// Emits an instruction.
    pub(crate) fn push(&mut self, frame: &mut Frame<'m>, op: Op) -> Result<()> {
        self.instructions += 1;
        if self.instructions > MAX_INSTRUCTIONS {
            return unsupported(
                format!("a program of more than {MAX_INSTRUCTIONS} scalar instructions"),
                Span::UNDEFINED,
            );
        }
        facts::note(&mut self.code.facts, &op);
        self.units.note(&op);
        frame.pending.push(Instr { op, span: frame.span });
        Ok(())
    }
}

impl<'m> Frame<'m> {
    fn new(function: &'m Function, info: &'m FunctionInfo) -> Self {
        Self {
            function,
            info,
            arguments: Vec::new(),
            values: HashMap::new(),
            locals: Vec::new(),
            result: Vec::new(),
            pending: Vec::new(),
            block: Vec::new(),
            variables: Vec::new(),
            owned: Vec::new(),
            effects: vec![Effects::default()],
            known: HashMap::new(),
            loaded: HashMap::new(),
            span: 0,
        }
    }

    fn finish(mut self) -> FunctionCode {
        self.flush();
        FunctionCode {
            body: self.block,
            variables: self.variables,
            owned: self.owned,
            result: self.result,
            effects: self.effects.swap_remove(0),
        }
    }

    /// Closes the current run of instructions.
    pub(crate) fn flush(&mut self) {
        if !self.pending.is_empty() {
            let run = std::mem::take(&mut self.pending).into_boxed_slice();
            self.block.push(Node::Run(run));
        }
    }

    /// Appends a node of control flow; what variables hold is no longer known after it.
    pub(crate) fn node(&mut self, node: Node) {
        self.flush();
        self.block.push(node);
        self.forget();
    }

    /// Forgets what variables and memory hold: other code comes between.
    pub(crate) fn forget(&mut self) {
        self.known.clear();
        self.loaded.clear();
    }

    /// Records an effect in the function and in every loop around the statement.
    pub(crate) fn effect(&mut self, record: impl Fn(&mut Effects)) {
        self.effects.iter_mut().for_each(record);
    }
}

impl Val {
    /// The scalars of a value.
    pub(crate) fn rows(self, span: Span) -> Result<Vec<Row>> {
        match self {
            Self::Rows(rows) => Ok(rows),
            Self::Place(_) => unsupported("a pointer used as a value", span),
            Self::Handle(_) => unsupported("a texture or sampler used as a value", span),
        }
    }

    /// The place of a pointer.
    pub(crate) fn place(self, span: Span) -> Result<Place> {
        match self {
            Self::Place(place) => Ok(place),
            Self::Rows(_) => unsupported("a value used as a pointer", span),
            Self::Handle(_) => unsupported("a texture or sampler used as a pointer", span),
        }
    }

    /// The texture or sampler.
    pub(crate) fn handle(self, span: Span) -> Result<HandleRef> {
        match self {
            Self::Handle(handle) => Ok(handle),
            Self::Rows(_) | Self::Place(_) => {
                unsupported("something else used as a texture or sampler", span)
            }
        }
    }
}
