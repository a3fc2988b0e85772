//! Coverage of the IR: every kind of expression, statement, function and so on occurs in a corpus file that another test
//! *evaluates*, or is listed here as out of reach with the reason.

use crate::common::{module, source};
use bossage_bounds::Program;
use naga::{Block, Expression, Function, Statement};
use std::collections::BTreeSet;

/// The corpus files; each is evaluated in `corpus.rs` or `textures.rs`.
const FILES: [&str; 9] = [
    "values",
    "flow",
    "integers",
    "shared",
    "wide",
    "fragment",
    "vertex",
    "textures",
    "subgroups",
];

/// Kinds by name, as `Debug` prints the variant.
const EXPECTED: &[(&str, &[&str])] = &[
    (
        "expression",
        &[
            "Literal",
            "Constant",
            "Override",
            "ZeroValue",
            "Compose",
            "Access",
            "AccessIndex",
            "Splat",
            "Swizzle",
            "FunctionArgument",
            "GlobalVariable",
            "LocalVariable",
            "Load",
            "ImageSample",
            "ImageLoad",
            "ImageQuery",
            "Unary",
            "Binary",
            "Select",
            "Derivative",
            "Relational",
            "Math",
            "As",
            "CallResult",
            "AtomicResult",
            "WorkGroupUniformLoadResult",
            "ArrayLength",
            "SubgroupBallotResult",
            "SubgroupOperationResult",
        ],
    ),
    (
        "statement",
        &[
            "Emit",
            "Block",
            "If",
            "Switch",
            "Loop",
            "Break",
            "Continue",
            "Return",
            "Kill",
            "ControlBarrier",
            "Store",
            "ImageStore",
            "Atomic",
            "ImageAtomic",
            "WorkGroupUniformLoad",
            "Call",
            "SubgroupBallot",
            "SubgroupGather",
            "SubgroupCollectiveOperation",
        ],
    ),
    ("unary", &["Negate", "LogicalNot", "BitwiseNot"]),
    (
        "binary",
        &[
            "Add",
            "Subtract",
            "Multiply",
            "Divide",
            "Modulo",
            "Equal",
            "NotEqual",
            "Less",
            "LessEqual",
            "Greater",
            "GreaterEqual",
            "And",
            "ExclusiveOr",
            "InclusiveOr",
            "ShiftLeft",
            "ShiftRight",
        ],
    ),
    (
        "atomic",
        &[
            "Add",
            "Subtract",
            "And",
            "ExclusiveOr",
            "InclusiveOr",
            "Min",
            "Max",
            "Exchange",
        ],
    ),
    ("level", &["Auto", "Zero", "Exact", "Bias", "Gradient"]),
    ("query", &["Size", "NumLevels", "NumLayers", "NumSamples"]),
    (
        "derivative",
        &[
            "X None",
            "Y None",
            "Width None",
            "X Fine",
            "Y Fine",
            "Width Fine",
            "X Coarse",
            "Y Coarse",
            "Width Coarse",
        ],
    ),
    ("relational", &["All", "Any"]),
    (
        "type",
        &[
            "Scalar", "Vector", "Matrix", "Atomic", "Array", "Struct", "Image", "Sampler", "Pointer",
        ],
    ),
    (
        "gather",
        &[
            "BroadcastFirst",
            "Broadcast",
            "Shuffle",
            "ShuffleDown",
            "ShuffleUp",
            "ShuffleXor",
            "QuadBroadcast",
            "QuadSwap",
        ],
    ),
    (
        "collective",
        &["All", "Any", "Add", "Mul", "Min", "Max", "And", "Or", "Xor"],
    ),
    (
        "integer math",
        &[
            "Abs",
            "Min",
            "Max",
            "Clamp",
            "Sign",
            "Dot",
            "Dot4I8Packed",
            "Dot4U8Packed",
            "CountTrailingZeros",
            "CountLeadingZeros",
            "CountOneBits",
            "ReverseBits",
            "ExtractBits",
            "InsertBits",
            "FirstTrailingBit",
            "FirstLeadingBit",
            "Pack4x8snorm",
            "Pack4x8unorm",
            "Pack2x16snorm",
            "Pack2x16unorm",
            "Pack2x16float",
            "Pack4xI8",
            "Pack4xU8",
            "Pack4xI8Clamp",
            "Pack4xU8Clamp",
            "Unpack4x8snorm",
            "Unpack4x8unorm",
            "Unpack2x16snorm",
            "Unpack2x16unorm",
            "Unpack2x16float",
            "Unpack4xI8",
            "Unpack4xU8",
        ],
    ),
];

