//! Coverage of the IR: every kind that naga has occurs in a shader that another test *evaluates*, or stands here with the reason why
//! none can reach it.
//!
//! The report, a line for each kind with the first shaders that reach it, is `tests/coverage.txt`; it is written anew with
//! `BOSSAGE_UPDATE_DOCS=1 cargo test -p bossage-bounds --test it coverage`.

use crate::common::{FILES, glsl, module, source};
use crate::kinds::{CLASSES, Kinds};
use bossage_bounds::Program;
use naga::{Binding, Block, Expression, Function, Module, Statement, TypeInner};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// Class, kinds, and why no shader of the tests reaches them. Whoever evaluates one gets [`bossage_bounds::Error::Unsupported`], or
/// cannot make one from source at all.
const OUT_OF_REACH: &[(&str, &str, &str)] = &[
    (
        "expression",
        "RayQueryVertexPositions RayQueryProceedResult RayQueryGetIntersection",
        "unsupported: ray queries",
    ),
    (
        "expression",
        "CooperativeLoad CooperativeMultiplyAdd",
        "unsupported: cooperative matrices",
    ),
    (
        "statement",
        "RayQuery RayPipelineFunction",
        "unsupported: ray queries and ray tracing pipelines",
    ),
    (
        "statement",
        "CooperativeStore",
        "unsupported: cooperative matrices",
    ),
    (
        "statement",
        "MemoryBarrier",
        "only SPIR-V makes one; it is run as a control barrier, which is stronger",
    ),
    ("type", "CooperativeMatrix", "unsupported: cooperative matrices"),
    (
        "type",
        "AccelerationStructure RayQuery",
        "unsupported: ray queries",
    ),
    (
        "type",
        "ValuePointer",
        "naga's validator makes it for itself; no module declares one",
    ),
    (
        "scalar",
        "AbstractInt AbstractFloat",
        "gone before validation: constants have concrete types by then",
    ),
    (
        "literal",
        "AbstractInt AbstractFloat",
        "gone before validation: constants have concrete types by then",
    ),
    (
        "array size",
        "Pending",
        "gone once pipeline constants are applied; `wide` has a workgroup size that depends on one",
    ),
    (
        "address space",
        "TaskPayload RayPayload IncomingRayPayload",
        "unsupported: mesh and ray tracing stages",
    ),
    (
        "image class",
        "External",
        "treated as a plain texture; nothing made from source declares one without its host's parameters",
    ),
    (
        "built-in",
        "MeshTaskSize CullPrimitive PointIndex LineIndices TriangleIndices VertexCount Vertices PrimitiveCount Primitives",
        "unsupported: mesh and task stages",
    ),
    (
        "built-in",
        "RayInvocationId NumRayInvocations InstanceCustomData GeometryIndex WorldRayOrigin WorldRayDirection ObjectRayOrigin \
         ObjectRayDirection RayTmin RayTCurrentMax ObjectToWorld WorldToObject HitKind",
        "unsupported: ray tracing stages",
    ),
    (
        "built-in",
        "BaseInstance BaseVertex CullDistance DrawIndex PointCoord PointSize",
        "no WGSL built-in of an ordinary stage",
    ),
    (
        "interpolation",
        "PerVertex",
        "needs an extension that reads the three vertices of a triangle",
    ),
];

type Reached = BTreeMap<(&'static str, &'static str), BTreeSet<String>>;

/// What one shader has.
struct Finder<'a> {
    reached: &'a mut Reached,
    shader: &'a str,
}

