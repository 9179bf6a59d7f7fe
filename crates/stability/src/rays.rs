//! What becomes of rays: lost, claimed twice, led astray.

use std::collections::BTreeMap;

use radiosity::glam::DVec3;
use radiosity::{Emitter, End, Mask, Ray, Rgb, Shot, Side, Work, cast, shoot};
use virtwall::Problem;

use crate::bench::{Bench, Trial};
use crate::finding::Count;

/// Patches of a trial that make about so many rays together, evenly chosen from all.
pub fn sources(bench: &Bench, trial: &Trial, most: u64) -> Vec<Emitter> {
    let problem = &*trial.problem;
    let rays = bench.case.rays.unwrap_or(u64::MAX).min(most);
    let all: Vec<(u32, u32)> = (0..)
        .zip(&problem.environments)
        .flat_map(|(e, environment)| (0..environment.patches.len() as u32).map(move |p| (e, p)))
        .filter(|&(e, p)| problem.environments[e as usize].patches[p as usize].area > 0.0)
        .filter(|&at| !bench.case.lamps_only || emits(problem, at))
        .collect();
    let wanted = rays.div_ceil(u64::from(problem.hemisphere.pixels())).min(all.len() as u64);
    let chosen = (0..wanted as usize).map(|i| all[i * all.len() / wanted as usize]);
    chosen.map(|(e, p)| source(problem, e, p)).collect()
}

/// Whether a patch, by environment and number, emits.
pub fn emits(problem: &Problem, (environment, patch): (u32, u32)) -> bool {
    let environment = &problem.environments[environment as usize];
    environment.emitted_power(&problem.space, patch) != Rgb::ZERO
}

/// A patch as a source of one watt.
fn source(problem: &Problem, environment: u32, patch: u32) -> Emitter {
    let geometry = problem.environments[environment as usize].patches[patch as usize];
    Emitter {
        environment,
        patch,
        polygon: geometry.polygon,
        centre: geometry.centre,
        normal: problem.space.scene.polygons[geometry.polygon as usize].plane.normal,
        power: Rgb::ONE,
        radiosity: Rgb::ONE,
    }
}

/// The rays of a source: its hemisphere's, or those aimed at all that is narrow.
pub fn rays(bench: &Bench, problem: &Problem, source: &Emitter) -> Vec<Ray> {
    if bench.case.aimed {
        return aimed(problem, source);
    }
    let [t, b, n] = problem.hemisphere.frame(source.centre, source.normal);
    let ray = |d: &DVec3| Ray::new(source.centre, t * d.x + b * d.y + n * d.z);
    problem.hemisphere.directions.iter().map(ray).collect()
}

/// Rays to corners of cells and to the corners and the middles of the edges of polygons.
fn aimed(problem: &Problem, source: &Emitter) -> Vec<Ray> {
    let (grid, scene) = (&problem.space.grid, &problem.space.scene);
    let mut targets: Vec<DVec3> = Vec::new();
    for cell in grid.whole().cells() {
        let bounds = grid.bounds(&radiosity::Block { low: cell, high: cell.map(|c| c + 1) });
        targets.extend([bounds.min, bounds.max]);
    }
    for polygon in &scene.polygons {
        let corners: Vec<DVec3> = scene.corners(polygon).collect();
        let next = corners.iter().cycle().skip(1);
        targets.extend(corners.iter().zip(next).flat_map(|(&a, &b)| [a, (a + b) * 0.5]));
    }
    let towards = |target: &DVec3| (*target - source.centre).try_normalize();
    let above = |direction: &DVec3| direction.dot(source.normal) > 1e-6;
    targets.iter().filter_map(towards).filter(above).map(|d| Ray::new(source.centre, d)).collect()
}

/// Rays of closed scenes that leave them.
pub fn leaks(bench: &Bench) -> Count {
    let mut count = Count::default();
    for trial in &bench.trials {
        for source in sources(bench, trial, u64::MAX) {
            count = count.and(if bench.case.aimed {
                let rays = aimed(&trial.problem, &source);
                let leaks = |ray: &&Ray| ours(&trial.problem, &source, ray).is_none();
                Count { wrong: rays.iter().filter(leaks).count() as u64, of: rays.len() as u64 }
            } else {
                shot_leaks(&trial.problem, &source)
            });
        }
    }
    count
}

/// The same of one source's hemisphere, whose pixels are all worth the same.
fn shot_leaks(problem: &Problem, source: &Emitter) -> Count {
    let (mut lost, pixels) = (0.0, problem.hemisphere.pixels());
    shoot_through(problem, source, |_, shot, _| lost += shot.escaped);
    Count { wrong: (lost * f64::from(pixels)).round() as u64, of: u64::from(pixels) }
}

/// Shoots a source through all environments that its mask comes to; `seen` is told each environment,
/// its shot and the mask.
pub fn shoot_through(problem: &Problem, source: &Emitter, mut seen: impl FnMut(u32, &Shot, &Mask)) {
    let mut waiting = vec![(source.environment, Mask::all(problem.hemisphere.pixels()))];
    while let Some((number, mask)) = waiting.pop() {
        let environment = &problem.environments[number as usize];
        let shot = shoot(&problem.space, environment, &problem.hemisphere, source, &mask);
        seen(number, &shot, &mask);
        for (side, outgoing) in Side::ALL.into_iter().zip(shot.outgoing) {
            let neighbour = |mask| (problem.decomposition.neighbour(number, side), mask);
            waiting.extend(outgoing.map(|outgoing| neighbour(outgoing.mask)));
        }
    }
}

