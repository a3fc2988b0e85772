//! The compiled program: structured blocks of scalar instructions over numbered rows.
//!
//! A *row* holds one scalar for every lane (invocation) of a batch. Every vector, matrix, array and struct is taken apart into
//! rows at compile time, so composing, swizzling and splatting cost nothing at run time. Rows are numbered once for the whole
//! program: WGSL has no recursion, so each function instance owns its rows.
//!
//! Invariant (checked by the builder): the destination of an expression instruction is a row allocated after its operands. Only
//! stores to variables go to older rows.

use super::facts::FactsByRow;
use crate::domain::ops::{BoolBinary, Compare, FloatBinary, FloatTernary, FloatUnary, IntBinary, IntUnary};
use crate::kind::{IntType, Kind};
use crate::width::Width;
use naga::{DerivativeAxis, DerivativeControl, Span};

/// One scalar for every lane.
pub(crate) type Row = u32;

/// Index of a memory region: a buffer, a storage texture or a workgroup variable.
pub(crate) type RegionId = u32;

/// Where a pointer starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Root {
    /// A variable of the invocation: its rows.
    Rows { base: Row, len: u32 },
    /// Memory that invocations share.
    Memory(RegionId),
}

/// How many elements an index may select.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Count {
    Fixed(u32),
    /// The rest of the region from this cell on.
    Runtime {
        start: u32,
    },
}

/// One run-time index on the way to a pointer's target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Dim {
    pub(crate) index: Row,
    pub(crate) int: IntType,
    pub(crate) stride: u32,
    pub(crate) count: Count,
}

/// A place: a root, a constant offset in scalars, and run-time indices.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Place {
    pub(crate) root: Root,
    pub(crate) offset: u32,
    pub(crate) dims: Vec<Dim>,
}

/// A texture or sampler variable, or an element of a binding array.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct HandleRef {
    pub(crate) resource: u32,
    pub(crate) index: Option<(Row, IntType)>,
}

/// One instruction.
#[derive(Clone, Debug)]
pub(crate) enum Op {
    Copy {
        dst: Row,
        src: Row,
    },
    FloatUnary {
        op: FloatUnary,
        w: Width,
        dst: Row,
        a: Row,
    },
    FloatBinary {
        op: FloatBinary,
        w: Width,
        dst: Row,
        a: Row,
        b: Row,
    },
    FloatTernary {
        op: FloatTernary,
        w: Width,
        dst: Row,
        a: Row,
        b: Row,
        c: Row,
    },
    Sum {
        w: Width,
        dst: Row,
        terms: [Row; 4],
        n: u8,
    },
    Chain(Box<Chain>),
    Unit(Box<Unit>),
    FloatCompare {
        op: Compare,
        w: Width,
        dst: Row,
        a: Row,
        b: Row,
    },
    FrexpExponent {
        w: Width,
        dst: Row,
        a: Row,
    },
    Ldexp {
        w: Width,
        dst: Row,
        a: Row,
        b: Row,
    },
    IsNan {
        dst: Row,
        a: Row,
    },
    IsInf {
        dst: Row,
        a: Row,
    },
    IntUnary {
        op: IntUnary,
        t: IntType,
        dst: Row,
        a: Row,
    },
    IntBinary {
        op: IntBinary,
        t: IntType,
        dst: Row,
        a: Row,
        b: Row,
    },
    IntCompare {
        op: Compare,
        t: IntType,
        dst: Row,
        a: Row,
        b: Row,
    },
    Not {
        dst: Row,
        a: Row,
    },
    BoolBinary {
        op: BoolBinary,
        dst: Row,
        a: Row,
        b: Row,
    },
    Select {
        kind: Kind,
        dst: Row,
        cond: Row,
        accept: Row,
        reject: Row,
    },
    Convert {
        from: Kind,
        to: Kind,
        dst: Row,
        a: Row,
    },
    ToBits {
        from: Kind,
        dst: Row,
        a: Row,
    },
    FromBits {
        to: Kind,
        dst: Row,
        a: Row,
    },
    Pick(Box<Pick>),
    Load(Box<Load>),
    Store(Box<Store>),
    ArrayLength {
        dst: Row,
        region: RegionId,
        start: u32,
        stride: u32,
    },
    Derivative {
        axis: DerivativeAxis,
        control: DerivativeControl,
        w: Width,
        dst: Row,
        a: Row,
    },
    Pack(Box<Pack>),
    Unpack(Box<Pack>),
    Atomic(Box<Atomic>),
    Sample(Box<Sample>),
    ImageLoad(Box<ImageLoad>),
    ImageStore(Box<ImageStore>),
    ImageQuery(Box<ImageQuery>),
    Subgroup(Box<Subgroup>),
}

/// A term of a sum, or a factor of a product.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Term {
    pub(crate) row: Row,
    pub(crate) negative: bool,
}

