//! The grid walk of Amanatides and Woo (1987) exactly as published: distances are accumulated step by step,
//! and components that are zero are divided by.

use radiosity::{Block, Emitter, Ray};
use virtwall::Problem;

/// The distance at which a ray ends.
pub fn end(problem: &Problem, source: &Emitter, ray: &Ray) -> Option<f64> {
    let grid = &problem.space.grid;
    let cells = grid.cells();
    let first = grid.cell_of(ray.origin);
    let mut cell = first.map(i64::from);
    let here = grid.bounds(&Block { low: first, high: first.map(|c| c + 1) });
    let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
    let (low, high) = (here.min.to_array(), here.max.to_array());
    let step = direction.map(|d| if d >= 0.0 { 1 } else { -1 });
    let mut next: [f64; 3] = std::array::from_fn(|axis| {
        let plane = if step[axis] > 0 { high[axis] } else { low[axis] };
        (plane - origin[axis]) / direction[axis]
    });
    let apart: [f64; 3] =
        std::array::from_fn(|axis| (high[axis] - low[axis]) / direction[axis].abs());
    loop {
        let axis = if next[0] < next[1] {
            if next[0] < next[2] { 0 } else { 2 }
        } else if next[1] < next[2] {
            1
        } else {
            2
        };
        let polygons = grid.polygons(cell.map(|c| c as u32)).iter();
        let hits = polygons
            .filter(|&&polygon| polygon != source.polygon)
            .filter_map(|&polygon| problem.space.facets.hit(polygon, ray, next[axis]));
        if let Some(distance) = hits.min_by(f64::total_cmp) {
            return Some(distance);
        }
        cell[axis] += step[axis];
        next[axis] += apart[axis];
        if !(0..i64::from(cells[axis])).contains(&cell[axis]) {
            return None;
        }
    }
}
