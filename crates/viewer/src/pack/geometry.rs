//! The block of a scene, which all runs of a problem share: materials, local environments, patches.

use radiosity::{Bounds, Mesh, Rgb, Shading};
use virtwall::Problem;

use super::Columns;

/// Steps along each axis in which corners are stored, in 16 bits.
const STEPS: f64 = 65_535.0;

pub(crate) fn geometry(problem: &Problem) -> Columns {
    let mut columns = Columns::default();
    let scene = &problem.space.scene;
    let (low, high) = (scene.bounds.min, scene.bounds.max);
    columns.floats([low, high].iter().flat_map(|corner| corner.to_array()));
    let boxes = problem.environments.iter().map(|e| problem.space.grid.bounds(&e.block));
    columns.floats(boxes.flat_map(|b| b.min.to_array().into_iter().chain(b.max.to_array())));
    let materials = scene.materials.iter().flat_map(|m| [m.reflectance, m.emission]);
    columns.floats(materials.flat_map(|rgb: Rgb| rgb.to_array()));
    columns.ints(scene.polygons.iter().map(|polygon| u64::from(polygon.material)));
    let patches = || problem.environments.iter().flat_map(|e| e.patches.iter());
    columns.ints(problem.environments.iter().map(|e| e.patches.len() as u64));
    columns.deltas(patches().map(|patch| i64::from(patch.polygon)));
    corners(problem, &mut columns);
    let areas = problem.environments.iter();
    columns.floats(
        areas.flat_map(|e| (0..e.patches.len() as u32).map(|patch| e.radiosity_area(patch))),
    );
    columns
}

/// The corners of each patch, and their positions. Patches share a position where smooth shading
/// averages them.
fn corners(problem: &Problem, columns: &mut Columns) {
    let mesh = Mesh::new(&problem.space, &problem.environments, Shading::Smooth);
    let Bounds { min: low, max: high } = problem.space.scene.bounds;
    // Numbered as they occur in patches, so that differences are small.
    let mut numbers = vec![None; mesh.positions().len()];
    let mut positions = Vec::new();
    let corners = || mesh.fans().map(|fan| fan.get(1..).unwrap_or_default());
    columns.ints(corners().map(|corners| corners.len() as u64));
    columns.deltas(corners().flatten().map(|&vertex| {
        *numbers[vertex as usize].get_or_insert_with(|| {
            positions.push(mesh.positions()[vertex as usize]);
            positions.len() as i64 - 1
        })
    }));
    for axis in 0..3 {
        let per_metre = STEPS / (high[axis] - low[axis]).max(f64::MIN_POSITIVE);
        let steps = positions.iter().map(|p| ((p[axis] - low[axis]) * per_metre).round());
        columns.deltas(steps.map(|step| step.clamp(0.0, STEPS) as i64));
    }
}
