//! A budget of host memory for kept shots.

use std::sync::atomic::{AtomicUsize, Ordering};

/// A budget of bytes that all problems of a sweep share.
pub struct Memory {
    limit: usize,
    used: AtomicUsize,
    most: AtomicUsize,
}

impl Memory {
    /// A budget of `limit` bytes.
    pub fn new(limit: usize) -> Memory {
        Memory { limit, used: AtomicUsize::new(0), most: AtomicUsize::new(0) }
    }

    /// The most bytes that were in use at a time.
    pub fn most(&self) -> usize {
        self.most.load(Ordering::Relaxed)
    }

    /// Take bytes from the budget; false if it has fewer left.
    pub(crate) fn take(&self, bytes: usize) -> bool {
        let fits = |used: usize| used.checked_add(bytes).filter(|&sum| sum <= self.limit);
        let taken = self.used.fetch_update(Ordering::Relaxed, Ordering::Relaxed, fits);
        if let Ok(used) = taken {
            self.most.fetch_max(used + bytes, Ordering::Relaxed);
        }
        taken.is_ok()
    }

    /// Give bytes back.
    pub(crate) fn give_back(&self, bytes: usize) {
        self.used.fetch_sub(bytes, Ordering::Relaxed);
    }
}
