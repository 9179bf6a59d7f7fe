//! Rays that ignore hits near their start, by an arbitrary length.

use radiosity::{Emitter, Ray};
use virtwall::Problem;

/// Hits nearer than this are ignored, metres.
const CLEAR: f64 = 1e-3;

/// The distance of the nearest polygon beyond [`CLEAR`].
pub fn end(problem: &Problem, _: &Emitter, ray: &Ray) -> Option<f64> {
    let beyond = Ray::new(ray.at(CLEAR), ray.direction);
    let polygons = 0..problem.space.scene.polygons.len() as u32;
    let hits = polygons.filter_map(|p| problem.space.facets.hit(p, &beyond, f64::INFINITY));
    hits.min_by(f64::total_cmp).map(|distance| distance + CLEAR)
}
