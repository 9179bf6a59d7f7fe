//! A processor: the time of counted operations.

use std::collections::BTreeMap;

use super::cache::CacheLevel;

/// A processor that takes a fixed number of cycles for each operation.
#[derive(Clone, Debug, PartialEq)]
pub struct Processor {
    /// Cycles a second, Hz.
    pub clock: f64,
    /// Factor on all cycle counts: compiled code is slower than operations counted by hand.
    pub scale: f64,
    /// Cycles of each operation, by name.
    pub cycles: BTreeMap<String, f64>,
    /// Its caches, the nearest first; none where the cycles include the cost of misses.
    pub caches: Vec<CacheLevel>,
    /// Its translation look-aside buffer, as a cache of pages; none where translations cost nothing.
    pub translations: Option<CacheLevel>,
}

impl Processor {
    /// Seconds that an operation takes, cycles × scale / clock; `None` for an unknown operation.
    pub fn price(&self, operation: &str) -> Option<f64> {
        self.cycles.get(operation).map(|cycles| cycles * self.scale / self.clock)
    }

    /// Lines of all its caches: a simulation holds the number of each.
    pub fn cache_lines(&self) -> u64 {
        self.caches.iter().map(|level| level.size / level.line).sum()
    }
}
