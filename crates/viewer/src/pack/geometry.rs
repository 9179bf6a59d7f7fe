//! The block of a scene, which all runs of a problem share: materials, local environments, patches.

use radiosity::glam::{DMat3, DQuat, DVec3};
use radiosity::{Bounds, Mesh, Rgb, Shading};
use virtwall::Problem;

use super::Columns;

/// Steps along each axis in which corners are stored, in 16 bits.
const STEPS: f64 = 65_535.0;

pub(crate) fn geometry(problem: &Problem) -> Columns {
    let mut columns = Columns::default();
    let scene = &problem.space.scene;
    let turn = to_z(scene.up);
    let all = turned(turn, scene.bounds);
    columns.floats([all.min, all.max].iter().flat_map(|corner| corner.to_array()));
    let boxes = problem.environments.iter().map(|e| problem.space.grid.bounds(&e.block));
    let boxes = boxes.map(|bounds| turned(turn, bounds));
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

/// The rotation of an axis to z, which is up in the viewer. It only swaps axes, which is exact.
fn to_z(up: DVec3) -> DMat3 {
    let turn = DMat3::from_quat(DQuat::from_rotation_arc(up, DVec3::Z));
    DMat3::from_cols(turn.x_axis.round(), turn.y_axis.round(), turn.z_axis.round())
}

fn turned(turn: DMat3, bounds: Bounds) -> Bounds {
    Bounds::of([bounds.min, bounds.max].map(|corner| turn * corner))
}

/// The corners of each patch, and their positions. Patches share a position where smooth shading
/// averages them.
fn corners(problem: &Problem, columns: &mut Columns) {
    let mesh = Mesh::new(&problem.space, &problem.environments, Shading::Smooth);
    let scene = &problem.space.scene;
    let turn = to_z(scene.up);
    let Bounds { min: low, max: high } = turned(turn, scene.bounds);
    // Numbered as they occur in patches, so that differences are small.
    let mut numbers = vec![None; mesh.positions().len()];
    let mut positions = Vec::new();
    let corners = || mesh.fans().map(|fan| fan.get(1..).unwrap_or_default());
    columns.ints(corners().map(|corners| corners.len() as u64));
    columns.deltas(corners().flatten().map(|&vertex| {
        *numbers[vertex as usize].get_or_insert_with(|| {
            positions.push(turn * mesh.positions()[vertex as usize]);
            positions.len() as i64 - 1
        })
    }));
    for axis in 0..3 {
        let per_metre = STEPS / (high[axis] - low[axis]).max(f64::MIN_POSITIVE);
        let steps = positions.iter().map(|p| ((p[axis] - low[axis]) * per_metre).round());
        columns.deltas(steps.map(|step| step.clamp(0.0, STEPS) as i64));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box on which y is up becomes the same box on which z is.
    #[test]
    fn any_axis_becomes_z_exactly() {
        let bounds = Bounds { min: DVec3::new(-1.0, 0.1, -3.7), max: DVec3::new(2.0, 5.3, 4.0) };
        assert_eq!(turned(to_z(DVec3::Z), bounds), bounds);
        let (min, max) = (DVec3::new(-1.0, -4.0, 0.1), DVec3::new(2.0, 3.7, 5.3));
        assert_eq!(turned(to_z(DVec3::Y), bounds), Bounds { min, max });
        for up in [DVec3::X, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z] {
            assert_eq!(to_z(up) * up, DVec3::Z);
        }
    }
}
