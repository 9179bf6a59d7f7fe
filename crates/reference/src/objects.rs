//! Form factors between the objects of a scene, an object being the union of its faces.

use radiosity::Scene;

use crate::cubature::{Estimate, Tolerance, integrate};
use crate::pair::{Pair, Surface};

/// The objects of a scene that have faces.
pub struct Objects<'a> {
    scene: &'a Scene,
    /// Number in the scene, faces, area in m².
    objects: Vec<(u32, Vec<Surface>, f64)>,
}

impl<'a> Objects<'a> {
    /// The objects of a scene. Faces of two-sided materials count with both sides.
    pub fn new(scene: &'a Scene) -> Objects<'a> {
        let mut objects: Vec<(u32, Vec<Surface>, f64)> =
            (0..scene.objects.len() as u32).map(|object| (object, Vec::new(), 0.0)).collect();
        for (number, polygon) in (0..).zip(&scene.polygons) {
            let (_, faces, area) = &mut objects[polygon.object as usize];
            faces.push(Surface::of_polygon(scene, number));
            *area += polygon.area;
        }
        objects.retain(|(_, faces, _)| !faces.is_empty());
        Objects { scene, objects }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.objects.len()
    }

    /// The name of one.
    pub fn name(&self, object: usize) -> &str {
        &self.scene.objects[self.objects[object].0 as usize]
    }

    /// The area of one, m².
    pub fn area(&self, object: usize) -> f64 {
        self.objects[object].2
    }

    /// The form factors between two objects, either way, each to within `tolerance` if that can be
    /// reached; the error says.
    pub fn exact(&self, one: usize, other: usize, tolerance: f64) -> [Estimate; 2] {
        let (_, from, from_area) = &self.objects[one];
        let (_, to, to_area) = &self.objects[other];
        let pairs: Vec<Pair> = from
            .iter()
            .flat_map(|from| to.iter().filter_map(|to| Pair::new(self.scene, from, to)))
            .collect();
        let parts = pairs.iter().enumerate().flat_map(|(i, pair)| pair.parts(i));
        let absolute = tolerance * from_area.min(*to_area);
        let exchange = integrate(parts, Tolerance { absolute, relative: 0.0 }, |pair, point| {
            pairs[pair].from_element(point)
        });
        [from_area, to_area].map(|area| exchange.over(*area))
    }
}
