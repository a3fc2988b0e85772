//! A derivative, or a texture sample that takes its level from one, where control flow is not uniform.
//!
//! Why: derivatives are differences between neighbouring invocations. Where some of those have gone another way the
//! result is undefined: in practice seams of wrong mip levels along every `if`, on some GPUs only. Relief techniques
//! sample inside loops with data-dependent exits, so this is the mistake to make there. Sample with an explicit level or
//! gradient instead.
//!
//! Uniformity is decided by a flow analysis of our own, a function at a time, with each call analysed for the uniformity
//! of its arguments: uniform are constants, uniform buffers, read-only storage, and what is computed from them, local
//! variables included as long as only uniform values are stored to them in uniform control flow. Everything else counts
//! as not uniform (varyings, writable memory, values behind pointer arguments), which is also the language's view.
//! `discard` leaves helper invocations running and does not count as divergence.

use std::collections::{BTreeSet, HashMap};

use naga::{
    AddressSpace, Block, BuiltIn, Expression, Function, Handle, LocalVariable, Module, Range, SampleLevel,
    Span, Statement, StorageAccess,
};

use crate::lint::{Finding, Rule, Severity};
use crate::shader::{Shader, Unit};
use crate::target::Stage;

pub(super) const RULE: Rule = Rule {
    id: "implicit_derivative",
    severity: Severity::Warning,
    find,
};

fn find(shader: &Shader) -> Vec<Finding> {
    let fragments = shader.units().iter().filter(|unit| unit.stage == Stage::Fragment);
    fragments
        .flat_map(spans)
        .map(|span| {
            let message = "a derivative is taken where control flow is not uniform, so the mip level is undefined; \
                 sample with an explicit level or gradient";
            Finding::new(shader, span, message.to_owned())
        })
        .collect()
}

fn spans(unit: &Unit) -> Vec<Span> {
    let function = &unit.entry().function;
    let arguments = function
        .arguments
        .iter()
        .map(|argument| matches!(argument.binding, Some(naga::Binding::BuiltIn(builtin)) if is_uniform(builtin)))
        .collect();
    let mut found = Found::default();
    Flow::new(&unit.module, function, arguments).run(false, &mut found);
    let mut found = found.places;
    found.sort_by_key(|span| span.to_range().map(|range| (range.start, range.end)));
    found.dedup();
    found
}

/// Offending places, and what is known of calls: function, which arguments are uniform, whether control flow has diverged.
#[derive(Default)]
struct Found {
    places: Vec<Span>,
    calls: HashMap<(Handle<Function>, Vec<bool>, bool), bool>,
}

const fn is_uniform(builtin: BuiltIn) -> bool {
    matches!(
        builtin,
        BuiltIn::WorkGroupId | BuiltIn::NumWorkGroups | BuiltIn::ViewIndex
    )
}

/// Where some invocations may have gone while others went on.
#[derive(Clone, Copy, Default)]
struct Diverged {
    /// Out of the function.
    returned: bool,
    /// Out of the innermost loop or switch.
    broke: bool,
    /// To the loop's next round.
    continued: bool,
}

impl Diverged {
    const fn any(self) -> bool {
        self.returned || self.broke || self.continued
    }

    const fn or(self, other: Self) -> Self {
        Self {
            returned: self.returned || other.returned,
            broke: self.broke || other.broke,
            continued: self.continued || other.continued,
        }
    }
}

/// The analysis of one function for one set of arguments.
struct Flow<'a> {
    module: &'a Module,
    function: &'a Function,
    arguments: Vec<bool>,
    /// Whether the value of an expression is the same in all invocations, as far as it has been computed.
    values: Vec<bool>,
    /// Local variables that may differ between invocations.
    varying: BTreeSet<Handle<LocalVariable>>,
    /// Results of calls that may differ between invocations.
    varying_results: BTreeSet<Handle<Expression>>,
    varying_return: bool,
}

impl<'a> Flow<'a> {
    fn new(module: &'a Module, function: &'a Function, arguments: Vec<bool>) -> Self {
        Self {
            module,
            function,
            arguments,
            values: vec![true; function.expressions.len()],
            varying: BTreeSet::new(),
            varying_results: BTreeSet::new(),
            varying_return: false,
        }
    }

