//! Facets: polygons in the form that ray tests read.

use glam::DVec3;

use crate::geometry::{Bounds, Ray};
use crate::scene::Scene;

/// Rounding of positions, as a fraction of the tolerance.
pub(super) const ROUNDING: f64 = 1e-4;

/// A polygon: its plane and the half-planes of its edges.
pub(crate) struct Facet {
    pub(crate) normal: DVec3,
    pub(crate) offset: f64,
    first_edge: u32,
    edges: u32,
    /// The two axes of the projection along the largest component of the normal.
    pub(crate) axes: (usize, usize),
    /// Axis and sign of the normal, if it is parallel to an axis.
    pub(crate) axis: Option<(usize, f64)>,
    /// Smallest and largest projected coordinates, if the polygon is an axis-aligned rectangle.
    pub(crate) rectangle: Option<[(f64, f64); 2]>,
}

/// The half-plane of an edge in the projected polygon: inside where `a·p + b·q + c`, in metres of
/// the projection, is not negative.
pub(crate) struct Edge {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) c: f64,
}

/// The polygons of a scene in the form that ray tests read.
///
/// Whether and where a ray hits a polygon is computed from the whole input polygon alone, so the
/// result is the same to the bit for every decomposition. Edges are widened by the tolerance of the
/// scene (1e-9 of its diagonal). That is far more than rounding, so that there are no gaps between
/// neighbours, and too little to change the light.
pub struct Facets {
    facets: Vec<Facet>,
    edges: Vec<Edge>,
    pub(crate) tolerance: f64,
}

impl Facets {
    /// Prepares the polygons of a scene. Facet `i` is polygon `i`.
    pub fn new(scene: &Scene) -> Facets {
        let mut facets = Vec::with_capacity(scene.polygons.len());
        let mut edges = Vec::new();
        for polygon in &scene.polygons {
            let normal = polygon.plane.normal;
            let axes = projection_axes(normal);
            let corners: Vec<DVec3> = scene.corners(polygon).collect();
            let first_edge = edges.len() as u32;
            let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
            for (i, &p) in corners.iter().enumerate() {
                edges.push(half_plane(p, corners[(i + 1) % corners.len()], middle, axes));
            }
            facets.push(Facet {
                normal,
                offset: polygon.plane.offset,
                first_edge,
                edges: corners.len() as u32,
                axes,
                rectangle: rectangle(&corners, axes),
                axis: (0..3).find(|&a| normal[a].abs() == 1.0).map(|a| (a, normal[a])),
            });
        }
        Facets { facets, edges, tolerance: scene.tolerance() }
    }

    /// One facet.
    pub(crate) fn facet(&self, facet: u32) -> &Facet {
        &self.facets[facet as usize]
    }

    /// Signed distance from a point to the plane of a facet, along its normal.
    #[inline(always)]
    pub(crate) fn above(&self, facet: &Facet, point: DVec3) -> f64 {
        facet.offset - facet.normal.dot(point)
    }

    /// The edges of a facet.
    pub(crate) fn edges(&self, facet: &Facet) -> &[Edge] {
        &self.edges[facet.first_edge as usize..][..facet.edges as usize]
    }

    /// Distance at which a ray hits a facet, if between the tolerance and `limit`.
    #[inline]
    pub fn hit(&self, facet: u32, ray: &Ray, limit: f64) -> Option<f64> {
        let t = self.meets_plane(facet, ray, limit)?;
        let f = self.facet(facet);
        let point = ray.at(t);
        self.edges(f).iter().all(|edge| self.within(f, edge, point)).then_some(t)
    }

    /// Number of edges tested for a point in the plane of a facet, until one excludes it.
    pub(crate) fn edges_tested(&self, facet: u32, point: DVec3) -> u32 {
        let f = self.facet(facet);
        let inside = self.edges(f).iter().take_while(|edge| self.within(f, edge, point)).count();
        f.edges.min(inside as u32 + 1)
    }

    /// Whether a point is inside an edge, or not farther outside than the tolerance.
    #[inline(always)]
    fn within(&self, facet: &Facet, edge: &Edge, point: DVec3) -> bool {
        let (p, q) = (point[facet.axes.0], point[facet.axes.1]);
        edge.a * p + edge.b * q + edge.c >= -self.tolerance
    }

    /// Like [`Facets::hit`], but for the plane of the facet.
    #[inline]
    pub(crate) fn meets_plane(&self, facet: u32, ray: &Ray, limit: f64) -> Option<f64> {
        let f = self.facet(facet);
        let slope = f.normal.dot(ray.direction);
        if slope == 0.0 {
            return None;
        }
        // Multiplied by the reciprocal, as in the grid: for a facet in a grid plane the two
        // distances are then the same number.
        let t = self.above(f, ray.origin) * (1.0 / slope);
        (t > self.tolerance && t <= limit).then_some(t)
    }

    /// Whether the ray comes from the front of the facet.
    #[inline]
    pub fn faces(&self, facet: u32, ray: &Ray) -> bool {
        self.facets[facet as usize].normal.dot(ray.direction) < 0.0
    }
}

/// The axes that remain when the largest component of the normal is dropped.
fn projection_axes(normal: DVec3) -> (usize, usize) {
    let largest = normal.abs().max_position();
    ((largest + 1) % 3, (largest + 2) % 3)
}

/// The extents of a projected polygon, if it is an axis-aligned rectangle.
fn rectangle(corners: &[DVec3], (i, j): (usize, usize)) -> Option<[(f64, f64); 2]> {
    let around = Bounds::of(corners.iter().copied());
    let on_side =
        |p: DVec3, axis: usize| p[axis] == around.min[axis] || p[axis] == around.max[axis];
    let corner = |&p: &DVec3| on_side(p, i) && on_side(p, j);
    let sides = [i, j].map(|axis| (around.min[axis], around.max[axis]));
    (corners.len() == 4 && corners.iter().all(corner)).then_some(sides)
}

/// The half-plane of the edge from `p` to `q` that contains `middle`, a point inside the polygon.
fn half_plane(p: DVec3, q: DVec3, middle: DVec3, (i, j): (usize, usize)) -> Edge {
    let (a, b) = (p[j] - q[j], q[i] - p[i]);
    let length = a.hypot(b);
    let inside = a * (middle[i] - p[i]) + b * (middle[j] - p[j]);
    let scale = if inside < 0.0 { -1.0 / length } else { 1.0 / length };
    let (a, b) = (a * scale, b * scale);
    Edge { a, b, c: -(a * p[i] + b * p[j]) }
}
