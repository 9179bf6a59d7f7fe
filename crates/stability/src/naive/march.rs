//! Rays passed from environment to environment without a rule for rays that meet an edge.

use radiosity::{Bounds, Ray, Side};
use virtwall::Problem;

use crate::cases::naive_method::MAX_RAYS;
use crate::checks::casting::{nearest, wrong_rays};
use crate::finding::Count;
use crate::runs::CaseRuns;

/// Which rays an interface passes on.
#[derive(Clone, Copy, PartialEq)]
pub enum Interface {
    /// Those that meet its face, edges included.
    Closed,
    /// Those that meet its face, edges excluded.
    Open,
    /// Those that meet its plane anywhere.
    Unbounded,
}

/// Following a ray stops after it has ended this many times, since each edge may double it.
const MOST_ENDS: u32 = 64;

/// Rays that end not at all or more than once.
pub fn owners(runs: &CaseRuns, interface: Interface) -> Count {
    wrong_rays(runs, MAX_RAYS, |problem, source, ray| {
        let hit = nearest(problem, source, ray).unwrap_or(f64::INFINITY);
        March { problem, ray, hit, interface }.ends(source.environment, None, 0) != 1
    })
}

struct March<'a> {
    problem: &'a Problem,
    ray: &'a Ray,
    /// Distance of the nearest polygon.
    hit: f64,
    interface: Interface,
}

impl March<'_> {
    /// How often the ray ends in an environment, which it entered through `from`, and in those behind it.
    fn ends(&self, environment: u32, from: Option<Side>, depth: u32) -> u32 {
        let here = &self.problem.environments[environment as usize];
        let bounds = self.problem.space.grid.bounds(&here.block);
        let behind = |side: &Side| Some(*side) != from && self.passes(&bounds, *side);
        let through: Vec<Side> = Side::ALL.into_iter().filter(behind).collect();
        let ends_here = u32::from(self.ends_in(environment, &bounds));
        if ends_here == 1 && self.interface != Interface::Unbounded || depth > 32 {
            return ends_here;
        }
        let mut ends = ends_here;
        for side in through.into_iter().filter(|&side| here.has_neighbour(side)) {
            if ends >= MOST_ENDS {
                break;
            }
            let back = Side { upper: !side.upper, ..side };
            let neighbour = self.problem.decomposition.neighbour(environment, side);
            ends += self.ends(neighbour, Some(back), depth + 1);
        }
        ends
    }

    /// Whether the hit is in an environment, by the same rule at its interfaces.
    fn ends_in(&self, environment: u32, bounds: &Bounds) -> bool {
        let (here, point) =
            (&self.problem.environments[environment as usize], self.ray.at(self.hit));
        Side::ALL.into_iter().filter(|&side| here.has_neighbour(side)).all(|side| {
            let at = point[side.axis];
            match (side.upper, self.interface) {
                (true, Interface::Open) => at < bounds.max[side.axis],
                (true, _) => at <= bounds.max[side.axis],
                (false, Interface::Open) => at > bounds.min[side.axis],
                (false, _) => at >= bounds.min[side.axis],
            }
        })
    }

    /// Whether the ray passes a side of an environment before its hit.
    fn passes(&self, bounds: &Bounds, side: Side) -> bool {
        let plane = if side.upper { bounds.max } else { bounds.min }[side.axis];
        let (origin, direction) = (self.ray.origin[side.axis], self.ray.direction[side.axis]);
        let distance = (plane - origin) / direction;
        let outwards = if side.upper { direction > 0.0 } else { direction < 0.0 };
        if !(outwards && distance >= 0.0 && distance <= self.hit) {
            return false;
        }
        let point = self.ray.at(distance);
        let inside = |test: fn(f64, f64) -> bool| {
            (0..3).filter(|&axis| axis != side.axis).all(|axis| {
                test(bounds.min[axis], point[axis]) && test(point[axis], bounds.max[axis])
            })
        };
        match self.interface {
            Interface::Closed => inside(|a, b| a <= b),
            Interface::Open => inside(|a, b| a < b),
            Interface::Unbounded => true,
        }
    }
}
