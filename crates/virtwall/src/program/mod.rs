//! The programs of RR-3008: what a compute node and the service node do.
//!
//! They know their machine only as a [`Process`].

mod compute_node;
mod node_result;
mod process;
mod queue;
mod region;
mod rules;
mod service_node;
mod shared;
mod termination;
mod virtual_walls;

pub use compute_node::{ComputeNode, compute_node};
pub use node_result::{EnvironmentResult, NodeResult};
pub use process::{Event, NoProgress, Process, ProgramError, Step};
pub use queue::{Queue, Turn};
pub use rules::{Order, Rules, Selection, Ties};
pub use service_node::{Collection, Display, NoDisplay, service_node};
pub(crate) use shared::Shared;
