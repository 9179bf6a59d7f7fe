//! What is measured on the runs of a case.
//!
//! - `casting`: the rays of a case and where they end
//! - `rays`: rays that are lost, claimed twice, or end in the wrong place
//! - `direct`: direct light from the lamps
//! - `light`: energy balance and radiosities
//! - `measures`: all measures that a case asks for

pub mod casting;
pub mod direct;
pub mod light;
mod measures;
pub mod rays;

pub use measures::measures;
