//! Static counts of an entry point and all it calls, from the IR.
//!
//! The IR is what every language is written from, so the counts hold for all of them; what a driver's compiler removes
//! or adds is not seen. Counts saturate instead of overflowing.

use naga::valid::FunctionInfo;
use naga::{
    AddressSpace, BinaryOperator, Block, Expression, Function, Handle, MathFunction, Statement, TypeInner,
};
use serde::{Deserialize, Serialize};

use crate::shader::Unit;

/// How much an entry point does, counted over the code: a loop's body counts once, both arms of a branch count, and a
/// function counts at each of its calls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cost {
    /// Scalar operations: arithmetic, comparisons, conversions, and math functions (each one a component). A product
    /// with a matrix and a dot product count as the multiplications and additions they stand for.
    pub ops: u32,
    /// Texture samples and gathers.
    pub samples: u32,
    /// Texture loads, stores and atomics.
    pub texture_loads: u32,
    /// Reads and writes of uniform and storage buffers and push constants.
    pub buffer_accesses: u32,
    /// `if` and `switch`.
    pub branches: u32,
    /// Loops.
    pub loops: u32,
    /// Function calls.
    pub calls: u32,
}

impl Cost {
    const fn add(&mut self, other: Self) {
        self.ops = self.ops.saturating_add(other.ops);
        self.samples = self.samples.saturating_add(other.samples);
        self.texture_loads = self.texture_loads.saturating_add(other.texture_loads);
        self.buffer_accesses = self.buffer_accesses.saturating_add(other.buffer_accesses);
        self.branches = self.branches.saturating_add(other.branches);
        self.loops = self.loops.saturating_add(other.loops);
        self.calls = self.calls.saturating_add(other.calls);
    }
}

/// The counts of a unit's entry point.
pub(crate) fn cost(unit: &Unit) -> Cost {
    // A function calls only functions before it in the arena, so one pass knows all that it needs.
    let mut known: Vec<Cost> = Vec::with_capacity(unit.module.functions.len());
    for (handle, function) in unit.module.functions.iter() {
        let counted = Counter {
            unit,
            function,
            info: &unit.info[handle],
            callees: &known,
        }
        .block(&function.body);
        known.push(counted);
    }
    Counter {
        unit,
        function: &unit.entry().function,
        info: unit.entry_info(),
        callees: &known,
    }
    .block(&unit.entry().function.body)
}

struct Counter<'a> {
    unit: &'a Unit,
    function: &'a Function,
    info: &'a FunctionInfo,
    callees: &'a [Cost],
}

