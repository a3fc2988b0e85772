//! The features that `@if` may name, which of them a stage turns on, and the search for misspelt ones.
//!
//! WESL takes an unknown feature for a false one; here it is an error. The words are those of the shader sources.

use std::ops::Range;

use wesl::syntax::{
    Attribute, Attributes, BinaryOperator, CompoundStatement, Expression, ExpressionNode, GlobalDeclaration,
    GlobalDirective, Statement, TranslationUnit, UnaryOperator,
};

use crate::feature_set::{
    Albedo, Alpha, Form, LightingSpace, Lights, NormalSource, Normaliser, Relief, Shading, Shadow, Transform,
};
use crate::stage::{FragmentKey, Pass, VertexKey};

/// Every feature that the library's sources may name, sorted.
pub(crate) const KNOWN: &[&str] = &[
    "albedo",
    "albedo_map",
    "alpha_cutoff",
    "alpha_mask",
    "ambient",
    "any_varying",
    "bent_normal",
    "blinn_phong",
    "capture",
    "cone_step",
    "cube_normaliser",
    "directional_light",
    "displacement",
    "dot3",
    "dot3_first_pass",
    "dot3_single_pass",
    "elevation",
    "emboss",
    "environment",
    "exact",
    "four_loads",
    "general_transform",
    "given_hit",
    "handedness",
    "height_map",
    "many_lights",
    "mirrored_uv",
    "normal_map",
    "normal_varying",
    "object_space",
    "parallax_iterative",
    "parallax_occlusion",
    "parallax_offset",
    "parallax_offset_limited",
    "parallax_slope_ao",
    "parallax_slope_ao_directed",
    "pixel_depth",
    "point_light",
    "position_varying",
    "published",
    "relaxed_cone_step",
    "relief",
    "relief_map",
    "relief_mapping",
    "sampler",
    "search",
    "self_shadow",
    "shadow",
    "slope",
    "soft_shadow",
    "specular",
    "specular_color",
    "steep_parallax",
    "tangent_varying",
    "unit_normal",
    "uv_varying",
    "view_axis",
    "view_tangent",
    "view_vector",
    "world_matrix",
    "wrap_lambert",
];

/// The features of a vertex module, sorted.
pub(crate) fn of_vertex(key: &VertexKey) -> Vec<&'static str> {
    let general = key.transform == Transform::General;
    let object_space = key.space == LightingSpace::Object;
    on([
        ("displacement", key.displacement),
        ("general_transform", general),
        ("handedness", key.tangent && (key.mirrored_uv || general)),
        ("height_map", key.displacement),
        ("mirrored_uv", key.mirrored_uv),
        ("normal_varying", key.normal),
        ("object_space", object_space),
        ("position_varying", key.position),
        ("sampler", key.displacement),
        ("tangent_varying", key.tangent),
        ("uv_varying", key.uv),
        (
            "world_matrix",
            !object_space && (key.position || key.tangent || (key.normal && !general)),
        ),
    ])
}

/// What a fragment module needs for several of its effects.
struct Needs {
    uv: bool,
    view_vector: bool,
    view_axis: bool,
    normal: bool,
    tangent: bool,
    /// The perturbed normal as it is, for formulas that take it unnormalised or normalise it themselves.
    bent_normal: bool,
    /// The perturbed normal at unit length.
    unit_normal: bool,
}

impl Needs {
    fn of(key: &FragmentKey) -> Self {
        let (lit, shifts) = (key.lights != Lights::None, key.relief.shifts());
        let emboss = key.shading == Shading::Emboss;
        let mapped = key.normal == NormalSource::Map || shifts || emboss;
        let view_axis = key.relief == Relief::ParallaxSlopeAo && key.form == Form::Published;
        Self {
            uv: mapped || key.albedo == Albedo::Map,
            view_vector: key.specular || key.environment || (shifts && !view_axis),
            view_axis,
            normal: lit || shifts || key.environment,
            tangent: mapped,
            bent_normal: key.environment || (lit && key.shading == Shading::WrapLambert),
            unit_normal: lit && (key.shading == Shading::BlinnPhong || emboss),
        }
    }
}

/// What is written for conformance, and never drawn by others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Variant {
    /// Nothing: the module itself.
    Plain,
    /// The interpolated inputs are written too.
    Capture,
    /// The hit is an input, and the ray is written.
    GivenHit,
}

