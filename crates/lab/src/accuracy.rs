//! What an experiment asks for in place of knobs.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The error that results are to stay below; the knobs that trade accuracy for time are found.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AccuracyFields {
    /// Root mean square of what is wrong with the radiosities, over that of what is reflected, such
    /// as 0.03: the column error_l2 of a run that has a reference. From 0.0001 to 1.
    pub relative_l2: f64,
    /// A runs.csv of a sweep through many settings of the same scenes, as a path from this file: columns
    /// sweep_time_s, its least time below the error, and cost_over_sweep tell how near what was found
    /// comes to that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweep: Option<String>,
}

/// The fields that it takes the place of.
pub const REPLACED: [&str; 7] = [
    "hemisphere.directions",
    "hemisphere.pixels",
    "hemisphere.pixels_a_bit",
    "source_split",
    "overshoot",
    "ambient",
    "stop.patch_threshold",
];

impl AccuracyFields {
    /// Refuses what nobody means.
    ///
    /// # Errors
    /// The field, and what is wrong with it.
    pub fn check(&self) -> Result<(), (&'static str, String)> {
        let error = self.relative_l2;
        match (1e-4..=1.0).contains(&error) {
            true => Ok(()),
            false => Err(("accuracy.relative_l2", format!("{error}; expected from 0.0001 to 1"))),
        }
    }
}
