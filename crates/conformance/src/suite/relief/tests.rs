//! Shaders that are broken on purpose are refused: on the evaluator, without an adapter.

use bossage_embedded::Embedded;
use bossage_shaders::{HeightRead, Library, LightTechnique, ReliefLight, ReliefSearch, ReliefTechnique};

use super::cones::ConeCase;
use super::exact::ExactCase;
use super::light::LightCase;
use super::maps;
use super::marching::MarchCase;
use crate::bench::Bench;
use crate::case::Case;
use crate::route::Route;
use crate::verdict::Verdict;

/// The case of a technique on a map: of its own promises where it has such.
fn case(technique: ReliefTechnique, map: &str) -> Box<dyn Case> {
    let field = maps::all().into_iter().find(|(name, _)| *name == map).unwrap().1;
    let heights = HeightRead::FourLoads;
    let search = ReliefSearch { technique, heights };
    match technique {
        ReliefTechnique::Exact => Box::new(ExactCase::new(heights, map, field)),
        ReliefTechnique::ConeStep => Box::new(ConeCase::new(search, map, field)),
        _ => Box::new(MarchCase::new(search, map, field)),
    }
}

fn verdict(library: &Library, technique: ReliefTechnique, map: &str) -> (Verdict, String) {
    let machine = Embedded::new();
    let outcome = case(technique, map).run(&Bench::new(&machine, Route::Embedded, library));
    (outcome.verdict, outcome.reason.unwrap_or_default())
}

/// The library with one text in one file replaced.
fn broken(file: &str, was: &str, is: &str) -> Library {
    let folder = tempfile::tempdir().unwrap();
    let shaders = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shaders");
    for entry in walk(&shaders) {
        let to = folder.path().join(entry.strip_prefix(&shaders).unwrap());
        std::fs::create_dir_all(to.parent().unwrap()).unwrap();
        std::fs::copy(&entry, &to).unwrap();
    }
    let path = folder.path().join(file);
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains(was), "{file} has no `{was}`");
    std::fs::write(&path, text.replacen(was, is, 1)).unwrap();
    Library::from_dir(folder.path()).unwrap_or_else(|why| panic!("{why}"))
}

fn walk(dir: &std::path::Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(dir).unwrap().map(|entry| entry.unwrap().path());
    entries
        .flat_map(|path| if path.is_dir() { walk(&path) } else { vec![path] })
        .collect()
}

/// File, text, what it becomes, and the technique that must be refused for it.
const FAULTS: &[(&str, &str, &str, ReliefTechnique)] = &[
    // The first layer is left out.
    (
        "techniques/steep_parallax.wesl",
        "var layer = 1u;",
        "var layer = 2u;",
        ReliefTechnique::SteepParallax,
    ),
    // The secant from the wrong end.
    (
        "techniques/parallax_occlusion.wesl",
        "march.step * (1.0 - secant",
        "march.step * (secant",
        ReliefTechnique::ParallaxOcclusion,
    ),
    // The upper end of the bracket.
    (
        "techniques/relief.wesl",
        "select(t, middle, gap >= 0.0)",
        "select(middle, t, gap >= 0.0)",
        ReliefTechnique::Relief,
    ),
    // Steps by half of the gap.
    (
        "techniques/parallax_iterative.wesl",
        "(surface - elevation) * normal_z",
        "0.5 * (surface - elevation) * normal_z",
        ReliefTechnique::ParallaxIterative,
    ),
    // Cones four times as wide.
    (
        "techniques/cone_step.wesl",
        "gap * (ratio / (ratio + reach))",
        "gap * (4.0 * ratio / (4.0 * ratio + reach))",
        ReliefTechnique::ConeStep,
    ),
    // A ray that is not there yet says that it is.
    (
        "techniques/cone_step.wesl",
        "select(STATUS_CAP_REACHED, ray.status",
        "select(ray.status, ray.status",
        ReliefTechnique::ConeStep,
    ),
    // Bisection away from the surface.
    (
        "techniques/relaxed_cone_step.wesl",
        "select(-half, half, gap > 0.0)",
        "select(half, -half, gap > 0.0)",
        ReliefTechnique::RelaxedConeStep,
    ),
    // The other root.
    (
        "techniques/exact.wesl",
        "select(root - gap.y, -2.0 * gap.x, rises)",
        "select(root + gap.y, -2.0 * gap.x, rises)",
        ReliefTechnique::Exact,
    ),
    // Straight down, where every depth is on the ray, another than the surface's.
    (
        "techniques/exact.wesl",
        "return HitRecord(ray.uv_top + hit * ray.delta, hit, status);",
        "return HitRecord(ray.uv_top + hit * ray.delta, select(hit, 0.5 * hit, dot(ray.delta, ray.delta) < 1e-12), status);",
        ReliefTechnique::Exact,
    ),
    // Windows are left too late.
    (
        "techniques/exact.wesl",
        "(block + 1.0 - place) * course.one",
        "(block + 2.0 - place) * course.one",
        ReliefTechnique::Exact,
    ),
    // Windows of rays that come from the other side.
    (
        "techniques/exact.wesl",
        "-1.0 - block, block",
        "course.blocks - 1.0 - block, block",
        ReliefTechnique::Exact,
    ),
    // Behind a window the walk goes on in the cell before it.
    (
        "techniques/exact.wesl",
        "select(next, floor(origin + t * along), t > end)",
        "next",
        ReliefTechnique::Exact,
    ),
    // Beyond the tile its last windows go on.
    (
        "techniques/exact.wesl",
        "turn * course.period",
        "0.0 * course.period",
        ReliefTechnique::Exact,
    ),
    // A summit between the ends of a cell is passed over.
    (
        "techniques/exact.wesl",
        "let summit = gap.y > 0.0",
        "let summit = gap.y > 100.0",
        ReliefTechnique::Exact,
    ),
    // Wrong texels beyond the border.
    (
        "lib/edge.wesl",
        "min(k, 2 * n - 1 - k)",
        "min(k, n - 1)",
        ReliefTechnique::Exact,
    ),
    // Without the cap a view from the side has no end; with another one its hits lie elsewhere.
    (
        "lib/relief_ray.wesl",
        "max(view_dir_ts.z, MIN_VIEW_Z)",
        "max(view_dir_ts.z, 0.1)",
        ReliefTechnique::Exact,
    ),
    // The status of a clamped ray.
    (
        "lib/relief_ray.wesl",
        "select(STATUS_HIT, STATUS_CLAMPED, view_dir_ts.z < MIN_VIEW_Z)",
        "STATUS_HIT",
        ReliefTechnique::SteepParallax,
    ),
    // Not finite, and not said.
    (
        "lib/relief_ray.wesl",
        "is_finite(view_dir_ts) && is_finite(layer)",
        "is_finite(layer)",
        ReliefTechnique::ParallaxOcclusion,
    ),
];

