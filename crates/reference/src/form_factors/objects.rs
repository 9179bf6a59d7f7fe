//! Form factors between the objects of a scene, or its faces; an object is the union of its faces.

use std::collections::{BTreeMap, BTreeSet};

use radiosity::Scene;

use crate::form_factors::cubature::{Estimate, Tolerance, integrate};
use crate::form_factors::pair::{Pair, Surface};

/// The objects of a scene that have faces, or its faces, each an object.
pub struct Objects<'a> {
    scene: &'a Scene,
    objects: Vec<Object>,
    /// For each polygon, the index of its object here.
    of_faces: Vec<usize>,
}

struct Object {
    name: String,
    /// Its polygons.
    faces: Vec<u32>,
    /// m².
    area: f64,
}

impl<'a> Objects<'a> {
    /// The objects of a scene. Faces of two-sided materials count with both sides.
    pub fn new(scene: &'a Scene) -> Objects<'a> {
        let numbers: BTreeSet<u32> = scene.polygons.iter().map(|polygon| polygon.object).collect();
        let places: BTreeMap<u32, usize> = numbers.into_iter().zip(0..).collect();
        let names = places.keys().map(|&number| scene.objects[number as usize].clone());
        let of_faces = scene.polygons.iter().map(|polygon| places[&polygon.object]).collect();
        Objects::of(scene, names, of_faces)
    }

    /// The faces of a scene, each named after its object and its number there, from 1.
    pub fn faces_of(scene: &'a Scene) -> Objects<'a> {
        let mut counts = vec![0; scene.objects.len()];
        let names = scene.polygons.iter().map(|polygon| {
            let number = polygon.object as usize;
            counts[number] += 1;
            format!("{}/{}", scene.objects[number], counts[number])
        });
        Objects::of(scene, names, (0..scene.polygons.len()).collect())
    }

    fn of(
        scene: &'a Scene,
        names: impl Iterator<Item = String>,
        of_faces: Vec<usize>,
    ) -> Objects<'a> {
        let object = |name| Object { name, faces: Vec::new(), area: 0.0 };
        let mut objects: Vec<Object> = names.map(object).collect();
        for (number, (polygon, &place)) in (0..).zip(scene.polygons.iter().zip(&of_faces)) {
            objects[place].faces.push(number);
            objects[place].area += polygon.area;
        }
        Objects { scene, objects, of_faces }
    }

    /// The number of objects.
    pub fn count(&self) -> usize {
        self.objects.len()
    }

    /// The name of an object.
    pub fn name(&self, object: usize) -> &str {
        &self.objects[object].name
    }

    /// The area of an object, m².
    pub fn area(&self, object: usize) -> f64 {
        self.objects[object].area
    }

    /// The polygons of an object.
    pub(crate) fn faces(&self, object: usize) -> &[u32] {
        &self.objects[object].faces
    }

    /// The index of a polygon's object.
    pub(crate) fn of_face(&self, polygon: u32) -> usize {
        self.of_faces[polygon as usize]
    }

    /// The form factors between two objects in both directions. Each error is at most `tolerance` if that
    /// can be reached.
    pub fn exact(&self, one: usize, other: usize, tolerance: f64) -> [Estimate; 2] {
        let (from, to) = (&self.objects[one], &self.objects[other]);
        let surfaces = |object: &Object| -> Vec<Surface> {
            object.faces.iter().map(|&face| Surface::of_polygon(self.scene, face)).collect()
        };
        let (sources, targets) = (surfaces(from), surfaces(to));
        // Over the smaller one: edges of the larger one that meet it are met along a part only, where the
        // integrand jumps.
        let area = |surface: &Surface| self.scene.polygons[surface.polygon as usize].area;
        let pair = |one, other| {
            let (from, to) = if area(one) > area(other) { (other, one) } else { (one, other) };
            Pair::new(self.scene, from, to)
        };
        let pairs: Vec<Pair> = sources
            .iter()
            .flat_map(|one| targets.iter().filter_map(move |other| pair(one, other)))
            .collect();
        let parts = pairs.iter().enumerate().flat_map(|(i, pair)| pair.parts(i));
        let absolute = tolerance * from.area.min(to.area);
        let exchange = integrate(parts, Tolerance { absolute, relative: 0.0 }, |pair, point| {
            pairs[pair].from_element(point)
        });
        [from.area, to.area].map(|area| exchange.over(area))
    }
}
