//! What a processor takes for counted operations.

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
    /// Its caches, the nearest first; none where the cycles hold what misses cost.
    pub caches: Vec<CacheLevel>,
    /// The translations of addresses that it holds, as a cache of pages; none where all are known.
    pub translations: Option<CacheLevel>,
}

impl Processor {
    /// Seconds that an operation takes, cycles × scale / clock; `None` for one without a price.
    pub fn price(&self, operation: &str) -> Option<f64> {
        self.cycles.get(operation).map(|cycles| cycles * self.scale / self.clock)
    }
}