/// `dst = a op b`, which may be computed from its terms in any order.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    pub(crate) op: FloatBinary,
    pub(crate) w: Width,
    pub(crate) dst: Row,
    pub(crate) a: Row,
    pub(crate) b: Row,
    pub(crate) terms: Vec<Term>,
}

/// A component of a vector that is divided by its length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    /// As it is squared.
    pub(crate) scaled: Row,
    /// As it was before all were divided by one divisor.
    pub(crate) whole: Row,
}

/// `dst = quotient`, which is `parts[at]` over the root of `sum`, the sum of the parts' squares.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Unit {
    pub(crate) w: Width,
    pub(crate) dst: Row,
    pub(crate) quotient: Row,
    pub(crate) sum: Row,
    pub(crate) parts: Vec<Part>,
    pub(crate) divisor: Option<Row>,
    pub(crate) at: usize,
}

/// `dst[k] = groups[index][k]`: a run-time index into a value.
#[derive(Clone, Debug)]
pub(crate) struct Pick {
    pub(crate) dst: Row,
    pub(crate) kinds: Vec<Kind>,
    pub(crate) groups: Vec<Vec<Row>>,
    pub(crate) index: Row,
    pub(crate) int: IntType,
}

#[derive(Clone, Debug)]
pub(crate) struct Load {
    pub(crate) dst: Row,
    pub(crate) kinds: Vec<Kind>,
    pub(crate) place: Place,
}

#[derive(Clone, Debug)]
pub(crate) struct Store {
    pub(crate) place: Place,
    pub(crate) kinds: Vec<Kind>,
    pub(crate) values: Vec<Row>,
}

/// How the parts of a packed word are encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Packing {
    Unorm { bits: u32 },
    Snorm { bits: u32 },
    Half,
    Int { signed: bool, clamp: bool },
}

impl Packing {
    /// Bits of one part.
    pub(crate) fn bits(self) -> u32 {
        match self {
            Self::Unorm { bits } | Self::Snorm { bits } => bits,
            Self::Half => 16,
            Self::Int { .. } => 8,
        }
    }
}

