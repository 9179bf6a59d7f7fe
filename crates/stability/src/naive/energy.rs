//! Energy stored and summed in ways that lose it.

use radiosity::{LocalEnvironment, Rgb};

use crate::checks::casting::sources;
use crate::checks::direct::{form_factors, lamps_and_others};
use crate::checks::light::{emissions, error, object_means};
use crate::naive::single::{self, Corners};
use crate::runs::{CaseRun, CaseRuns};

/// Greatest radiosity, relative to that of a lamp, that one shot of a lamp deposits on any patch if rays
/// carry radiosity instead of energy.
pub fn brightest(runs: &CaseRuns) -> f64 {
    let mut brightest: f64 = 0.0;
    for run in &runs.list {
        let problem = &*run.problem;
        let scene = &problem.space.scene;
        for lamp in lamps_and_others(runs, run).0 {
            let of = |environment: u32, patch: u32| {
                problem.environments[environment as usize].patches[patch as usize]
            };
            let area = of(lamp.environment, lamp.patch).area;
            for (environment, found) in (0..).zip(form_factors(problem, &lamp)) {
                for (patch, form_factor) in (0..).zip(found).filter(|&(_, f)| f > 0.0) {
                    let patch = of(environment, patch);
                    let material = scene.material(&scene.polygons[patch.polygon as usize]);
                    let got = material.reflectance.x * form_factor * area / patch.area;
                    brightest = brightest.max(got);
                }
            }
        }
    }
    brightest
}

/// Relative error of the emitted energy if it is summed ray by ray in single precision.
pub fn closure(runs: &CaseRuns) -> f64 {
    let mut sum = 0.0_f32;
    let mut emitted = 0.0_f64;
    for run in &runs.list {
        let pixels = run.problem.hemisphere.pixels();
        for _ in sources(runs, run, u64::MAX) {
            (0..pixels).for_each(|_| sum += 1.0 / pixels as f32);
            emitted += 1.0;
        }
    }
    (1.0 - f64::from(sum) / emitted).abs()
}

/// Greatest relative error of the mean radiosities of objects if `change` is applied to each row of form
/// factors.
fn error_with(runs: &CaseRuns, change: impl Fn(&mut Vec<f64>)) -> f64 {
    let Some(exact) = &runs.case.expected.exact else { return f64::NAN };
    let of = |run: &CaseRun| {
        let radiosity = solve(runs, run, &change);
        error(exact, &object_means(&run.problem, &radiosity))
    };
    runs.list.iter().map(of).fold(0.0, f64::max)
}

/// Radiosities by Jacobi iteration with form factors by rays.
fn solve(runs: &CaseRuns, run: &CaseRun, change: &impl Fn(&mut Vec<f64>)) -> Vec<Vec<Rgb>> {
    let problem = &*run.problem;
    let scene = &problem.space.scene;
    let patches: Vec<_> = problem.environments.iter().flat_map(|e| &e.patches).collect();
    let rows: Vec<Vec<f64>> = sources(runs, run, u64::MAX)
        .iter()
        .map(|source| {
            let mut row: Vec<f64> = form_factors(problem, source).into_iter().flatten().collect();
            change(&mut row);
            row
        })
        .collect();
    let emission: Vec<f64> = emissions(problem).collect();
    let reflectance: Vec<f64> = patches
        .iter()
        .map(|patch| scene.material(&scene.polygons[patch.polygon as usize]).reflectance.x)
        .collect();
    let mut radiosity = emission.clone();
    // Rows are sources, columns receivers.
    for _ in 0..40_000 {
        let mut next = emission.clone();
        for (from, row) in rows.iter().enumerate() {
            for (to, form_factor) in row.iter().enumerate().filter(|(_, f)| **f > 0.0) {
                let power = radiosity[from] * patches[from].area * form_factor;
                next[to] += reflectance[to] * power / patches[to].area;
            }
        }
        let moved = next.iter().zip(&radiosity).map(|(a, b)| (a - b).abs() / b.max(1e-300));
        let moved = moved.fold(0.0, f64::max);
        radiosity = next;
        if moved < 1e-9 {
            break;
        }
    }
    let mut all = radiosity.into_iter().map(Rgb::splat);
    let count = |environment: &LocalEnvironment| environment.patches.len();
    problem.environments.iter().map(|e| all.by_ref().take(count(e)).collect()).collect()
}

/// The error if every bounce loses the share of rays that single precision loses in this scene.
pub fn leaky(runs: &CaseRuns) -> f64 {
    let leaks = single::leaks(runs, Corners::Own);
    let kept = 1.0 - leaks.wrong as f64 / leaks.of as f64;
    error_with(runs, |row| row.iter_mut().for_each(|form_factor| *form_factor *= kept))
}

/// The error if each row of form factors is scaled to sum to 1, even in an open scene.
pub fn normalised(runs: &CaseRuns) -> f64 {
    error_with(runs, |row| {
        let sum: f64 = row.iter().sum();
        row.iter_mut().for_each(|form_factor| *form_factor /= sum);
    })
}
