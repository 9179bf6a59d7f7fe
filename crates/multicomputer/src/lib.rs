//! What a distributed-memory machine costs: its processors, its mesh, its message layer.
//!
//! Knows nothing of patches, masks or light: an operation is a name with a price, a message a
//! number of bytes. A [`Machine`] is what a file in `machines/` says, checked once; a
//! [`Multicomputer`] is such a machine running over [`desim`], whose processes each hold a
//! [`Node`].

mod account;
mod agenda;
mod auto;
mod buffers;
mod cache;
mod display;
mod ethernet;
mod fault;
mod file;
mod kernels;
mod machine;
mod memory;
mod message_layer;
mod multicomputer;
mod network;
mod node;
mod observer;
mod processor;
pub mod quantity;
mod record;
mod repetition;
mod replay;
mod shared;
mod socket;
mod sourced;
mod start_up;
mod topology;
mod trace;
mod traffic;

pub use account::{Activity, LayerAccount, NodeAccount};
pub use auto::{Choice, choose};
pub use buffers::{FullBuffers, Rank};
pub use cache::{CacheLevel, Caches};
pub use display::{Display, WhenFull};
pub use ethernet::Ethernet;
pub use fault::MachineFault;
pub use file::machine_schema;
pub use kernels::{KernelError, exchange, hot_spot, ping_pong};
pub use machine::{Machine, MachineError, Published};
pub use memory::{NodeMemory, Segment};
pub use message_layer::{MessageLayer, Packets};
pub use multicomputer::Multicomputer;
pub use network::{
    Arrival, Channel, ChannelUse, Deadlock, Delivery, Flit, Foretold, Formula, Ideal,
    LinkParameters, LogGp, LogGpParameters, Message, Model, Network, NetworkParameters, Rung,
    Stall, Waiting, Wormhole,
};
pub use node::Node;
pub use observer::{MachineObserver, Sent};
pub use processor::Processor;
pub use record::{Letter, Record, Recorder};
pub use replay::{Course, ReplayDeadlock, replay};
pub use socket::{DisplayAccount, Socket};
pub use start_up::{Reading, StartUp};
pub use topology::{Hop, Link, Place, Position, Shape, Topology};
pub use trace::{Item, Trace, trace_schema};
pub use traffic::{Load, Measured, Pattern, fluid_bound};
