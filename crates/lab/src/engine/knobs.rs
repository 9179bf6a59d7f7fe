//! How an experiment's patches are shot where it goes beyond the paper.

use virtwall::{Shooting, SourceSplit};

use crate::experiment::fields::Experiment;
use crate::experiment::refine::MOST_HALVINGS;
use crate::experiment::source_split::SplitFields;

/// The parts that a patch may be cut into along a direction.
const MOST_PARTS: u32 = 64;

/// Refuses values that make no sense.
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
    if let Some(error) = point.refine.relative_l2.filter(|error| !(*error > 0.0 && *error < 1.0)) {
        return Err(("refine.relative_l2", format!("{error}; expected more than 0, less than 1")));
    }
    if !(1..=MOST_HALVINGS).contains(&point.refine.most_halvings) {
        let message = format!("{}; expected 1 to {MOST_HALVINGS}", point.refine.most_halvings);
        return Err(("refine.most_halvings", message));
    }
    if let Some(least) = point.hemisphere.least_pixels
        && !(1..=point.hemisphere.pixels).contains(&least)
    {
        let message = format!("{least}; expected 1 to {}, the pixels", point.hemisphere.pixels);
        return Err(("hemisphere.least_pixels", message));
    }
    Ok(())
}

/// How patches are shot at a point of an experiment.
pub fn shooting(point: &Experiment) -> Shooting {
    let SplitFields { most, nearer_than } = point.source_split;
    Shooting {
        split: SourceSplit { nearer_than: nearer_than.unwrap_or(f64::INFINITY), most },
        overshoot: point.overshoot,
        ambient: point.ambient,
    }
}
