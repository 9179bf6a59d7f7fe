//! Warnings about the light of a scene: there is none, or it falls on backs.

use radiosity::glam::DVec3;
use radiosity::{ObjFile, Polygon, Rgb, Scene};

/// Most lamps from which rays are cast.
const LAMPS: usize = 8;

/// Directions of the rays of a lamp, whose normal is z.
const DIRECTIONS: [DVec3; 8] = [
    DVec3::new(0.17, 0.02, 0.98),
    DVec3::new(-0.07, 0.42, 0.91),
    DVec3::new(-0.44, -0.37, 0.82),
    DVec3::new(0.66, -0.24, 0.71),
    DVec3::new(0.38, 0.66, 0.64),
    DVec3::new(-0.75, 0.43, 0.5),
    DVec3::new(0.03, -0.91, 0.42),
    DVec3::new(-0.91, -0.33, 0.26),
];

/// Names of the materials in use that older files would mean as lamps: by `Ka` above 1.
pub fn bright_ambients(file: &ObjFile) -> Vec<String> {
    let bright = file.used_materials().filter(|material| material.ambient.max_element() > 1.0);
    bright.map(|material| format!("\"{}\"", material.name())).collect()
}

/// A warning if nothing emits light or if most of what is emitted falls on backs.
pub fn warning(scene: &Scene, bright_ambients: &[String]) -> Option<String> {
    let lamps: Vec<&Polygon> =
        scene.polygons.iter().filter(|p| scene.material(p).emission != Rgb::ZERO).collect();
    if lamps.is_empty() {
        let meant = match bright_ambients {
            [] => String::new(),
            names => format!(" (Ka is above 1 in {}, perhaps meant as lamps)", names.join(", ")),
        };
        let what_to_do = "give a material Ke in its MTL file, or in a scene file";
        return Some(format!("no polygon emits light, so that all is dark{meant}: {what_to_do}"));
    }
    let (hits, backs) = rays(scene, &lamps);
    if 2 * backs <= hits {
        return None;
    }
    let all = scene.polygons.len();
    let outward = scene.polygons.iter().filter(|polygon| faces_out(scene, polygon)).count();
    let polygons = match outward {
        0 => String::new(),
        count => format!(" ({count} of {all} polygons face out of the scene and have no patches)"),
    };
    Some(format!(
        "{backs} of {hits} rays from lamps fall on backs, which absorb all light{polygons}: turn these \
         polygons over, since fronts are where corners run counter-clockwise, or make their \
         materials two-sided"
    ))
}

/// The numbers of rays from lamps that meet a polygon, and that meet only its back.
fn rays(scene: &Scene, lamps: &[&Polygon]) -> (usize, usize) {
    let some = lamps.iter().step_by(lamps.len().div_ceil(LAMPS));
    let rays = some.flat_map(|lamp| {
        let count = lamp.vertices.len() as f64;
        let centre = scene.corners(lamp).sum::<DVec3>() / count;
        let normal = lamp.plane.normal;
        let (u, v) = normal.any_orthonormal_pair();
        DIRECTIONS.map(|way| (centre, (u * way.x + v * way.y + normal * way.z).normalize()))
    });
    let fronts: Vec<bool> = rays.filter_map(|(from, way)| meets_front(scene, from, way)).collect();
    (fronts.len(), fronts.iter().filter(|&&front| !front).count())
}

/// Whether the nearest polygon along a ray shows its front; `None` if there is no polygon.
fn meets_front(scene: &Scene, from: DVec3, way: DVec3) -> Option<bool> {
    let tolerance = scene.tolerance();
    let mut nearest: Option<(f64, bool)> = None;
    for polygon in &scene.polygons {
        let towards = polygon.plane.normal.dot(way);
        let distance = (polygon.plane.offset - polygon.plane.normal.dot(from)) / towards;
        let front = towards < 0.0;
        // Polygons back to back are at the same distance: one of them shows its front.
        let nearer = nearest.is_none_or(|(least, _)| distance < least - tolerance);
        let same = || nearest.is_some_and(|(least, _)| front && distance <= least + tolerance);
        let ahead = distance > tolerance && distance.is_finite();
        if ahead && (nearer || same()) && contains(scene, polygon, from + way * distance) {
            nearest = Some((distance, front));
        }
    }
    nearest.map(|(_, front)| front)
}

/// Whether a point in the plane of a polygon is inside it.
fn contains(scene: &Scene, polygon: &Polygon, point: DVec3) -> bool {
    let next = scene.corners(polygon).skip(1).chain(scene.corners(polygon).take(1));
    let mut edges = scene.corners(polygon).zip(next);
    edges.all(|(a, b)| (b - a).cross(point - a).dot(polygon.plane.normal) >= 0.0)
}

/// Whether a polygon is in a side of the scene's bounds and faces outwards.
fn faces_out(scene: &Scene, polygon: &Polygon) -> bool {
    let (low, high) = (scene.bounds.min, scene.bounds.max);
    (0..3).any(|axis| {
        let normal = polygon.plane.normal[axis];
        let in_plane = |plane: f64| scene.corners(polygon).all(|corner| corner[axis] == plane);
        (normal == 1.0 && in_plane(high[axis])) || (normal == -1.0 && in_plane(low[axis]))
    })
}
