//! Cleans the faces of a file into a scene: local coordinates, welded vertices, convex planar
//! polygons with positive area, no duplicates.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use earcut::Earcut;
use glam::DVec3;

use super::coplanar::share_planes;
use super::error::{FARTHEST, SceneError};
use super::flat::flattened;
use super::overlaps::{cut_overlaps, order};
use super::scene::{Face, Material, Plane, Polygon, Rgb, Scene};
use super::warnings::{WarningKind, Warnings};
use crate::geometry::Bounds;

/// Largest distance of a corner from the plane of a planar face, relative to the size of the face.
const FLATNESS: f64 = 1e-6;

impl Scene {
    /// Cleans faces into a scene, with warnings about what had to be repaired.
    ///
    /// Coordinates become local to the centre of all corners, and those closer than 1e-9 of the
    /// diagonal become equal. Faces that are not planar (to 1e-6 of their size) or not convex are
    /// divided into triangles. Faces without area, and faces with the same corners and front as an
    /// other one, are dropped. A face of a two-sided material is stored twice, back to back.
    /// Corners are moved onto the planes of planar faces, which become level if they are almost so.
    /// Polygons in the same plane share it to the bit. Of those that face the same way and overlap,
    /// one is seen, whatever the order of the faces; what it covers is cut out of the others.
    ///
    /// # Errors
    /// An impossible material, a coordinate that is not finite or beyond 1e12 m, an index out of
    /// range, too many corners, or no face with an area.
    pub fn new(
        faces: &[Face],
        materials: Vec<Material>,
        objects: Vec<String>,
    ) -> Result<(Scene, Warnings), SceneError> {
        check(faces, &materials, &objects)?;
        let world = Bounds::of(faces.iter().flat_map(|f| f.points.iter().copied()));
        let origin = (world.min + world.max) * 0.5;
        let tolerance = 1e-9 * world.size().length();
        let (mut welded, corners) = weld(faces, origin, tolerance);

        let mut cleaner = Cleaner {
            vertices: &mut welded,
            tolerance,
            seen: BTreeMap::new(),
            materials: &materials,
            polygons: Vec::new(),
            warnings: Warnings::default(),
            earcut: Earcut::new(),
        };
        let mut corners = corners.as_slice();
        for (index, face) in faces.iter().enumerate() {
            let (own, rest) = corners.split_at(face.points.len());
            corners = rest;
            let two_sided = materials[face.material as usize].two_sided;
            cleaner.add(face, own, two_sided, || place(faces, index, &objects));
        }
        let Cleaner { mut polygons, mut warnings, .. } = cleaner;
        if polygons.is_empty() {
            let found = format!("no surface: {} faces, none with an area", faces.len());
            return Err(SceneError::Invalid(format!("{found}; expected at least one")));
        }
        share_planes(&mut polygons, tolerance);
        for overlap in cut_overlaps(&mut polygons, &mut welded, &materials, tolerance) {
            warnings.add_area(WarningKind::Overlap, overlap.area, || {
                let name = |object: u32| &objects[object as usize];
                format!("\"{}\" over \"{}\"", name(overlap.front), name(overlap.covered))
            });
        }
        check_absorption(&polygons, &materials)?;
        let vertices = keep_used(&welded, &mut polygons);
        let bounds = Bounds::of(vertices.iter().copied());
        let (up, media) = (DVec3::Z, Vec::new());
        let scene = Scene { vertices, polygons, materials, objects, origin, bounds, up, media };
        Ok((scene, warnings))
    }
}

/// Rejects surfaces that all reflect everything of a colour: its light might never end.
fn check_absorption(polygons: &[Polygon], materials: &[Material]) -> Result<(), SceneError> {
    let material = |polygon: &Polygon| &materials[polygon.material as usize];
    let least = polygons.iter().map(|polygon| material(polygon).reflectance).reduce(Rgb::min);
    if least.is_some_and(|least| least.max_element() == 1.0) {
        let name = &material(&polygons[0]).name;
        let found = format!("every face reflects all light of a colour (Kd 1, first: \"{name}\")");
        let expected =
            "some that absorb; \"clamp_reflectance\" in a scene file lowers reflectances";
        return Err(SceneError::Invalid(format!("{found}; expected {expected}")));
    }
    Ok(())
}

