//! What an optimising compiler leaves of every permutation: `snapshots/instructions@index.snap`, one line a module.
//!
//! The counts of `permutations@index.snap` are of the code as it is written. Here they are of what `spirv-opt -O` makes of the
//! emitted SPIR-V, with all calls inlined and what is dead or the same taken out: nearer to what a driver runs. Another version of
//! the tool counts otherwise, so the snapshot names the one that it is of, and with another the test is skipped, aloud.

mod support;

use std::collections::BTreeSet;
use std::fmt::{Display, Formatter};
use std::io::Write;
use std::path::PathBuf;
use std::thread;

use bossage_shaders::{AssembledShader, Library};
use bossage_translate::emit::spirv_listing;
use bossage_translate::external::{self, LIMITS};
use bossage_translate::{Contents, EmitOptions, Target, emit};

use support::{modules, parse, settings, snapshot_dir};

const INDEX: &str = "instructions@index";
const TOOL: &str = "spirv-opt";

/// Instructions of the function bodies of a module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Instructions {
    /// All but labels and the declarations of variables, which make no machine code.
    all: usize,
    /// Samples, fetches and gathers of textures.
    fetches: usize,
    /// Conditional branches and switches.
    branches: usize,
    /// Calls that are left.
    calls: usize,
}

impl Instructions {
    /// Those of a listing, one instruction a line.
    fn of(listing: &str) -> Self {
        let mut counts = Self::default();
        let mut inside = false;
        for opcode in listing.lines().filter_map(opcode) {
            match opcode {
                "OpFunction" => inside = true,
                "OpFunctionEnd" => inside = false,
                "OpLabel" | "OpVariable" | "OpFunctionParameter" => {}
                _ if inside => counts.add(opcode),
                _ => {}
            }
        }
        counts
    }

    fn add(&mut self, opcode: &str) {
        self.all += 1;
        let reads = ["Sample", "Fetch", "Gather"];
        self.fetches +=
            usize::from(opcode.starts_with("OpImage") && reads.iter().any(|read| opcode.contains(read)));
        self.branches += usize::from(matches!(opcode, "OpBranchConditional" | "OpSwitch"));
        self.calls += usize::from(opcode == "OpFunctionCall");
    }
}

impl Display for Instructions {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let Self {
            all,
            fetches,
            branches,
            calls,
        } = self;
        write!(f, "{all} fetches {fetches} branches {branches} calls {calls}")
    }
}

/// `%7 = OpFAdd %float %5 %6` and `OpReturn` have one; comments and empty lines have none.
fn opcode(line: &str) -> Option<&str> {
    line.split_whitespace().find(|word| word.starts_with("Op"))
}

/// The optimiser and its version, `SPIRV-Tools v2023.1`.
struct Optimiser {
    path: PathBuf,
    version: String,
}

impl Optimiser {
    fn find() -> Option<Self> {
        let program = format!("{TOOL}{}", std::env::consts::EXE_SUFFIX);
        let path = external::tool_folders()
            .into_iter()
            .map(|folder| folder.join(&program))
            .find(|path| path.is_file())?;
        let said = external::run(&path, &["--version".to_owned()], &[], &LIMITS)
            .ok()?
            .output;
        let version = said.split_whitespace().take(2).collect::<Vec<_>>().join(" ");
        version
            .starts_with("SPIRV-Tools")
            .then_some(Self { path, version })
    }

    /// What is left of a module.
    fn optimise(&self, spirv: &[u8]) -> Vec<u8> {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let [from, to] = ["in.spv", "out.spv"].map(|name| folder.path().join(name));
        std::fs::write(&from, spirv).expect("the module can be written");
        let arguments = ["-O", &from.to_string_lossy(), "-o", &to.to_string_lossy()].map(str::to_owned);
        let outcome =
            external::run(&self.path, &arguments, &[], &LIMITS).unwrap_or_else(|why| panic!("{why}"));
        assert!(outcome.success, "{TOOL} refuses a module: {}", outcome.output);
        std::fs::read(&to).expect("the optimiser has written the module")
    }
}

/// The emitted module as it is, and what the optimiser makes of it.
fn counts(optimiser: &Optimiser, assembled: &AssembledShader) -> [Instructions; 2] {
    let emitted =
        emit(&parse(assembled), Target::Spirv, &EmitOptions::default()).unwrap_or_else(|why| panic!("{why}"));
    let [file] = &emitted.files[..] else {
        panic!("{}: one entry point a module", assembled.name)
    };
    let Contents::Binary(spirv) = &file.contents else {
        panic!("{}: SPIR-V is bytes", assembled.name)
    };
    [spirv.clone(), optimiser.optimise(spirv)]
        .map(|bytes| Instructions::of(&spirv_listing(&bytes).expect("the module disassembles")))
}

