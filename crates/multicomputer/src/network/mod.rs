//! The network: when a message arrives and what it costs the processors at both ends.
//!
//! A ladder of models behind one trait. The first rungs know no contention; a rung that does would
//! keep the state of [`crate::Mesh`]'s links between deliveries.

mod delivery;
mod ideal;
mod loggp;
mod model;

pub use delivery::{Delivery, Network};
pub use ideal::Ideal;
pub use loggp::{LogGp, LogGpParameters};
pub use model::NetworkModel;
