//! The whole suite on every adapter and route of this machine.

use bossage_conformance::{Selection, Silent, Verdict, run};
use bossage_shaders::Library;

#[test]
fn the_library_conforms() {
    let library = Library::embedded().expect("the embedded library is whole");
    let selection = Selection { filter: std::env::var("CASE").ok(), ..Selection::default() };
    let start = std::time::Instant::now();
    let report = run(&selection, &library, &mut Silent).expect("an adapter");
    for case in &report.cases {
        if matches!(case.verdict, Verdict::Fail | Verdict::Warn) {
            println!("{} {} {:?}\n{:?}", case.route, case.id, case.reason, case.worst);
        }
    }
    println!("{:?} {:?}", report.totals(), start.elapsed());
    assert!(report.is_ok());
}
