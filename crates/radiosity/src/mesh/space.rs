//! A scene sorted into the global grid. It does not depend on the decomposition.

use glam::DVec3;

use super::facets::Facets;
use super::grid::Grid;
use crate::scene::Scene;

/// A scene with its grid of cells.
pub struct Space {
    /// The scene. Vertices within the tolerance of a grid plane were moved onto it.
    pub scene: Scene,
    /// The grid over the whole scene.
    pub grid: Grid,
    /// The polygons in the form that ray tests read.
    pub facets: Facets,
}

impl Space {
    /// Sorts a scene into a grid with `cells` cells along each axis, at least 1.
    pub fn new(mut scene: Scene, cells: [u32; 3]) -> Space {
        let planes = Grid::planes(&scene, cells);
        snap(&mut scene, &planes);
        let grid = Grid::new(&scene, planes);
        let facets = Facets::new(&scene);
        Space { scene, grid, facets }
    }
}

/// Moves vertices within the tolerance of a grid plane exactly onto it. A polygon is then either in
/// a grid plane, and a ray crosses both at exactly the same distance, or clearly outside of it.
fn snap(scene: &mut Scene, planes: &[Vec<f64>; 3]) {
    let tolerance = scene.tolerance();
    for vertex in &mut scene.vertices {
        for (axis, planes) in planes.iter().enumerate() {
            let above = planes.partition_point(|&plane| plane < vertex[axis] - tolerance);
            if let Some(&plane) = planes.get(above)
                && plane <= vertex[axis] + tolerance
            {
                vertex[axis] = plane;
            }
        }
    }
    for polygon in &mut scene.polygons {
        let corners: Vec<DVec3> =
            polygon.vertices.iter().map(|&v| scene.vertices[v as usize]).collect();
        for axis in 0..3 {
            if corners.iter().all(|p| p[axis] == corners[0][axis]) {
                let mut normal = DVec3::ZERO;
                normal[axis] = polygon.plane.normal[axis].signum();
                polygon.plane.normal = normal;
                polygon.plane.offset = normal[axis] * corners[0][axis];
            }
        }
    }
}
