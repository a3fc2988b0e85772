//! Route `msl` alone sees a fault of the emitted MSL: one that was planted there is refused on that route, and named.

#![allow(clippy::print_stderr, reason = "a skip must be seen")]

use bossage_conformance::bench::Bench;
use bossage_conformance::{Route, Selection, Verdict, machines};
use bossage_embedded::Embedded;
use bossage_runner::{
    AdapterInfo, AdapterSelector, Code, ComputeJob, ComputeOutput, DispatchLimits, Error, Machine, RenderJob,
    RenderOutput, Shader,
};
use bossage_shaders::Library;

/// A machine that gets every text of MSL with one component swapped for another.
#[derive(Debug)]
struct Planted(Box<dyn Machine>);

const GOOD: &str = "outputs[output + 0u] = _e29.x;";
const SWAPPED: &str = "outputs[output + 0u] = _e29.y;";

impl Machine for Planted {
    fn info(&self) -> &AdapterInfo {
        self.0.info()
    }

    fn dispatch_limits(&self) -> DispatchLimits {
        self.0.dispatch_limits()
    }

    fn compute(&self, job: &ComputeJob<'_>) -> Result<ComputeOutput, Error> {
        let Code::Msl(text) = job.shader.code else {
            panic!("route msl hands over MSL")
        };
        assert!(text.contains(GOOD), "the text has changed: {text}");
        let text = text.replace(GOOD, SWAPPED);
        let shader = Shader {
            code: Code::Msl(&text),
            ..job.shader
        };
        self.0.compute(&ComputeJob {
            shader,
            ..job.clone()
        })
    }

    fn render(&self, job: &RenderJob<'_>) -> Result<RenderOutput, Error> {
        self.0.render(job)
    }
}

fn clang() -> Option<Box<dyn Machine>> {
    if let Some(reason) = Route::Msl.missing() {
        let list = std::env::var("BOSSAGE_REQUIRE").unwrap_or_default();
        assert!(!list.split(',').any(|name| name.trim() == "clang"), "{reason}");
        eprintln!("SKIP 1 test: {reason}");
        return None;
    }
    Some(machines::open(&AdapterSelector::named(bossage_metal::NAME)).unwrap())
}

#[test]
fn a_component_that_is_swapped_in_the_emitted_msl_is_refused_on_that_route_alone_and_named() {
    let (Some(sound), Some(other)) = (clang(), clang()) else {
        return;
    };
    let (planted, embedded) = (Planted(other), Embedded::new());
    let library = Library::embedded().unwrap();
    let benches = [
        Bench::new(&embedded, Route::Embedded, &library),
        Bench::new(sound.as_ref(), Route::Msl, &library),
        Bench::new(&planted, Route::Msl, &library),
    ];
    let selection = Selection {
        filter: Some("normal_mips/hardened/edge".to_owned()),
        ..Selection::default()
    };
    let cases = selection.cases().unwrap();
    let case = cases
        .iter()
        .find(|case| case.id().to_string() == "normal_mips/hardened/edge");
    let case = case.expect("the case is there").as_ref();
    let outcomes = case.run_all(&benches);
    let results: Vec<_> = outcomes
        .into_iter()
        .zip(&benches)
        .map(|(outcome, bench)| outcome.into_result(case, bench))
        .collect();
    let verdicts: Vec<Verdict> = results.iter().map(|result| result.verdict).collect();
    assert_eq!(
        verdicts,
        [Verdict::Pass, Verdict::Pass, Verdict::Fail],
        "{results:?}"
    );
    let named = &results[2];
    assert_eq!(
        (named.route, named.adapter.as_str()),
        (Route::Msl, bossage_metal::NAME)
    );
    assert_eq!(named.id.to_string(), "normal_mips/hardened/edge");
    assert!(named.refused > 0 && named.reason.as_ref().is_some_and(|why| why.contains("refused")));
}
