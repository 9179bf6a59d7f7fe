//! The network: when a message arrives, what it costs the processors at both ends, and which messages
//! block which on the way.
//!
//! All models stand behind one trait, [`Network`]; [`NetworkModel`] lists them.

/// Which model is good enough.
mod auto;
/// Injection, links, ejection: what messages take in turns.
mod channel;
/// Messages that wait for each other in a circle.
mod deadlock;
/// Wormhole routing, flit by flit.
mod flit;
/// Models without contention.
mod formula;
/// Past holders of a channel.
mod holders;
/// Messages that cost nothing.
mod ideal;
/// Parameters of links and routers.
mod links;
/// LogGP.
mod loggp;
/// A message, as the network sees it.
mod message;
/// The models by name, and their parameters.
mod model;
/// The trait of all models.
mod network;
/// All messages of a run, recorded.
mod record;
/// Routers of the flit model.
mod routers;
/// Places, links and routes.
mod topology;
/// Wormhole routing, message by message.
mod wormhole;

pub use auto::{AutoResult, choose};
pub use channel::Channel;
pub use deadlock::{Deadlock, Waiting};
pub use flit::Flit;
pub use formula::{ContentionFree, Delivery, Formula};
pub use ideal::Ideal;
pub use links::LinkParameters;
pub use loggp::{LogGp, LogGpParameters};
pub use message::Message;
pub use model::{ModelChoice, NetworkModel, NetworkParameters};
pub use network::{Arrival, ChannelUse, Network, Stall};
pub use record::{Record, RecordedMessage, Recorder};
pub use topology::{Hop, Link, Place, Position, Shape, Topology};
pub use wormhole::Wormhole;
