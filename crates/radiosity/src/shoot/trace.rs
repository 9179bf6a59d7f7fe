//! What a shot touches in memory, record by record: a cache wants to know more than counts.

use super::hemisphere::Hemisphere;
use super::mask::Mask;
use super::shot::Emitter;
use crate::geometry::Ray;
use crate::mesh::{LocalEnvironment, Side, Space};

/// A record that the virtual processor reads or writes while it casts rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Record {
    /// The direction of a pixel.
    Direction(u32),
    /// A plane of the grid that the search for the source's cell looks at.
    Search {
        /// Across which axis it lies.
        axis: usize,
        /// Its number there.
        plane: u32,
    },
    /// A cell of the grid, by its place, x running fastest, and its list of so many polygons.
    Cell {
        /// Its place.
        place: u32,
        /// Length of its list.
        polygons: u32,
    },
    /// The plane of a polygon.
    Plane(u32),
    /// A plane of the grid, whose distance along the ray is computed.
    Crossing {
        /// Across which axis it lies.
        axis: usize,
        /// Its number there.
        plane: u32,
    },
    /// The edges of a polygon whose plane the ray meets in this cell, up to the one that it passes outside.
    Edges {
        /// The polygon.
        polygon: u32,
        /// How many.
        edges: u32,
    },
    /// What finds the patch that a ray hits, and the patch.
    Hit {
        /// Its polygon.
        polygon: u32,
        /// Its number in its environment.
        patch: u32,
    },
    /// The mask, copied for a neighbour (§4.2.3).
    Copy,
    /// The direction of a pixel still true, and its bit in that copy: does it hit the neighbour's plane?
    PlaneTest(u32),
}

/// Tell `touch` of every record, in the order in which [`shoot_plainly`](crate::shoot_plainly) comes by.
pub fn trace(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    source: &Emitter,
    mask: &Mask,
    mut touch: impl FnMut(Record),
) {
    let [tangent, bitangent, normal] = hemisphere.frame(source.centre, source.normal);
    let start = space.grid.cell_of(source.centre);
    let looked_at = space.grid.planes_looked_at(source.centre);
    let mut left = Vec::new();
    for pixel in mask.ones() {
        touch(Record::Direction(pixel));
        looked_at.iter().for_each(|&(axis, plane)| touch(Record::Search { axis, plane }));
        let d = hemisphere.directions[pixel as usize];
        let ray = Ray::new(source.centre, tangent * d.x + bitangent * d.y + normal * d.z);
        if let Some(side) = trace_ray(space, environment, &ray, (source, start), &mut touch)
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

/// Follow a ray from a source in a cell; the side by which it leaves, if it hits nothing.
fn trace_ray(
    space: &Space,
    environment: &LocalEnvironment,
    ray: &Ray,
    (source, start): (&Emitter, [u32; 3]),
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
        let others = listed.iter().copied().filter(|&polygon| polygon != source.polygon);
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

/// The nearest polygon of a cell that the ray hits before `exit`. Which of several coplanar ones it is
/// does not matter here.
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
        let edges = space.facets.edges_looked_at(polygon, ray.at(distance));
        touch(Record::Edges { polygon, edges });
        if let Some(distance) = space.facets.hit(polygon, ray, limit) {
            nearest = Some((polygon, distance));
        }
    }
    nearest
}
