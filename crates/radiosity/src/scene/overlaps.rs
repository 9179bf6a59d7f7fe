//! Polygons of one plane that face the same way and overlap.
//!
//! A ray meets them at the same distance, and of equal fronts the polygon with the lower number is hit.
//! So their order decides which one is seen, for rays, exact form factors and pictures alike. Here it is
//! made independent of the order of the faces in a file.

use std::cmp::Ordering;

use glam::DVec3;

use super::scene::{Material, Polygon};
use crate::geometry::{Bounds, area_and_centroid, clip_to_half, visit_pairs};

/// Two polygons that overlap.
pub(crate) struct Overlap {
    /// The one that is seen.
    pub(crate) front: u32,
    /// The one that is covered.
    pub(crate) covered: u32,
    /// m².
    pub(crate) area: f64,
}

/// Sorts overlapping polygons: lights first, then the smaller one. Other polygons keep their numbers.
/// Returns the overlaps.
pub(crate) fn sort_overlaps(
    polygons: &mut [Polygon],
    vertices: &[DVec3],
    materials: &[Material],
    tolerance: f64,
) -> Vec<Overlap> {
    let mut overlaps = find(polygons, vertices, tolerance);
    if overlaps.is_empty() {
        return overlaps;
    }
    let mut numbers: Vec<u32> = (0..polygons.len() as u32).collect();
    for members in connected(polygons.len(), &overlaps) {
        let polygon = |number: u32| &polygons[number as usize];
        let mut sorted = members.clone();
        sorted.sort_by(|&a, &b| order(polygon(a), polygon(b), materials));
        let copies: Vec<Polygon> = sorted.iter().map(|&number| polygon(number).clone()).collect();
        for ((place, old), copy) in members.into_iter().zip(sorted).zip(copies) {
            polygons[place as usize] = copy;
            numbers[old as usize] = place;
        }
    }
    for Overlap { front, covered, .. } in &mut overlaps {
        let [one, other] = [*front, *covered].map(|old| numbers[old as usize]);
        (*front, *covered) = (one.min(other), one.max(other));
    }
    overlaps
}

/// Which of two overlapping polygons is seen: lights first, then the smaller one, then the brighter one.
pub(crate) fn order(one: &Polygon, other: &Polygon, materials: &[Material]) -> Ordering {
    let emission = |p: &Polygon| materials[p.material as usize].emission.element_sum();
    let reflectance = |p: &Polygon| materials[p.material as usize].reflectance.to_array();
    let dark = |p: &Polygon| emission(p) <= 0.0;
    let brighter = |a: f64, b: f64| b.total_cmp(&a);
    let reflected = || {
        let components = reflectance(one).into_iter().zip(reflectance(other));
        components.map(|(a, b)| brighter(a, b)).find(|o| o.is_ne()).unwrap_or(Ordering::Equal)
    };
    dark(one)
        .cmp(&dark(other))
        .then(one.area.total_cmp(&other.area))
        .then_with(|| brighter(emission(one), emission(other)))
        .then_with(reflected)
}

/// The overlaps of polygons with the same plane and front.
fn find(polygons: &[Polygon], vertices: &[DVec3], tolerance: f64) -> Vec<Overlap> {
    // Zero is added so that -0 and 0 are the same.
    let plane = |number: &u32| {
        let plane = polygons[*number as usize].plane;
        let [x, y, z] = plane.normal.to_array();
        [x, y, z, plane.offset].map(|part| (part + 0.0).to_bits())
    };
    let corners = |number: u32| -> Vec<DVec3> {
        let polygon = &polygons[number as usize];
        polygon.vertices.iter().map(|&vertex| vertices[vertex as usize]).collect()
    };
    let mut numbers: Vec<u32> = (0..polygons.len() as u32).collect();
    numbers.sort_by_key(|number| (plane(number), *number));
    let mut overlaps = Vec::new();
    for alike in numbers.chunk_by(|one, other| plane(one) == plane(other)) {
        let boxes: Vec<Bounds> = alike.iter().map(|&number| Bounds::of(corners(number))).collect();
        visit_pairs(&boxes, |one, other| {
            let [one, other] = [one, other].map(|place| alike[place as usize]);
            let normal = polygons[one as usize].plane.normal;
            let area = shared_area(&corners(one), &corners(other), normal);
            // Neighbours share a strip no wider than the tolerance.
            let strip = shared_length(&corners(one), &corners(other)) * 4.0 * tolerance;
            if area > strip {
                overlaps.push(Overlap { front: one.min(other), covered: one.max(other), area });
            }
        });
    }
    overlaps.sort_by_key(|overlap| (overlap.front, overlap.covered));
    overlaps
}

/// The length of the diagonal of the space that two polygons share, metres.
fn shared_length(one: &[DVec3], other: &[DVec3]) -> f64 {
    let [one, other] = [one, other].map(|corners| Bounds::of(corners.iter().copied()));
    one.intersection(&other).size().length()
}

/// The area that two convex polygons of one plane share, m².
fn shared_area(one: &[DVec3], other: &[DVec3], normal: DVec3) -> f64 {
    let edges = other.iter().zip(other.iter().cycle().skip(1));
    let shared = edges.fold(one.to_vec(), |ring, (&from, &to)| {
        let inwards = normal.cross(to - from);
        clip_to_half(&ring, |p| inwards.dot(p - from))
    });
    area_and_centroid(&shared).0
}

/// Groups of polygons that are connected by overlaps, each in increasing order.
fn connected(polygons: usize, overlaps: &[Overlap]) -> Vec<Vec<u32>> {
    let mut parents: Vec<u32> = (0..polygons as u32).collect();
    let root = |parents: &mut [u32], mut number: u32| {
        while parents[number as usize] != number {
            parents[number as usize] = parents[parents[number as usize] as usize];
            number = parents[number as usize];
        }
        number
    };
    for &Overlap { front, covered, .. } in overlaps {
        let [one, other] = [front, covered].map(|number| root(&mut parents, number));
        parents[one.max(other) as usize] = one.min(other);
    }
    let mut members: Vec<u32> = overlaps.iter().flat_map(|o| [o.front, o.covered]).collect();
    members.sort_unstable();
    members.dedup();
    let mut rooted: Vec<(u32, u32)> =
        members.into_iter().map(|number| (root(&mut parents, number), number)).collect();
    rooted.sort_unstable();
    let groups = rooted.chunk_by(|one, other| one.0 == other.0);
    groups.map(|group| group.iter().map(|&(_, number)| number).collect()).collect()
}
