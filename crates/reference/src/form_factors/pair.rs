//! Form factors between two convex polygons, with the shadows of others.

use radiosity::glam::DVec3;
use radiosity::{Bounds, Plane, Scene};

use crate::form_factors::clipping::{Ring, above, cut_out, fan, seen_from, sides, without_repeats};
use crate::form_factors::cubature::{Estimate, Part, Tolerance, integrate, quarters};
use crate::form_factors::element::contour;

/// A convex part of a scene's polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Corners, counter-clockwise seen from the front, local coordinates.
    pub corners: Vec<DVec3>,
    /// The plane.
    pub plane: Plane,
    /// The polygon that it belongs to.
    pub polygon: u32,
}

/// Two surfaces, prepared for integration over the first: each without the part behind the other, and the
/// polygons that may block light between them.
///
/// As for rays, a polygon is opaque from both sides.
pub struct Pair {
    from: Ring,
    normal: DVec3,
    to: Ring,
    /// The largest first, since it may hide everything.
    blockers: Vec<Blocker>,
}

/// The part of a polygon that may block light between two others.
struct Blocker {
    corners: Ring,
    plane: Plane,
    area: f64,
}

impl Surface {
    /// A whole polygon of a scene.
    pub fn of_polygon(scene: &Scene, polygon: u32) -> Surface {
        let face = &scene.polygons[polygon as usize];
        Surface { corners: scene.corners(face).collect(), plane: face.plane, polygon }
    }

    fn height(&self, point: DVec3) -> f64 {
        height(&self.plane, point)
    }

    /// The part that is in front of another surface.
    fn in_front_of(&self, other: &Surface, tolerance: f64) -> Option<Ring> {
        let faces = self.corners.iter().any(|&p| other.height(p) > tolerance);
        faces.then(|| above(&self.corners, |p| other.height(p)))
    }
}

impl Pair {
    /// Two surfaces of a scene; `None` if they do not face each other.
    pub fn new(scene: &Scene, from: &Surface, to: &Surface) -> Option<Pair> {
        if from.polygon == to.polygon {
            return None;
        }
        let tolerance = scene.tolerance();
        let (source, target) = (from.in_front_of(to, tolerance)?, to.in_front_of(from, tolerance)?);
        let between = |polygon: &u32| *polygon != from.polygon && *polygon != to.polygon;
        let blocker = |polygon| Blocker::new(scene, polygon, from, to);
        let mut blockers: Vec<Blocker> =
            (0..scene.polygons.len() as u32).filter(between).filter_map(blocker).collect();
        blockers.sort_by(|a, b| b.area.total_cmp(&a.area));
        Some(Pair { from: source, normal: from.plane.normal, to: target, blockers })
    }

    /// The form factor from an element of the first surface to the visible part of the second, exact to
    /// rounding: the shadows of all blockers are cut out.
    pub fn from_element(&self, point: DVec3) -> f64 {
        let mut pieces = vec![seen_from(point, &self.to)];
        for blocker in &self.blockers {
            if pieces.is_empty() {
                return 0.0;
            }
            pieces = blocker.shade(pieces, point);
        }
        pieces.iter().map(|piece| contour(self.normal, piece)).sum()
    }

    /// The triangles over which [`Pair::from_element`] is to be integrated.
    pub(crate) fn parts(&self, function: usize) -> Vec<Part> {
        let smooth = self.blockers.is_empty();
        let part = |triangle| Part { triangle, function, smooth };
        let triangles = fan(&self.from);
        if smooth {
            triangles.map(part).collect()
        } else {
            // Finer from the start: light that no sample point sees would be missed.
            triangles.flat_map(quarters).map(part).collect()
        }
    }

    /// Area of the first surface times the form factor to the second, m²; the same the other way round.
    pub fn exchange(&self, tolerance: Tolerance) -> Estimate {
        integrate(self.parts(0), tolerance, |_, point| self.from_element(point))
    }
}

impl Blocker {
    /// `None` for a polygon that cannot be between the two surfaces.
    fn new(scene: &Scene, polygon: u32, from: &Surface, to: &Surface) -> Option<Blocker> {
        let Surface { corners, plane, .. } = Surface::of_polygon(scene, polygon);
        let tolerance = scene.tolerance();
        // Its plane must separate them.
        let reach = |surface: &Surface, side: f64| {
            surface.corners.iter().any(|&p| side * height(&plane, p) > tolerance)
        };
        let parts = |side: f64| reach(from, side) && reach(to, -side);
        let before = |surface: &Surface| corners.iter().any(|&p| surface.height(p) > tolerance);
        if !((parts(1.0) || parts(-1.0)) && before(from) && before(to)) {
            return None;
        }
        let corners = above(&above(&corners, |p| from.height(p)), |p| to.height(p));
        let corners = without_repeats(corners, tolerance);
        let area = fan(&corners).map(|[a, b, c]| (b - a).cross(c - a).length()).sum();
        let possible = !corners.is_empty() && !outside(&corners, from, to);
        possible.then_some(Blocker { corners, plane, area })
    }

    /// The parts of pieces, in coordinates relative to `point`, outside the shadow for a light at `point`.
    fn shade(&self, pieces: Vec<Ring>, point: DVec3) -> Vec<Ring> {
        let side = height(&self.plane, point);
        if side == 0.0 {
            return pieces;
        }
        let corners = seen_from(point, &self.corners);
        let inwards: Vec<DVec3> = sides(&corners).iter().map(|s| s * side.signum()).collect();
        cut_out(pieces, &corners, &inwards)
    }
}

fn height(plane: &Plane, point: DVec3) -> f64 {
    plane.normal.dot(point) - plane.offset
}

/// Whether all corners are outside the bounding box of two surfaces, on one side of it.
fn outside(corners: &[DVec3], from: &Surface, to: &Surface) -> bool {
    let both = Bounds::of(from.corners.iter().chain(&to.corners).copied());
    let own = Bounds::of(corners.iter().copied());
    (own.min.cmpgt(both.max) | own.max.cmplt(both.min)).any()
}