    /// Adds the offending places; says whether the returned value may differ between invocations.
    fn run(mut self, diverged: bool, found: &mut Found) -> bool {
        // Sets only grow, so this ends; what is found before they are complete is also found after.
        loop {
            let known = (self.varying.len(), self.varying_results.len());
            self.block(&self.function.body, diverged, found);
            if known == (self.varying.len(), self.varying_results.len()) {
                return self.varying_return;
            }
        }
    }

    fn block(&mut self, block: &Block, diverged: bool, found: &mut Found) -> Diverged {
        let mut out = Diverged::default();
        for statement in block {
            let after = self.statement(statement, diverged || out.any(), found);
            out = out.or(after);
        }
        out
    }

    fn statement(&mut self, statement: &Statement, diverged: bool, found: &mut Found) -> Diverged {
        let mut out = Diverged::default();
        match statement {
            Statement::Emit(range) => self.emit(range.clone(), diverged, found),
            Statement::Block(block) => out = self.block(block, diverged, found),
            Statement::If {
                condition,
                accept,
                reject,
            } => {
                let inside = diverged || !self.uniform(*condition);
                out = self.block(accept, inside, found);
                out = out.or(self.block(reject, inside, found));
            }
            Statement::Switch { selector, cases } => {
                let inside = diverged || !self.uniform(*selector);
                for case in cases {
                    out = out.or(self.block(&case.body, inside, found));
                }
                // Here they meet again.
                out.broke = false;
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => out.returned = self.repeat(body, continuing, *break_if, diverged, found),
            Statement::Break => out.broke = diverged,
            Statement::Continue => out.continued = diverged,
            Statement::Return { value } => {
                self.varying_return |= diverged || value.is_some_and(|value| !self.uniform(value));
                out.returned = diverged;
            }
            Statement::Store { pointer, value } => self.store(*pointer, *value, diverged),
            Statement::Call {
                function,
                arguments,
                result,
            } => self.call(*function, arguments, *result, diverged, found),
            _ => {}
        }
        out
    }

    /// Computes the expressions of a range, each of which comes after its operands.
    fn emit(&mut self, range: Range<Expression>, diverged: bool, found: &mut Found) {
        for handle in range {
            self.values[handle.index()] = self.compute(handle);
            if diverged && self.takes_derivative(handle) {
                found.places.push(self.function.expressions.get_span(handle));
            }
        }
    }

    /// A loop that some invocations may leave, or go round, before others is not uniform from its second round on.
    /// Says whether some may have returned; those that left otherwise meet behind it.
    fn repeat(
        &mut self,
        body: &Block,
        continuing: &Block,
        break_if: Option<Handle<Expression>>,
        diverged: bool,
        found: &mut Found,
    ) -> bool {
        let once = |flow: &mut Self, diverged: bool, found: &mut Found| {
            let first = flow.block(body, diverged, found);
            let then = flow.block(continuing, diverged || first.any(), found);
            let mut out = first.or(then);
            out.broke |= break_if.is_some_and(|condition| !flow.uniform(condition));
            out
        };
        let out = once(self, diverged, found);
        if out.any() && !diverged {
            once(self, true, found);
        }
        out.returned
    }

    fn store(&mut self, pointer: Handle<Expression>, value: Handle<Expression>, diverged: bool) {
        if let Some(local) = self.local(pointer)
            && (diverged || !self.uniform(value) || !self.uniform(pointer))
        {
            self.varying.insert(local);
        }
    }

    fn call(
        &mut self,
        function: Handle<Function>,
        arguments: &[Handle<Expression>],
        result: Option<Handle<Expression>>,
        diverged: bool,
        found: &mut Found,
    ) {
        let uniform = arguments.iter().map(|argument| self.uniform(*argument)).collect();
        // What is behind a pointer may be written by the callee.
        let pointed: Vec<_> = arguments
            .iter()
            .filter_map(|argument| self.local(*argument))
            .collect();
        self.varying.extend(pointed);
        if self.callee_varies(function, uniform, diverged, found)
            && let Some(result) = result
        {
            self.varying_results.insert(result);
        }
    }

    /// Whether a call's result may differ between invocations. A call is analysed once for each way to make it: chains of calls
    /// would otherwise take time exponential in their length.
    fn callee_varies(
        &self,
        function: Handle<Function>,
        uniform: Vec<bool>,
        diverged: bool,
        found: &mut Found,
    ) -> bool {
        let way = (function, uniform.clone(), diverged);
        if let Some(&varies) = found.calls.get(&way) {
            return varies;
        }
        let callee = Flow::new(self.module, &self.module.functions[function], uniform);
        let varies = callee.run(diverged, found);
        found.calls.insert(way, varies);
        varies
    }

    /// The local variable that a pointer leads to.
    fn local(&self, pointer: Handle<Expression>) -> Option<Handle<LocalVariable>> {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(local) => Some(local),
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => self.local(base),
            _ => None,
        }
    }

