//! Receivers that cast rays to find a lamp.

use radiosity::{Emitter, Ray};

use crate::checks::casting::rays;
use crate::checks::direct::dark_patches;
use crate::checks::rays::our_polygon;
use crate::finding::Count;
use crate::runs::CaseRuns;

/// Patches that see a lamp but hit it with none of their own rays.
pub fn dark(runs: &CaseRuns) -> Count {
    dark_patches(runs, |problem, lamp, patches| {
        let finds = |patch: &Emitter| {
            let hit = |ray: &Ray| our_polygon(problem, patch, ray) == Some(lamp.polygon);
            rays(runs, problem, patch).iter().any(hit)
        };
        patches.iter().filter(|patch| !finds(patch)).count()
    })
}
