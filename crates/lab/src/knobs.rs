//! What an experiment says of how a patch is shot beyond what the paper does.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use virtwall::{Shooting, SourceSplit};

use crate::experiment::Experiment;

/// Cutting of patches into several sources.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SplitFields {
    /// Into how many parts a patch is cut along each of its two directions, at most; each shoots with
    /// a hemisphere of its own. 1: patches shoot from their centres, as the paper's do.
    #[schemars(range(min = 1, max = 64))]
    pub most: u32,
    /// Cut only as far as need be for nothing in front of a patch to be nearer to its centre than so
    /// many edges of its parts. Default: all patches are cut into "most".
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearer_than: Option<f64>,
}

impl Default for SplitFields {
    fn default() -> SplitFields {
        SplitFields { most: 1, nearer_than: None }
    }
}

impl SplitFields {
    /// Whether patches shoot from their centres.
    pub fn is_none(&self) -> bool {
        *self == SplitFields::default()
    }
}

/// The parts that a patch may be cut into along a direction.
const MOST_PARTS: u32 = 64;

/// Refuses values that make no sense.
///
/// # Errors
/// The field, and what is wrong with it.
pub fn check(point: &Experiment) -> Result<(), (&'static str, String)> {
    let SplitFields { most, nearer_than } = point.source_split;
    if !(1..=MOST_PARTS).contains(&most) {
        return Err(("source_split.most", format!("{most}; expected 1 to {MOST_PARTS}")));
    }
    if let Some(edges) = nearer_than.filter(|edges| !(edges.is_finite() && *edges > 0.0)) {
        return Err(("source_split.nearer_than", format!("{edges}; expected more than 0")));
    }
    if !(1.0..2.0).contains(&point.overshoot) {
        let message = format!("{}; expected from 1 to less than 2", point.overshoot);
        return Err(("overshoot", message));
    }
    let pixels = point.hemisphere.pixels_a_bit;
    if !(pixels.is_power_of_two() && pixels <= 64) {
        let message = format!("{pixels}; expected 1, 2, 4, 8, 16, 32 or 64");
        return Err(("hemisphere.pixels_a_bit", message));
    }
    Ok(())
}

/// How patches are shot at a point of an experiment.
pub fn shooting(point: &Experiment) -> Shooting {
    let SplitFields { most, nearer_than } = point.source_split;
    Shooting {
        split: SourceSplit { nearer_than: nearer_than.unwrap_or(f64::INFINITY), most },
        pixels_a_bit: point.hemisphere.pixels_a_bit,
        overshoot: point.overshoot,
        ambient: point.ambient,
    }
}
