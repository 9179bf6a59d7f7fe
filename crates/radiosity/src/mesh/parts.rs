//! A patch divided into several emitters, for accuracy on surfaces close to it.

use glam::DVec3;

use super::environment::LocalEnvironment;
use super::shape::extent;
use super::space::Space;
use crate::geometry::{Bounds, area_and_centroid, clip_to_half, clip_to_slab};

/// A part of a patch, which shoots its share of the power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Centroid, where its rays start.
    pub centre: DVec3,
    /// Its fraction of the patch's area, and so of its power.
    pub share: f64,
}

impl LocalEnvironment {
    /// Divides a patch into `along` parts in both directions. Parts without area are left out. If
    /// none remain, the result is the patch itself.
    pub fn parts(&self, space: &Space, patch: u32, along: u32) -> Vec<Part> {
        let whole = Part { centre: self.patches[patch as usize].centre, share: 1.0 };
        let outline = if along > 1 { self.outline(space, patch) } else { Vec::new() };
        let (area, _) = area_and_centroid(&outline);
        if area <= 0.0 {
            return vec![whole];
        }
        let [u, v] = self.axes(space, patch);
        let slabs = |points: &[DVec3], axis: DVec3| -> Vec<Vec<DVec3>> {
            let (low, length) = extent(&outline, axis);
            let at = |i: u32| low + length * (f64::from(i) / f64::from(along));
            (0..along).map(|i| clip_to_slab(points, axis, at(i), at(i + 1))).collect()
        };
        let rows = slabs(&outline, v);
        let pieces = rows.iter().flat_map(|row| slabs(row, u));
        let parts = pieces.map(|piece| {
            let (part, centre) = area_and_centroid(&piece);
            Part { centre, share: part / area }
        });
        parts.filter(|part| part.share > 0.0).collect()
    }

    /// Number of parts in both directions, 1 to `most`, so that no polygon in front of the patch is
    /// nearer to its centre than `edges` times the longer edge of a part.
    ///
    /// Hidden polygons count too, so that the result does not depend on the decomposition.
    pub fn parts_needed(&self, space: &Space, patch: u32, edges: f64, most: u32) -> u32 {
        let outline = self.outline(space, patch);
        if outline.is_empty() || most <= 1 {
            return 1;
        }
        let edge = self.axes(space, patch).map(|axis| extent(&outline, axis).1);
        let reach = edges * edge[0].max(edge[1]);
        match self.nearest_in_front(space, patch, reach) {
            Some(distance) if distance * f64::from(most) > reach => {
                (reach / distance).ceil().max(1.0) as u32
            }
            Some(_) => most,
            None => 1,
        }
    }

    /// Distance from a patch's centre to the nearest polygon in front of it, if within `reach`.
    fn nearest_in_front(&self, space: &Space, patch: u32, reach: f64) -> Option<f64> {
        let scene = &space.scene;
        let patch = &self.patches[patch as usize];
        let normal = scene.polygons[patch.polygon as usize].plane.normal;
        let tolerance = scene.tolerance();
        let height = |p: DVec3| (p - patch.centre).dot(normal);
        let mut nearest: Option<f64> = None;
        for polygon in &scene.polygons {
            let corners: Vec<DVec3> = scene.corners(polygon).collect();
            let around = Bounds::of(corners.iter().copied());
            let closest = patch.centre.clamp(around.min, around.max).distance(patch.centre);
            if closest >= nearest.unwrap_or(reach)
                || corners.iter().all(|&p| height(p) <= tolerance)
            {
                continue;
            }
            let before = clip_to_half(&corners, height);
            let distance = distance(patch.centre, &before, polygon.plane.normal);
            if distance < nearest.unwrap_or(reach) {
                nearest = Some(distance);
            }
        }
        nearest
    }

    /// Unit vectors of the two directions in which the polygon of a patch is meshed.
    fn axes(&self, space: &Space, patch: u32) -> [DVec3; 2] {
        let polygon = &space.scene.polygons[self.patches[patch as usize].polygon as usize];
        let mut corners = space.scene.corners(polygon);
        let edge = corners.next().zip(corners.next()).map_or(DVec3::X, |(a, b)| b - a);
        let u = edge.normalize();
        [u, polygon.plane.normal.cross(u)]
    }
}

/// Distance from a point to a convex polygon, metres.
fn distance(point: DVec3, corners: &[DVec3], normal: DVec3) -> f64 {
    let Some(&last) = corners.last() else { return f64::INFINITY };
    let mut before = last;
    let (mut inside, mut nearest) = (true, f64::INFINITY);
    for &here in corners {
        let (edge, away) = (here - before, point - before);
        inside &= normal.cross(edge).dot(away) >= 0.0;
        let along = (away.dot(edge) / edge.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        nearest = nearest.min(away.distance(edge * along));
        before = here;
    }
    if inside { (point - last).dot(normal).abs() } else { nearest }
}