/// Pixels that do not end exactly once over all environments.
pub fn owners(bench: &Bench) -> Count {
    let mut count = Count::default();
    for trial in &bench.trials {
        let pixels = trial.problem.hemisphere.pixels();
        for source in sources(bench, trial, u64::MAX) {
            let mut ends = vec![0_u32; pixels as usize];
            shoot_through(&trial.problem, &source, |_, shot, mask| {
                let mut left = Mask::none(pixels);
                shot.outgoing.iter().flatten().for_each(|outgoing| left.merge(&outgoing.mask));
                mask.ones().filter(|&pixel| !left.get(pixel)).for_each(|p| ends[p as usize] += 1);
            });
            let wrong = ends.iter().filter(|&&ends| ends != 1).count() as u64;
            count = count.and(Count { wrong, of: u64::from(pixels) });
        }
    }
    count
}

/// Where a ray ends when it is handed from environment to environment.
pub fn follow(problem: &Problem, source: &Emitter, ray: &Ray) -> End {
    let mut environment = source.environment;
    loop {
        let here = &problem.environments[environment as usize];
        match cast(&problem.space, here, ray, source.polygon, &mut Work::default()) {
            End::Leaves(side) if here.has_neighbour(side) => {
                environment = problem.decomposition.neighbour(environment, side);
            }
            end => return end,
        }
    }
}

/// The nearest of all polygons, each tested: what a ray must end on.
pub fn nearest(problem: &Problem, source: &Emitter, ray: &Ray) -> Option<f64> {
    let polygons = 0..problem.space.scene.polygons.len() as u32;
    let hit = |polygon| problem.space.facets.hit(polygon, ray, f64::INFINITY);
    polygons.filter(|&polygon| polygon != source.polygon).filter_map(hit).min_by(f64::total_cmp)
}

/// Rays of all trials that `ends` at another distance than the nearest polygon's.
pub fn astray(
    bench: &Bench,
    most: u64,
    ends: impl Fn(&Problem, &Emitter, &Ray) -> Option<f64>,
) -> Count {
    let mut count = Count::default();
    for trial in &bench.trials {
        let (problem, tolerance) = (&*trial.problem, trial.problem.space.scene.tolerance());
        for source in sources(bench, trial, most) {
            for ray in rays(bench, problem, &source) {
                let right = match (nearest(problem, &source, &ray), ends(problem, &source, &ray)) {
                    (Some(nearest), Some(end)) => (end - nearest).abs() <= tolerance,
                    (nearest, end) => nearest.is_none() && end.is_none(),
                };
                count = count.and(Count { wrong: u64::from(!right), of: 1 });
            }
        }
    }
    count
}

/// The distance at which our ray ends.
pub fn ours(problem: &Problem, source: &Emitter, ray: &Ray) -> Option<f64> {
    match follow(problem, source, ray) {
        End::Hit { distance, .. } => Some(distance),
        End::Leaves(_) => None,
    }
}

/// Of rays that meet several polygons of one plane at once, those that do not end on the one that most
/// of their like do.
pub fn torn(
    bench: &Bench,
    most: u64,
    end: impl Fn(&Problem, &Emitter, &Ray) -> Option<u32>,
) -> Count {
    let mut count = Count::default();
    for trial in &bench.trials {
        let problem = &*trial.problem;
        let mut ends: BTreeMap<Vec<u32>, BTreeMap<Option<u32>, u64>> = BTreeMap::new();
        for source in sources(bench, trial, most) {
            for ray in rays(bench, problem, &source) {
                let met = met_at_once(problem, &source, &ray);
                if met.len() > 1 {
                    let end = end(problem, &source, &ray);
                    *ends.entry(met).or_default().entry(end).or_default() += 1;
                }
            }
        }
        for ends in ends.values() {
            let of = ends.values().sum();
            count = count.and(Count { wrong: of - ends.values().max().unwrap_or(&0), of });
        }
    }
    count
}

/// The polygons whose fronts a ray meets first, all within the tolerance.
fn met_at_once(problem: &Problem, source: &Emitter, ray: &Ray) -> Vec<u32> {
    let facets = &problem.space.facets;
    let Some(first) = nearest(problem, source, ray) else { return Vec::new() };
    let reach = first + problem.space.scene.tolerance();
    let polygons = 0..problem.space.scene.polygons.len() as u32;
    let others = polygons.filter(|&p| p != source.polygon && facets.faces(p, ray));
    others.filter(|&p| facets.hit(p, ray, reach).is_some()).collect()
}

/// The polygon on which our ray ends.
pub fn our_polygon(problem: &Problem, source: &Emitter, ray: &Ray) -> Option<u32> {
    match follow(problem, source, ray) {
        End::Hit { polygon, .. } => Some(polygon),
        End::Leaves(_) => None,
    }
}
