//! The built-in functions and operators of floats, as expressions in `x` and `y`.

/// What arguments are worth trying.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// Any finite number.
    Any,
    /// Numbers within [−1, 1].
    Unit,
    /// Numbers within [−π, π].
    Angle,
    /// Positive numbers.
    Positive,
    /// Numbers whose exponentials are finite.
    Exponent,
    /// A positive base and a moderate exponent.
    Power,
}

/// A function to check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Function {
    /// Its name in case ids.
    pub name: &'static str,
    /// WGSL, an `f32` in `x` and `y`.
    pub expression: &'static str,
    /// Where most of the arguments lie; a fourth of them are hard values of any kind.
    pub domain: Domain,
}

const fn of(name: &'static str, expression: &'static str, domain: Domain) -> Function {
    Function {
        name,
        expression,
        domain,
    }
}

use Domain::{Angle, Any, Exponent, Positive, Power, Unit};

/// All of them.
pub const ALL: &[Function] = &[
    of("abs", "abs(x)", Any),
    of("acos", "acos(x)", Unit),
    of("acosh", "acosh(x)", Positive),
    of("add", "x + y", Any),
    of("asin", "asin(x)", Unit),
    of("asinh", "asinh(x)", Any),
    of("atan", "atan(x)", Any),
    of("atan2", "atan2(x, y)", Any),
    of("atanh", "atanh(x)", Unit),
    of("ceil", "ceil(x)", Any),
    of("clamp", "clamp(x, min(y, 1.0), max(y, 1.0))", Any),
    of("cos", "cos(x)", Angle),
    of("cosh", "cosh(x)", Exponent),
    of("cross", "cross(vec3f(x, y, 1.0), vec3f(y, 1.0, x)).z", Any),
    of("degrees", "degrees(x)", Any),
    of("determinant", "determinant(mat2x2f(x, y, 0.5, x))", Any),
    of("distance", "distance(vec2f(x, y), vec2f(0.5, 0.25))", Any),
    of("divide", "x / y", Any),
    of("dot", "dot(vec4f(x, y, 1.0, x), vec4f(y, x, 0.3, -y))", Any),
    of("exp", "exp(x)", Exponent),
    of("exp2", "exp2(x)", Exponent),
    of(
        "face_forward",
        "faceForward(vec2f(x, 1.0), vec2f(y, 1.0), vec2f(x, 1.0)).x",
        Any,
    ),
    of("floor", "floor(x)", Any),
    of("fma", "fma(x, y, 0.7)", Any),
    of("fract", "fract(x)", Any),
    of("inverse_sqrt", "inverseSqrt(x)", Positive),
    of("ldexp", "ldexp(x, 3)", Any),
    of("length", "length(vec3f(x, y, 0.5))", Any),
    of("log", "log(x)", Positive),
    of("log2", "log2(x)", Positive),
    of("matrix_vector", "(mat2x2f(x, y, 0.3, x) * vec2f(y, 0.7)).x", Any),
    of("max", "max(x, y)", Any),
    of("min", "min(x, y)", Any),
    of("mix", "mix(x, y, 0.3)", Any),
    of("modf", "modf(x).fract", Any),
    of("multiply", "x * y", Any),
    of("negate", "-x", Any),
    of("normalize", "normalize(vec3f(x, y, 0.5)).x", Any),
    of("pack_half", "unpack2x16float(pack2x16float(vec2f(x, y))).y", Any),
    of(
        "pack_snorm",
        "unpack4x8snorm(pack4x8snorm(vec4f(x, y, x, y))).x",
        Unit,
    ),
    of(
        "pack_unorm",
        "unpack4x8unorm(pack4x8unorm(vec4f(x, y, x, y))).x",
        Unit,
    ),
    of("pow", "pow(x, y)", Power),
    of("quantize_to_f16", "quantizeToF16(x)", Any),
    of("radians", "radians(x)", Any),
    of("reflect", "reflect(vec2f(x, y), vec2f(0.6, 0.8)).x", Any),
    of(
        "refract",
        "refract(vec2f(0.6, x), vec2f(0.0, 1.0), 0.5 + 0.25 * y).x",
        Unit,
    ),
    of("remainder", "x % y", Any),
    of("round", "round(x)", Any),
    of("saturate", "saturate(x)", Any),
    of("select", "select(x, y, x < y)", Any),
    of("sign", "sign(x)", Any),
    of("sin", "sin(x)", Angle),
    of("sinh", "sinh(x)", Exponent),
    of("smoothstep", "smoothstep(0.25, 0.75, x)", Unit),
    of("sqrt", "sqrt(x)", Positive),
    of("step", "step(x, y)", Any),
    of("subtract", "x - y", Any),
    of("tan", "tan(x)", Angle),
    of("tanh", "tanh(x)", Exponent),
    of("to_int", "f32(i32(x))", Any),
    of("to_uint", "f32(u32(x))", Any),
    of("trunc", "trunc(x)", Any),
];
