//! The network: when a message arrives, what it costs the processors at both ends, and who holds up
//! whom on the way.
//!
//! A ladder of models behind one trait, [`Network`]; [`Rung`] lists them.

mod channel;
mod deadlock;
mod delivery;
mod flit;
mod formula;
mod ideal;
mod links;
mod loggp;
mod message;
mod routers;
mod rung;
mod tenants;
mod wormhole;

pub use channel::Channel;
pub use deadlock::{Deadlock, Waiting};
pub use delivery::{Arrival, ChannelUse, Network, Stall};
pub use flit::Flit;
pub use formula::{Delivery, Foretold, Formula};
pub use ideal::Ideal;
pub use links::LinkParameters;
pub use loggp::{LogGp, LogGpParameters};
pub use message::Message;
pub use rung::{Model, NetworkParameters, Rung};
pub use wormhole::Wormhole;