/// The features of a fragment module, sorted.
pub(crate) fn of_fragment(key: &FragmentKey, variant: Variant) -> Vec<&'static str> {
    let needs = Needs::of(key);
    let first_of = |pass| key.shading == Shading::Dot3TwoPass && key.pass == pass;
    let (first, second) = (first_of(Pass::First), first_of(Pass::Second));
    let single = key.shading == Shading::Dot3SinglePass;
    let masked = key.alpha == Alpha::Mask;
    let wrap = key.shading == Shading::WrapLambert;
    on([
        ("albedo", !first),
        ("albedo_map", key.albedo == Albedo::Map),
        ("alpha_cutoff", masked && !wrap),
        ("alpha_mask", masked),
        ("ambient", !second),
        ("any_varying", needs.normal || needs.uv),
        ("bent_normal", needs.bent_normal),
        ("blinn_phong", key.shading == Shading::BlinnPhong),
        ("capture", variant == Variant::Capture),
        ("cone_step", key.relief == Relief::ConeStep),
        ("cube_normaliser", key.normaliser == Normaliser::Cube),
        ("directional_light", key.lights == Lights::Directional),
        ("dot3", single || first),
        ("dot3_first_pass", first),
        ("dot3_single_pass", single),
        ("elevation", key.relief.is_offset()),
        ("emboss", key.shading == Shading::Emboss),
        ("environment", key.environment),
        ("exact", key.relief == Relief::Exact),
        ("given_hit", variant == Variant::GivenHit),
        ("handedness", key.handedness),
        (
            "height_map",
            key.relief.reads_heights() || key.shading == Shading::Emboss,
        ),
        ("many_lights", key.lights == Lights::Many),
        ("normal_map", key.normal == NormalSource::Map),
        ("normal_varying", needs.normal),
        ("parallax_iterative", key.relief == Relief::ParallaxIterative),
        ("parallax_occlusion", key.relief == Relief::ParallaxOcclusion),
        ("parallax_offset", key.relief == Relief::ParallaxOffset),
        (
            "parallax_offset_limited",
            key.relief == Relief::ParallaxOffsetLimited,
        ),
        ("parallax_slope_ao", key.relief == Relief::ParallaxSlopeAo),
        (
            "parallax_slope_ao_directed",
            key.relief == Relief::ParallaxSlopeAoDirected,
        ),
        ("pixel_depth", key.pixel_depth),
        ("point_light", key.lights == Lights::Point),
        (
            "position_varying",
            needs.view_vector || matches!(key.lights, Lights::Point | Lights::Many),
        ),
        ("published", key.form == Form::Published),
        ("relaxed_cone_step", key.relief == Relief::RelaxedConeStep),
        ("relief", key.relief.shifts()),
        ("relief_map", key.relief.reads_relief_map()),
        ("relief_mapping", key.relief == Relief::Relief),
        (
            "sampler",
            needs.uv || key.environment || key.normaliser == Normaliser::Cube,
        ),
        ("search", key.relief.is_search()),
        ("self_shadow", key.shadow == Shadow::Hard),
        ("shadow", key.shadow != Shadow::None),
        ("slope", key.relief.is_slope()),
        ("soft_shadow", key.shadow == Shadow::Soft),
        ("specular", key.specular),
        ("specular_color", key.specular || key.environment),
        ("steep_parallax", key.relief == Relief::SteepParallax),
        ("tangent_varying", needs.tangent),
        ("unit_normal", needs.unit_normal),
        ("uv_varying", needs.uv),
        ("view_axis", needs.view_axis),
        (
            "view_tangent",
            key.relief.is_offset() || key.relief.is_search() || key.relief == Relief::ParallaxSlopeAoDirected,
        ),
        ("view_vector", needs.view_vector),
        ("wrap_lambert", wrap),
    ])
}

