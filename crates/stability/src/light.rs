//! What becomes of light: whether energy closes, and how far radiosities are from what they should be.

use std::collections::BTreeMap;

use radiosity::Rgb;
use radiosity::glam::DVec3;
use virtwall::{Ending, Outcome, Problem};

use crate::bench::{Bench, Trial};
use crate::right::Exact;

/// Greatest share of the emitted energy that is unaccounted for.
///
/// # Errors
/// Why a run did not end; so for all of these.
pub fn closure(bench: &Bench) -> Result<f64, String> {
    let errors = bench.outcomes()?;
    Ok(errors.iter().map(|(_, outcome)| outcome.energy.error()).fold(0.0, worse))
}

/// The greater of two, and no number rather than any.
pub fn worse(one: f64, other: f64) -> f64 {
    if one.is_nan() || other.is_nan() { f64::NAN } else { one.max(other) }
}

/// Greatest radiosity that a patch got from others, over the greatest that is emitted.
pub fn brightest(bench: &Bench) -> Result<f64, String> {
    let mut brightest: f64 = 0.0;
    for (trial, outcome) in bench.outcomes()? {
        let most = emissions(&trial.problem).flatten().fold(0.0, f64::max);
        let pairs = outcome.radiosity.iter().flatten().zip(emissions(&trial.problem).flatten());
        let reflected = pairs.map(|(radiosity, emission)| (radiosity.x - emission) / most);
        brightest = reflected.fold(brightest, worse);
    }
    Ok(brightest)
}

/// Red emitted by each patch, by environment, W/m².
pub fn emissions(problem: &Problem) -> impl Iterator<Item = Vec<f64>> {
    let scene = &problem.space.scene;
    problem.environments.iter().map(move |environment| {
        let of = |patch: &radiosity::Patch| {
            scene.material(&scene.polygons[patch.polygon as usize]).emission.x
        };
        environment.patches.iter().map(of).collect()
    })
}

/// Radiosities that are no numbers.
pub fn no_numbers(bench: &Bench) -> Result<u64, String> {
    let of =
        |outcome: &Outcome| outcome.radiosity.iter().flatten().filter(|b| !b.is_finite()).count();
    Ok(bench.outcomes()?.iter().map(|(_, outcome)| of(outcome) as u64).sum())
}

/// Greatest relative L2 difference between the light of the first trial and that of any other.
pub fn difference(bench: &Bench) -> Result<f64, String> {
    let outcomes = bench.outcomes()?;
    let Some((first, others)) = outcomes.split_first() else { return Ok(0.0) };
    let unit = 1e6 / first.0.problem.space.scene.bounds.size().length();
    let first = by_place(first.0, first.1, unit);
    let mut greatest = 0.0;
    for (trial, outcome) in others {
        let other = by_place(trial, outcome, unit);
        let apart = first.len().abs_diff(other.len());
        if apart > 0 {
            return Err(format!(
                "{}: {apart} patches more or less; no mesh to compare",
                trial.label
            ));
        }
        greatest = worse(greatest, relative_l2(&first, &other));
    }
    Ok(greatest)
}

/// By a patch's place and side before its scene was changed, in units of a millionth of the scene, so
/// that rounding does not matter: its area and its radiosity.
type Lit = BTreeMap<[i64; 6], (f64, Rgb)>;

fn by_place(trial: &Trial, outcome: &Outcome, unit: f64) -> Lit {
    let scene = &trial.problem.space.scene;
    let key = |point: DVec3| (point * unit + 0.25).to_array().map(|x| x.floor() as i64);
    let mut lit = Lit::new();
    for (environment, radiosity) in trial.problem.environments.iter().zip(&outcome.radiosity) {
        for (patch, &radiosity) in environment.patches.iter().zip(radiosity) {
            let normal = scene.polygons[patch.polygon as usize].plane.normal;
            let world = patch.centre + scene.origin;
            let centre = trial.change.undone(world);
            let ahead = trial.change.undone(world + normal) - centre;
            let [x, y, z] = key(centre);
            let [a, b, c] = (ahead * 8.0).to_array().map(|x| x.round() as i64);
            if patch.area > 0.0 {
                lit.insert([x, y, z, a, b, c], (patch.area, radiosity));
            }
        }
    }
    lit
}

/// Difference of two lights over the first one, each weighted by area.
fn relative_l2(one: &Lit, other: &Lit) -> f64 {
    let (mut apart, mut size) = (0.0, 0.0);
    for (place, &(area, radiosity)) in one {
        let Some((_, there)) = other.get(place) else { return f64::NAN };
        apart += area * (radiosity - *there).length_squared();
        size += area * radiosity.length_squared();
    }
    if size > 0.0 { (apart / size).sqrt() } else { apart }
}

/// Mean radiosity of each object, red, W/m².
pub fn object_means(problem: &Problem, radiosity: &[Vec<Rgb>]) -> BTreeMap<String, f64> {
    let scene = &problem.space.scene;
    let mut sums: BTreeMap<String, (f64, f64)> = BTreeMap::new();
    for (environment, radiosity) in problem.environments.iter().zip(radiosity) {
        for (patch, radiosity) in environment.patches.iter().zip(radiosity) {
            let object = scene.polygons[patch.polygon as usize].object;
            let (sum, area) = sums.entry(scene.objects[object as usize].clone()).or_default();
            (*sum, *area) = (*sum + radiosity.x * patch.area, *area + patch.area);
        }
    }
    sums.into_iter().map(|(object, (sum, area))| (object, sum / area)).collect()
}

/// How far the mean radiosities of objects are from what they should be, in the worst case.
pub fn off(exact: &Exact, means: &BTreeMap<String, f64>) -> f64 {
    let error = |(object, &exact): (&String, &f64)| {
        means.get(object).map_or(f64::NAN, |mean| (mean / exact - 1.0).abs())
    };
    exact.radiosity.iter().map(error).fold(0.0, worse)
}

/// The same of all trials, and the greatest share of the energy that a run says is still to be shot.
pub fn off_and_told(bench: &Bench, exact: &Exact) -> Result<(f64, f64), String> {
    let (mut greatest, mut told): (f64, f64) = (0.0, 0.0);
    for (trial, outcome) in bench.outcomes()? {
        greatest = worse(greatest, off(exact, &object_means(&trial.problem, &outcome.radiosity)));
        let left = outcome.energy.unshot + outcome.energy.in_transit;
        told = told.max(left.element_sum() / outcome.energy.emitted.element_sum());
    }
    Ok((greatest, told))
}

/// Local shots of all runs.
pub fn shots(bench: &Bench) -> Result<u64, String> {
    Ok(bench.outcomes()?.iter().map(|(_, outcome)| outcome.counts.local_shots).sum())
}

/// How the runs ended, each way once.
pub fn endings(bench: &Bench) -> String {
    let ending = |trial| match bench.outcome(trial).map(|outcome| outcome.ending) {
        Ok(Ending::Agreed) => "agreed".to_owned(),
        Ok(Ending::TooEarly { .. }) => "too early, and told".to_owned(),
        Err(message) => message,
    };
    let mut all: Vec<String> = bench.trials.iter().map(ending).collect();
    all.dedup();
    all.join("; ")
}
