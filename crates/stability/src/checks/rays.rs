//! Rays that are lost, claimed twice, or end in the wrong place.

use std::collections::BTreeMap;

use radiosity::{Emitter, Mask, Ray};
use virtwall::Problem;

use crate::checks::casting::{follow, nearest, rays, shoot_through, sources, wrong_rays};
use crate::finding::Count;
use crate::runs::CaseRuns;

/// Rays that leave closed scenes.
pub fn leaks(runs: &CaseRuns) -> Count {
    if runs.case.aimed {
        return wrong_rays(runs, u64::MAX, |problem, source, ray| {
            follow(problem, source, ray).is_none()
        });
    }
    let mut count = Count::default();
    for run in &runs.list {
        let pixels = run.problem.hemisphere.pixels();
        for source in sources(runs, run, u64::MAX) {
            // All pixels have the same form factor.
            let mut lost = 0.0;
            shoot_through(&run.problem, &source, |_, shot, _| lost += shot.escaped);
            let wrong = (lost * f64::from(pixels)).round() as u64;
            count = count.and(Count { wrong, of: u64::from(pixels) });
        }
    }
    count
}

/// Pixels that end not at all or more than once over all environments.
pub fn owners(runs: &CaseRuns) -> Count {
    let mut count = Count::default();
    for run in &runs.list {
        let pixels = run.problem.hemisphere.pixels();
        for source in sources(runs, run, u64::MAX) {
            let mut ends = vec![0_u32; pixels as usize];
            shoot_through(&run.problem, &source, |_, shot, mask| {
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

/// Rays for which `ends` gives another distance than that of the nearest polygon.
pub fn astray(
    runs: &CaseRuns,
    most: u64,
    ends: impl Fn(&Problem, &Emitter, &Ray) -> Option<f64>,
) -> Count {
    wrong_rays(runs, most, |problem, source, ray| {
        match (nearest(problem, source, ray), ends(problem, source, ray)) {
            (Some(nearest), Some(end)) => {
                let right = (end - nearest).abs() <= problem.space.scene.tolerance();
                !right
            }
            (nearest, end) => nearest.is_some() || end.is_some(),
        }
    })
}

/// The distance at which this program ends a ray.
pub fn ours(problem: &Problem, source: &Emitter, ray: &Ray) -> Option<f64> {
    follow(problem, source, ray).map(|(_, distance)| distance)
}

/// How often rays end on each polygon, by the polygons that they meet at once.
type Ends = BTreeMap<Vec<(u32, bool)>, BTreeMap<Option<u32>, u64>>;

/// Of the rays that meet several polygons of one plane at once from one side, those that end on another polygon than the
/// majority.
pub fn torn(
    runs: &CaseRuns,
    most: u64,
    end: impl Fn(&Problem, &Emitter, &Ray) -> Option<u32>,
) -> Count {
    let mut count = Count::default();
    for run in &runs.list {
        let problem = &*run.problem;
        let mut ends: Ends = BTreeMap::new();
        for source in sources(runs, run, most) {
            for ray in rays(runs, problem, &source) {
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

/// The polygons that a ray meets first, all at one distance within the tolerance; and whether it meets their
/// fronts.
fn met_at_once(problem: &Problem, source: &Emitter, ray: &Ray) -> Vec<(u32, bool)> {
    let facets = &problem.space.facets;
    let Some(first) = nearest(problem, source, ray) else { return Vec::new() };
    let reach = first + problem.space.scene.tolerance();
    let polygons = 0..problem.space.scene.polygons.len() as u32;
    let others = polygons.filter(|&p| p != source.polygon);
    let met = others.filter(|&p| facets.hit(p, ray, reach).is_some());
    met.map(|p| (p, facets.faces(p, ray))).collect()
}

/// The polygon on which this program ends a ray.
pub fn our_polygon(problem: &Problem, source: &Emitter, ray: &Ray) -> Option<u32> {
    follow(problem, source, ray).map(|(polygon, _)| polygon)
}
