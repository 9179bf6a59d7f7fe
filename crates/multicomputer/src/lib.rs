//! A distributed-memory machine and what it costs: processors, memory, message layer, network, display.
//!
//! Knows nothing of patches, masks or light: an operation is a name with a price, a message a
//! number of bytes. A [`Machine`] is the checked content of a file in `machines/`; a
//! [`Multicomputer`] is such a machine running over [`desim`], whose processes each hold a
//! [`Node`].

mod bench; // small programs and traffic that measure machines
mod display; // from the service node to a display: frames, Ethernet, back pressure
mod machine; // the machine: its file, checked, and running
mod network; // when messages arrive: topologies and the ladder of network models
mod node; // a node: processor, caches, memory, message layer, and where its time goes
mod sourced; // numbers of a machine file, with their provenance

pub use bench::{
    KernelError, Load, Measured, Operation, OperationKind, Pattern, ReplayDeadlock,
    ReplayedMessage, Schedule, StalledSchedule, Trace, TraceMessage, Workload, exchange,
    fluid_bound, hot_spot, perform, ping_pong, replay, trace_schema,
};
pub use display::{Display, DisplayAccount, Ethernet, Socket, WhenFull};
pub use machine::{
    Machine, MachineError, Multicomputer, Published, machine_changes_schema, machine_schema,
    with_source,
};
pub use network::{
    Arrival, AutoResult, Channel, ChannelUse, ContentionFree, Deadlock, Delivery, Flit, Formula,
    Hop, Ideal, Link, LinkParameters, LogGp, LogGpParameters, Message, ModelChoice, Network,
    NetworkModel, NetworkParameters, Place, Position, Record, RecordedMessage, Recorder,
    RouterStages, Shape, Stall, Topology, Waiting, Wormhole, choose,
};
pub use node::{
    Activity, CacheLevel, Caches, FullBuffers, LayerAccount, MachineObserver, MessageLayer, Node,
    NodeAccount, NodeMemory, Packets, Processor, Rank, Reading, Segment, Sent, StartUp,
};
