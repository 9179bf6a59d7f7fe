//! Back ends: what the programs run on. Each is a folder of its own.

mod error;
mod host;
mod prepared;
mod progress;
pub(crate) mod simulated;
pub(crate) mod threads;

pub use error::RunError;
