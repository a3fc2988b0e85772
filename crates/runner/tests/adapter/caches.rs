//! What a device compiled is kept.

use crate::compute::{DOUBLE, probe, ramp};
use crate::support::{compile, device};

#[test]
fn what_is_compiled_once_is_not_compiled_again() {
    let Some(device) = device("what_is_compiled_once_is_not_compiled_again") else {
        return;
    };
    // A text of its own, since the device is shared between tests that run at the same time.
    let own = compile(&DOUBLE.replace("2.0 *", "32.0 *"));
    let inputs = ramp(10);
    probe(own.wgsl("double"), &inputs, None).run(device).unwrap();
    let start = std::time::Instant::now();
    for _ in 0..50 {
        probe(own.wgsl("double"), &inputs, None).run(device).unwrap();
    }
    let sizes = device.cache_sizes();
    // Every text of these tests is one module; 50 uncached runs would have added 50.
    assert!(
        sizes.modules < 50 && sizes.pipelines < 50,
        "{sizes:?} after {:?}",
        start.elapsed()
    );
}
