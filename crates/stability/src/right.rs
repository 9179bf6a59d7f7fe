//! What right means.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;

/// What is right, by measure; each measure that has a value is made over all runs of the case.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Right {
    /// Rays of a closed scene that leave it: at most so many.
    pub leaks: Option<u64>,
    /// Rays that end elsewhere than on the nearest of all polygons: at most so many.
    pub astray: Option<u64>,
    /// Pixels that do not end exactly once over all local environments: at most so many.
    pub owners: Option<u64>,
    /// Rays that meet several polygons of one plane, and do not end on that on which most of their like
    /// do: at most so many.
    pub torn: Option<u64>,
    /// Patches that see a light and get nothing of it: at most so many.
    pub dark: Option<u64>,
    /// Share of the emitted energy that is unaccounted for: at most so much.
    pub closure: Option<f64>,
    /// Greatest radiosity that a patch gets from others, over the greatest emitted: at most so much.
    pub brightest: Option<f64>,
    /// Mean radiosities of objects, where they are known.
    pub exact: Option<Exact>,
    /// Relative L2 difference between the light of the first run and that of any other: at most so much.
    pub same_light: Option<f64>,
    /// Radiosities that are no numbers: exactly so many, none that is.
    pub no_numbers: Option<u64>,
    /// Sources shot from their own local environments: exactly so many, over all runs.
    pub shots: Option<u64>,
    /// How all runs end.
    pub ends: Option<String>,
    /// A part of a warning that is given.
    pub warns: Option<String>,
    /// A part of the message with which the experiment is refused.
    pub refused: Option<String>,
}

/// Mean radiosities that are known.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Exact {
    /// Of each object, red, W/m².
    pub radiosity: BTreeMap<String, f64>,
    /// The greatest relative error.
    pub within: f64,
    /// Whether an error is right as well that is no greater than the share of the emitted energy that
    /// the run says is not shot yet: it has not converged, and tells.
    #[serde(default)]
    pub or_told: bool,
}

impl Right {
    /// Whether a measure of this name is asked for.
    pub fn asks(&self, measure: &str) -> bool {
        match measure {
            "leaks" => self.leaks.is_some(),
            "astray" => self.astray.is_some(),
            "owners" => self.owners.is_some(),
            "torn" => self.torn.is_some(),
            "dark" => self.dark.is_some(),
            "closure" => self.closure.is_some(),
            "brightest" => self.brightest.is_some(),
            "exact" => self.exact.is_some(),
            "no_numbers" => self.no_numbers.is_some(),
            _ => false,
        }
    }
}
