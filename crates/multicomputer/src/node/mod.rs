//! A node: processor, caches, memory, message layer, and where its time goes.

/// Where a node's time went.
mod account;
/// Buffers for messages that were not read, and deadlock by full buffers.
mod buffers;
/// Data caches and translation look-aside buffer.
mod cache;
/// Memory and paging.
mod memory;
/// Packets, coprocessor, copies, buffers.
mod message_layer;
/// A node as the process on it sees it.
mod node;
/// The interface for observers of a run.
mod observer;
/// Prices of operations.
mod processor;
/// What the nodes of a running machine share.
mod shared;
/// Reading of input at start-up.
mod start_up;

pub use account::{Activity, LayerAccount, NodeAccount};
pub(crate) use buffers::Buffers;
pub use buffers::{FullBuffers, Rank};
pub use cache::{CacheLevel, Caches};
pub use memory::{NodeMemory, Segment};
pub(crate) use message_layer::MessageLayerFile;
pub use message_layer::{MessageLayer, Packets};
pub use node::Node;
pub use observer::{MachineObserver, Sent};
pub use processor::Processor;
pub(crate) use shared::{NodeState, Shared, Wires};
pub(crate) use start_up::StartUpFile;
pub use start_up::{Reading, StartUp};