/// `word` packs or unpacks `parts`.
#[derive(Clone, Debug)]
pub(crate) struct Pack {
    pub(crate) packing: Packing,
    pub(crate) word: Row,
    pub(crate) parts: Vec<Row>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum AtomicOp {
    Integer(IntBinary),
    FloatAdd,
    FloatSubtract,
    FloatMin,
    FloatMax,
    Exchange,
    CompareExchange,
}

/// A read-modify-write of memory; `result` is the old value, and `exchanged` whether a comparison held.
#[derive(Clone, Debug)]
pub(crate) struct Atomic {
    pub(crate) op: AtomicOp,
    pub(crate) kind: Kind,
    pub(crate) target: AtomicTarget,
    pub(crate) value: Row,
    pub(crate) compare: Option<Row>,
    pub(crate) result: Option<Row>,
    pub(crate) exchanged: Option<Row>,
}

#[derive(Clone, Debug)]
pub(crate) enum AtomicTarget {
    Place(Place),
    Texel {
        image: HandleRef,
        coordinate: Vec<(Row, IntType)>,
        layer: Option<(Row, IntType)>,
    },
}

/// Which level of detail a sample reads.
#[derive(Clone, Debug)]
pub(crate) enum Level {
    Auto,
    Zero,
    Exact(Row),
    ExactInt(Row, IntType),
    Bias(Row),
    Gradient { x: Vec<Row>, y: Vec<Row> },
}

#[derive(Clone, Debug)]
pub(crate) struct Sample {
    pub(crate) image: HandleRef,
    pub(crate) sampler: HandleRef,
    pub(crate) coordinate: Vec<Row>,
    pub(crate) layer: Option<(Row, IntType)>,
    pub(crate) offset: Vec<Row>,
    pub(crate) level: Level,
    pub(crate) gather: Option<u8>,
    pub(crate) reference: Option<Row>,
    pub(crate) clamp_to_edge: bool,
    pub(crate) dst: Row,
    pub(crate) parts: u32,
    pub(crate) kind: Kind,
}

#[derive(Clone, Debug)]
pub(crate) struct ImageLoad {
    pub(crate) image: HandleRef,
    pub(crate) coordinate: Vec<(Row, IntType)>,
    pub(crate) layer: Option<(Row, IntType)>,
    pub(crate) sample: Option<(Row, IntType)>,
    pub(crate) level: Option<(Row, IntType)>,
    pub(crate) dst: Row,
    pub(crate) parts: u32,
    pub(crate) kind: Kind,
}

#[derive(Clone, Debug)]
pub(crate) struct ImageStore {
    pub(crate) image: HandleRef,
    pub(crate) coordinate: Vec<(Row, IntType)>,
    pub(crate) layer: Option<(Row, IntType)>,
    pub(crate) values: Vec<Row>,
    pub(crate) kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Query {
    Size,
    Levels,
    Layers,
    Samples,
}

#[derive(Clone, Debug)]
pub(crate) struct ImageQuery {
    pub(crate) image: HandleRef,
    pub(crate) query: Query,
    pub(crate) level: Option<(Row, IntType)>,
    pub(crate) dst: Row,
    pub(crate) parts: u32,
}

/// What lanes of a subgroup do together.
#[derive(Clone, Copy, Debug)]
pub(crate) enum SubgroupOp {
    Ballot,
    All,
    Any,
    Reduce(Combine),
    Inclusive(Combine),
    Exclusive(Combine),
    BroadcastFirst,
    Broadcast(Row, IntType),
    Shuffle(Row, IntType),
    ShuffleDown(Row, IntType),
    ShuffleUp(Row, IntType),
    ShuffleXor(Row, IntType),
    QuadBroadcast(Row, IntType),
    QuadSwap(u32),
}

/// How values of lanes combine.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Combine {
    Float(FloatBinary),
    Int(IntBinary),
}

#[derive(Clone, Debug)]
pub(crate) struct Subgroup {
    pub(crate) op: SubgroupOp,
    pub(crate) kind: Kind,
    pub(crate) argument: Option<Row>,
    pub(crate) dst: Row,
}

/// An instruction and the number of the source span it came from.
#[derive(Clone, Debug)]
pub(crate) struct Instr {
    pub(crate) op: Op,
    pub(crate) span: u32,
}

/// What a piece of code may change.
#[derive(Clone, Debug, Default)]
pub(crate) struct Effects {
    /// Variables of the invocation, as row ranges (base, length).
    pub(crate) rows: std::collections::BTreeSet<(Row, u32)>,
    pub(crate) regions: std::collections::BTreeSet<RegionId>,
    pub(crate) returns: bool,
    pub(crate) kills: bool,
}

impl Effects {
    pub(crate) fn absorb(&mut self, other: &Self) {
        self.rows.extend(&other.rows);
        self.regions.extend(&other.regions);
        self.returns |= other.returns;
        self.kills |= other.kills;
    }
}

/// A statement of structured control flow, or a run of instructions.
#[derive(Clone, Debug)]
pub(crate) enum Node {
    Run(Box<[Instr]>),
    If {
        cond: Row,
        accept: Block,
        reject: Block,
        span: u32,
    },
    Switch {
        selector: Row,
        int: IntType,
        cases: Vec<Case>,
        span: u32,
    },
    Loop(Box<Loop>),
    Break,
    Continue,
    Return,
    Kill,
    Barrier,
    Call {
        function: usize,
        span: u32,
    },
}

pub(crate) type Block = Vec<Node>;

#[derive(Clone, Debug)]
pub(crate) struct Case {
    /// `None` is the default.
    pub(crate) value: Option<i128>,
    pub(crate) body: Block,
    pub(crate) fall_through: bool,
}

#[derive(Clone, Debug)]
pub(crate) struct Loop {
    pub(crate) body: Block,
    pub(crate) continuing: Block,
    pub(crate) break_if: Option<Row>,
    pub(crate) effects: Effects,
    pub(crate) span: u32,
}

/// One function for one set of pointer and texture arguments.
#[derive(Clone, Debug, Default)]
pub(crate) struct FunctionCode {
    pub(crate) body: Block,
    /// Rows of variables, parameters and the result: what differs between forks of an invocation.
    pub(crate) variables: Vec<(Row, u32)>,
    /// All rows that the function owns.
    pub(crate) owned: Vec<(Row, u32)>,
    pub(crate) result: Vec<Row>,
    pub(crate) effects: Effects,
}

/// A scalar known at compile time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Constant {
    pub(crate) kind: Kind,
    /// A float's `f64` bits, an integer's low bits, a truth value.
    pub(crate) bits: u64,
}

/// The whole program.
#[derive(Clone, Debug, Default)]
pub(crate) struct Code {
    pub(crate) kinds: Vec<Kind>,
    pub(crate) constants: Vec<(Row, Constant)>,
    /// By row: whether it may hold a product, itself or by way of copies and calls.
    pub(crate) products: Vec<bool>,
    pub(crate) functions: Vec<FunctionCode>,
    pub(crate) entry: usize,
    pub(crate) privates: Vec<(Row, u32)>,
    pub(crate) spans: Vec<Span>,
    /// Spans of `normalize`, which divides by a length.
    pub(crate) normalises: std::collections::BTreeSet<u32>,
    /// What conditions say of what they compare.
    pub(crate) facts: FactsByRow,
    pub(crate) uses_derivatives: bool,
    pub(crate) uses_barriers: bool,
    pub(crate) uses_subgroups: bool,
}
