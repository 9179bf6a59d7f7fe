//! Faces used as the file has them, without repair.

use radiosity::glam::DVec3;

use crate::cases::naive_method::MAX_RAYS;
use crate::checks::casting::wrong_rays;
use crate::finding::Count;
use crate::runs::CaseRuns;

/// A face with the normal of its first three corners.
struct Face {
    corners: Vec<DVec3>,
    normal: DVec3,
}

/// The faces of the OBJ file of the case. Only plain `v` and `f` lines are understood.
fn read(runs: &CaseRuns) -> Result<Vec<Face>, String> {
    let name = runs.scene_file.display();
    let text = config::read_text(&runs.scene_file).map_err(|fault| fault.to_string())?;
    let mut points = Vec::new();
    let mut faces = Vec::new();
    for line in text.lines() {
        let too_hard = || format!("{name}: \"{line}\"; expected plain numbers");
        match line.split_once(' ') {
            Some(("v", numbers)) => {
                let numbers: Vec<f64> = numbers.split(' ').filter_map(|n| n.parse().ok()).collect();
                points.push(DVec3::from_slice(numbers.get(..3).ok_or_else(too_hard)?));
            }
            Some(("f", numbers)) => {
                let point =
                    |number: &str| points.get(number.parse::<usize>().ok()?.wrapping_sub(1));
                let corners: Option<Vec<DVec3>> =
                    numbers.split(' ').map(|n| point(n).copied()).collect();
                let corners = corners.filter(|corners| corners.len() > 2).ok_or_else(too_hard)?;
                let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
                faces.push(Face { normal: normal / normal.length(), corners });
            }
            _ => {}
        }
    }
    Ok(faces)
}

impl Face {
    /// Whether a ray hits the face: it meets the plane, left of every edge.
    fn is_hit(&self, origin: DVec3, direction: DVec3) -> bool {
        let distance = (self.corners[0] - origin).dot(self.normal) / direction.dot(self.normal);
        let point = origin + direction * distance;
        let next = self.corners.iter().cycle().skip(1);
        let left = |(a, b): (&DVec3, &DVec3)| (*b - *a).cross(point - *a).dot(self.normal) >= -1e-9;
        distance > 1e-6 && self.corners.iter().zip(next).all(left)
    }
}

/// Rays that hit no face.
pub fn leaks(runs: &CaseRuns) -> Result<Count, String> {
    let faces = read(runs)?;
    Ok(wrong_rays(runs, MAX_RAYS, |problem, _, ray| {
        let origin = ray.origin + problem.space.scene.origin;
        !faces.iter().any(|face| face.is_hit(origin, ray.direction))
    }))
}

/// The number of normals that are NaN.
pub fn no_normals(runs: &CaseRuns) -> Result<u64, String> {
    Ok(read(runs)?.iter().filter(|face| face.normal.is_nan()).count() as u64)
}
