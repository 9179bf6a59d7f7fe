//! A z-buffer: finds the polygon that a camera sees at each sample of a picture.

use glam::DVec3;

use super::camera::{Camera, View};
use crate::geometry::clip_to_slab;
use crate::scene::{Plane, Scene};

/// Marks samples without a polygon.
const NOTHING: u32 = u32::MAX;

/// The nearest polygon front at each sample of a picture.
pub(crate) struct ZBuffer {
    /// Samples in a row.
    columns: usize,
    rows: usize,
    eye: DVec3,
    view: View,
    /// Inverse depth of the visible polygon, 1/m. 0 is infinitely far.
    inverse_depth: Vec<f64>,
    /// Visible polygon.
    seen: Vec<u32>,
}

impl ZBuffer {
    /// An empty buffer with `samples` × `samples` samples per pixel.
    pub(crate) fn new(camera: &Camera, samples: usize) -> ZBuffer {
        let (columns, rows) = (camera.width as usize * samples, camera.height as usize * samples);
        ZBuffer {
            columns,
            rows,
            eye: camera.eye,
            view: camera.view(),
            inverse_depth: vec![0.0; columns * rows],
            seen: vec![NOTHING; columns * rows],
        }
    }

    /// Draws the polygon fronts of a scene below a height.
    pub(crate) fn draw(&mut self, scene: &Scene, up: DVec3, height: f64) {
        // Near plane.
        let near = 1e-5 * scene.bounds.size().length();
        let forward = self.view.forward;
        let depth = self.eye.dot(forward) + near;
        for (index, polygon) in scene.polygons.iter().enumerate() {
            let plane = polygon.plane;
            if plane.normal.dot(self.eye) <= plane.offset {
                continue;
            }
            let corners: Vec<DVec3> = scene.corners(polygon).collect();
            let below = clip_to_slab(&corners, up, f64::NEG_INFINITY, height);
            let ahead = clip_to_slab(&below, forward, depth, f64::INFINITY);
            self.fill(index as u32, plane, &ahead);
        }
    }

    /// Draws one polygon, row by row, where it is the nearest so far.
    fn fill(&mut self, index: u32, plane: Plane, corners: &[DVec3]) {
        let corners: Vec<[f64; 2]> = corners.iter().map(|&corner| self.project(corner)).collect();
        let (top, bottom) = extent(corners.iter().map(|c| c[1]));
        let distance = plane.normal.dot(self.eye) - plane.offset;
        for row in samples(top, bottom, self.rows) {
            let (left, right) = extent(crossings(&corners, row as f64 + 0.5));
            for column in samples(left, right, self.columns) {
                // 1/t, where the ray eye + t direction meets the plane.
                let inverse_depth = -plane.normal.dot(self.direction(column, row)) / distance;
                let sample = row * self.columns + column;
                if inverse_depth > self.inverse_depth[sample] {
                    self.inverse_depth[sample] = inverse_depth;
                    self.seen[sample] = index;
                }
            }
        }
    }

    /// Column and row of a point in front of the eye. Centres of samples are at index + 0.5.
    fn project(&self, point: DVec3) -> [f64; 2] {
        let View { forward, right, up, slopes } = self.view;
        let offset = point - self.eye;
        let depth = offset.dot(forward);
        let x = offset.dot(right) / (depth * slopes[0]);
        let y = offset.dot(up) / (depth * slopes[1]);
        [(1.0 + x) / 2.0 * self.columns as f64, (1.0 - y) / 2.0 * self.rows as f64]
    }

    /// Direction through the centre of a sample, with a depth of one metre.
    fn direction(&self, column: usize, row: usize) -> DVec3 {
        let View { forward, right, up, slopes } = self.view;
        let x = (2 * column + 1) as f64 / self.columns as f64 - 1.0;
        let y = 1.0 - (2 * row + 1) as f64 / self.rows as f64;
        forward + right * (x * slopes[0]) + up * (y * slopes[1])
    }

    /// Visible polygon and point of each sample, row by row.
    pub(crate) fn seen(&self) -> impl Iterator<Item = Option<(u32, DVec3)>> {
        (0..self.seen.len()).map(|sample| {
            let (row, column) = (sample / self.columns, sample % self.columns);
            let point = || self.eye + self.direction(column, row) / self.inverse_depth[sample];
            (self.seen[sample] != NOTHING).then(|| (self.seen[sample], point()))
        })
    }
}

/// Columns at which the edges of a convex polygon cross the middle of a row.
fn crossings(corners: &[[f64; 2]], y: f64) -> impl Iterator<Item = f64> {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    edges.filter(move |(a, b)| (a[1] <= y) != (b[1] <= y)).map(move |(a, b)| {
        // Always from the upper end, so that neighbouring polygons agree to the bit.
        let (a, b) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        a[0] + (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1]))
    })
}

/// Smallest and largest value.
fn extent(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}

/// The samples, of `count`, whose centres are in [low, high). (A cast from a float saturates.)
fn samples(low: f64, high: f64, count: usize) -> std::ops::Range<usize> {
    let index = |x: f64| ((x - 0.5).ceil() as usize).min(count);
    index(low)..index(high)
}
