//! The programs on a simulated machine: what their steps, messages and memory cost.

mod footprint;
mod interpreter;
mod layout;
mod prices;
mod process;
mod simulation;
mod start_up;
mod start_up_step;
mod storage;

pub use footprint::Thing;
pub use layout::Layout;
pub use simulation::{simulate, simulate_observed, simulate_over};
pub use start_up::{StartUpReport, start_up};
pub use start_up_step::StartUpStep;
pub use storage::Storage;
