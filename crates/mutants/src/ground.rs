//! What mutants are judged against: the cases, and the text of every module that they use, without a fault.
//!
//! A mutant's reach is exact: a case is affected if and only if the assembled text of a module that it uses differs. Affected
//! cases run in a fixed order, the quick kinds first, until one refuses an output. Before a case judges its first mutant it is
//! run on the library as it is, where it must pass: a case that fails anyway tells nothing.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use bossage_conformance::bench::Bench;
use bossage_conformance::case::{Case, Outcome};
use bossage_conformance::suite::scene::files_in;
use bossage_conformance::{Module, Route, Selection, Verdict};
use bossage_runner::Machine;
use bossage_shaders::{AssembledShader, Library};
use bossage_translate::{Shader, Source};

use crate::error::Error;
use crate::fate::Fate;
use crate::folder::{Copy, Sources};
use crate::mutant::Mutant;

/// Whether an outcome refuses the shader.
pub type Jury = fn(&Outcome) -> bool;

/// Conformance's own: a failed case. A warning or a skip catches nothing.
#[must_use]
pub fn conformance(outcome: &Outcome) -> bool {
    outcome.verdict == Verdict::Fail
}

/// What a judgement does next, and how long that may take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// The case.
    pub case: String,
    /// Whether it runs without a fault.
    pub unmutated: bool,
    /// The limit.
    pub limit: Duration,
}

/// A case with an unmutated library may take so long: the oracles compute what is expected then.
const UNMUTATED_LIMIT: Duration = Duration::from_secs(600);

/// The limit of a case with a mutant: this, and `SLOWER` times what it took without. Every loop of the library is bounded, so a
/// mutant does not lengthen one case by much, unless it never ends.
const LIMIT: Duration = Duration::from_secs(10);
const SLOWER: u32 = 20;

/// The cases and texts.
pub struct Ground {
    sources: Sources,
    copy: Copy,
    library: Library,
    cases: Vec<Standing>,
    texts: BTreeMap<Module, AssembledShader>,
}

/// A case, and what is known of it.
struct Standing {
    case: Box<dyn Case>,
    modules: BTreeSet<Module>,
    /// How long it took unmutated, once it has run.
    took: OnceCell<Duration>,
}

/// The folder of the scenes that are rendered: the examples.
#[must_use]
pub fn scenes_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

impl Ground {
    /// Lists the cases, those of the examples' scenes only where they are asked for, and assembles every module that they use.
    ///
    /// # Errors
    /// When the library or a scene is faulty as it is.
    pub fn new(sources: Sources, scenes: bool) -> Result<Self, Error> {
        let copy = sources.copy()?;
        let library = Library::from_dir(copy.path()).map_err(|error| Error::Library(error.to_string()))?;
        let scenes = if scenes {
            files_in(&scenes_folder())?
        } else {
            Vec::new()
        };
        let selection = Selection {
            scenes,
            ..Selection::default()
        };
        let mut cases: Vec<Standing> = selection
            .cases()?
            .into_iter()
            .map(Standing::new)
            .collect::<Result<_, _>>()?;
        cases.sort_by_key(|it| (rank(it.case.as_ref()), it.case.id().clone()));
        let modules: BTreeSet<Module> = cases.iter().flat_map(|it| it.modules.iter().copied()).collect();
        let text = |module: Module| match module.assemble(&library) {
            Ok(text) => Ok((module, text)),
            Err(error) => Err(Error::Library(format!("{module}: {error}"))),
        };
        let texts = modules.into_iter().map(text).collect::<Result<_, _>>()?;
        Ok(Self {
            sources,
            copy,
            library,
            cases,
            texts,
        })
    }

    /// The names of the cases, in the order in which they run.
    pub fn cases(&self) -> impl Iterator<Item = String> {
        self.cases.iter().map(|it| it.case.id().to_string())
    }

