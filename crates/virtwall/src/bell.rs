//! Wakes threads that wait for something to change, and costs next to nothing where none does.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, MutexGuard, PoisonError};

/// A condition variable that knows whether anybody waits: to wake is a call of the system, even if there is
/// nobody to wake.
#[derive(Default)]
pub(crate) struct Bell {
    changed: Condvar,
    waiting: AtomicUsize,
}

impl Bell {
    /// Wait for what the guarded state is to become. Whoever changes it rings afterwards: it has then
    /// either been seen, or the mutex has passed on that somebody waits.
    pub(crate) fn wait<'a, T>(&self, held: MutexGuard<'a, T>) -> MutexGuard<'a, T> {
        self.waiting.fetch_add(1, Ordering::Relaxed);
        let held = self.changed.wait(held).unwrap_or_else(PoisonError::into_inner);
        self.waiting.fetch_sub(1, Ordering::Relaxed);
        held
    }

    /// Wake one thread that waits.
    pub(crate) fn ring_for_one(&self) {
        if self.waiting.load(Ordering::Relaxed) > 0 {
            self.changed.notify_one();
        }
    }

    /// Wake all that wait.
    pub(crate) fn ring(&self) {
        if self.waiting.load(Ordering::Relaxed) > 0 {
            self.changed.notify_all();
        }
    }
}
