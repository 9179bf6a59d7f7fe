//! Cases as their files state them.

pub mod case; // the file
pub mod change; // changes to the scene that must not change its light
pub mod expected; // what is right
pub mod naive_method; // names of naive methods

pub use case::case_schema;
