//! The operations of scalars, as the compiled program names them.

/// A float function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(
    missing_docs,
    reason = "each name is the WGSL built-in of that name; the three below are explained"
)]
pub enum FloatUnary {
    Negate,
    Abs,
    Sign,
    Saturate,
    Floor,
    Ceil,
    Round,
    Trunc,
    Fract,
    /// `x * x` of one and the same value, which an interval knows to be no less than zero.
    Square,
    Sqrt,
    InverseSqrt,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Exp,
    Exp2,
    Log,
    Log2,
    Radians,
    Degrees,
    QuantizeToF16,
    /// The fraction that `modf` returns.
    ModfFract,
    /// The fraction that `frexp` returns.
    FrexpFract,
}

/// A float function of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(
    missing_docs,
    reason = "each name is the WGSL operator or built-in of that name"
)]
pub enum FloatBinary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    Min,
    Max,
    Atan2,
    Pow,
    Step,
}

/// A float function of three arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each name is the WGSL built-in of that name")]
pub enum FloatTernary {
    Fma,
    Clamp,
    Mix,
    SmoothStep,
}

/// A comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each name says it")]
pub enum Compare {
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
}

/// An integer function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(
    missing_docs,
    reason = "each name is the WGSL operator or built-in of that name"
)]
pub enum IntUnary {
    Negate,
    Not,
    Abs,
    Sign,
    CountOneBits,
    CountLeadingZeros,
    CountTrailingZeros,
    FirstLeadingBit,
    FirstTrailingBit,
    ReverseBits,
}

/// An integer function of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(
    missing_docs,
    reason = "each name is the WGSL operator or built-in of that name"
)]
pub enum IntBinary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    And,
    Or,
    Xor,
    ShiftLeft,
    ShiftRight,
    Min,
    Max,
}

/// A function of two truth values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each name says it")]
pub enum BoolBinary {
    And,
    Or,
    Equal,
    NotEqual,
}
