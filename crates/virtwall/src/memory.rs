//! Host memory for kept shots.

use std::sync::atomic::{AtomicUsize, Ordering};

/// A budget of bytes, which all problems that are worked on share.
pub struct Memory {
    limit: usize,
    used: AtomicUsize,
    most: AtomicUsize,
}

impl Memory {
    /// So many bytes.
    pub fn new(limit: usize) -> Memory {
        Memory { limit, used: AtomicUsize::new(0), most: AtomicUsize::new(0) }
    }

    /// The most that was in use at a time, bytes.
    pub fn most(&self) -> usize {
        self.most.load(Ordering::Relaxed)
    }

    /// Take so many bytes, if there are as many left.
    pub(crate) fn take(&self, bytes: usize) -> bool {
        let fits = |used: usize| used.checked_add(bytes).filter(|&sum| sum <= self.limit);
        let taken = self.used.fetch_update(Ordering::Relaxed, Ordering::Relaxed, fits);
        if let Ok(used) = taken {
            self.most.fetch_max(used + bytes, Ordering::Relaxed);
        }
        taken.is_ok()
    }

    /// Give bytes back that were taken.
    pub(crate) fn give_back(&self, bytes: usize) {
        self.used.fetch_sub(bytes, Ordering::Relaxed);
    }
}
