//! Every module that the library can produce is valid WGSL by naga's rules, and there is a bounded number of them.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::time::Instant;

use bossage_shaders::{AssembledShader, FeatureSet, Kernel, Library, PROBES, Result, Stage};

/// The promise of the feature model: the golden index of permutations stays readable.
const MOST_MODULES: usize = 1600;

fn validate(shader: &AssembledShader) -> std::result::Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(&shader.wgsl).map_err(|error| {
        format!(
            "{}\n{}\n{}",
            shader.name,
            error.emit_to_string(&shader.wgsl),
            shader.wgsl
        )
    })?;
    naga::valid::Validator::new(
        naga::valid::ValidationFlags::all(),
        naga::valid::Capabilities::default(),
    )
    .validate(&module)
    .map_err(|error| {
        format!(
            "{}\n{}\n{}",
            shader.name,
            error.emit_to_string(&shader.wgsl),
            shader.wgsl
        )
    })?;
    Ok(module)
}

/// Every surface module, by name.
fn surface_modules(library: &Library) -> Result<BTreeMap<String, AssembledShader>> {
    let mut modules = BTreeMap::new();
    for set in FeatureSet::reachable() {
        for stage in [
            Stage::Vertex,
            Stage::Fragment,
            Stage::SecondPass,
            Stage::FragmentCapture,
            Stage::FragmentGivenHit,
        ] {
            if let Entry::Vacant(vacant) = modules.entry(set.module_name(stage)) {
                let shader = library.assemble_surface(&set, stage)?;
                assert_eq!(&shader.name, vacant.key());
                vacant.insert(shader);
            }
        }
    }
    Ok(modules)
}

#[test]
#[expect(
    clippy::print_stdout,
    reason = "the number of permutations is a figure to watch, with --nocapture"
)]
fn every_reachable_permutation_is_valid() -> Result<()> {
    let library = Library::embedded()?;
    let start = Instant::now();
    let modules = surface_modules(&library)?;
    let each = start.elapsed() / modules.len() as u32;
    let (mut vertex, mut fragment, mut capture) = (0, 0, 0);
    for shader in modules.values() {
        if let Err(message) = validate(shader) {
            panic!("{message}");
        }
        match shader.name.as_str() {
            name if name.starts_with("surface_vertex") => vertex += 1,
            name if name.ends_with("-capture") || name.ends_with("-given_hit") => capture += 1,
            _ => fragment += 1,
        }
    }
    let permutations = FeatureSet::reachable().len();
    println!(
        "{permutations} permutations of {} modules ({vertex} vertex, {fragment} fragment), and {capture} for conformance; \
         assembled in {each:?} each",
        vertex + fragment
    );
    assert!(vertex + fragment < MOST_MODULES);
    Ok(())
}

#[test]
fn the_validator_is_not_blind() -> Result<()> {
    let mut shader = Library::embedded()?.assemble_kernel(Kernel::HeightToNormal)?;
    shader.wgsl = shader.wgsl.replacen("bake.slope", "bake.slop", 1);
    assert!(validate(&shader).is_err());
    Ok(())
}

#[test]
fn every_kernel_is_valid_and_has_its_entry() -> Result<()> {
    let library = Library::embedded()?;
    for kernel in Kernel::all() {
        let shader = library.assemble_kernel(kernel)?;
        let module = validate(&shader).unwrap_or_else(|message| panic!("{message}"));
        let [entry] = &module.entry_points[..] else {
            panic!("{} has not one entry point", shader.name)
        };
        assert_eq!(
            (entry.name.as_str(), entry.workgroup_size),
            (kernel.entry(), kernel.workgroup_size())
        );
    }
    Ok(())
}

#[test]
fn every_probe_is_valid_and_has_its_entry() -> Result<()> {
    let library = Library::embedded()?;
    for probe in PROBES {
        let shader = library.assemble_probe(probe.id)?;
        let module = validate(&shader).unwrap_or_else(|message| panic!("{message}"));
        let [entry] = &module.entry_points[..] else {
            panic!("{} has not one entry point", shader.name)
        };
        assert_eq!(
            (entry.name.as_str(), entry.workgroup_size),
            (probe.entry, [64, 1, 1])
        );
    }
    Ok(())
}

#[test]
fn assembling_is_deterministic_within_and_between_libraries() -> Result<()> {
    let (one, other) = (Library::embedded()?, Library::embedded()?);
    for set in FeatureSet::reachable().into_iter().step_by(17) {
        for stage in [Stage::Vertex, Stage::Fragment, Stage::FragmentCapture] {
            let first = one.assemble_surface(&set, stage)?;
            assert_eq!(first, one.assemble_surface(&set, stage)?);
            assert_eq!(first, other.assemble_surface(&set, stage)?);
        }
    }
    Ok(())
}

#[test]
fn threads_may_share_a_library() -> Result<()> {
    let library = Library::embedded()?;
    let sets = FeatureSet::reachable();
    let alone = |set: &FeatureSet| library.assemble_surface(set, Stage::Fragment);
    let expected: Vec<AssembledShader> = sets.iter().step_by(5).map(alone).collect::<Result<_>>()?;
    std::thread::scope(|scope| {
        let work = || sets.iter().step_by(5).map(alone).collect::<Result<Vec<_>>>();
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(work)).collect();
        for thread in threads {
            let result = thread.join().unwrap_or_else(|_| panic!("a thread panicked"));
            assert_eq!(result.ok().as_ref(), Some(&expected));
        }
    });
    Ok(())
}
