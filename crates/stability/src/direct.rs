//! Light straight from the lamps: who gets it, and how much.

use radiosity::{Emitter, End, Ray};
use virtwall::Problem;

use crate::bench::{Bench, Trial};
use crate::finding::Count;
use crate::rays::{emits, follow, shoot_through, sources};

/// Patches that emit, as sources, and those that do not.
pub fn lamps_and_others(bench: &Bench, trial: &Trial) -> (Vec<Emitter>, Vec<Emitter>) {
    let emits = |source: &Emitter| emits(&trial.problem, (source.environment, source.patch));
    sources(bench, trial, u64::MAX).into_iter().partition(emits)
}

/// Whether a patch and a lamp see each other's centres.
pub fn sees(problem: &Problem, patch: &Emitter, lamp: &Emitter) -> bool {
    let away = lamp.centre - patch.centre;
    let Some(direction) = away.try_normalize() else { return false };
    if direction.dot(patch.normal) <= 1e-6 || direction.dot(lamp.normal) >= -1e-6 {
        return false;
    }
    let end = follow(problem, patch, &Ray::new(patch.centre, direction));
    matches!(end, End::Hit { polygon, .. } if polygon == lamp.polygon)
}

/// Patches that see a lamp and that none of its rays finds.
pub fn dark(bench: &Bench) -> Count {
    let mut count = Count::default();
    for trial in &bench.trials {
        let (lamps, others) = lamps_and_others(bench, trial);
        for lamp in &lamps {
            let found = form_factors(&trial.problem, lamp);
            for patch in others.iter().filter(|patch| sees(&trial.problem, patch, lamp)) {
                let dark = found[patch.environment as usize][patch.patch as usize] == 0.0;
                count = count.and(Count { wrong: u64::from(dark), of: 1 });
            }
        }
    }
    count
}

/// Form factors by rays from a source to all patches, by environment.
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
