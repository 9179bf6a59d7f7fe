//! Memory of the nodes: what an experiment changes of a machine's, and what runs tell of it.

use multicomputer::NodeMemory;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use virtwall::{Outcome, Thing};

use crate::files::quantity::{Period, Size};

/// What an experiment says of the nodes' memory in place of the machine's file.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct NodeMemoryFields {
    /// What the operating system leaves of the installed memory.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub available: Option<Size>,
    /// What a patch takes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub patch: Option<Size>,
    /// Time of a page fault until its first byte comes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fault_time: Option<Period>,
}

impl NodeMemoryFields {
    /// Whether the experiment leaves all as it is.
    pub fn is_empty(&self) -> bool {
        *self == NodeMemoryFields::default()
    }

    /// Changes what the experiment names.
    pub fn lay_over(&self, memory: &mut NodeMemory) {
        let bytes = |size: &Size| size.value().round() as u64;
        if let Some(available) = &self.available {
            memory.available = bytes(available);
        }
        if let Some(patch) = &self.patch {
            memory.sizes.insert(Thing::Patch.name().to_owned(), bytes(patch));
        }
        if let Some(time) = &self.fault_time {
            memory.fault_time = desim::Duration::from_seconds_f64(time.value());
        }
    }
}

/// What a run tells of its nodes' memory, where that is modelled.
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
