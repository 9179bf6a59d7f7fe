//! A node: processor, caches, memory, message layer, and where its time goes.

/// A node's time by activity.
mod account;
/// Finite buffers for messages.
mod buffers;
/// Data caches and translation look-aside buffer.
mod cache;
/// A second processor for messages.
mod coprocessor;
/// A message with sender and receiver.
mod envelope;
/// Deadlock by full buffers.
mod full_buffers;
/// Memory and paging.
mod memory;
/// Packets, coprocessor, copies, buffers: what a machine file says.
mod message_layer;
/// The interface for the process on a node.
mod node;
/// The interface for observers of a run.
mod observer;
/// The time of operations.
mod processor;
/// All nodes of a running machine.
mod shared;
/// Reading of input at start-up.
mod start_up;
/// The state of one node.
mod state;
/// The network and the messages in flight.
mod transport;

pub use account::{Activity, LayerAccount, NodeAccount};
pub(crate) use buffers::Buffers;
pub use cache::{CacheLevel, Caches};
pub use envelope::Rank;
pub use full_buffers::FullBuffers;
pub use memory::{NodeMemory, Segment};
pub(crate) use message_layer::MessageLayerFile;
pub use message_layer::{MessageLayer, Packets};
pub use node::Node;
pub use observer::{MachineObserver, Sent};
pub use processor::Processor;
pub(crate) use shared::Shared;
pub(crate) use start_up::StartUpFile;
pub use start_up::{Reading, StartUp};
pub(crate) use state::NodeState;
