//! Locks.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Locks, also after another thread's panic, which ends the program anyway.
pub fn held<T: ?Sized>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
