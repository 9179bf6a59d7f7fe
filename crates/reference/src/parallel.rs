//! The same work done by several threads, with the same results.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

/// `work(0)` to `work(count - 1)` by as many threads; `done` hears of each that ends.
pub fn map<T: Send>(
    count: usize,
    threads: usize,
    work: impl Fn(usize) -> T + Sync,
    mut done: impl FnMut(),
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let mut results: Vec<Option<T>> = (0..count).map(|_| None).collect();
    std::thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        for _ in 0..threads.clamp(1, count.max(1)) {
            let (sender, next, work) = (sender.clone(), &next, &work);
            scope.spawn(move || {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= count || sender.send((number, work(number))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        for (number, result) in receiver {
            results[number] = Some(result);
            done();
        }
    });
    // A thread that panics makes the scope panic: here every number has its result.
    results.into_iter().flatten().collect()
}

/// One for each of this host's processors.
pub fn host_threads() -> usize {
    std::thread::available_parallelism().map_or(1, |processors| processors.get())
}
