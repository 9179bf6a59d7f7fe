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

/// Repeated callbacks.
mod alarm;
/// What can happen at a moment.
mod event;
/// Events to come, in order.
mod event_queue;
/// The interface for processes and callbacks.
mod handle;
/// Named futures.
mod process;
/// The callback of an alarm.
mod repeated;
/// How one process wakes others.
mod signal;
/// The executor.
mod simulation;
/// The deadlock report.
mod stalled;
/// What a simulation and its handles share.
mod state;
/// Waits under way.
mod ticket;
/// Virtual time.
mod time;
/// The future of all waits.
mod wait;

pub use alarm::Alarm;
pub use event_queue::EventQueue;
pub use handle::Handle;
pub use signal::Signal;
pub use simulation::Simulation;
pub use stalled::{Stalled, Waiting};
pub use ticket::ProcessId;
pub use time::{Duration, Time};
