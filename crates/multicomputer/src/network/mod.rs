//! The network: when a message arrives, what it costs the processors at both ends, and which messages
//! block which on the way.
//!
//! All models stand behind one trait, [`Network`]; [`NetworkModel`] lists them.

mod auto; // which model is good enough
mod channel; // injection, links, ejection: what messages take in turns
mod deadlock; // messages that wait for each other in a circle
mod flit; // wormhole routing, flit by flit
mod formula; // models without contention
mod holders; // past holders of a channel
mod ideal; // messages that cost nothing
mod links; // parameters of links and routers
mod loggp; // LogGP
mod message; // a message, as the network sees it
mod model; // the models by name, and their parameters
mod network; // the trait of all models
mod record; // all messages of a run, recorded
mod routers; // routers of the flit model
mod topology; // places, links and routes
mod wormhole; // wormhole routing, message by message

pub use auto::{AutoResult, choose};
pub use channel::Channel;
pub use deadlock::{Deadlock, Waiting};
pub use flit::Flit;
pub use formula::{ContentionFree, Delivery, Formula};
pub use ideal::Ideal;
pub use links::{LinkParameters, RouterStages};
pub use loggp::{LogGp, LogGpParameters};
pub use message::Message;
pub use model::{ModelChoice, NetworkModel, NetworkParameters};
pub use network::{Arrival, ChannelUse, Network, Stall};
pub use record::{Record, RecordedMessage, Recorder};
pub use topology::{Hop, Link, Place, Position, Shape, Topology};
pub use wormhole::Wormhole;
