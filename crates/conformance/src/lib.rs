//! Numeric conformance: cases, routes, oracles, verdicts, reports.
//!
//! A **case** ([`case_id`]) is a function, a bake, a mesh or a scene with a generator of inputs. A **route** ([`route`]) is a
//! way from the assembled shader to results. Each output is judged by two oracles that know nothing of each other: **truth**,
//! the f64 reference, and the **acceptance interval**, which `bossage-bounds` evaluates from the very module that is run, by
//! the WGSL accuracy rules, at that very input ([`bound`], [`tolerance`]). The output must lie in the interval, and so must the truth. Vocabulary and rules: `docs/numerics.md`.
//!
//! Verdicts: pass, warning, failure, skip (always with a reason), expected failure. A published defect that does *not* show
//! is a failure. Outputs are filled with a sentinel before the shader runs: what it does not write is a failure.
//!
//! ```
//! use bossage_conformance::{Selection, Verdict, report, run};
//! use bossage_shaders::Library;
//!
//! let selection = Selection { filter: Some("parallax_offset/hardened/control".to_owned()), ..Selection::default() };
//! let report = run(&selection, &Library::embedded()?, &mut bossage_conformance::Silent)?;
//! assert!(report.cases.iter().all(|case| case.verdict == Verdict::Pass));
//! let json = report::json::write(&report)?;
//! assert!(json.starts_with("{\n  \"schema\": 1"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod bench;
pub mod bound;
pub mod case;
pub mod case_id;
pub mod compare;
mod concurrent;
pub mod cone_passes;
pub mod deviation;
mod dispatch;
pub mod environment;
mod error;
pub mod generate;
pub mod heat;
pub mod hunt;
pub mod machines;
pub mod module;
pub mod oracle;
pub mod report;
pub mod route;
mod run;
pub mod suite;
pub mod tolerance;
pub mod ulp;
pub mod undecided;
pub mod user;
mod verdict;
pub mod width;

pub use error::Error;
pub use module::Module;
pub use report::{CaseResult, Report, Totals};
pub use route::Route;
pub use run::{Progress, Selection, Silent, run, run_cases};
pub use verdict::Verdict;
