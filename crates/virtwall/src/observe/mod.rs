//! Observers of simulated runs, and recordings.

mod energy;
mod observer;
mod observers;
mod recording;

pub use energy::EnergyLedger;
pub(crate) use energy::fraction;
pub use observer::{Activity, Observer, SentMessage, SharedObserver};
pub use observers::Observers;
pub use recording::{EnergyAt, MessageRecord, NodeRecord, Recording, ShotRecord, Span};
