//! The memory accesses of a shot, record by record, as input for models of caches (§5.2).

use super::hemisphere::Hemisphere;
use super::mask::Mask;
use super::shot::Emitter;
use crate::geometry::Ray;
use crate::mesh::{LocalEnvironment, Side, Space};

/// A record that the simulated processor reads or writes while it casts rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Record {
    /// The direction of a pixel.
    Direction(u32),
    /// A plane of the grid, read in the search for the cell of the emitter.
    Search {
        /// Axis of its normal.
        axis: usize,
        /// Index among the planes of that axis.
        plane: u32,
    },
    /// A cell of the grid and its list of polygons.
    Cell {
        /// Index of the cell. x varies fastest.
        place: u32,
        /// Length of the list.
        polygons: u32,
    },
    /// The plane of a polygon.
    Plane(u32),
    /// A plane of the grid whose distance along the ray is computed.
    Crossing {
        /// Axis of its normal.
        axis: usize,
        /// Index among the planes of that axis.
        plane: u32,
    },
    /// The edges of a polygon whose plane the ray meets in this cell, until one excludes it.
    Edges {
        /// Index of the polygon.
        polygon: u32,
        /// Number of edges.
        edges: u32,
    },
    /// The piece in which the hit patch is looked up, and the patch.
    Hit {
        /// Index of its polygon.
        polygon: u32,
        /// Index of the patch in its environment.
        patch: u32,
    },
    /// The copy of the mask for a neighbour (§4.2.3).
    Copy,
    /// A pixel's direction and bit in that copy, tested against the neighbour's plane.
    PlaneTest(u32),
}

/// Calls `touch` for every record, in the order of [`shoot_plainly`](crate::shoot_plainly).
pub fn trace(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    emitter: &Emitter,
    mask: &Mask,
    mut touch: impl FnMut(Record),
) {
    let frame = hemisphere.frame(emitter.centre, emitter.normal);
    let start = space.grid.cell_of(emitter.centre);
    let tested = space.grid.planes_tested(emitter.centre);
    let mut left = Vec::new();
    for pixel in mask.ones() {
        touch(Record::Direction(pixel));
        tested.iter().for_each(|&(axis, plane)| touch(Record::Search { axis, plane }));
        let ray = Ray::new(emitter.centre, hemisphere.direction(frame, pixel));
        if let Some(side) = trace_ray(space, environment, &ray, (emitter, start), &mut touch)
            && environment.has_neighbour(side)
        {
            left.push(pixel);
        }
    }
    for _ in Side::ALL.iter().filter(|&&side| environment.has_neighbour(side)) {
        touch(Record::Copy);
        left.iter().for_each(|&pixel| touch(Record::PlaneTest(pixel)));
    }
}

/// Follows a ray from an emitter in cell `start`. Returns the side where it leaves, if any.
fn trace_ray(
    space: &Space,
    environment: &LocalEnvironment,
    ray: &Ray,
    (emitter, start): (&Emitter, [u32; 3]),
    touch: &mut impl FnMut(Record),
) -> Option<Side> {
    let Space { grid, .. } = space;
    let Some(mut passage) = grid.enter(&environment.block, ray, start) else {
        return Some(grid.side_towards(&environment.block, ray));
    };
    let ahead = |cell: [u32; 3], axis: usize| {
        let plane = cell[axis] + u32::from(ray.direction[axis] > 0.0);
        Record::Crossing { axis, plane }
    };
    (0..3).for_each(|axis| touch(ahead(passage.cell, axis)));
    loop {
        let (place, listed) = (grid.index(passage.cell) as u32, passage.polygons());
        touch(Record::Cell { place, polygons: listed.len() as u32 });
        let others = listed.iter().copied().filter(|&polygon| polygon != emitter.polygon);
        if let Some((polygon, distance)) = nearest_hit(space, others, ray, passage.exit(), touch) {
            if let Some(patch) = environment.patch_at(polygon, ray.at(distance)) {
                touch(Record::Hit { polygon, patch });
            }
            return None;
        }
        let axis = passage.next_axis();
        if let Err(side) = passage.step() {
            return Some(side);
        }
        touch(ahead(passage.cell, axis));
    }
}

/// The nearest polygon of a cell that a ray hits before `exit`, any one of coplanar ones.
fn nearest_hit(
    space: &Space,
    polygons: impl Iterator<Item = u32>,
    ray: &Ray,
    exit: f64,
    touch: &mut impl FnMut(Record),
) -> Option<(u32, f64)> {
    let mut nearest: Option<(u32, f64)> = None;
    for polygon in polygons {
        touch(Record::Plane(polygon));
        let limit = nearest.map_or(exit, |(_, distance)| distance);
        let Some(distance) = space.facets.meets_plane(polygon, ray, limit) else { continue };
        let edges = space.facets.edges_tested(polygon, ray.at(distance));
        touch(Record::Edges { polygon, edges });
        if let Some(distance) = space.facets.hit(polygon, ray, limit) {
            nearest = Some((polygon, distance));
        }
    }
    nearest
}
