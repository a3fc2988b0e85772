//! A case on several machines at once: as many as there are cores, and one job at a time on each machine.
//!
//! Threads of our own, not those that the suites share their work among: whoever waits there for an expectation may be given another
//! bench of the same case to run, which would wait for the same expectation for ever.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{self, available_parallelism};

use crate::bench::Bench;

/// What `work` gives for each bench, in their order.
pub(crate) fn on_each<T: Send>(benches: &[Bench<'_>], work: impl Fn(&Bench<'_>) -> T + Sync) -> Vec<T> {
    let machines = by_machine(benches);
    let workers = available_parallelism().map_or(1, usize::from).min(machines.len());
    if workers < 2 {
        return benches.iter().map(work).collect();
    }
    let next = AtomicUsize::new(0);
    let turn = || {
        let mut done = Vec::new();
        while let Some(own) = machines.get(next.fetch_add(1, Ordering::Relaxed)) {
            done.extend(own.iter().map(|&index| (index, work(&benches[index]))));
        }
        done
    };
    let mut done: Vec<(usize, T)> = thread::scope(|scope| {
        let threads: Vec<_> = (0..workers).map(|_| scope.spawn(turn)).collect();
        let joined = threads.into_iter().map(|thread| thread.join());
        joined
            .flat_map(|done| done.unwrap_or_else(|panic| resume_unwind(panic)))
            .collect()
    });
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, result)| result).collect()
}

/// The benches of each machine, those with the most first: they take longest.
fn by_machine(benches: &[Bench<'_>]) -> Vec<Vec<usize>> {
    let mut machines: Vec<Vec<usize>> = Vec::new();
    for (index, bench) in benches.iter().enumerate() {
        let same = |own: &&mut Vec<usize>| std::ptr::addr_eq(benches[own[0]].device, bench.device);
        match machines.iter_mut().find(same) {
            Some(own) => own.push(index),
            None => machines.push(vec![index]),
        }
    }
    machines.sort_by_key(|own| std::cmp::Reverse(own.len()));
    machines
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use bossage_embedded::Embedded;
    use bossage_shaders::Library;

    use super::*;
    use crate::route::Route;

    #[test]
    fn results_come_in_the_order_of_the_benches_and_a_machine_does_one_thing_at_a_time() {
        let machines = [Embedded::new(), Embedded::new(), Embedded::new()];
        let library = Library::embedded().unwrap();
        let bench = |machine: usize| Bench::new(&machines[machine], Route::Embedded, &library);
        let benches = [0, 1, 0, 2, 1, 0].map(bench);
        assert_eq!(by_machine(&benches), [vec![0, 2, 5], vec![1, 4], vec![3]]);
        let busy: [Mutex<()>; 3] = Default::default();
        let which = |bench: &Bench<'_>| {
            let place = machines
                .iter()
                .position(|one| std::ptr::addr_eq(one, bench.device))
                .unwrap();
            let _alone = busy[place].try_lock().expect("nobody else is at it");
            thread::sleep(std::time::Duration::from_millis(5));
            place
        };
        assert_eq!(on_each(&benches, which), [0, 1, 0, 2, 1, 0]);
    }
}
