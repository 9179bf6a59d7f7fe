//! The rays of a case, and where they end.

use radiosity::glam::DVec3;
use radiosity::{Emitter, End, Mask, Ray, Rgb, Shot, Side, Work, cast, shoot};
use virtwall::Problem;

use crate::finding::Count;
use crate::runs::{CaseRun, CaseRuns};

/// Patches of a run as sources, chosen evenly from all. Together they cast about as many rays as the case
/// asks for, at most `most`.
pub fn sources(runs: &CaseRuns, run: &CaseRun, most: u64) -> Vec<Emitter> {
    let problem = &*run.problem;
    let rays = runs.case.rays.unwrap_or(u64::MAX).min(most);
    let all: Vec<(u32, u32)> = (0..)
        .zip(&problem.environments)
        .flat_map(|(e, environment)| (0..environment.patches.len() as u32).map(move |p| (e, p)))
        .filter(|&(e, p)| problem.environments[e as usize].patches[p as usize].area > 0.0)
        .filter(|&at| !runs.case.lamps_only || emits(problem, at))
        .collect();
    let wanted = rays.div_ceil(u64::from(problem.hemisphere.pixels())).min(all.len() as u64);
    let chosen = (0..wanted as usize).map(|i| all[i * all.len() / wanted as usize]);
    chosen.map(|(e, p)| source(problem, e, p)).collect()
}

/// Whether a patch emits; it is given by its environment and its number there.
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

/// The rays of a source: those of its hemisphere or, in an aimed case, those to corners and edges.
pub fn rays(runs: &CaseRuns, problem: &Problem, source: &Emitter) -> Vec<Ray> {
    if runs.case.aimed {
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

/// Shoots a source through all environments that its mask reaches. Calls `seen` with each environment, the
/// shot there and the mask.
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

/// Of all rays, at most about `most` a run, those that are wrong.
pub fn wrong_rays(
    runs: &CaseRuns,
    most: u64,
    is_wrong: impl Fn(&Problem, &Emitter, &Ray) -> bool,
) -> Count {
    let mut count = Count::default();
    for run in &runs.list {
        for source in sources(runs, run, most) {
            let rays = rays(runs, &run.problem, &source);
            let wrong = rays.iter().filter(|ray| is_wrong(&run.problem, &source, ray)).count();
            count = count.and(Count { wrong: wrong as u64, of: rays.len() as u64 });
        }
    }
    count
}

/// The polygon and the distance at which this program ends a ray, from environment to environment.
pub fn follow(problem: &Problem, source: &Emitter, ray: &Ray) -> Option<(u32, f64)> {
    let mut environment = source.environment;
    loop {
        let here = &problem.environments[environment as usize];
        match cast(&problem.space, here, ray, source.polygon, &mut Work::default()) {
            End::Leaves(side) if here.has_neighbour(side) => {
                environment = problem.decomposition.neighbour(environment, side);
            }
            End::Leaves(_) => return None,
            End::Hit { polygon, distance } => return Some((polygon, distance)),
        }
    }
}

/// The distance of the nearest polygon, found by testing all: where a ray must end.
pub fn nearest(problem: &Problem, source: &Emitter, ray: &Ray) -> Option<f64> {
    let polygons = 0..problem.space.scene.polygons.len() as u32;
    let hit = |polygon| problem.space.facets.hit(polygon, ray, f64::INFINITY);
    polygons.filter(|&polygon| polygon != source.polygon).filter_map(hit).min_by(f64::total_cmp)
}
