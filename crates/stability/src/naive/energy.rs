//! Energy kept in ways that lose it.

use radiosity::{LocalEnvironment, Rgb};

use super::single::{self, Corners};
use crate::bench::{Bench, Trial};
use crate::direct::{form_factors, lamps_and_others};
use crate::light::{emissions, object_means, off};
use crate::rays::sources;

/// Greatest radiosity, over a lamp's, that one shot of a lamp brings to any patch when each ray brings
/// its radiosity over the patch's area.
pub fn brightest(bench: &Bench) -> f64 {
    let mut brightest: f64 = 0.0;
    for trial in &bench.trials {
        let problem = &*trial.problem;
        let scene = &problem.space.scene;
        for lamp in lamps_and_others(bench, trial).0 {
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

/// Share of a watt that is missing when its rays' shares are added up in single precision.
pub fn closure(bench: &Bench) -> f64 {
    let mut sum = 0.0_f32;
    let mut emitted = 0.0_f64;
    for trial in &bench.trials {
        let pixels = trial.problem.hemisphere.pixels();
        for _ in sources(bench, trial, u64::MAX) {
            (0..pixels).for_each(|_| sum += 1.0 / pixels as f32);
            emitted += 1.0;
        }
    }
    (1.0 - f64::from(sum) / emitted).abs()
}

/// How far the mean radiosities of objects are off when form factors are changed by `change`, which is
/// told each row.
fn off_with(bench: &Bench, change: impl Fn(&mut Vec<f64>)) -> f64 {
    let Some(exact) = &bench.case.right.exact else { return f64::NAN };
    let of = |trial: &Trial| {
        let radiosity = solve(bench, trial, &change);
        off(exact, &object_means(&trial.problem, &radiosity))
    };
    bench.trials.iter().map(of).fold(0.0, f64::max)
}

/// Radiosities by Jacobi's iteration over form factors by rays.
fn solve(bench: &Bench, trial: &Trial, change: &impl Fn(&mut Vec<f64>)) -> Vec<Vec<Rgb>> {
    let problem = &*trial.problem;
    let scene = &problem.space.scene;
    let patches: Vec<_> = problem.environments.iter().flat_map(|e| &e.patches).collect();
    let rows: Vec<Vec<f64>> = sources(bench, trial, u64::MAX)
        .iter()
        .map(|source| {
            let mut row: Vec<f64> = form_factors(problem, source).into_iter().flatten().collect();
            change(&mut row);
            row
        })
        .collect();
    let emission: Vec<f64> = emissions(problem).flatten().collect();
    let reflectance: Vec<f64> = patches
        .iter()
        .map(|patch| scene.material(&scene.polygons[patch.polygon as usize]).reflectance.x)
        .collect();
    let mut radiosity = emission.clone();
    // Power goes from a row's patch to those of its columns.
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

/// With the share of rays lost that single precision loses in this scene, at every bounce.
pub fn leaky(bench: &Bench) -> f64 {
    let leaks = single::leaks(bench, Corners::Own);
    let kept = 1.0 - leaks.wrong as f64 / leaks.of as f64;
    off_with(bench, |row| row.iter_mut().for_each(|form_factor| *form_factor *= kept))
}

/// With rows that sum to 1, whatever goes out of the scene.
pub fn normalised(bench: &Bench) -> f64 {
    off_with(bench, |row| {
        let sum: f64 = row.iter().sum();
        row.iter_mut().for_each(|form_factor| *form_factor /= sum);
    })
}
