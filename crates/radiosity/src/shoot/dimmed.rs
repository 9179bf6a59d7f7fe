//! Shooting in a scene with participating media (§3.2), one ray at a time.

use super::hemisphere::Hemisphere;
use super::mask::Mask;
use super::plain::{End, cast};
use super::shot::{Emitter, Outgoing, Shot, count_passes};
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
    let mut sums = Sums { hits: vec![0.0; environment.patches.len()], ..Sums::default() };
    for pixel in mask.ones() {
        let ray = Ray::new(emitter.centre, hemisphere.direction(frame, pixel));
        let end = cast(space, environment, &ray, emitter.polygon, &mut sums.work);
        let limit = if let End::Hit { distance, .. } = end { distance } else { f64::INFINITY };
        let depth = mask.depth(pixel) + optical_depth(&space.scene.media, &ray, &within, limit);
        let arriving = hemisphere.weights[pixel as usize] * mask.transmittance(pixel);
        let left = hemisphere.weights[pixel as usize] * libm::exp(-depth);
        let kept = match end {
            End::Hit { polygon, distance } => {
                let front = space.facets.faces(polygon, &ray);
                let patch = environment.patch_at(polygon, ray.at(distance)).filter(|_| front);
                sums.hit(patch, left)
            }
            End::Leaves(side) if environment.has_neighbour(side) => {
                let outgoing = sums.outgoing[side.index()].get_or_insert_with(|| Outgoing {
                    mask: Mask::none(mask.pixels()).with_depths(bits),
                    form_factor: 0.0,
                });
                let left =
                    hemisphere.weights[pixel as usize] * outgoing.mask.set_depth(pixel, depth);
                outgoing.form_factor += left;
                left
            }
            End::Leaves(_) => {
                sums.escaped += left;
                left
            }
        };
        sums.medium += arriving - kept;
    }
    sums.finish(environment, mask)
}

/// Sums of form factors, reduced by media.
#[derive(Default)]
struct Sums {
    /// By patch.
    hits: Vec<f64>,
    backs: f64,
    escaped: f64,
    medium: f64,
    outgoing: [Option<Outgoing>; 6],
    work: Work,
}

impl Sums {
    /// Adds the form factor of a ray that hits a patch, or a back (`None`), and returns it.
    fn hit(&mut self, patch: Option<u32>, form_factor: f64) -> f64 {
        self.work.count(Operation::Hit, 1);
        match patch {
            Some(patch) => self.hits[patch as usize] += form_factor,
            None => self.backs += form_factor,
        }
        form_factor
    }

    fn finish(self, environment: &LocalEnvironment, mask: &Mask) -> Shot {
        let Sums { hits, backs, escaped, medium, outgoing, work } = self;
        let hits = (0u32..).zip(hits).filter(|&(_, form_factor)| form_factor > 0.0).collect();
        // A mask is empty if all its pixels are beyond the last step. It is not sent.
        let outgoing =
            outgoing.map(|outgoing| outgoing.filter(|outgoing| !outgoing.mask.is_empty()));
        let mut shot = Shot { hits, backs, escaped, medium, outgoing, work };
        count_passes(&mut shot, environment, mask);
        shot
    }
}
