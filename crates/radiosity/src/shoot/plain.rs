//! Shooting one ray at a time: slow and simple. Tests compare the fast path with it.

use super::form_factors::FormFactors;
use super::hemisphere::Hemisphere;
use super::mask::Mask;
use super::shot::{Emitter, Shot, Tally};
use super::work::{Operation, Work};
use crate::geometry::Ray;
use crate::mesh::{LocalEnvironment, Passage, Side, Space};
use crate::shoot::bundle::WIDTH;

/// How the passage of a ray through an environment ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// At a polygon.
    Hit {
        /// The polygon.
        polygon: u32,
        /// Metres from the ray's origin.
        distance: f64,
    },
    /// Through a side of the environment.
    Leaves(Side),
}

/// Like [`shoot`](crate::shoot), one ray at a time, testing the polygons cell by cell. For scenes
/// without participating media.
pub fn shoot_plainly(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    emitter: &Emitter,
    mask: &Mask,
) -> Shot {
    let frame = hemisphere.frame(emitter.centre, emitter.normal);
    let form_factors = FormFactors::one_by_one(Tally::places(environment), hemisphere);
    let mut tally = Tally::new(environment, mask, form_factors);
    for pixel in mask.ones() {
        let ray = Ray::new(emitter.centre, hemisphere.direction(frame, pixel));
        cast_pixel(space, environment, &ray, emitter.polygon, pixel, &mut tally);
    }
    tally.finish()
}

/// Casts the ray of a pixel and counts how it ends.
pub(crate) fn cast_pixel(
    space: &Space,
    environment: &LocalEnvironment,
    ray: &Ray,
    own_polygon: u32,
    pixel: u32,
    tally: &mut Tally,
) {
    let (bundle, bit) = (pixel as usize / WIDTH, 1 << (pixel as usize % WIDTH));
    match cast(space, environment, ray, own_polygon, &mut tally.work) {
        End::Hit { polygon, distance } => {
            let front = space.facets.faces(polygon, ray);
            let piece = environment.piece(polygon).filter(|_| front);
            let patch = piece.and_then(|piece| environment.patch_hit(piece, ray, distance));
            tally.hit(patch, bundle, bit);
        }
        End::Leaves(side) => tally.leave(side, bundle, bit),
    }
}

/// Follows one ray through an environment, to its nearest hit or the side where it leaves.
pub fn cast(
    space: &Space,
    environment: &LocalEnvironment,
    ray: &Ray,
    own_polygon: u32,
    work: &mut Work,
) -> End {
    work.count(Operation::Ray, 1);
    let start = space.grid.cell_of(ray.origin);
    let end = follow(space, environment, ray, start, |passage| {
        work.count(Operation::CellStep, 1);
        let polygons = passage.polygons();
        work.count(Operation::PolygonTest, polygons.len() as u64);
        let others = polygons.iter().copied().filter(|&polygon| polygon != own_polygon);
        nearest_hit(space, environment, others, ray, passage.reach())
    });
    end.unwrap_or_else(End::Leaves)
}

/// Follows a ray from cell `start` through an environment until `search`, called in each cell, finds
/// a hit. If it finds none, returns the side where the ray leaves.
#[inline]
pub(crate) fn follow<T>(
    space: &Space,
    environment: &LocalEnvironment,
    ray: &Ray,
    start: [u32; 3],
    mut search: impl FnMut(&Passage) -> Option<T>,
) -> Result<T, Side> {
    let Some(mut passage) = space.grid.enter(&environment.block, ray, start) else {
        return Err(space.grid.side_towards(&environment.block, ray));
    };
    loop {
        if let Some(hit) = search(&passage) {
            return Ok(hit);
        }
        passage.step()?;
    }
}

/// How a ray ends inside a cell: at the nearest polygon, not farther away than `reach`. At equal
/// distances, fronts precede backs, then lower indices precede, so that each point of coplanar
/// surfaces has one owner. If this polygon only touches the environment, the ray leaves towards it,
/// unless it runs along the side.
#[inline]
fn nearest_hit(
    space: &Space,
    environment: &LocalEnvironment,
    polygons: impl Iterator<Item = u32>,
    ray: &Ray,
    reach: f64,
) -> Option<End> {
    let mut nearest: Option<(u32, f64, Option<Side>)> = None;
    for polygon in polygons {
        let limit = nearest.map_or(reach, |(_, distance, _)| distance);
        let Some(distance) = space.facets.hit(polygon, ray, limit) else { continue };
        let touches = environment.only_touches(polygon);
        let side = if touches { environment.side_crossed(space, ray, distance) } else { None };
        let replaces = nearest.is_none_or(|(other, other_distance, _)| {
            distance < other_distance
                || (space.facets.faces(polygon, ray) && !space.facets.faces(other, ray))
        });
        if replaces {
            nearest = Some((polygon, distance, side));
        }
    }
    let (polygon, distance, side) = nearest?;
    Some(side.map_or(End::Hit { polygon, distance }, End::Leaves))
}
