//! Form factors between the objects of a scene; an object is the union of its faces.

use radiosity::Scene;

use crate::form_factors::cubature::{Estimate, Tolerance, integrate};
use crate::form_factors::pair::{Pair, Surface};

/// The objects of a scene that have faces.
pub struct Objects<'a> {
    scene: &'a Scene,
    objects: Vec<Object>,
}

struct Object {
    /// Its number in the scene.
    number: u32,
    /// Its polygons.
    faces: Vec<u32>,
    /// m².
    area: f64,
}

impl<'a> Objects<'a> {
    /// The objects of a scene. Faces of two-sided materials count with both sides.
    pub fn new(scene: &'a Scene) -> Objects<'a> {
        let object = |number| Object { number, faces: Vec::new(), area: 0.0 };
        let mut objects: Vec<Object> = (0..scene.objects.len() as u32).map(object).collect();
        for (number, polygon) in (0..).zip(&scene.polygons) {
            let object = &mut objects[polygon.object as usize];
            object.faces.push(number);
            object.area += polygon.area;
        }
        objects.retain(|object| !object.faces.is_empty());
        Objects { scene, objects }
    }

    /// The number of objects.
    pub fn count(&self) -> usize {
        self.objects.len()
    }

    /// The name of an object.
    pub fn name(&self, object: usize) -> &str {
        &self.scene.objects[self.objects[object].number as usize]
    }

    /// The area of an object, m².
    pub fn area(&self, object: usize) -> f64 {
        self.objects[object].area
    }

    /// The polygons of an object.
    pub(crate) fn faces(&self, object: usize) -> &[u32] {
        &self.objects[object].faces
    }

    /// The index here of the object with this number in the scene.
    pub(crate) fn place(&self, number: u32) -> Option<usize> {
        self.objects.binary_search_by_key(&number, |object| object.number).ok()
    }

    /// The form factors between two objects in both directions. Each error is at most `tolerance` if that
    /// can be reached.
    pub fn exact(&self, one: usize, other: usize, tolerance: f64) -> [Estimate; 2] {
        let (from, to) = (&self.objects[one], &self.objects[other]);
        let surfaces = |object: &Object| -> Vec<Surface> {
            object.faces.iter().map(|&face| Surface::of_polygon(self.scene, face)).collect()
        };
        let (sources, targets) = (surfaces(from), surfaces(to));
        let pairs: Vec<Pair> = sources
            .iter()
            .flat_map(|from| targets.iter().filter_map(|to| Pair::new(self.scene, from, to)))
            .collect();
        let parts = pairs.iter().enumerate().flat_map(|(i, pair)| pair.parts(i));
        let absolute = tolerance * from.area.min(to.area);
        let exchange = integrate(parts, Tolerance { absolute, relative: 0.0 }, |pair, point| {
            pairs[pair].from_element(point)
        });
        [from.area, to.area].map(|area| exchange.over(area))
    }
}
