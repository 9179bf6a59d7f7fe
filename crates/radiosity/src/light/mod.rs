//! The light on patches, and progressive radiosity in one environment (§5.2).

mod greatest; // the greatest of many changing values
mod light; // radiosity and unshot power of the patches of an environment
mod refinement; // smaller patches where radiosity changes
mod solve; // progressive radiosity without a decomposition

pub use greatest::Greatest;
pub use light::Light;
pub use refinement::{Refinement, RefinementError, Wanted};
pub use solve::solve;
