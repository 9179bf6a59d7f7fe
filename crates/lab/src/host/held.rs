//! Locks.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// A lock that does not mind another thread's panic: that ends the program anyway.
pub fn held<T: ?Sized>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
