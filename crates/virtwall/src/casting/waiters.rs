//! A condition variable that makes no system call when no thread waits.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, MutexGuard, PoisonError};

/// A condition variable that counts its waiting threads: to notify one is a system call, even when none waits.
#[derive(Default)]
pub(super) struct Waiters {
    changed: Condvar,
    waiting: AtomicUsize,
}

impl Waiters {
    /// Wait until the guarded state may have changed. A thread changes the state under the mutex and then
    /// notifies. So either it sees this thread in the count, or this thread has seen the change.
    pub fn wait<'a, T>(&self, held: MutexGuard<'a, T>) -> MutexGuard<'a, T> {
        self.waiting.fetch_add(1, Ordering::Relaxed);
        let held = self.changed.wait(held).unwrap_or_else(PoisonError::into_inner);
        self.waiting.fetch_sub(1, Ordering::Relaxed);
        held
    }

    /// Wake one waiting thread.
    pub fn notify_one(&self) {
        if self.waiting.load(Ordering::Relaxed) > 0 {
            self.changed.notify_one();
        }
    }

    /// Wake all waiting threads.
    pub fn notify_all(&self) {
        if self.waiting.load(Ordering::Relaxed) > 0 {
            self.changed.notify_all();
        }
    }
}