/// Names a face by its object and its number in it, counted from 1.
fn place(faces: &[Face], index: usize, objects: &[String]) -> String {
    let object = faces[index].object;
    let number = faces[..=index].iter().filter(|f| f.object == object).count();
    format!("object \"{}\", face {number}", objects[object as usize])
}

/// Rejects invalid materials, indices and coordinates.
fn check(faces: &[Face], materials: &[Material], objects: &[String]) -> Result<(), SceneError> {
    materials.iter().try_for_each(Material::check)?;
    let corners: usize = faces.iter().map(|f| f.points.len()).sum();
    if corners > u32::MAX as usize / 2 {
        let most = u32::MAX / 2;
        let message = format!("{corners} corners of faces; expected at most {most}");
        return Err(SceneError::Invalid(message));
    }
    for (number, face) in faces.iter().enumerate() {
        for (what, index, count) in
            [("material", face.material, materials.len()), ("object", face.object, objects.len())]
        {
            if index as usize >= count {
                let found = format!("face {} has {what} {index}", number + 1);
                return Err(SceneError::Invalid(format!("{found}; expected less than {count}")));
            }
        }
        // NaN fails the comparison too.
        if let Some(&at) = face.points.iter().find(|p| !p.abs().cmple(DVec3::splat(FARTHEST)).all())
        {
            return Err(SceneError::Corner { place: place(faces, number, objects), at });
        }
    }
    Ok(())
}

/// Welds corners: returns distinct vertices, local to the origin, and the index of each corner's
/// vertex.
///
/// On each axis coordinates closer than the tolerance become equal, so that faces in the same plane
/// x = c share it exactly. Vertices are equal if their three coordinates are.
fn weld(faces: &[Face], origin: DVec3, tolerance: f64) -> (Vec<DVec3>, Vec<u32>) {
    let points = || faces.iter().flat_map(|f| &f.points).map(|&p| p - origin);
    let levels: [Vec<f64>; 3] = std::array::from_fn(|axis| {
        let mut values: Vec<f64> = points().map(|p| p[axis]).collect();
        values.sort_unstable_by(f64::total_cmp);
        values.dedup_by(|next, first| *next - *first <= tolerance);
        values
    });
    let ranks: Vec<[u32; 3]> = points()
        .map(|p| std::array::from_fn(|a| levels[a].partition_point(|&v| v <= p[a]) as u32 - 1))
        .collect();
    let mut distinct = ranks.clone();
    distinct.sort_unstable();
    distinct.dedup();
    let corners =
        ranks.iter().map(|rank| distinct.partition_point(|other| other < rank) as u32).collect();
    let vertices = distinct
        .iter()
        .map(|rank| DVec3::from_array(std::array::from_fn(|a| levels[a][rank[a] as usize])))
        .collect();
    (vertices, corners)
}

/// Keeps the vertices that polygons use, and renumbers the corners of the polygons.
fn keep_used(vertices: &[DVec3], polygons: &mut [Polygon]) -> Vec<DVec3> {
    let mut number = vec![u32::MAX; vertices.len()];
    for &v in polygons.iter().flat_map(|p| &p.vertices) {
        number[v as usize] = 0;
    }
    let mut used = Vec::new();
    for (vertex, number) in vertices.iter().zip(&mut number).filter(|(_, n)| **n == 0) {
        *number = used.len() as u32;
        used.push(*vertex);
    }
    for v in polygons.iter_mut().flat_map(|p| &mut p.vertices) {
        *v = number[*v as usize];
    }
    used
}

/// Convex planar rings of vertices, each with its plane and area.
type Pieces = Vec<(Vec<u32>, Plane, f64)>;

/// Turns faces into polygons, one at a time.
struct Cleaner<'a> {
    vertices: &'a mut Vec<DVec3>,
    tolerance: f64,
    /// Rings of the polygons so far, each starting at its smallest vertex, and their numbers.
    seen: BTreeMap<Vec<u32>, usize>,
    materials: &'a [Material],
    polygons: Vec<Polygon>,
    warnings: Warnings,
    earcut: Earcut<f64>,
}