impl Finder<'_> {
    fn add<K: Kinds>(&mut self, kind: &K) {
        let shader = self.shader.to_owned();
        self.reached
            .entry((K::CLASS, kind.kind()))
            .or_default()
            .insert(shader);
    }

    fn module(&mut self, module: &Module) {
        for (_, ty) in module.types.iter() {
            self.ty(&ty.inner);
        }
        for (_, variable) in module.global_variables.iter() {
            self.add(&variable.space);
        }
        for (_, expression) in module.global_expressions.iter() {
            self.expression(expression);
        }
        for (_, function) in module.functions.iter() {
            self.function(function);
        }
        for entry in &module.entry_points {
            self.function(&entry.function);
        }
    }

    fn ty(&mut self, inner: &TypeInner) {
        self.add(inner);
        match inner {
            TypeInner::Scalar(scalar)
            | TypeInner::Vector { scalar, .. }
            | TypeInner::Matrix { scalar, .. }
            | TypeInner::Atomic(scalar) => self.add(&scalar.kind),
            TypeInner::Array { size, .. } => self.add(size),
            TypeInner::Pointer { space, .. } => self.add(space),
            TypeInner::Struct { members, .. } => {
                members
                    .iter()
                    .filter_map(|m| m.binding.as_ref())
                    .for_each(|b| self.binding(b));
            }
            TypeInner::Image { dim, class, .. } => {
                self.add(dim);
                self.add(class);
                if let naga::ImageClass::Storage { format, .. } = class {
                    self.add(format);
                }
            }
            TypeInner::CooperativeMatrix { .. }
            | TypeInner::ValuePointer { .. }
            | TypeInner::Sampler { .. }
            | TypeInner::AccelerationStructure { .. }
            | TypeInner::RayQuery { .. }
            | TypeInner::BindingArray { .. } => {}
        }
    }

    fn binding(&mut self, binding: &Binding) {
        match binding {
            Binding::BuiltIn(built_in) => self.add(built_in),
            Binding::Location {
                interpolation,
                sampling,
                ..
            } => {
                interpolation.iter().for_each(|kind| self.add(kind));
                sampling.iter().for_each(|kind| self.add(kind));
            }
        }
    }

    fn function(&mut self, function: &Function) {
        let arguments = function.arguments.iter().filter_map(|a| a.binding.as_ref());
        let result = function.result.iter().filter_map(|r| r.binding.as_ref());
        arguments.chain(result).for_each(|binding| self.binding(binding));
        for (_, expression) in function.expressions.iter() {
            self.expression(expression);
        }
        self.block(&function.body);
    }

    fn expression(&mut self, expression: &Expression) {
        self.add(expression);
        match expression {
            Expression::Literal(literal) => self.add(literal),
            Expression::Unary { op, .. } => self.add(op),
            Expression::Binary { op, .. } => self.add(op),
            Expression::Math { fun, .. } => self.add(fun),
            Expression::Relational { fun, .. } => self.add(fun),
            Expression::Derivative { axis, ctrl, .. } => {
                self.add(axis);
                self.add(ctrl);
            }
            Expression::ImageSample { level, .. } => self.add(level),
            Expression::ImageQuery { query, .. } => self.add(query),
            // Their kind is all there is to them.
            _ => {}
        }
    }

    fn block(&mut self, block: &Block) {
        for statement in block.iter() {
            self.add(statement);
            match statement {
                Statement::Block(inner) => self.block(inner),
                Statement::If { accept, reject, .. } => {
                    [accept, reject].into_iter().for_each(|b| self.block(b))
                }
                Statement::Switch { cases, .. } => cases.iter().for_each(|case| {
                    self.add(&case.value);
                    self.block(&case.body);
                }),
                Statement::Loop { body, continuing, .. } => {
                    [body, continuing].into_iter().for_each(|b| self.block(b));
                }
                Statement::Atomic { fun, .. } | Statement::ImageAtomic { fun, .. } => self.add(fun),
                Statement::SubgroupGather { mode, .. } => {
                    self.add(mode);
                    if let naga::GatherMode::QuadSwap(direction) = mode {
                        self.add(direction);
                    }
                }
                Statement::SubgroupCollectiveOperation {
                    op, collective_op, ..
                } => {
                    self.add(op);
                    self.add(collective_op);
                }
                // Their kind is all there is to them.
                _ => {}
            }
        }
    }
}

/// Every shader that a test evaluates, by the name in the report.
fn evaluated() -> Vec<(String, Module)> {
    let files = FILES.map(|name| (name.to_owned(), module(&source(name)).0));
    let expressions = crate::accept::all_expressions();
    let built_ins = crate::math::bodies()
        .into_iter()
        .map(|body| crate::common::probe_source(&body));
    let storage = crate::further::storage_shaders();
    files
        .into_iter()
        .chain([("glsl".to_owned(), glsl(&source("glsl")).0)])
        .chain([("accept.rs".to_owned(), module(&expressions).0)])
        .chain(built_ins.map(|text| ("math.rs".to_owned(), module(&text).0)))
        .chain(
            storage
                .iter()
                .map(|text| ("further.rs".to_owned(), module(text).0)),
        )
        .collect()
}

fn reached() -> Reached {
    let mut reached = Reached::new();
    for (shader, module) in evaluated() {
        let mut finder = Finder {
            reached: &mut reached,
            shader: &shader,
        };
        finder.module(&module);
    }
    reached
}

fn reason(class: &str, kind: &str) -> Option<&'static str> {
    OUT_OF_REACH
        .iter()
        .find(|(of, kinds, _)| *of == class && kinds.split_whitespace().any(|name| name == kind))
        .map(|(.., reason)| *reason)
}

