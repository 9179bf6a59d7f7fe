//! Polygons of one plane that face the same way and overlap.
//!
//! A side of a plane has one surface at each point. Where polygons overlap, one of them is seen, whatever
//! the order of the faces in a file. The part that it covers is cut out of the others: it neither emits
//! nor receives light, and nothing that follows needs to know of it.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use glam::DVec3;

use super::scene::{Material, Polygon};
use crate::geometry::{Bounds, area_and_centroid, clip_to_half, cut_by_edge, visit_pairs};

/// Two polygons that overlap.
pub(crate) struct Overlap {
    /// The object that is seen.
    pub(crate) front: u32,
    /// The object that is covered.
    pub(crate) covered: u32,
    /// m².
    pub(crate) area: f64,
}

/// Cuts covered parts out of polygons. Pieces take the place of their polygon; new corners are added to
/// the vertices. Returns the overlaps.
pub(crate) fn cut_overlaps(
    polygons: &mut Vec<Polygon>,
    vertices: &mut Vec<DVec3>,
    materials: &[Material],
    tolerance: f64,
) -> Vec<Overlap> {
    let rings: Vec<Vec<DVec3>> = polygons.iter().map(|p| ring(p, vertices)).collect();
    let shared = find(polygons, &rings, tolerance);
    if shared.is_empty() {
        return Vec::new();
    }
    // Front to back; the places of different polygons differ.
    let sorted = |a: u32, b: u32| {
        let [one, other] = [a, b].map(|number| &polygons[number as usize]);
        order(one, other, materials).then_with(|| from_least(one).cmp(&from_least(other)))
    };
    let mut covers: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    let mut overlaps = Vec::new();
    for (one, other, area) in shared {
        let seen = sorted(one, other).is_lt();
        let (front, covered) = if seen { (one, other) } else { (other, one) };
        covers.entry(covered).or_default().push(front);
        let [front, covered] = [front, covered].map(|number| polygons[number as usize].object);
        overlaps.push(Overlap { front, covered, area });
    }
    covers.values_mut().for_each(|fronts| fronts.sort_by(|&a, &b| sorted(a, b)));

    let mut corners = Corners::new(vertices);
    let whole = std::mem::take(polygons);
    for (number, polygon) in (0..).zip(whole) {
        let Some(fronts) = covers.get(&number) else {
            polygons.push(polygon);
            continue;
        };
        let start = vec![rings[number as usize].clone()];
        let pieces = fronts.iter().fold(start, |pieces, &front| {
            let cover = Cover::new(&rings[front as usize], polygon.plane.normal, tolerance);
            pieces.into_iter().flat_map(|piece| cover.cut(piece)).collect()
        });
        for piece in pieces {
            let area = area_and_centroid(&piece).0;
            let numbers = piece.into_iter().map(|corner| corners.number(corner)).collect();
            polygons.push(Polygon { vertices: numbers, area, ..polygon.clone() });
        }
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

/// The corners of a polygon from its first vertex on, the one with the least number.
fn from_least(polygon: &Polygon) -> Vec<u32> {
    let mut vertices = polygon.vertices.clone();
    let least = (0..vertices.len()).min_by_key(|&place| vertices[place]).unwrap_or(0);
    vertices.rotate_left(least);
    vertices
}

/// Positions of the corners of a polygon, the same wherever its face starts in a file.
fn ring(polygon: &Polygon, vertices: &[DVec3]) -> Vec<DVec3> {
    from_least(polygon).iter().map(|&vertex| vertices[vertex as usize]).collect()
}

/// Pairs of polygons with the same plane and front that overlap, and the area that they share, m².
fn find(polygons: &[Polygon], rings: &[Vec<DVec3>], tolerance: f64) -> Vec<(u32, u32, f64)> {
    // Zero is added so that -0 and 0 are the same.
    let plane = |number: &u32| {
        let plane = polygons[*number as usize].plane;
        let [x, y, z] = plane.normal.to_array();
        [x, y, z, plane.offset].map(|part| (part + 0.0).to_bits())
    };
    let mut numbers: Vec<u32> = (0..polygons.len() as u32).collect();
    numbers.sort_by_key(|number| (plane(number), *number));
    let mut overlaps = Vec::new();
    for alike in numbers.chunk_by(|one, other| plane(one) == plane(other)) {
        let normal = polygons[alike[0] as usize].plane.normal;
        let ring = |number: u32| &rings[number as usize];
        let bounds = |&number: &u32| Bounds::of(ring(number).iter().copied());
        let boxes: Vec<Bounds> = alike.iter().map(bounds).collect();
        visit_pairs(&boxes, |one, other| {
            let [one, other] = [one, other].map(|place| alike[place as usize]);
            let cover = Cover::new(ring(one), normal, tolerance);
            if let Some(area) = cover.shared_area(ring(other)) {
                overlaps.push((one.min(other), one.max(other), area));
            }
        });
    }
    overlaps.sort_by_key(|&(one, other, _)| (one, other));
    overlaps
}

/// A convex polygon that covers others of its plane.
struct Cover<'a> {
    ring: &'a [DVec3],
    normal: DVec3,
    tolerance: f64,
}

impl Cover<'_> {
    fn new(ring: &[DVec3], normal: DVec3, tolerance: f64) -> Cover<'_> {
        Cover { ring, normal, tolerance }
    }

    fn edges(&self) -> impl Iterator<Item = [DVec3; 2]> + '_ {
        let next = self.ring.iter().cycle().skip(1);
        self.ring.iter().zip(next).map(|(&from, &to)| [from, to])
    }

    /// The area shared with a convex polygon, m², if they overlap.
    fn shared_area(&self, other: &[DVec3]) -> Option<f64> {
        let shared = self.edges().fold(other.to_vec(), |ring, [from, to]| {
            let inwards = self.normal.cross(to - from);
            clip_to_half(&ring, |p| inwards.dot(p - from))
        });
        // Neighbours share a strip no wider than the tolerance.
        let strip = Bounds::of(shared.iter().copied()).size().length() * 4.0 * self.tolerance;
        Some(area_and_centroid(&shared).0).filter(|&area| area > strip)
    }

    /// The convex parts of a polygon that are not covered.
    fn cut(&self, polygon: Vec<DVec3>) -> Vec<Vec<DVec3>> {
        if self.shared_area(&polygon).is_none() {
            return vec![polygon];
        }
        let mut inside = polygon;
        let mut parts = Vec::new();
        for edge in self.edges() {
            let [within, beyond] = cut_by_edge(&inside, edge, self.normal, self.tolerance);
            parts.extend(Some(beyond).filter(|part| self.has_area(part)));
            inside = within;
        }
        parts
    }

    /// Whether a part is wider than the tolerance.
    fn has_area(&self, part: &[DVec3]) -> bool {
        let next = part.iter().cycle().skip(1);
        let perimeter: f64 = part.iter().zip(next).map(|(a, b)| a.distance(*b)).sum();
        area_and_centroid(part).0 > self.tolerance * perimeter
    }
}

/// Numbers of vertices by position.
struct Corners<'a> {
    vertices: &'a mut Vec<DVec3>,
    numbers: BTreeMap<[u64; 3], u32>,
}

impl Corners<'_> {
    fn new(vertices: &mut Vec<DVec3>) -> Corners<'_> {
        let numbers = vertices.iter().map(|&vertex| key(vertex)).zip(0..).collect();
        Corners { vertices, numbers }
    }

    fn number(&mut self, at: DVec3) -> u32 {
        let new = self.vertices.len() as u32;
        let number = *self.numbers.entry(key(at)).or_insert(new);
        if number == new {
            self.vertices.push(at);
        }
        number
    }
}

/// The bits of a position, the same for -0 and 0.
fn key(at: DVec3) -> [u64; 3] {
    (at + 0.0).to_array().map(f64::to_bits)
}
