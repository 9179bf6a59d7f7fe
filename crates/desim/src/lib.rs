//! Virtual time, the event queue, and processes written as `async fn`.
//!
//! Knows nothing of bytes, machines or light. One thread takes events in the order (time, sequence
//! number): equal times are first come, first served, and the same program always runs the same way.
//! When no event is left and processes still wait, the run ends with [`Stalled`], which names each
//! process and what it waits for.
//!
//! ```
//! use desim::{Duration, Signal, Simulation, Time};
//!
//! let simulation = Simulation::new();
//! let handle = simulation.handle();
//! let ready = Signal::new(&handle, "ready");
//!
//! let awaited = ready.clone();
//! handle.spawn("waiter", async move { awaited.wait().await });
//! handle.at(Time::ZERO + Duration::from_seconds_f64(1.5), move || ready.notify());
//!
//! assert_eq!(simulation.run().unwrap().to_string(), "1.5 s");
//! ```

mod alarm; // repeated callbacks
mod event; // what can happen at a moment
mod event_queue; // events to come, in order
mod handle; // the interface for processes and callbacks
mod process; // named futures
mod repeated; // the callback of an alarm
mod signal; // how one process wakes others
mod simulation; // the executor
mod stalled; // the deadlock report
mod state; // what a simulation and its handles share
mod ticket; // waits under way
mod time; // virtual time
mod wait; // the future of all waits

pub use alarm::Alarm;
pub use event_queue::EventQueue;
pub use handle::Handle;
pub use signal::Signal;
pub use simulation::Simulation;
pub use stalled::{Stalled, Waiting};
pub use time::{Duration, Time};