impl Counter<'_> {
    fn block(&self, block: &Block) -> Cost {
        let mut total = Cost::default();
        for statement in block {
            total.add(self.statement(statement));
            for inner in crate::ir::inner_blocks(statement) {
                total.add(self.block(inner));
            }
        }
        total
    }

    fn statement(&self, statement: &Statement) -> Cost {
        let mut total = Cost::default();
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    total.add(self.expression(handle));
                }
            }
            Statement::If { .. } | Statement::Switch { .. } => total.branches = 1,
            Statement::Loop { .. } => total.loops = 1,
            Statement::Store { pointer, .. } | Statement::Atomic { pointer, .. } => {
                total.buffer_accesses = u32::from(self.is_buffer(*pointer));
            }
            Statement::ImageStore { .. } | Statement::ImageAtomic { .. } => total.texture_loads = 1,
            Statement::Call { function, .. } => {
                total = self.callees.get(function.index()).copied().unwrap_or_default();
                total.calls = total.calls.saturating_add(1);
            }
            _ => {}
        }
        total
    }

    fn expression(&self, handle: Handle<Expression>) -> Cost {
        let mut total = Cost::default();
        match self.function.expressions[handle] {
            Expression::Binary { op, left, right } => {
                total.ops = self.binary(op, left, right, handle);
            }
            Expression::Math { fun, arg, .. } => total.ops = self.math(fun, arg, handle),
            Expression::Unary { .. }
            | Expression::Select { .. }
            | Expression::Derivative { .. }
            | Expression::Relational { .. }
            | Expression::As { convert: Some(_), .. } => total.ops = self.components(handle),
            Expression::ImageSample { .. } => total.samples = 1,
            Expression::ImageLoad { .. } => total.texture_loads = 1,
            Expression::Load { pointer } => {
                total.buffer_accesses = u32::from(self.is_buffer(pointer));
            }
            _ => {}
        }
        total
    }

    fn inner(&self, handle: Handle<Expression>) -> &TypeInner {
        self.info[handle].ty.inner_with(&self.unit.module.types)
    }

    fn components(&self, handle: Handle<Expression>) -> u32 {
        components(self.inner(handle))
    }

    fn binary(
        &self,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
        result: Handle<Expression>,
    ) -> u32 {
        let (left, right) = (self.inner(left), self.inner(right));
        let summed = match (op, left, right) {
            (
                BinaryOperator::Multiply,
                TypeInner::Matrix { columns, .. },
                TypeInner::Vector { .. } | TypeInner::Matrix { .. },
            ) => *columns as u32,
            (BinaryOperator::Multiply, TypeInner::Vector { size, .. }, TypeInner::Matrix { .. }) => {
                *size as u32
            }
            _ => 1,
        };
        self.components(result) * multiply_add(summed)
    }

    fn math(&self, function: MathFunction, argument: Handle<Expression>, result: Handle<Expression>) -> u32 {
        let dot = || multiply_add(self.components(argument));
        match function {
            MathFunction::Dot => dot(),
            // The root of a dot product; a distance subtracts first, a normalisation divides last.
            MathFunction::Length => dot() + 1,
            MathFunction::Distance | MathFunction::Normalize => dot() + 1 + self.components(argument),
            MathFunction::Cross => 9,
            _ => self.components(result),
        }
    }

    fn is_buffer(&self, pointer: Handle<Expression>) -> bool {
        matches!(
            self.inner(pointer).pointer_space(),
            Some(AddressSpace::Uniform | AddressSpace::Storage { .. } | AddressSpace::Immediate)
        )
    }
}

/// Operations of a sum of `n` products.
const fn multiply_add(n: u32) -> u32 {
    2 * n - 1
}

const fn components(inner: &TypeInner) -> u32 {
    match *inner {
        TypeInner::Vector { size, .. } => size as u32,
        TypeInner::Matrix { columns, rows, .. } => columns as u32 * rows as u32,
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Shader, Source};

    fn cost_of(body: &str) -> Cost {
        let text = format!(
            "struct U {{ m: mat4x4f, v: vec4f }}
            @group(0) @binding(0) var<uniform> u: U;
            @group(0) @binding(1) var<storage, read_write> out: array<vec4f>;
            @group(0) @binding(2) var t: texture_2d<f32>;
            fn twice(x: vec4f) -> vec4f {{ return x + x; }}
            @compute @workgroup_size(1) fn main(@builtin(global_invocation_id) id: vec3u) {{ {body} }}"
        );
        let shader = Shader::parse("cost.wgsl", &Source::Wgsl(text)).unwrap();
        cost(&shader.units()[0])
    }

    #[test]
    fn operations_count_by_component() {
        // One read of v, one write; four additions.
        let counted = cost_of("out[0] = u.v + vec4f(1.0);");
        assert_eq!((counted.ops, counted.buffer_accesses), (4, 2));
    }

    #[test]
    fn a_matrix_product_counts_its_dot_products() {
        // Each of four results: four products and three sums.
        assert_eq!(cost_of("out[0] = u.m * u.v;").ops, 28);
    }

    #[test]
    fn calls_are_expanded() {
        let counted = cost_of("out[0] = twice(twice(u.v));");
        assert_eq!((counted.ops, counted.calls), (8, 2));
    }

    #[test]
    fn control_flow_counts() {
        let counted = cost_of(
            "for (var i = 0u; i < 4u; i++) { if id.x > i { out[i] = textureLoad(t, vec2u(i), 0); } }",
        );
        assert_eq!((counted.loops, counted.texture_loads), (1, 1));
        // The loop's own exit is an `if`.
        assert_eq!(counted.branches, 2);
    }
}
