//! What an experiment asks for in place of knobs.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::files::WrongField;

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
const REPLACED: [&str; 6] = [
    "hemisphere.directions",
    "hemisphere.pixels",
    "source_split",
    "overshoot",
    "ambient",
    "stop.patch_threshold",
];

impl AccuracyFields {
    /// Refuses what nobody means, and knobs beside it in the experiment that it stands in.
    ///
    /// # Errors
    /// The field, and what is wrong with it.
    pub fn check(&self, experiment: &Value) -> Result<(), WrongField> {
        let error = self.relative_l2;
        if !(1e-4..=1.0).contains(&error) {
            return Err(("accuracy.relative_l2", format!("{error}; expected from 0.0001 to 1")));
        }
        let set = |field: &&str| {
            let pointer = format!("/{}", field.replace('.', "/"));
            experiment.pointer(&pointer).is_some()
        };
        let message = "stands beside \"accuracy\", which finds it; expected one of the two";
        match REPLACED.into_iter().find(set) {
            None => Ok(()),
            Some(field) => Err((field, message.to_owned())),
        }
    }
}
