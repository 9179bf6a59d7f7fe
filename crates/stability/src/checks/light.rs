//! Measures of light: energy balance and radiosities of the runs.

use std::collections::BTreeMap;

use radiosity::Rgb;
use radiosity::glam::DVec3;
use virtwall::{Ending, Outcome, Problem};

use crate::cases::expected::Exact;
use crate::runs::{CaseRun, CaseRuns};

/// Greatest share of the emitted energy that is unaccounted for.
pub fn closure(runs: &CaseRuns) -> Result<f64, String> {
    let outcomes = runs.outcomes()?;
    Ok(outcomes.iter().map(|(_, outcome)| outcome.energy.error()).fold(0.0, worse))
}

/// The greater of two numbers; NaN if one is NaN.
fn worse(one: f64, other: f64) -> f64 {
    if one.is_nan() || other.is_nan() { f64::NAN } else { one.max(other) }
}

/// Greatest reflected radiosity of a patch, over the greatest emitted radiosity.
pub fn brightest(runs: &CaseRuns) -> Result<f64, String> {
    let mut brightest: f64 = 0.0;
    for (run, outcome) in runs.outcomes()? {
        let most = emissions(&run.problem).fold(0.0, f64::max);
        let pairs = outcome.radiosity.iter().flatten().zip(emissions(&run.problem));
        let reflected = pairs.map(|(radiosity, emission)| (radiosity.x - emission) / most);
        brightest = reflected.fold(brightest, worse);
    }
    Ok(brightest)
}

/// Emitted radiosity of each patch, red channel, W/m².
pub fn emissions(problem: &Problem) -> impl Iterator<Item = f64> {
    let scene = &problem.space.scene;
    let patches = problem.environments.iter().flat_map(|environment| &environment.patches);
    patches.map(|patch| scene.material(&scene.polygons[patch.polygon as usize]).emission.x)
}

/// The number of radiosities that are not finite.
pub fn no_numbers(runs: &CaseRuns) -> Result<u64, String> {
    let of =
        |outcome: &Outcome| outcome.radiosity.iter().flatten().filter(|b| !b.is_finite()).count();
    Ok(runs.outcomes()?.iter().map(|(_, outcome)| of(outcome) as u64).sum())
}

/// Greatest relative L2 difference between the radiosities of the first run and of any other.
pub fn difference(runs: &CaseRuns) -> Result<f64, String> {
    let outcomes = runs.outcomes()?;
    let Some((first, others)) = outcomes.split_first() else { return Ok(0.0) };
    let unit = 1e6 / first.0.problem.space.scene.bounds.size().length();
    let first = by_place(first.0, first.1, unit);
    let mut greatest = 0.0;
    for (run, outcome) in others {
        let other = by_place(run, outcome, unit);
        let apart = first.len().abs_diff(other.len());
        if apart > 0 {
            return Err(format!(
                "{}: {apart} patches more or less than in the first run",
                run.label
            ));
        }
        greatest = worse(greatest, relative_l2(&first, &other));
    }
    Ok(greatest)
}

/// Area and radiosity of patches, by position and orientation before the scene was changed. Positions are
/// rounded to a millionth of the scene, so that patches of different runs match.
type Lit = BTreeMap<[i64; 6], (f64, Rgb)>;

fn by_place(run: &CaseRun, outcome: &Outcome, unit: f64) -> Lit {
    let scene = &run.problem.space.scene;
    let key = |point: DVec3| (point * unit + 0.25).to_array().map(|x| x.floor() as i64);
    let mut lit = Lit::new();
    for (environment, radiosity) in run.problem.environments.iter().zip(&outcome.radiosity) {
        for (patch, &radiosity) in environment.patches.iter().zip(radiosity) {
            let normal = scene.polygons[patch.polygon as usize].plane.normal;
            let world = patch.centre + scene.origin;
            let centre = run.change.undone(world);
            let ahead = run.change.undone(world + normal) - centre;
            let [x, y, z] = key(centre);
            let [a, b, c] = (ahead * 8.0).to_array().map(|x| x.round() as i64);
            if patch.area > 0.0 {
                lit.insert([x, y, z, a, b, c], (patch.area, radiosity));
            }
        }
    }
    lit
}

/// The area-weighted L2 difference of two solutions, relative to the first.
fn relative_l2(one: &Lit, other: &Lit) -> f64 {
    let (mut apart, mut size) = (0.0, 0.0);
    for (place, &(area, radiosity)) in one {
        let Some((_, there)) = other.get(place) else { return f64::NAN };
        apart += area * (radiosity - *there).length_squared();
        size += area * radiosity.length_squared();
    }
    if size > 0.0 { (apart / size).sqrt() } else { apart }
}

/// Mean radiosity of each object, red channel, W/m².
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

/// Greatest relative error of the mean radiosities of objects.
pub fn error(exact: &Exact, means: &BTreeMap<String, f64>) -> f64 {
    let relative = |(object, &exact): (&String, &f64)| {
        means.get(object).map_or(f64::NAN, |mean| (mean / exact - 1.0).abs())
    };
    exact.radiosity.iter().map(relative).fold(0.0, worse)
}

/// The same over all runs, and the greatest share of the emitted energy that a run reports as unshot.
pub fn error_and_unshot(runs: &CaseRuns, exact: &Exact) -> Result<(f64, f64), String> {
    let (mut greatest, mut unshot): (f64, f64) = (0.0, 0.0);
    for (run, outcome) in runs.outcomes()? {
        greatest = worse(greatest, error(exact, &object_means(&run.problem, &outcome.radiosity)));
        let left = outcome.energy.unshot + outcome.energy.in_transit;
        unshot = unshot.max(left.element_sum() / outcome.energy.emitted.element_sum());
    }
    Ok((greatest, unshot))
}

/// The number of local shots of all runs.
pub fn shots(runs: &CaseRuns) -> Result<u64, String> {
    Ok(runs.outcomes()?.iter().map(|(_, outcome)| outcome.counts.local_shots).sum())
}

/// How the runs ended; equal endings in a row are listed once.
pub fn endings(runs: &CaseRuns) -> String {
    let ending = |run| match runs.outcome(run).map(|outcome| outcome.ending) {
        Ok(Ending::Agreed) => "agreed".to_owned(),
        Ok(Ending::TooEarly { .. }) => "too early, and told".to_owned(),
        Err(message) => message,
    };
    let mut all: Vec<String> = runs.list.iter().map(ending).collect();
    all.dedup();
    all.join("; ")
}
