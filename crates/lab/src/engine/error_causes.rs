//! What makes up the error of a run, as columns of the results.

use serde::{Deserialize, Serialize};

/// The columns of runs.csv: [`Causes`] by name.
pub const COLUMNS: [&str; 4] =
    ["error_stopping", "error_directions", "error_sampling", "error_mesh"];

/// The parts that make up a run's error, as area-weighted root mean squares relative to what is
/// reflected. As vectors they add up to the error: so it is at most their sum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Causes {
    /// What was not shot, over-shooting and the ambient term included.
    pub stopping: f64,
    /// Rays in so many directions in place of all.
    pub directions: f64,
    /// Shooting from the centres of patches, or of their parts.
    pub sampling: f64,
    /// What the patches of the run miss of the answer.
    pub mesh: f64,
}

impl Causes {
    /// The cell of a column.
    pub fn cell(&self, column: &str) -> Option<String> {
        let parts = [self.stopping, self.directions, self.sampling, self.mesh];
        let (_, part) = COLUMNS.iter().zip(parts).find(|(name, _)| **name == column)?;
        Some(format!("{part:.6e}"))
    }
}
