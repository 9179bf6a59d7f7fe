//! The light on patches, and progressive radiosity in one environment (§5.2).
//!
//! - `light`: radiosity and unshot power of the patches of an environment
//! - `greatest`: the greatest of many changing values
//! - `solve`: progressive radiosity without a decomposition
//! - `refinement`: smaller patches where radiosity changes

mod greatest;
mod light;
mod refinement;
mod solve;

pub use greatest::Greatest;
pub use light::Light;
pub use refinement::{Refinement, Wanted};
pub use solve::{solve, solve_watched};
