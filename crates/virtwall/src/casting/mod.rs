//! How the host obtains a shot: cast now, kept from another run, or cast ahead of time by an idle thread.
//!
//! A shot depends on geometry alone, so results are the same whichever way it was obtained.

mod helpers;
mod kept_shots;
mod look_ahead;
mod memory;
mod meter;
mod shot_code;
mod shot_key;
mod waiters;

pub use helpers::Helpers;
pub use kept_shots::{Archive, KeptShots, ShotCounts};
pub(crate) use look_ahead::LookAhead;
pub use memory::Memory;
pub use meter::ShotMeter;
pub use shot_key::ShotKey;
