//! Shooting through participating media, a ray at a time.

use super::hemisphere::Hemisphere;
use super::mask::Mask;
use super::plain::{End, cast};
use super::shot::{Emitter, Outgoing, Shot, count_passes};
use super::work::{Operation, Work};
use crate::geometry::Ray;
use crate::media::{DepthBits, optical_depth};
use crate::mesh::{LocalEnvironment, Space};

/// [`shoot`](crate::shoot) in a scene with media. What a ray brings to where it ends is dimmed by the depth
/// that its pixel has come with and by that on its way through this environment; masks go on with both.
pub(crate) fn shoot_dimmed(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    source: &Emitter,
    mask: &Mask,
) -> Shot {
    let [tangent, bitangent, normal] = hemisphere.frame(source.centre, source.normal);
    let within = space.grid.bounds(&environment.block);
    let bits = mask.depth_bits().unwrap_or(DepthBits::Sixteen);
    let mut found = Found { hits: vec![0.0; environment.patches.len()], ..Found::default() };
    for pixel in mask.ones() {
        let d = hemisphere.directions[pixel as usize];
        let ray = Ray::new(source.centre, tangent * d.x + bitangent * d.y + normal * d.z);
        let end = cast(space, environment, &ray, source.polygon, &mut found.work);
        let limit = if let End::Hit { distance, .. } = end { distance } else { f64::INFINITY };
        let depth = mask.depth(pixel) + optical_depth(&space.scene.media, &ray, &within, limit);
        let arriving = hemisphere.weights[pixel as usize] * mask.transmittance(pixel);
        let left = hemisphere.weights[pixel as usize] * libm::exp(-depth);
        let kept = match end {
            End::Hit { polygon, distance } => {
                let front = space.facets.faces(polygon, &ray);
                let patch = environment.patch_at(polygon, ray.at(distance)).filter(|_| front);
                found.hit(patch, left)
            }
            End::Leaves(side) if environment.has_neighbour(side) => {
                let goes = found.outgoing[side.index()].get_or_insert_with(|| Outgoing {
                    mask: Mask::none(mask.pixels()).with_depths(bits),
                    form_factor: 0.0,
                });
                let left = hemisphere.weights[pixel as usize] * goes.mask.set_depth(pixel, depth);
                goes.form_factor += left;
                left
            }
            End::Leaves(_) => {
                found.escaped += left;
                left
            }
        };
        found.medium += arriving - kept;
    }
    found.finish(environment, mask)
}

/// Form factors while pixels are added up, dimmed.
#[derive(Default)]
struct Found {
    /// By patch.
    hits: Vec<f64>,
    backs: f64,
    escaped: f64,
    medium: f64,
    outgoing: [Option<Outgoing>; 6],
    work: Work,
}

impl Found {
    /// A pixel falls on the front of a patch, or on a back; returns the same form factor.
    fn hit(&mut self, patch: Option<u32>, form_factor: f64) -> f64 {
        self.work.count(Operation::Hit, 1);
        match patch {
            Some(patch) => self.hits[patch as usize] += form_factor,
            None => self.backs += form_factor,
        }
        form_factor
    }

    fn finish(self, environment: &LocalEnvironment, mask: &Mask) -> Shot {
        let Found { hits, backs, escaped, medium, outgoing, work } = self;
        let hits = (0u32..).zip(hits).filter(|&(_, form_factor)| form_factor > 0.0).collect();
        // Masks whose every pixel was dimmed beyond the last step go nowhere.
        let outgoing = outgoing.map(|goes| goes.filter(|goes| !goes.mask.is_empty()));
        let mut shot = Shot { hits, backs, escaped, medium, outgoing, work };
        count_passes(&mut shot, environment, mask);
        shot
    }
}
