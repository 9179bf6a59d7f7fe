//! Cases as their files state them.
//!
//! - `case`: the file
//! - `change`: changes to the scene that must not change its light
//! - `expected`: what is right
//! - `naive_method`: names of naive methods

pub mod case;
pub mod change;
pub mod expected;
pub mod naive_method;

pub use case::case_schema;
