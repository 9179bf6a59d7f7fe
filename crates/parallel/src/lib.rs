//! Distributes independent pieces of work over threads of the host. Results are in the order of the pieces, so
//! they do not depend on the number of threads.
//!
//! Written with the standard library, since rayon would add several seconds to a build for one function.

use std::io::{self, Write};
use std::sync::Once;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{self, Scope, ScopedJoinHandle};
use std::{hint, iter, panic};

/// Host memory that is left to the work if threads take all that the host allows, bytes.
const RESERVE: usize = 256 << 20;

/// Computes `work(0)` to `work(count - 1)` on `threads` threads, or as many as can be started. A thread takes the
/// next number when it is free; the calling thread is one of them.
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
        let others = start(scope, threads.clamp(1, count.max(1)) - 1, share);
        let mut results = share();
        for thread in others {
            results.extend(thread.join().unwrap_or_else(|cause| panic::resume_unwind(cause)));
        }
        results
    });
    results.sort_unstable_by_key(|&(number, _)| number);
    results.into_iter().map(|(_, result)| result).collect()
}

/// Starts `count` threads that help the calling one with `work`, or as many as the host allows. If they are
/// fewer, a note on standard error says so, once a process.
pub fn start<'scope, T: Send + 'scope>(
    scope: &'scope Scope<'scope, '_>,
    count: usize,
    work: impl Fn() -> T + Copy + Send + 'scope,
) -> Vec<ScopedJoinHandle<'scope, T>> {
    let mut reserve = Vec::<u8>::new();
    // Without it, as little memory is left as the limits leave.
    let _ = reserve.try_reserve_exact(if count > 0 { RESERVE } else { 0 });
    hint::black_box(&mut reserve);
    let mut started = Vec::new();
    while started.len() < count {
        match thread::Builder::new().spawn_scoped(scope, work) {
            Ok(thread) => started.push(thread),
            Err(error) => {
                note_missing(started.len() + 1, count + 1, &error);
                break;
            }
        }
    }
    started
}

fn note_missing(threads: usize, wanted: usize, error: &io::Error) {
    static NOTED: Once = Once::new();
    NOTED.call_once(|| {
        let note = format!("note: {wanted} threads wanted, {threads} there: {error}");
        // A closed standard error is no reason to fail.
        let _ = writeln!(io::stderr().lock(), "{note}");
    });
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
