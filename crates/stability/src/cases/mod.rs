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

pub use case::{Case, Listed, Overlay, case_schema};
pub use change::{Change, Turn};
pub use expected::{Exact, Expected};
pub use naive_method::NaiveMethod;
