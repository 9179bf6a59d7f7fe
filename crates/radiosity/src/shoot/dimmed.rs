//! Shooting in a scene with participating media (§3.2), one ray at a time.

use super::hemisphere::Hemisphere;
use super::mask::Mask;
use super::plain::{End, cast};
use super::shot::{Emitter, Shot, Tally, finish, place_of_exit, place_of_hit};
use super::work::{Operation, Work};
use crate::geometry::Ray;
use crate::media::{DepthBits, optical_depth};
use crate::mesh::{LocalEnvironment, Space};

/// [`shoot`](crate::shoot) in a scene with media. The optical depth of a ray is that in the mask
/// plus that of its path here. Outgoing masks store the sum.
pub(crate) fn shoot_dimmed(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    emitter: &Emitter,
    mask: &Mask,
) -> Shot {
    let frame = hemisphere.frame(emitter.centre, emitter.normal);
    let within = space.grid.bounds(&environment.block);
    let bits = mask.depth_bits().unwrap_or(DepthBits::Sixteen);
    let mut form_factors = vec![0.0; Tally::places(environment)];
    let mut outgoing: [Option<Mask>; 6] = Default::default();
    let (mut medium, mut work) = (0.0, Work::NONE);
    for pixel in mask.ones() {
        let ray = Ray::new(emitter.centre, hemisphere.direction(frame, pixel));
        let end = cast(space, environment, &ray, emitter.polygon, &mut work);
        let limit = if let End::Hit { distance, .. } = end { distance } else { f64::INFINITY };
        let depth = mask.depth(pixel) + optical_depth(&space.scene.media, &ray, &within, limit);
        let weight = hemisphere.weights[pixel as usize];
        let left = weight * libm::exp(-depth);
        let (place, kept) = match end {
            End::Hit { polygon, distance } => {
                work.count(Operation::Hit, 1);
                let front = space.facets.faces(polygon, &ray);
                let piece = environment.piece(polygon).filter(|_| front);
                let patch = piece.and_then(|piece| environment.patch_hit(piece, &ray, distance));
                (place_of_hit(environment, patch), left)
            }
            End::Leaves(side) if environment.has_neighbour(side) => {
                let none = || Mask::none(mask.pixels()).with_depths(bits);
                let outgoing = outgoing[side.index()].get_or_insert_with(none);
                (place_of_exit(environment, side), weight * outgoing.set_depth(pixel, depth))
            }
            End::Leaves(side) => (place_of_exit(environment, side), left),
        };
        form_factors[place] += kept;
        medium += weight * mask.transmittance(pixel) - kept;
    }
    // A mask is empty if all its pixels are beyond the last step. It is not sent.
    let outgoing = outgoing.map(|mask| mask.filter(|mask| !mask.is_empty()));
    Shot { medium, ..finish(environment, mask, |place| form_factors[place], outgoing, work) }
}