impl Cleaner<'_> {
    fn add(&mut self, face: &Face, corners: &[u32], two_sided: bool, place: impl Fn() -> String) {
        let ring = self.without_redundant_corners(corners);
        let Some((plane, area)) = self.measure(&ring) else {
            self.warnings.add(WarningKind::ZeroArea, place);
            return;
        };
        let split = if !self.is_planar(&ring, plane) {
            Some(WarningKind::NonPlanar)
        } else if !self.is_convex(&ring, plane) {
            Some(WarningKind::Concave)
        } else {
            None
        };
        let pieces = if let Some(kind) = split {
            self.warnings.add(kind, &place);
            self.triangles(&ring, plane, &place)
        } else {
            vec![(ring, plane, area)]
        };
        let mut duplicated = false;
        for (ring, plane, area) in pieces {
            let (flat, plane) = self.flattened(&ring, plane);
            let reversed = |ring: &[u32]| ring.iter().rev().copied().collect::<Vec<u32>>();
            let back = two_sided.then(|| (reversed(&ring), reversed(&flat)));
            duplicated |= !self.push(face, ring, flat, plane, area);
            if let Some((ring, flat)) = back {
                duplicated |= !self.push(face, ring, flat, plane.reversed(), area);
            }
        }
        if duplicated {
            self.warnings.add(WarningKind::Duplicate, place);
        }
    }

    /// The ring with corners exactly on a plane, and that plane.
    fn flattened(&mut self, ring: &[u32], plane: Plane) -> (Vec<u32>, Plane) {
        let corners: Vec<DVec3> = self.points(ring).collect();
        let Some((flat, plane)) = flattened(&corners, plane, self.slack(ring), self.tolerance)
        else {
            return (ring.to_vec(), plane);
        };
        let first = self.vertices.len() as u32;
        self.vertices.extend(&flat);
        ((first..).take(flat.len()).collect(), plane)
    }

    /// Adds a polygon of a ring that was flattened. Returns false if there is one of this ring; the one that is seen
    /// is kept.
    fn push(
        &mut self,
        face: &Face,
        ring: Vec<u32>,
        mut flat: Vec<u32>,
        plane: Plane,
        area: f64,
    ) -> bool {
        let mut key = ring;
        let least = (0..key.len()).min_by_key(|&i| key[i]).unwrap_or(0);
        key.rotate_left(least);
        flat.shrink_to_fit();
        let (material, object) = (face.material, face.object);
        let polygon = Polygon { vertices: flat, material, object, plane, area };
        match self.seen.entry(key) {
            Entry::Vacant(new) => {
                new.insert(self.polygons.len());
                self.polygons.push(polygon);
                true
            }
            Entry::Occupied(old) => {
                let old = &mut self.polygons[*old.get()];
                let polygon = Polygon { area: old.area, ..polygon };
                if order(&polygon, old, self.materials).is_lt() {
                    *old = polygon;
                }
                false
            }
        }
    }

    fn at(&self, vertex: u32) -> DVec3 {
        self.vertices[vertex as usize]
    }

    fn points(&self, ring: &[u32]) -> impl Iterator<Item = DVec3> + Clone {
        ring.iter().map(|&v| self.at(v))
    }

    /// The ring without corners that are repeated or on the line through their neighbours.
    fn without_redundant_corners(&self, ring: &[u32]) -> Vec<u32> {
        let mut kept: Vec<u32> = Vec::with_capacity(ring.len());
        for &corner in ring {
            while let [.., before, last] = *kept
                && self.is_redundant(before, last, corner)
            {
                kept.pop();
            }
            if kept.last() != Some(&corner) {
                kept.push(corner);
            }
        }
        // The same where the end of the ring meets its start.
        let mut rest = kept.as_slice();
        while let [first, second, .., before, last] = *rest {
            if self.is_redundant(before, last, first) {
                rest = &rest[..rest.len() - 1];
            } else if self.is_redundant(last, first, second) {
                rest = &rest[1..];
            } else {
                break;
            }
        }
        rest.to_vec()
    }

    fn is_redundant(&self, before: u32, corner: u32, after: u32) -> bool {
        let chord = self.at(after) - self.at(before);
        let off = (self.at(corner) - self.at(before)).cross(chord).length();
        off <= self.tolerance * chord.length()
    }

    /// Plane (Newell's method) and area of a ring, or `None` if it has no area.
    fn measure(&self, ring: &[u32]) -> Option<(Plane, f64)> {
        let first = self.at(*ring.first()?);
        let edges = || self.points(ring).zip(self.points(ring).cycle().skip(1));
        let perimeter: f64 = edges().map(|(a, b)| a.distance(b)).sum();
        let normal: DVec3 = edges().map(|(a, b)| (a - first).cross(b - first)).sum::<DVec3>() * 0.5;
        let area = normal.length();
        if ring.len() < 3 || area <= self.tolerance * perimeter {
            return None;
        }
        let level = (0..3).find(|&axis| self.points(ring).all(|p| p[axis] == first[axis]));
        let plane = match level {
            Some(axis) => {
                let side = normal[axis].signum();
                Plane { normal: DVec3::AXES[axis] * side, offset: first[axis] * side }
            }
            None => {
                let normal = normal / area;
                let offsets: f64 = self.points(ring).map(|p| normal.dot(p)).sum();
                Plane { normal, offset: offsets / ring.len() as f64 }
            }
        };
        Some((plane, area))
    }

    fn is_planar(&self, ring: &[u32], plane: Plane) -> bool {
        let slack = self.slack(ring);
        ring.len() == 3
            || self.points(ring).all(|p| (plane.normal.dot(p) - plane.offset).abs() <= slack)
    }

    /// Largest distance of a corner from a plane in which a ring is.
    fn slack(&self, ring: &[u32]) -> f64 {
        let size = Bounds::of(self.points(ring)).size().length();
        // Welding can move a corner by the tolerance along each axis.
        (FLATNESS * size).max(4.0 * self.tolerance)
    }

    /// Whether the ring turns left at every corner and goes around once: each corner is left of the
    /// first edge and the triangle fan from the first corner never turns back.
    fn is_convex(&self, ring: &[u32], plane: Plane) -> bool {
        let left = |a: u32, b: u32, c: u32| {
            let (a, b, c) = (self.at(a), self.at(b), self.at(c));
            (b - a).cross(c - a).dot(plane.normal) > 0.0
        };
        let n = ring.len();
        (0..n).all(|i| left(ring[i], ring[(i + 1) % n], ring[(i + 2) % n]))
            && (2..n).all(|i| left(ring[0], ring[1], ring[i]))
            && (2..n).all(|i| left(ring[0], ring[i - 1], ring[i]))
    }

    /// Triangles that cover a ring, with the same front.
    fn triangles(&mut self, ring: &[u32], plane: Plane, place: impl FnOnce() -> String) -> Pieces {
        // Projected along the largest component of the normal.
        let facing = plane.normal.abs().max_position();
        let flat: Vec<[f64; 2]> =
            self.points(ring).map(|p| [p[(facing + 1) % 3], p[(facing + 2) % 3]]).collect();
        let mut corners: Vec<u32> = Vec::new();
        self.earcut.earcut_slice(&flat, &[], &mut corners);
        if earcut::deviation(flat.iter().copied(), &[], &corners) > FLATNESS {
            self.warnings.add(WarningKind::SelfCrossing, place);
        }
        let mut pieces = Vec::with_capacity(corners.len() / 3);
        for triangle in corners.chunks_exact(3) {
            let mut triangle: Vec<u32> = triangle.iter().map(|&i| ring[i as usize]).collect();
            if let Some((own, area)) = self.measure(&triangle) {
                let turned = own.normal.dot(plane.normal) < 0.0;
                if turned {
                    triangle.reverse();
                }
                pieces.push((triangle, if turned { own.reversed() } else { own }, area));
            }
        }
        pieces
    }
}
