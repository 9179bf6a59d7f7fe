//! Distributes independent pieces of work over threads of the host. Results are in the order of the pieces, so
//! they do not depend on the number of threads.
//!
//! Written with the standard library, since rayon would add several seconds to a build for one function.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::{iter, panic, thread};

/// Computes `work(0)` to `work(count - 1)` on `threads` threads. A thread takes the next number when it is free.
///
/// # Panics
/// If `work` does.
pub fn map<T: Send>(count: usize, threads: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let share = || {
        let numbers = || Some(next.fetch_add(1, Ordering::Relaxed)).filter(|&n| n < count);
        iter::from_fn(numbers).map(|n| (n, work(n))).collect::<Vec<_>>()
    };
    let mut results = thread::scope(|scope| {
        let threads = threads.clamp(1, count.max(1));
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(share)).collect();
        let join = |thread: thread::ScopedJoinHandle<'_, _>| {
            thread.join().unwrap_or_else(|cause| panic::resume_unwind(cause))
        };
        threads.into_iter().flat_map(join).collect::<Vec<_>>()
    });
    results.sort_unstable_by_key(|&(number, _)| number);
    results.into_iter().map(|(_, result)| result).collect()
}

/// The number of processors of this host.
pub fn host_threads() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

#[cfg(test)]
mod tests {
    use super::map;

    #[test]
    fn results_come_in_order() {
        let squares: Vec<usize> = (0..100).map(|n| n * n).collect();
        for threads in [0, 1, 3, 200] {
            assert_eq!(map(100, threads, |n| n * n), squares);
        }
        assert_eq!(map(0, 2, |n| n), []);
    }
}