/// Not reached, each with its reason.
const OUT_OF_REACH: &[(&str, &str)] = &[
    (
        "expression RayQueryVertexPositions",
        "ray queries are unsupported",
    ),
    ("expression RayQueryProceedResult", "ray queries are unsupported"),
    (
        "expression RayQueryGetIntersection",
        "ray queries are unsupported",
    ),
    (
        "expression CooperativeLoad",
        "cooperative matrices are unsupported",
    ),
    (
        "expression CooperativeMultiplyAdd",
        "cooperative matrices are unsupported",
    ),
    ("statement RayQuery", "ray queries are unsupported"),
    (
        "statement RayPipelineFunction",
        "ray tracing pipelines are unsupported",
    ),
    (
        "statement CooperativeStore",
        "cooperative matrices are unsupported",
    ),
    ("statement MemoryBarrier", "WGSL makes control barriers only"),
    ("relational IsNan", "no WGSL built-in"),
    ("relational IsInf", "no WGSL built-in"),
    (
        "binary LogicalAnd",
        "naga's WGSL front end makes control flow of && and ||",
    ),
    (
        "binary LogicalOr",
        "naga's WGSL front end makes control flow of && and ||",
    ),
    ("math Outer", "no WGSL built-in"),
    ("math Inverse", "no WGSL built-in"),
];

fn variant(debug: String) -> String {
    debug.chars().take_while(|c| c.is_alphanumeric()).collect()
}

fn expressions(function: &Function, out: &mut BTreeSet<String>) {
    for (_, e) in function.expressions.iter() {
        out.insert(format!("expression {}", variant(format!("{e:?}"))));
        match e {
            Expression::Unary { op, .. } => out.insert(format!("unary {op:?}")),
            Expression::Binary { op, .. } => out.insert(format!("binary {op:?}")),
            Expression::Math { fun, .. } => out.insert(format!("integer math {fun:?}")),
            Expression::Relational { fun, .. } => out.insert(format!("relational {fun:?}")),
            Expression::Derivative { axis, ctrl, .. } => out.insert(format!("derivative {axis:?} {ctrl:?}")),
            Expression::ImageSample { level, .. } => {
                out.insert(format!("level {}", variant(format!("{level:?}"))))
            }
            Expression::ImageQuery { query, .. } => {
                out.insert(format!("query {}", variant(format!("{query:?}"))))
            }
            _ => false,
        };
    }
    statements(&function.body, out);
}

fn statements(block: &Block, out: &mut BTreeSet<String>) {
    for s in block.iter() {
        out.insert(format!("statement {}", variant(format!("{s:?}"))));
        match s {
            Statement::Block(b) => statements(b, out),
            Statement::If { accept, reject, .. } => [accept, reject].iter().for_each(|b| statements(b, out)),
            Statement::Switch { cases, .. } => cases.iter().for_each(|c| statements(&c.body, out)),
            Statement::Loop { body, continuing, .. } => {
                [body, continuing].iter().for_each(|b| statements(b, out))
            }
            Statement::Atomic { fun, .. } | Statement::ImageAtomic { fun, .. } => {
                out.insert(format!("atomic {}", variant(format!("{fun:?}"))));
            }
            Statement::SubgroupGather { mode, .. } => {
                out.insert(format!("gather {}", variant(format!("{mode:?}"))));
            }
            Statement::SubgroupCollectiveOperation { op, .. } => {
                out.insert(format!("collective {op:?}"));
            }
            _ => {}
        }
    }
}

fn covered() -> BTreeSet<String> {
    let mut out = BTreeSet::new();
    for file in FILES {
        let (module, _) = module(&source(file));
        module.types.iter().for_each(|(_, t)| {
            out.insert(format!("type {}", variant(format!("{:?}", t.inner))));
        });
        module.global_expressions.iter().for_each(|(_, e)| {
            out.insert(format!("expression {}", variant(format!("{e:?}"))));
        });
        module
            .functions
            .iter()
            .for_each(|(_, f)| expressions(f, &mut out));
        module
            .entry_points
            .iter()
            .for_each(|e| expressions(&e.function, &mut out));
    }
    out
}

#[test]
fn every_kind_of_the_ir_is_evaluated() {
    let covered = covered();
    let missing: Vec<String> = EXPECTED
        .iter()
        .flat_map(|(class, names)| names.iter().map(move |n| format!("{class} {n}")))
        .filter(|name| !covered.contains(name))
        .collect();
    assert!(
        missing.is_empty(),
        "kinds that no corpus file covers: {missing:#?}"
    );
    let surprising: Vec<_> = OUT_OF_REACH
        .iter()
        .filter(|(name, _)| covered.contains(*name))
        .collect();
    assert!(
        surprising.is_empty(),
        "kinds listed as out of reach that the corpus covers: {surprising:#?}"
    );
}

#[test]
fn nothing_is_covered_that_is_not_listed() {
    let listed: BTreeSet<String> = EXPECTED
        .iter()
        .flat_map(|(c, names)| names.iter().map(move |n| format!("{c} {n}")))
        .collect();
    let unlisted: Vec<_> = covered()
        .into_iter()
        .filter(|c| !listed.contains(c) && !c.starts_with("integer math"))
        .collect();
    assert!(unlisted.is_empty(), "{unlisted:#?}");
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
    assert_eq!(found, FILES.iter().map(|s| s.to_string()).collect());
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