    fn uniform(&self, handle: Handle<Expression>) -> bool {
        match self.function.expressions[handle] {
            Expression::FunctionArgument(index) => {
                self.arguments.get(index as usize).copied().unwrap_or(false)
            }
            Expression::CallResult(_) => !self.varying_results.contains(&handle),
            Expression::AtomicResult { .. }
            | Expression::SubgroupBallotResult
            | Expression::SubgroupOperationResult { .. }
            | Expression::RayQueryProceedResult => false,
            // Constants and pointers to variables are never computed and stay uniform.
            _ => self.values[handle.index()],
        }
    }

    /// Whether an expression that is computed here and now is uniform.
    fn compute(&self, handle: Handle<Expression>) -> bool {
        match self.function.expressions[handle] {
            Expression::Load { pointer } => self.memory_is_uniform(pointer) && self.uniform(pointer),
            Expression::RayQueryGetIntersection { .. } | Expression::RayQueryVertexPositions { .. } => false,
            ref other => operands(other).into_iter().all(|operand| self.uniform(operand)),
        }
    }

    /// Whether all invocations read the same from the memory that a pointer leads to.
    fn memory_is_uniform(&self, pointer: Handle<Expression>) -> bool {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(local) => !self.varying.contains(&local),
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => {
                self.memory_is_uniform(base)
            }
            Expression::GlobalVariable(global) => match self.module.global_variables[global].space {
                AddressSpace::Uniform | AddressSpace::Immediate => true,
                AddressSpace::Storage { access } => !access.contains(StorageAccess::STORE),
                _ => false,
            },
            _ => false,
        }
    }

    fn takes_derivative(&self, handle: Handle<Expression>) -> bool {
        match self.function.expressions[handle] {
            Expression::Derivative { .. } => true,
            Expression::ImageSample {
                level, gather: None, ..
            } => {
                matches!(level, SampleLevel::Auto | SampleLevel::Bias(_))
            }
            _ => false,
        }
    }
}

