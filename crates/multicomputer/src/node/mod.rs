//! A node: processor, caches, memory, message layer, and where its time goes.

mod account; // a node's time by activity
mod buffers; // finite buffers for messages
mod cache; // data caches and translation look-aside buffer
mod coprocessor; // a second processor for messages
mod envelope; // a message with sender and receiver
mod full_buffers; // deadlock by full buffers
mod memory; // memory and paging
mod message_layer; // packets, coprocessor, copies, buffers: what a machine file says
mod node; // the interface for the process on a node
mod observer; // the interface for observers of a run
mod processor; // the time of operations
mod shared; // all nodes of a running machine
mod start_up; // reading of input at start-up
mod state; // the state of one node
mod transport; // the network and the messages in flight

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
