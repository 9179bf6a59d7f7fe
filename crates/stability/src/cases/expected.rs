//! The expected result of a case: bounds on its measures.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;

/// What is right, by measure. Each measure with a value is made over all runs of the case.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Expected {
    /// Most rays that may leave a closed scene.
    pub leaks: Option<u64>,
    /// Most rays that may end elsewhere than on the nearest polygon.
    pub astray: Option<u64>,
    /// Most pixels that may end not at all or more than once over all local environments.
    pub owners: Option<u64>,
    /// Of the rays that meet several polygons of one plane: most that may end on another polygon than
    /// the majority.
    pub torn: Option<u64>,
    /// Most patches that may see a lamp and receive nothing from it.
    pub dark: Option<u64>,
    /// Greatest share of the emitted energy that may be unaccounted for.
    pub closure: Option<f64>,
    /// Bound of the greatest reflected radiosity of a patch, over the greatest emitted radiosity.
    pub brightest: Option<f64>,
    /// Known mean radiosities of objects.
    pub exact: Option<Exact>,
    /// Greatest relative L2 difference between the radiosities of the first run and of any other.
    pub same_light: Option<f64>,
    /// Number of radiosities that are not finite: 0.
    pub no_numbers: Option<u64>,
    /// Number of sources shot from their own local environments, over all runs.
    pub shots: Option<u64>,
    /// A part of the description of how the runs end.
    pub ends: Option<String>,
    /// A part of an expected warning.
    pub warns: Option<String>,
    /// A part of the message with which the experiment must be refused.
    pub refused: Option<String>,
}

/// Known mean radiosities.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Exact {
    /// Of each object, red channel, W/m².
    pub radiosity: BTreeMap<String, f64>,
    /// The greatest relative error.
    pub within: f64,
    /// Whether a greater error is right as well, up to the share of the emitted energy that the run
    /// reports as unshot: such a run has not converged and says so.
    #[serde(default, rename = "or_told")]
    pub or_unshot: bool,
}