/// Kinds that nothing reaches and nobody explains, and kinds that are explained although something reaches them.
fn disagreements(reached: &Reached) -> (Vec<String>, Vec<String>) {
    let all = CLASSES
        .iter()
        .flat_map(|(class, kinds)| kinds.iter().map(move |kind| (*class, *kind)));
    let name = |(class, kind): (&str, &str)| format!("{class} {kind}");
    let unreached = all
        .clone()
        .filter(|at| !reached.contains_key(at) && reason(at.0, at.1).is_none());
    let needless = all.filter(|at| reached.contains_key(at) && reason(at.0, at.1).is_some());
    (unreached.map(name).collect(), needless.map(name).collect())
}

#[test]
fn every_kind_of_the_ir_is_evaluated_or_has_a_reason() {
    let (unreached, needless) = disagreements(&reached());
    assert!(
        unreached.is_empty(),
        "kinds that no evaluated shader reaches: {unreached:#?}"
    );
    assert!(
        needless.is_empty(),
        "kinds with a reason that are reached: {needless:#?}"
    );
}

/// Negative control: without the file that alone has them, kinds are missed.
#[test]
fn a_kind_that_is_not_reached_is_seen() {
    let mut less = reached();
    less.retain(|_, shaders| {
        shaders.remove("subgroups");
        !shaders.is_empty()
    });
    let (unreached, _) = disagreements(&less);
    assert!(unreached.contains(&"gather QuadSwap".to_owned()), "{unreached:?}");
    let mut more = reached();
    more.insert(("statement", "RayQuery"), BTreeSet::from(["x".to_owned()]));
    assert_eq!(disagreements(&more).1, ["statement RayQuery"]);
}

#[test]
fn reasons_name_kinds_that_there_are() {
    for (class, kinds, _) in OUT_OF_REACH {
        let (_, known) = CLASSES.iter().find(|(name, _)| name == class).unwrap();
        for kind in kinds.split_whitespace() {
            assert!(known.contains(&kind), "{class} {kind}");
        }
    }
}

fn report() -> String {
    let reached = reached();
    let mut text = String::from("Kinds of naga's IR and the first shaders of the tests that reach them.\n");
    for (class, kinds) in CLASSES {
        let count = kinds
            .iter()
            .filter(|kind| reached.contains_key(&(*class, **kind)))
            .count();
        let _ = writeln!(text, "\n{class}: {count} of {}", kinds.len());
        for kind in *kinds {
            let place = match reached.get(&(*class, *kind)) {
                Some(shaders) => shaders.iter().take(3).cloned().collect::<Vec<_>>().join(", "),
                None => format!("- ({})", reason(class, kind).unwrap_or("not reached")),
            };
            let _ = writeln!(text, "  {kind:28} {place}");
        }
    }
    text
}

#[test]
fn the_report_is_current() {
    let path = format!("{}/tests/coverage.txt", env!("CARGO_MANIFEST_DIR"));
    let wanted = report();
    if std::env::var_os("BOSSAGE_UPDATE_DOCS").is_some() {
        std::fs::write(&path, &wanted).unwrap_or_else(|why| panic!("{path}: {why}"));
        return;
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        found == wanted,
        "tests/coverage.txt is stale; write it anew with BOSSAGE_UPDATE_DOCS=1"
    );
}

#[test]
fn every_corpus_file_is_listed() {
    let dir = format!("{}/tests/corpus", env!("CARGO_MANIFEST_DIR"));
    let found: BTreeSet<String> = std::fs::read_dir(dir)
        .unwrap()
        .map(|e| {
            e.unwrap()
                .path()
                .file_stem()
                .unwrap()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    let listed = FILES.iter().copied().chain(["glsl"]).map(str::to_owned).collect();
    assert_eq!(found, listed);
}

#[test]
fn unsupported_constructs_are_errors_with_a_place() {
    let source = "enable wgpu_ray_query;
        @group(0) @binding(0) var acc: acceleration_structure;
        @compute @workgroup_size(1) fn main() {
            var rq: ray_query;
            rayQueryInitialize(&rq, acc, RayDesc(0u, 255u, 0.1, 100.0, vec3f(0.0), vec3f(0.0, 1.0, 0.0)));
        }";
    let (module, info) = module(source);
    let error = Program::new(&module, &info, "main").unwrap_err();
    assert!(
        matches!(error, bossage_bounds::Error::Unsupported { .. }),
        "{error}"
    );
}
