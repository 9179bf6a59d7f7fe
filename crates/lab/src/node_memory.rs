//! Memory of the nodes: what an experiment changes of a machine's, and what runs tell of it.

use std::borrow::Cow;

use multicomputer::{Machine, NodeMemory};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use virtwall::{Outcome, Thing};

use crate::experiment::Experiment;
use crate::quantity::Size;

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
    /// What one page fault brings in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub burst: Option<Size>,
}

impl NodeMemoryFields {
    /// Whether the experiment leaves all as it is.
    pub fn is_empty(&self) -> bool {
        *self == NodeMemoryFields::default()
    }

    fn lay_over(&self, memory: &mut NodeMemory) {
        let bytes = |size: &Size| size.value().round() as u64;
        for (field, size) in
            [(&mut memory.available, &self.available), (&mut memory.burst, &self.burst)]
        {
            *field = size.as_ref().map_or(*field, bytes);
        }
        let patch = self.patch.as_ref().map(bytes);
        memory.sizes.extend(patch.map(|bytes| (Thing::Patch.name().to_owned(), bytes)));
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

/// The machine as a point of an experiment has it.
pub fn machine<'a>(machine: &'a Machine, point: &Experiment) -> Cow<'a, Machine> {
    let mut machine = Cow::Borrowed(machine);
    if machine.node_memory.is_some() && !point.node_memory.is_empty() {
        machine
            .to_mut()
            .node_memory
            .iter_mut()
            .for_each(|memory| point.node_memory.lay_over(memory));
    }
    machine
}

/// The figures of a run on a machine whose memory is modelled.
pub fn figures(outcome: &Outcome) -> Option<NodeMemoryFigures> {
    let marks = outcome.nodes.iter().filter_map(|node| node.memory_high_water);
    let paging: desim::Duration = outcome.nodes.iter().map(|node| node.paging).sum();
    let figures = |high_water| NodeMemoryFigures { high_water, paging_s: paging.as_seconds_f64() };
    marks.max().map(figures)
}
