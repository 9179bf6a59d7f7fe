//! The error of a run, and the parts that make it up.

use serde::{Deserialize, Serialize};

/// How far a run's radiosities are from the answer, relative to what is reflected, as
/// [`reference::Difference`] says.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorFigures {
    /// Area-weighted root mean square.
    pub l2: f64,
    /// The greatest of any patch and colour.
    pub maximum: f64,
    /// The answer's own error.
    pub reference: f64,
    /// The parts of the first, if they are asked for.
    pub causes: Option<Causes>,
}

/// The parts that make up a run's error, as area-weighted root mean squares relative to what is
/// reflected. As vectors they add up to the error: so it is at most their sum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Causes {
    /// Rays in a finite number of directions.
    pub directions: f64,
    /// Shooting from the centres of patches, or of their parts.
    pub sampling: f64,
    /// The size of the run's patches.
    pub mesh: f64,
    /// What was not shot, over-shooting and the ambient term included.
    pub stopping: f64,
}

impl Causes {
    /// Each part with its name for people.
    pub fn named(&self) -> [(&'static str, f64); 4] {
        let Causes { directions, sampling, mesh, stopping } = *self;
        [
            ("directions", directions),
            ("centre sampling", sampling),
            ("mesh", mesh),
            ("stopping", stopping),
        ]
    }

    /// The total of estimated parts, which are taken to be independent.
    pub fn total(&self) -> f64 {
        self.named().iter().map(|(_, error)| error * error).sum::<f64>().sqrt()
    }
}
