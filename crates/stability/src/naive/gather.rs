//! Receivers that cast rays to find a lamp.

use radiosity::Ray;

use crate::checks::casting::rays;
use crate::checks::direct::{lamps_and_others, sees};
use crate::checks::rays::our_polygon;
use crate::finding::Count;
use crate::runs::CaseRuns;

/// Patches that see a lamp but hit it with none of their own rays.
pub fn dark(runs: &CaseRuns) -> Count {
    let mut count = Count::default();
    for run in &runs.list {
        let problem = &*run.problem;
        let (lamps, others) = lamps_and_others(runs, run);
        for lamp in &lamps {
            for patch in others.iter().filter(|patch| sees(problem, patch, lamp)) {
                let finds = |ray: &Ray| our_polygon(problem, patch, ray) == Some(lamp.polygon);
                let dark = !rays(runs, problem, patch).iter().any(finds);
                count = count.and(Count { wrong: u64::from(dark), of: 1 });
            }
        }
    }
    count
}
