//! The computer that the program runs on: clock, memory, locks, the program file.

pub mod held; // Locks on what threads share.
pub mod host_clock; // The host's clock.
pub mod host_memory; // Free memory of the host.
pub mod program; // The digest of this program.