fn on<const N: usize>(features: [(&'static str, bool); N]) -> Vec<&'static str> {
    features
        .into_iter()
        .filter_map(|(name, on)| on.then_some(name))
        .collect()
}

/// Every feature that a module names, with the place in its text.
pub(crate) fn used(module: &TranslationUnit) -> Vec<(String, Range<usize>)> {
    let mut found = Vec::new();
    for attributes in attribute_lists(module) {
        for attribute in attributes {
            if let Attribute::If(condition) | Attribute::Elif(condition) = attribute.node() {
                names(condition, &mut found);
            }
        }
    }
    found
}

/// The feature names in a condition. Anything that is no condition is left for WESL to refuse.
fn names(condition: &ExpressionNode, found: &mut Vec<(String, Range<usize>)>) {
    match condition.node() {
        Expression::TypeOrIdentifier(name) => found.push((name.ident.to_string(), condition.span().range())),
        Expression::Parenthesized(inner) => names(&inner.expression, found),
        Expression::Unary(inner) if matches!(inner.operator, UnaryOperator::LogicalNegation) => {
            names(&inner.operand, found);
        }
        Expression::Binary(pair)
            if matches!(
                pair.operator,
                BinaryOperator::ShortCircuitAnd | BinaryOperator::ShortCircuitOr
            ) =>
        {
            names(&pair.left, found);
            names(&pair.right, found);
        }
        Expression::Literal(_)
        | Expression::NamedComponent(_)
        | Expression::Indexing(_)
        | Expression::Unary(_)
        | Expression::Binary(_)
        | Expression::FunctionCall(_) => {}
    }
}

/// Every list of attributes on which WESL allows a condition.
fn attribute_lists(module: &TranslationUnit) -> Vec<&Attributes> {
    let mut lists: Vec<&Attributes> = module.imports.iter().map(|import| &import.attributes).collect();
    lists.extend(module.global_directives.iter().map(|directive| match directive {
        GlobalDirective::Diagnostic(it) => &it.attributes,
        GlobalDirective::Enable(it) => &it.attributes,
        GlobalDirective::Requires(it) => &it.attributes,
    }));
    for declaration in &module.global_declarations {
        of_declaration(declaration.node(), &mut lists);
    }
    lists
}

fn of_declaration<'a>(declaration: &'a GlobalDeclaration, lists: &mut Vec<&'a Attributes>) {
    match declaration {
        GlobalDeclaration::Void => {}
        GlobalDeclaration::Declaration(it) => lists.push(&it.attributes),
        GlobalDeclaration::TypeAlias(it) => lists.push(&it.attributes),
        GlobalDeclaration::ConstAssert(it) => lists.push(&it.attributes),
        GlobalDeclaration::Struct(it) => {
            lists.push(&it.attributes);
            lists.extend(it.members.iter().map(|member| &member.attributes));
        }
        GlobalDeclaration::Function(it) => {
            lists.push(&it.attributes);
            lists.extend(it.parameters.iter().map(|parameter| &parameter.attributes));
            for statement in statements(&it.body) {
                lists.extend(attributes_of(statement));
            }
        }
    }
}

/// Every statement of a body, nested ones included.
pub(crate) fn statements(body: &CompoundStatement) -> Vec<&Statement> {
    let mut all = Vec::new();
    let mut bodies = vec![body];
    while let Some(body) = bodies.pop() {
        for statement in &body.statements {
            all.push(statement.node());
            bodies.extend(bodies_of(statement.node()));
            if let Statement::For(it) = statement.node() {
                all.extend(it.initializer.iter().chain(&it.update).map(|part| part.node()));
            }
        }
    }
    all
}

fn bodies_of(statement: &Statement) -> Vec<&CompoundStatement> {
    match statement {
        Statement::Compound(it) => vec![it],
        Statement::If(it) => {
            let chained = it.else_if_clauses.iter().map(|clause| &clause.body);
            std::iter::once(&it.if_clause.body)
                .chain(chained)
                .chain(it.else_clause.iter().map(|c| &c.body))
                .collect()
        }
        Statement::Switch(it) => it.clauses.iter().map(|clause| &clause.body).collect(),
        Statement::Loop(it) => std::iter::once(&it.body)
            .chain(it.continuing.iter().map(|c| &c.body))
            .collect(),
        Statement::For(it) => vec![&it.body],
        Statement::While(it) => vec![&it.body],
        Statement::Void
        | Statement::Assignment(_)
        | Statement::Increment(_)
        | Statement::Decrement(_)
        | Statement::Break(_)
        | Statement::Continue(_)
        | Statement::Return(_)
        | Statement::Discard(_)
        | Statement::FunctionCall(_)
        | Statement::ConstAssert(_)
        | Statement::Declaration(_) => Vec::new(),
    }
}

fn attributes_of(statement: &Statement) -> Vec<&Attributes> {
    match statement {
        Statement::Void => Vec::new(),
        Statement::Compound(it) => vec![&it.attributes],
        Statement::Assignment(it) => vec![&it.attributes],
        Statement::Increment(it) => vec![&it.attributes],
        Statement::Decrement(it) => vec![&it.attributes],
        Statement::If(it) => {
            let chained = it.else_if_clauses.iter().map(|clause| &clause.attributes);
            std::iter::once(&it.attributes)
                .chain(chained)
                .chain(it.else_clause.iter().map(|c| &c.attributes))
                .collect()
        }
        Statement::Switch(it) => std::iter::once(&it.attributes)
            .chain(it.clauses.iter().map(|clause| &clause.attributes))
            .collect(),
        Statement::Loop(it) => {
            let breaks = it
                .continuing
                .iter()
                .filter_map(|c| c.break_if.as_ref())
                .map(|b| &b.attributes);
            std::iter::once(&it.attributes)
                .chain(it.continuing.iter().map(|c| &c.attributes))
                .chain(breaks)
                .collect()
        }
        Statement::For(it) => vec![&it.attributes],
        Statement::While(it) => vec![&it.attributes],
        Statement::Break(it) => vec![&it.attributes],
        Statement::Continue(it) => vec![&it.attributes],
        Statement::Return(it) => vec![&it.attributes],
        Statement::Discard(it) => vec![&it.attributes],
        Statement::FunctionCall(it) => vec![&it.attributes],
        Statement::ConstAssert(it) => vec![&it.attributes],
        Statement::Declaration(it) => vec![&it.attributes],
    }
}