/// The expressions that an expression is computed from.
fn operands(expression: &Expression) -> Vec<Handle<Expression>> {
    use Expression as E;
    match *expression {
        E::Compose { ref components, .. } => components.clone(),
        E::Access { base, index } => vec![base, index],
        E::AccessIndex { base: one, .. }
        | E::Splat { value: one, .. }
        | E::Swizzle { vector: one, .. }
        | E::Unary { expr: one, .. }
        | E::Derivative { expr: one, .. }
        | E::Relational { argument: one, .. }
        | E::As { expr: one, .. }
        | E::ArrayLength(one) => vec![one],
        E::Binary { left, right, .. } => vec![left, right],
        E::Select {
            condition,
            accept,
            reject,
        } => vec![condition, accept, reject],
        E::Math {
            arg,
            arg1,
            arg2,
            arg3,
            ..
        } => [Some(arg), arg1, arg2, arg3].into_iter().flatten().collect(),
        E::ImageSample {
            image,
            sampler,
            coordinate,
            array_index,
            offset,
            level,
            depth_ref,
            ..
        } => {
            let mut all = vec![image, sampler, coordinate];
            all.extend([array_index, offset, depth_ref].into_iter().flatten());
            match level {
                SampleLevel::Auto | SampleLevel::Zero => {}
                SampleLevel::Exact(one) | SampleLevel::Bias(one) => all.push(one),
                SampleLevel::Gradient { x, y } => all.extend([x, y]),
            }
            all
        }
        E::ImageLoad {
            image,
            coordinate,
            array_index,
            sample,
            level,
        } => {
            let mut all = vec![image, coordinate];
            all.extend([array_index, sample, level].into_iter().flatten());
            all
        }
        E::ImageQuery { image, .. } => vec![image],
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use crate::lint::testing::lines;

    /// Findings in a fragment shader's body, whose first line is number 1.
    fn in_main(body: &str) -> Vec<u32> {
        let text = format!(
            "{body} return c; }}
            @group(0) @binding(0) var t: texture_2d<f32>;
            @group(0) @binding(1) var s: sampler;
            struct U {{ count: u32, on: u32 }}
            @group(0) @binding(2) var<uniform> u: U;
            fn fetch(uv: vec2f) -> vec4f {{ return textureSample(t, s, uv); }}
            fn clamped(x: f32) -> f32 {{ if x > 1.0 {{ return 1.0; }} return x; }}"
        );
        let head = "@fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f { var c = vec4f(); ";
        lines("implicit_derivative", &format!("{head}{text}"))
    }

    #[test]
    fn a_branch_on_a_varying_is_found() {
        assert_eq!(in_main("if uv.x > 0.5 {\n c = textureSample(t, s, uv); }"), [2]);
        assert_eq!(in_main("if uv.x > 0.5 {\n c = dpdx(uv).xyxy; }"), [2]);
    }

    #[test]
    fn a_call_in_a_branch_is_found_where_it_samples() {
        assert_eq!(in_main("if uv.x > 0.5 { c = fetch(uv); }").len(), 1);
    }

    #[test]
    fn an_early_return_is_found() {
        assert_eq!(
            in_main("if uv.x > 0.5 { return c; }\n c = textureSample(t, s, uv);"),
            [2]
        );
    }

    #[test]
    fn a_loop_with_a_varying_exit_is_found() {
        assert_eq!(
            in_main(
                "for (var i = 0u; i < 8u; i++) {\n c += textureSample(t, s, uv);\n if c.x > 0.5 { break; } }"
            ),
            [2]
        );
        assert_eq!(
            in_main(
                "var x = uv.x; loop {\n c += textureSample(t, s, uv); x -= 0.1; continuing { break if x < 0.0; } }"
            ),
            [2]
        );
    }

    #[test]
    fn a_varying_through_a_variable_or_a_call_is_found() {
        assert_eq!(
            in_main("var x = 0.0; x = uv.x; if x > 0.5 {\n c = textureSample(t, s, uv); }"),
            [2]
        );
        assert_eq!(
            in_main("if clamped(uv.x) > 0.5 {\n c = textureSample(t, s, uv); }"),
            [2]
        );
    }

    #[test]
    fn uniform_control_flow_is_not_found() {
        for body in [
            "c = textureSample(t, s, uv);",
            "if u.on == 1u { c = textureSample(t, s, uv); }",
            "for (var i = 0u; i < 8u; i++) { c += textureSample(t, s, uv); }",
            "for (var i = 0u; i < u.count; i++) { c += fetch(uv); }",
            "if clamped(f32(u.count)) > 0.5 { c = fetch(uv); }",
        ] {
            assert!(in_main(body).is_empty(), "{body}");
        }
    }

    #[test]
    fn control_flow_that_has_met_again_is_not_found() {
        for body in [
            "if uv.x > 0.5 { c = vec4f(1.0); } c += textureSample(t, s, uv);",
            "loop { c.x += uv.x; if c.x > 0.5 { break; } } c += textureSample(t, s, uv);",
            "switch u32(uv.x) { case 1u: { c.x = 1.0; } default: { break; } } c += textureSample(t, s, uv);",
        ] {
            assert!(in_main(body).is_empty(), "{body}");
        }
    }

    #[test]
    fn a_long_chain_of_calls_takes_no_time() {
        let mut source = String::from("fn g0(x: f32) -> f32 { return dpdx(x); }\n");
        for k in 1..200 {
            source += &format!(
                "fn g{k}(x: f32) -> f32 {{ return g{}(x) + g{}(x * 2.0); }}\n",
                k - 1,
                k - 1
            );
        }
        source += "@fragment fn main(@location(0) x: f32) -> @location(0) vec4f { if x > 0.0 { return vec4f(g199(x)); } return vec4f(); }";
        assert_eq!(lines("implicit_derivative", &source), [1]);
    }

    #[test]
    fn explicit_levels_and_discard_are_not_found() {
        for body in [
            "if uv.x > 0.5 { c = textureSampleLevel(t, s, uv, 0.0); }",
            "if uv.x > 0.5 { c = textureSampleGrad(t, s, uv, uv, uv); }",
            "if uv.x > 0.5 { discard; } c = textureSample(t, s, uv);",
        ] {
            assert!(in_main(body).is_empty(), "{body}");
        }
    }
}
