//! Small programs and traffic that measure machines.

mod csv_trace; // traffic as CSV
mod dependencies; // items that wait for others
mod goal; // schedules in the text form of LogGOPSim
mod kernels; // ping-pong, exchange, hot spot
mod performance; // a schedule performed over a network
mod replay; // a trace sent over a network
mod schedule; // what each node computes, sends and receives
mod trace; // messages that a user's file lists
mod traffic; // synthetic traffic
mod workload; // a file of messages in any format

pub use kernels::{KernelError, exchange, hot_spot, ping_pong};
pub use performance::{StalledSchedule, perform};
pub use replay::{ReplayDeadlock, ReplayedMessage, replay};
pub use schedule::{Operation, OperationKind, Schedule};
pub use trace::{Trace, TraceMessage, trace_schema};
pub use traffic::{Load, Measured, Pattern, fluid_bound};
pub use workload::Workload;