#[test]
fn the_library_as_it_is_keeps_its_promises() {
    let library = Library::embedded().unwrap();
    for technique in ReliefTechnique::ALL {
        let (verdict, reason) = verdict(&library, technique, "noise");
        assert_eq!(verdict, Verdict::Pass, "{technique:?}: {reason}");
    }
}

/// The same for shadows.
const DARK_FAULTS: &[(&str, &str, &str, LightTechnique)] = &[
    // The first sample is left out.
    (
        "techniques/self_shadow.wesl",
        "var sample = 1u; over",
        "var sample = 2u; over",
        LightTechnique::SelfShadow,
    ),
    // The ray goes down.
    (
        "techniques/self_shadow.wesl",
        "(ground + s)",
        "(ground - s)",
        LightTechnique::SelfShadow,
    ),
    // From where the search stopped instead of from the surface.
    (
        "techniques/self_shadow.wesl",
        "height_at(height_map, height_sampler, read, hit.uv);",
        "1.0 - hit.t;",
        LightTechnique::SelfShadow,
    ),
    (
        "techniques/soft_shadow.wesl",
        "let ground = height_at(height_map, height_sampler, read, hit.uv);",
        "let ground = 1.0 - hit.t;",
        LightTechnique::SoftShadow,
    ),
    // A light below the horizon.
    (
        "techniques/self_shadow.wesl",
        "light_dir_ts.z <= 0.0",
        "light_dir_ts.z <= -2.0",
        LightTechnique::SelfShadow,
    ),
    // Heights over the floor instead of over the place.
    (
        "techniques/soft_shadow.wesl",
        "(height - ground) / s",
        "height / s",
        LightTechnique::SoftShadow,
    ),
    (
        "techniques/soft_shadow.wesl",
        "(2.0 * w)",
        "w",
        LightTechnique::SoftShadow,
    ),
];

fn light_verdict(library: &Library, technique: LightTechnique) -> (Verdict, String) {
    let heights = HeightRead::FourLoads;
    let field = maps::all()
        .into_iter()
        .find(|(name, _)| *name == "noise")
        .unwrap()
        .1;
    let case = LightCase::new(ReliefLight { technique, heights }, "noise", field);
    let machine = Embedded::new();
    let outcome = case.run(&Bench::new(&machine, Route::Embedded, library));
    (outcome.verdict, outcome.reason.unwrap_or_default())
}

#[test]
fn shadows_keep_their_promises_and_broken_ones_are_refused() {
    let library = Library::embedded().unwrap();
    for technique in LightTechnique::ALL {
        let (verdict, reason) = light_verdict(&library, technique);
        assert_eq!(verdict, Verdict::Pass, "{technique:?}: {reason}");
    }
    for (file, was, is, technique) in DARK_FAULTS {
        let (verdict, reason) = light_verdict(&broken(file, was, is), *technique);
        assert_eq!(verdict, Verdict::Fail, "{file}: `{is}` passes: {reason}");
    }
}

#[test]
fn what_is_broken_is_refused() {
    for (file, was, is, technique) in FAULTS {
        let (verdict, reason) = verdict(&broken(file, was, is), *technique, "noise");
        assert_eq!(verdict, Verdict::Fail, "{file}: `{is}` passes: {reason}");
    }
}
