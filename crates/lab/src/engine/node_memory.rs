//! Figures of the memory of nodes in a run's results.

use serde::{Deserialize, Serialize};
use virtwall::Outcome;

/// Figures of the nodes' memory in a run's results, if the machine models it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NodeMemoryFigures {
    /// The most bytes that program and message buffers of one node have held.
    pub high_water: u64,
    /// How long nodes waited for pages, all added, seconds.
    pub paging_s: f64,
}

/// The figures of a run on a machine whose memory is modelled.
pub fn figures(outcome: &Outcome) -> Option<NodeMemoryFigures> {
    let marks = outcome.nodes.iter().filter_map(|node| node.memory_high_water);
    let paging: desim::Duration = outcome.nodes.iter().map(|node| node.paging).sum();
    let figures = |high_water| NodeMemoryFigures { high_water, paging_s: paging.as_seconds_f64() };
    marks.max().map(figures)
}
