//! Virtual time, the event queue, and processes written as `async fn`.
//!
//! Knows nothing of bytes, machines or light. One thread of control takes events in the order
//! (time, sequence number), so that equal times are first come, first served, and the same program
//! always runs the same way. When no event is left and processes still wait, the run ends with
//! [`Stalled`], which names who waits for what.
//!
//! ```
//! use desim::{Duration, Signal, Simulation, Time};
//!
//! let simulation = Simulation::new();
//! let handle = simulation.handle();
//! let bell = Signal::new(&handle, "the bell");
//!
//! let heard = bell.clone();
//! handle.spawn("listener", async move { heard.wait().await });
//! handle.at(Time::ZERO + Duration::from_seconds_f64(1.5), move || bell.notify());
//!
//! assert_eq!(simulation.run().unwrap().to_string(), "1.5 s");
//! ```

mod alarm;
mod event;
mod handle;
mod process;
mod repeated;
mod signal;
mod simulation;
mod stalled;
mod state;
mod ticket;
mod time;
mod wait;

pub use alarm::Alarm;
pub use handle::Handle;
pub use signal::Signal;
pub use simulation::Simulation;
pub use stalled::{Stalled, Waiting};
pub use state::Observation;
pub use ticket::ProcessId;
pub use time::{Duration, Time};
