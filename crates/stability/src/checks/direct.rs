//! Direct light from the lamps.

use radiosity::{Emitter, Ray};
use virtwall::Problem;

use crate::checks::casting::{emits, shoot_through, sources};
use crate::checks::rays::our_polygon;
use crate::finding::Count;
use crate::runs::{CaseRun, CaseRuns};

/// Patches that emit, and those that do not, as sources.
pub fn lamps_and_others(runs: &CaseRuns, run: &CaseRun) -> (Vec<Emitter>, Vec<Emitter>) {
    let emits = |source: &Emitter| emits(&run.problem, (source.environment, source.patch));
    sources(runs, run, u64::MAX).into_iter().partition(emits)
}

/// Whether a patch sees the centre of a lamp.
fn sees(problem: &Problem, patch: &Emitter, lamp: &Emitter) -> bool {
    let away = lamp.centre - patch.centre;
    let Some(direction) = away.try_normalize() else { return false };
    if direction.dot(patch.normal) <= 1e-6 || direction.dot(lamp.normal) >= -1e-6 {
        return false;
    }
    our_polygon(problem, patch, &Ray::new(patch.centre, direction)) == Some(lamp.polygon)
}

/// Patches that see a lamp; `dark` counts those to which it brings no light.
pub fn dark_patches(
    runs: &CaseRuns,
    dark: impl Fn(&Problem, &Emitter, &[&Emitter]) -> usize,
) -> Count {
    let mut count = Count::default();
    for run in &runs.list {
        let (lamps, others) = lamps_and_others(runs, run);
        for lamp in &lamps {
            let patches = others.iter().filter(|patch| sees(&run.problem, patch, lamp));
            let patches: Vec<&Emitter> = patches.collect();
            let wrong = dark(&run.problem, lamp, &patches) as u64;
            count = count.and(Count { wrong, of: patches.len() as u64 });
        }
    }
    count
}

/// Patches that see a lamp but are hit by none of its rays.
pub fn dark(runs: &CaseRuns) -> Count {
    dark_patches(runs, |problem, lamp, patches| {
        let found = form_factors(problem, lamp);
        let found = |patch: &Emitter| found[patch.environment as usize][patch.patch as usize];
        patches.iter().filter(|patch| found(patch) == 0.0).count()
    })
}

/// Form factors by rays from a source to all patches, by environment and patch.
pub fn form_factors(problem: &Problem, source: &Emitter) -> Vec<Vec<f64>> {
    let empty = |environment: &radiosity::LocalEnvironment| vec![0.0; environment.patches.len()];
    let mut found: Vec<Vec<f64>> = problem.environments.iter().map(empty).collect();
    shoot_through(problem, source, |number, shot, _| {
        for &(patch, form_factor) in &shot.hits {
            found[number as usize][patch as usize] = form_factor;
        }
    });
    found
}
