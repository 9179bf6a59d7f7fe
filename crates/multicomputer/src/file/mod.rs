//! Values of a file: units, provenance, faults.

/// What is wrong with a file, and where.
mod fault;
/// Numbers with units.
pub mod quantity;
/// Maps that refuse a key given twice.
mod repetition;
/// Values with their provenance.
mod sourced;

pub use fault::MachineFault;
pub(crate) use fault::read;
pub(crate) use repetition::without_repetition;
pub(crate) use sourced::{
    Bandwidth, Bytes, Cycles, Frequency, Positive, Quantity, Sourced, Time, whole_bytes,
};
