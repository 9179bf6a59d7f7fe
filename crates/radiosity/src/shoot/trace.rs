//! The memory accesses of a shot, record by record, as input for models of caches (§5.2).

use super::hemisphere::Hemisphere;
use super::mask::Mask;
use super::plain::follow;
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
        let mut crossed = 0..3;
        let hit = follow(space, environment, &ray, start, |passage| {
            for axis in crossed.clone() {
                let plane = passage.cell[axis] + u32::from(ray.direction[axis] > 0.0);
                touch(Record::Crossing { axis, plane });
            }
            let next = passage.next_axis();
            crossed = next..next + 1;
            let (place, listed) = (space.grid.index(passage.cell) as u32, passage.polygons());
            touch(Record::Cell { place, polygons: listed.len() as u32 });
            let others = listed.iter().copied().filter(|&polygon| polygon != emitter.polygon);
            nearest_hit(space, environment, others, &ray, passage.reach(), &mut touch)
        });
        match hit {
            Ok((polygon, distance)) => {
                let piece = environment.piece(polygon);
                let patch = piece.and_then(|piece| environment.patch_hit(piece, &ray, distance));
                if let Some(patch) = patch {
                    touch(Record::Hit { polygon, patch });
                }
            }
            Err(side) => left.extend(environment.has_neighbour(side).then_some(pixel)),
        }
    }
    for _ in Side::ALL.iter().filter(|&&side| environment.has_neighbour(side)) {
        touch(Record::Copy);
        left.iter().for_each(|&pixel| touch(Record::PlaneTest(pixel)));
    }
}

/// The nearest polygon of a cell that a ray hits within `reach`, any one of coplanar ones.
fn nearest_hit(
    space: &Space,
    environment: &LocalEnvironment,
    polygons: impl Iterator<Item = u32>,
    ray: &Ray,
    reach: f64,
    touch: &mut impl FnMut(Record),
) -> Option<(u32, f64)> {
    let mut nearest: Option<(u32, f64)> = None;
    for polygon in polygons {
        touch(Record::Plane(polygon));
        let limit = nearest.map_or(reach, |(_, distance)| distance);
        let Some(distance) = space.facets.meets_plane(polygon, ray, limit) else { continue };
        let edges = space.facets.edges_tested(polygon, ray.at(distance));
        touch(Record::Edges { polygon, edges });
        if let Some(distance) = space.facets.hit(polygon, ray, limit)
            && !environment.only_touches(polygon)
        {
            nearest = Some((polygon, distance));
        }
    }
    nearest
}
