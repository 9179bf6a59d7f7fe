//! Small programs and traffic that measure machines.

mod kernels; // ping-pong, exchange, hot spot
mod replay; // a trace sent over a network
mod trace; // messages that a user's file lists
mod traffic; // synthetic traffic

pub use kernels::{KernelError, exchange, hot_spot, ping_pong};
pub use replay::{ReplayDeadlock, ReplayedMessage, replay};
pub use trace::{Trace, TraceMessage, trace_schema};
pub use traffic::{Load, Measured, Pattern, fluid_bound};