fn line(optimiser: &Optimiser, assembled: &AssembledShader) -> String {
    let [before, after] = counts(optimiser, assembled);
    format!("{}: {} | -O {after}", assembled.name, before.all)
}

/// The lines of all modules, in their order. A process a module is started, so the cores share them.
fn lines(optimiser: &Optimiser, modules: &[AssembledShader]) -> Vec<String> {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let part = modules.len().div_ceil(cores).max(1);
    thread::scope(|scope| {
        let parts: Vec<_> = modules
            .chunks(part)
            .map(|chunk| {
                scope.spawn(move || chunk.iter().map(|one| line(optimiser, one)).collect::<Vec<_>>())
            })
            .collect();
        parts
            .into_iter()
            .flat_map(|part| part.join().expect("every module has its counts"))
            .collect()
    })
}

/// The version that the snapshot is of; `None` where there is no snapshot yet.
fn recorded() -> Option<String> {
    let text = std::fs::read_to_string(snapshot_dir().join(format!("{INDEX}.snap"))).ok()?;
    let body = text.splitn(3, "---").nth(2)?.trim_start();
    body.lines().next()?.split(" -O,").next().map(str::to_owned)
}

/// The optimiser, if it is there and counts as the snapshot does.
fn optimiser() -> Option<Optimiser> {
    let found = Optimiser::find();
    let other = |found: &Optimiser| recorded().is_some_and(|version| version != found.version);
    let problem = match &found {
        None => format!("`{TOOL}` was not found; on Debian: apt install spirv-tools"),
        Some(tool) if other(tool) => format!(
            "{INDEX} is of {}, and here is {}",
            recorded().unwrap_or_default(),
            tool.version
        ),
        Some(_) => return found,
    };
    let required = std::env::var("BOSSAGE_REQUIRE").unwrap_or_default();
    assert!(
        !required.split(',').any(|item| item.trim() == TOOL),
        "{TOOL} is required, but {problem}"
    );
    writeln!(std::io::stderr(), "SKIP: the index of instructions: {problem}")
        .expect("standard error can be written");
    None
}

#[test]
fn the_instructions_of_all_permutations() {
    let Some(optimiser) = optimiser() else { return };
    let modules = modules(&Library::embedded().unwrap());
    let head = format!(
        "{} -O, {} modules: instructions as emitted | and optimised",
        optimiser.version,
        modules.len()
    );
    let lines = lines(&optimiser, &modules);
    assert_eq!(lines.iter().collect::<BTreeSet<_>>().len(), modules.len());
    settings().bind(|| insta::assert_snapshot!(INDEX, format!("{head}\n\n{}", lines.join("\n"))));
}

#[test]
fn a_useless_operation_costs_nothing_and_a_useful_one_does() {
    let Some(optimiser) = optimiser() else { return };
    let library = Library::embedded().unwrap();
    let modules = modules(&library);
    let module = modules
        .iter()
        .find(|module| module.wgsl.contains("return vec4f(") && module.name.starts_with("surface_fragment"))
        .expect("a surface returns a colour");
    let with = |change: &str| {
        let mut changed = module.clone();
        changed.wgsl = module.wgsl.replacen("return vec4f(", change, 1);
        counts(&optimiser, &changed)
    };
    let [plain, plain_optimised] = counts(&optimiser, module);
    let [dead, dead_optimised] = with("let unused = sqrt(f32(7) * 3.0); return vec4f(");
    assert!(dead.all >= plain.all);
    assert_eq!(dead_optimised, plain_optimised);
    let [_, live_optimised] = with("return sqrt(1.5) * vec4f(");
    assert_ne!(live_optimised, plain_optimised);
}

#[test]
fn instructions_are_counted_by_kind() {
    let listing = "OpCapability Shader\n%1 = OpFunction %2 None %3\n%4 = OpLabel\n%5 = OpVariable %6 Function\n\
                   %7 = OpImageSampleImplicitLod %8 %9 %10\n%11 = OpImageFetch %8 %9 %10\nOpSelectionMerge %12 None\n\
                   OpBranchConditional %13 %12 %14\n%15 = OpFunctionCall %2 %16\nOpReturn\nOpFunctionEnd\n";
    let expected = Instructions {
        all: 6,
        fetches: 2,
        branches: 1,
        calls: 1,
    };
    assert_eq!(Instructions::of(listing), expected);
}
