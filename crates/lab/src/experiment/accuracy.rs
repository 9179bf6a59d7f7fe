//! The field `accuracy`: an error to reach, in place of the settings that decide it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::files::WrongField;

/// The error that results are to stay below; the settings that trade accuracy for time are found.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AccuracyFields {
    /// Root mean square of what is wrong with the radiosities, over that of what is reflected, such
    /// as 0.03: the column error_l2 of a run that has a reference. From 0.0001 to 1.
    pub relative_l2: f64,
    /// A runs.csv of a sweep through many settings of the same scenes, as a path from this file: columns
    /// sweep_time_s, its least time below the error, and cost_over_sweep compare the setting found with it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweep: Option<String>,
}

/// The fields that it replaces.
pub const REPLACED: [&str; 6] = [
    "hemisphere.directions",
    "hemisphere.pixels",
    "source_split",
    "overshoot",
    "ambient",
    "stop.patch_threshold",
];

impl AccuracyFields {
    /// Refuses an error out of range, and an experiment that also sets what it replaces.
    pub fn check(&self, experiment: &Value) -> Result<(), WrongField> {
        let error = self.relative_l2;
        if !(1e-4..=1.0).contains(&error) {
            return Err(("accuracy.relative_l2", format!("{error}; expected from 0.0001 to 1")));
        }
        let set = |field: &&str| experiment.pointer(&pointer(field)).is_some();
        let message = "is set together with \"accuracy\", which finds it; expected one of the two";
        let replaced = REPLACED.into_iter().find(set);
        replaced.map_or(Ok(()), |field| Err((field, message.to_owned())))
    }
}

/// Takes the fields that an accuracy replaces out of an experiment that asks for one.
pub fn without_replaced(experiment: &mut Value) {
    if experiment["accuracy"].is_null() {
        return;
    }
    for field in REPLACED {
        let (around, name) = field.rsplit_once('.').unwrap_or(("", field));
        let around = experiment.pointer_mut(&pointer(around)).and_then(Value::as_object_mut);
        around.and_then(|fields| fields.shift_remove(name));
    }
}

fn pointer(field: &str) -> String {
    field.split('.').filter(|key| !key.is_empty()).map(|key| format!("/{key}")).collect()
}
