//! A pinhole camera, and standard views of a scene.

use glam::{DQuat, DVec3};

use crate::geometry::Bounds;

/// A pinhole camera. Positions are local to the scene's origin, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position of the camera.
    pub eye: DVec3,
    /// Point in the middle of the picture.
    pub target: DVec3,
    /// Upward direction. Not parallel to the line of sight.
    pub up: DVec3,
    /// Vertical angle of view, degrees.
    pub field_of_view_degrees: f64,
    /// Pixels in a row.
    pub width: u32,
    /// Rows of pixels.
    pub height: u32,
}

impl Camera {
    /// A view down from the front right in which the box just fills the picture. `up` is a unit
    /// vector.
    pub fn overview(bounds: &Bounds, up: DVec3, width: u32, height: u32) -> Camera {
        let direction = DQuat::from_rotation_arc(DVec3::Z, up) * DVec3::new(-0.25, 0.9, -1.1);
        Camera::around(bounds, direction, up, width, height)
    }

    /// A view across the box from one of its corners, at eye height if the box is high enough.
    /// `up` is a unit vector.
    pub fn inside(bounds: &Bounds, up: DVec3, width: u32, height: u32) -> Camera {
        const EYE: f64 = 1.7;
        // The box turned so that z is up.
        let turn = DQuat::from_rotation_arc(up, DVec3::Z);
        let turned = Bounds::of(corners(bounds).map(|corner| turn * corner));
        let at = |share: f64, height: f64| {
            let floor = turned.min + turned.size() * DVec3::new(share, share, 0.0);
            turn.inverse() * (floor + DVec3::Z * height.min(0.6 * turned.size().z))
        };
        let field_of_view_degrees = 60.0;
        let (eye, target) = (at(0.05, EYE), at(0.95, 0.7 * EYE));
        Camera { eye, target, field_of_view_degrees, ..Camera::overview(bounds, up, width, height) }
    }

    /// A view along a direction in which the box just fills the picture.
    fn around(bounds: &Bounds, direction: DVec3, up: DVec3, width: u32, height: u32) -> Camera {
        const FILLED: f64 = 0.96;
        let centre = (bounds.min + bounds.max) * 0.5;
        let mut camera = Camera {
            eye: centre,
            target: centre + direction,
            up,
            field_of_view_degrees: 30.0,
            width,
            height,
        };
        let view = camera.view();
        let half = bounds.size() * 0.5;
        let centred = Bounds { min: -half, max: half };
        let corners = || corners(&centred);
        // At distance d behind the centre and shift s, a corner at (side, depth) is in the picture
        // if |side - s| <= slope (depth + d). This is the smallest d for which an s exists.
        let fit = |axis: DVec3, slope: f64| {
            let slope = slope * FILLED;
            let most = corners().map(|c| c.dot(axis) - slope * c.dot(view.forward));
            let least = corners().map(|c| c.dot(axis) + slope * c.dot(view.forward));
            let (most, least) = (most.fold(f64::MIN, f64::max), least.fold(f64::MAX, f64::min));
            ((most - least) / (2.0 * slope), (most + least) / 2.0)
        };
        let (across, right) = fit(view.right, view.slopes[0]);
        let (along, up) = fit(view.up, view.slopes[1]);
        let shifted = centre + view.right * right + view.up * up;
        let distance = across.max(along);
        camera.eye = shifted - view.forward * distance;
        camera.target = shifted;
        camera
    }

    /// Its axes and angles of view.
    pub(crate) fn view(&self) -> View {
        let forward = (self.target - self.eye).normalize_or(DVec3::Y);
        let right =
            forward.cross(self.up).try_normalize().unwrap_or(forward.any_orthonormal_vector());
        let vertical = libm::tan(self.field_of_view_degrees.to_radians() / 2.0);
        let aspect = f64::from(self.width) / f64::from(self.height);
        View { forward, right, up: right.cross(forward), slopes: [vertical * aspect, vertical] }
    }
}

/// The corners of a box.
fn corners(bounds: &Bounds) -> impl Iterator<Item = DVec3> + use<> {
    let ends = [bounds.min, bounds.max];
    (0..8_usize).map(move |i| DVec3::new(ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z))
}

/// Orthonormal axes of a camera, and half the width and height that it sees per metre of depth.
pub(crate) struct View {
    pub(crate) forward: DVec3,
    pub(crate) right: DVec3,
    pub(crate) up: DVec3,
    pub(crate) slopes: [f64; 2],
}
