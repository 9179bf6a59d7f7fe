//! Gives polygons in the same plane exactly the same plane.

use super::scene::{Plane, Polygon};

/// Components of unit normals that differ by less count as equal.
const NORMALS: f64 = 1e-9;

/// Replaces planes that differ only by rounding by the plane of the largest polygon among them, so
/// that a ray meets all of them at the same distance and the rules for equal distances decide.
/// Axis-aligned polygons share planes already, since corners are welded for each axis.
pub(crate) fn share_planes(polygons: &mut [Polygon], tolerance: f64) {
    let slanted = |polygon: &Polygon| polygon.plane.normal.abs().max_element() < 1.0;
    let numbers: Vec<usize> = (0..polygons.len()).filter(|&i| slanted(&polygons[i])).collect();
    let planes: Vec<Plane> = numbers.iter().map(|&i| facing_up(polygons[i].plane)).collect();
    let parts = |plane: &Plane| [plane.normal.x, plane.normal.y, plane.normal.z, plane.offset];
    let levels: [Vec<f64>; 4] = std::array::from_fn(|part| {
        let mut values: Vec<f64> = planes.iter().map(|plane| parts(plane)[part]).collect();
        values.sort_unstable_by(f64::total_cmp);
        let within = if part < 3 { NORMALS } else { tolerance };
        values.dedup_by(|next, first| *next - *first <= within);
        values
    });
    let rank = |plane: &Plane| -> [usize; 4] {
        std::array::from_fn(|i| levels[i].partition_point(|&level| level <= parts(plane)[i]))
    };
    let mut order: Vec<([usize; 4], usize)> = planes.iter().map(rank).zip(0..).collect();
    order.sort_unstable();
    for alike in order.chunk_by(|one, other| one.0 == other.0) {
        // The plane of the largest polygon is the most accurate.
        let area = |&(_, i): &([usize; 4], usize)| polygons[numbers[i]].area;
        let largest = alike.iter().max_by(|one, other| area(one).total_cmp(&area(other)));
        let Some(shared) = largest.map(|&(_, i)| planes[i]) else { continue };
        for &(_, i) in alike {
            let plane = &mut polygons[numbers[i]].plane;
            let turned = facing_up(*plane) != *plane;
            *plane = if turned { shared.reversed() } else { shared };
        }
    }
}

/// The plane, reversed if the first non-zero component of its normal is negative.
fn facing_up(plane: Plane) -> Plane {
    let first = plane.normal.to_array().into_iter().find(|&x| x != 0.0);
    if first.is_some_and(|x| x < 0.0) { plane.reversed() } else { plane }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::scene::{Face, Material, Scene};

    /// Overlapping triangles in slanted planes, facing both ways, share one plane to the bit.
    #[test]
    fn slanted_coplanar_polygons_have_one_plane() {
        let (u, v) =
            (DVec3::new(1.0, 2.0, 3.0).normalize(), DVec3::new(3.0, 0.3, -1.2).normalize());
        let at = |[a, b]: [f64; 2], height: f64| u * a + v * b + u.cross(v) * height;
        let triangle = |points: [[f64; 2]; 3], height| Face {
            points: points.map(|point| at(point, height)).to_vec(),
            material: 0,
            object: 0,
        };
        let faces = [
            triangle([[0.0, 0.0], [1.0, 0.1], [0.3, 0.9]], 0.0),
            triangle([[0.2, 0.1], [1.3, 0.3], [0.7, 1.9]], 0.0),
            triangle([[0.2, 0.1], [0.7, 1.9], [1.3, 0.3]], 0.0),
            triangle([[0.0, 0.0], [1.0, 0.1], [0.3, 0.9]], 0.1),
        ];
        let (materials, objects) = (vec![Material::default()], vec!["all".to_owned()]);
        let (scene, _) = Scene::new(&faces, materials, objects).expect("a scene");
        let planes: Vec<Plane> = scene.polygons.iter().map(|polygon| polygon.plane).collect();
        assert_eq!(planes[0], planes[1]);
        assert_eq!(planes[0], planes[2].reversed());
        assert!((planes[0].offset - planes[3].offset).abs() > 0.09);
    }
}
