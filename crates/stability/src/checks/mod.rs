//! What is measured on the runs of a case.

pub mod casting; // the rays of a case and where they end
pub mod direct; // direct light from the lamps
pub mod light; // energy balance and radiosities
mod measures; // all measures that a case asks for
pub mod rays; // rays that are lost, claimed twice, or end in the wrong place

pub use measures::measures;
