//! The computer that the program runs on: clock, memory, locks, the program file.
//!
//! - [`host_clock`]: The host's clock.
//! - [`host_memory`]: Free memory of the host.
//! - [`held`]: Locks on what threads share.
//! - [`program`]: The digest of this program.

pub mod held;
pub mod host_clock;
pub mod host_memory;
pub mod program;
