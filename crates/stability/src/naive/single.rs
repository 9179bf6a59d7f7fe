//! Triangles in single precision.

use radiosity::glam::{DVec3, Vec3};
use radiosity::{Emitter, Ray, Scene};
use virtwall::Problem;

use crate::cases::naive_method::MAX_RAYS;
use crate::checks::casting::{rays, sources};
use crate::finding::Count;
use crate::runs::CaseRuns;

/// How the corners of a polygon are rounded.
#[derive(Clone, Copy, PartialEq)]
pub enum Corners {
    /// Each corner once, so that neighbours share it.
    Shared,
    /// The first corner and the edges from it, so that neighbours differ.
    Own,
}

/// A corner, the edges from it, and the polygon to which the triangle belongs.
struct Triangle {
    corner: Vec3,
    edges: [Vec3; 2],
    polygon: u32,
}

fn triangles(scene: &Scene, corners: Corners) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    for (polygon, surface) in (0..).zip(&scene.polygons) {
        let world: Vec<DVec3> = scene.corners(surface).map(|p| p + scene.origin).collect();
        let single = |p: &DVec3| match corners {
            Corners::Shared => p.as_vec3(),
            Corners::Own => world[0].as_vec3() + (*p - world[0]).as_vec3(),
        };
        let points: Vec<Vec3> = world.iter().map(single).collect();
        let fan = points[1..].windows(2).map(|pair| Triangle {
            corner: points[0],
            edges: [pair[0] - points[0], pair[1] - points[0]],
            polygon,
        });
        triangles.extend(fan);
    }
    triangles
}

/// The distance of a hit, by Möller and Trumbore (1997).
fn distance(triangle: &Triangle, origin: Vec3, direction: Vec3) -> Option<f32> {
    let [a, b] = triangle.edges;
    let p = direction.cross(b);
    let inverse = 1.0 / a.dot(p);
    let t = origin - triangle.corner;
    let u = t.dot(p) * inverse;
    let q = t.cross(a);
    let v = direction.dot(q) * inverse;
    let distance = b.dot(q) * inverse;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0).then_some(distance)
}

/// Rays that hit no triangle of the scene of the last run, which is the most changed one.
pub fn leaks(runs: &CaseRuns, corners: Corners) -> Count {
    let Some(run) = runs.list.last() else { return Count::default() };
    let scene = &run.problem.space.scene;
    let triangles = triangles(scene, corners);
    let mut count = Count::default();
    for source in sources(runs, run, MAX_RAYS) {
        let origin = (source.centre + scene.origin).as_vec3();
        for ray in rays(runs, &run.problem, &source) {
            let direction = ray.direction.as_vec3();
            let hit = |triangle: &Triangle| {
                triangle.polygon != source.polygon
                    && distance(triangle, origin, direction).is_some()
            };
            count = count.and(Count { wrong: u64::from(!triangles.iter().any(hit)), of: 1 });
        }
    }
    count
}

/// The nearest polygon; of several at equal distance the last one.
pub fn last(problem: &Problem, source: &Emitter, ray: &Ray) -> Option<u32> {
    let (origin, direction) = (ray.origin.as_vec3(), ray.direction.as_vec3());
    let mut nearest: Option<(f32, u32)> = None;
    for triangle in triangles(&problem.space.scene, Corners::Shared) {
        let local =
            Triangle { corner: triangle.corner - problem.space.scene.origin.as_vec3(), ..triangle };
        if let Some(distance) = distance(&local, origin, direction)
            && local.polygon != source.polygon
            && nearest.is_none_or(|(other, _)| distance <= other)
        {
            nearest = Some((distance, local.polygon));
        }
    }
    nearest.map(|(_, polygon)| polygon)
}