    /// Judges a mutant. `step` is told before anything runs.
    ///
    /// # Errors
    /// When a case fails without a fault, or asks for a module that it does not name.
    pub fn judge(
        &self,
        mutant: &Mutant,
        machine: &dyn Machine,
        jury: Jury,
        step: &mut dyn FnMut(Step),
    ) -> Result<Fate, Error> {
        let library = match self.copy.library(&self.sources, mutant)? {
            Ok(library) => library,
            Err(error) => return Ok(invalid(&error.to_string())),
        };
        let changed = match self.changed(mutant, &library) {
            Ok(changed) => changed,
            Err(reason) => return Ok(invalid(&reason)),
        };
        let affected = self.cases.iter().filter(|it| !it.modules.is_disjoint(&changed));
        let bench = Bench::new(machine, Route::Wgsl, &library);
        let mut ran = 0;
        for standing in affected {
            let took = self.unmutated(standing, machine, step)?;
            step(Step::new(standing, false, LIMIT + SLOWER * took));
            let outcome = standing.case.run(&bench);
            ran += 1;
            if jury(&outcome) {
                return Ok(Fate::Caught {
                    case: standing.case.id().to_string(),
                    reason: outcome.reason.unwrap_or_default(),
                });
            }
        }
        Ok(if ran == 0 {
            Fate::Unreached
        } else {
            Fate::Survived { cases: ran }
        })
    }

    /// The modules whose text the mutant changes; `Err` says how one of them does not assemble or validate.
    fn changed(&self, mutant: &Mutant, library: &Library) -> Result<BTreeSet<Module>, String> {
        let mut changed = BTreeSet::new();
        let mut valid = BTreeSet::new();
        let inside = self
            .texts
            .iter()
            .filter(|(_, text)| text.modules.contains(&mutant.file));
        for (module, text) in inside {
            let mutated = module.assemble(library).map_err(|error| error.to_string())?;
            if mutated.wgsl == text.wgsl {
                continue;
            }
            changed.insert(*module);
            if valid.insert(mutated.wgsl.clone()) {
                Shader::parse(&mutated.name, &Source::Wgsl(mutated.wgsl))
                    .map_err(|diagnostic| diagnostic.to_string())?;
            }
        }
        Ok(changed)
    }

    /// Runs a case on the library as it is, once; how long that took.
    fn unmutated(
        &self,
        standing: &Standing,
        machine: &dyn Machine,
        step: &mut dyn FnMut(Step),
    ) -> Result<Duration, Error> {
        if let Some(took) = standing.took.get() {
            return Ok(*took);
        }
        step(Step::new(standing, true, UNMUTATED_LIMIT));
        let bench = Bench::new(machine, Route::Wgsl, &self.library);
        let case = || standing.case.id().to_string();
        // What is expected is computed in the first run; the second is what a mutant is compared with.
        let outcome = standing.case.run(&bench);
        let start = Instant::now();
        let again = standing.case.run(&bench);
        let took = start.elapsed();
        if [&outcome, &again].iter().any(|outcome| conformance(outcome)) {
            return Err(Error::FailsUnmutated {
                case: case(),
                reason: outcome.reason.unwrap_or_default(),
            });
        }
        if let Some(module) = bench
            .asked()
            .iter()
            .find(|module| !standing.modules.contains(module))
        {
            return Err(Error::Undeclared {
                case: case(),
                module: module.to_string(),
            });
        }
        Ok(*standing.took.get_or_init(|| took))
    }
}

impl Standing {
    fn new(case: Box<dyn Case>) -> Result<Self, Error> {
        let modules = case
            .modules()
            .map_err(|message| Error::Library(format!("{}: {message}", case.id())))?;
        Ok(Self {
            modules: modules.into_iter().collect(),
            case,
            took: OnceCell::new(),
        })
    }
}

impl Step {
    fn new(standing: &Standing, unmutated: bool, limit: Duration) -> Self {
        Self {
            case: standing.case.id().to_string(),
            unmutated,
            limit,
        }
    }
}

/// Quick kinds first. Kinds that are not named here come before the slow ones.
fn rank(case: &dyn Case) -> u8 {
    match (case.id().technique.as_str(), case.id().generator.as_str()) {
        ("scene", _) => 4,
        (_, "control" | "cure" | "defect") => 0,
        (_, "edge") => 1,
        (_, "random") => 3,
        _ => 2,
    }
}

/// The first line that says something.
fn invalid(message: &str) -> Fate {
    let line = message
        .lines()
        .find(|line| !line.trim().is_empty())
        .unwrap_or_default();
    Fate::Invalid {
        reason: line.trim().to_owned(),
    }
}
