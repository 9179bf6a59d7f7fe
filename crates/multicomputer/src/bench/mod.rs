//! Small programs and traffic that measure machines.

/// Ping-pong, exchange, hot spot.
mod kernels;
/// A trace sent over a network.
mod replay;
/// Messages that a user's file lists.
mod trace;
/// Synthetic traffic.
mod traffic;

pub use kernels::{KernelError, exchange, hot_spot, ping_pong};
pub use replay::{ReplayDeadlock, ReplayedMessage, replay};
pub use trace::{Trace, TraceMessage, trace_schema};
pub use traffic::{Load, Measured, Pattern, fluid_bound};
