//! An emitter, and the result of shooting it through one environment.

use glam::DVec3;

use super::form_factors::FormFactors;
use super::mask::Mask;
use super::work::{Operation, Work};
use crate::mesh::{LocalEnvironment, Side};
use crate::scene::Rgb;

/// Geometry and photometry of a patch that shoots: what other environments must know about it.
/// Together with its visibility mask it is a source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emitter {
    /// Index of its environment.
    pub environment: u32,
    /// Index of the patch in that environment.
    pub patch: u32,
    /// Index of its polygon, which its own rays cannot hit.
    pub polygon: u32,
    /// Origin of its rays.
    pub centre: DVec3,
    /// Unit normal, the axis of the hemisphere.
    pub normal: DVec3,
    /// The power to shoot, W.
    pub power: Rgb,
    /// The same per area, W/m²: the delta-radiosity of §4.2.2.
    pub radiosity: Rgb,
}

/// Result of shooting an emitter through one environment. It does not depend on its power.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// Patches hit, in increasing order, and the form factor of each.
    pub hits: Vec<(u32, f64)>,
    /// Form factor of all backs of polygons.
    pub backs: f64,
    /// Form factor of the rays that left the scene.
    pub escaped: f64,
    /// Form factor absorbed by participating media.
    pub medium: f64,
    /// For each side, by [`Side::index`]: the pixels that leave through it, if there are any.
    pub outgoing: [Option<Outgoing>; 6],
    /// Operations counted.
    pub work: Work,
}

/// A mask for a neighbour.
///
/// Paper: §4.2.3, Figure 3.
#[derive(Clone, Debug, PartialEq)]
pub struct Outgoing {
    /// True for the pixels whose ray first leaves through this interface.
    ///
    /// Choice C12: §4.2.3 says "hits the plane". With unbounded planes, one pixel would reach
    /// several neighbours and its energy would be counted twice.
    pub mask: Mask,
    /// Sum of their form factors, reduced by participating media.
    pub form_factor: f64,
}

/// Counts the pixels of a shot by where their rays end.
pub(crate) struct Tally<'a> {
    environment: &'a LocalEnvironment,
    mask: &'a Mask,
    form_factors: FormFactors<'a>,
    outgoing: [Option<Mask>; 6],
    pub(crate) work: Work,
}

impl<'a> Tally<'a> {
    /// An empty tally. `form_factors` must have [`Tally::places`] places.
    pub(crate) fn new(
        environment: &'a LocalEnvironment,
        mask: &'a Mask,
        form_factors: FormFactors<'a>,
    ) -> Tally<'a> {
        Tally { environment, mask, form_factors, outgoing: Default::default(), work: Work::NONE }
    }

    /// Number of form factors: of each patch, of all backs, of what leaves the scene, and of what
    /// leaves through each side to a neighbour.
    pub(crate) fn places(environment: &LocalEnvironment) -> usize {
        environment.patches.len() + 2 + Side::ALL.len()
    }

    /// Rays of a bundle, one bit each, hit the front of a patch, or a back (`None`).
    #[inline]
    pub(crate) fn hit(&mut self, patch: Option<u32>, bundle: usize, rays: u64) {
        self.form_factors.add(place_of_hit(self.environment, patch), bundle, rays);
        self.work.count(Operation::Hit, u64::from(rays.count_ones()));
    }

    /// Rays of a bundle, one bit each, leave through a side, to a neighbour or out of the scene.
    pub(crate) fn leave(&mut self, side: Side, bundle: usize, rays: u64) {
        self.form_factors.add(place_of_exit(self.environment, side), bundle, rays);
        if self.environment.has_neighbour(side) {
            self.outgoing[side.index()]
                .get_or_insert_with(|| Mask::none(self.mask.pixels()))
                .set_in_word(bundle, rays);
        }
    }

    /// The finished shot.
    pub(crate) fn finish(self) -> Shot {
        let Tally { environment, mask, form_factors, outgoing, work } = self;
        finish(environment, mask, |place| form_factors.of(place), outgoing, work)
    }
}

/// The form factor to which a hit of a patch counts, or of a back (`None`).
pub(crate) fn place_of_hit(environment: &LocalEnvironment, patch: Option<u32>) -> usize {
    patch.map_or(environment.patches.len(), |patch| patch as usize)
}

/// The form factor to which a ray counts that leaves through a side.
pub(crate) fn place_of_exit(environment: &LocalEnvironment, side: Side) -> usize {
    let escaped = environment.patches.len() + 1;
    if environment.has_neighbour(side) { escaped + 1 + side.index() } else { escaped }
}

/// The finished shot with the form factor of each place. Counts the other operations of §4.2.3:
/// every pixel of the mask is tested, the mask is copied for each neighbour, each pixel still true is
/// tested against the plane of that neighbour, and the radiosities of all local patches are updated.
pub(crate) fn finish(
    environment: &LocalEnvironment,
    mask: &Mask,
    form_factor: impl Fn(usize) -> f64,
    mut outgoing: [Option<Mask>; 6],
    mut work: Work,
) -> Shot {
    let patches = environment.patches.len();
    let left: u64 = outgoing.iter().flatten().map(|mask| u64::from(mask.count())).sum();
    let neighbours = Side::ALL.iter().filter(|&&side| environment.has_neighbour(side)).count();
    let words = mask.words().len() as u64 * u64::from(mask.bits_a_pixel());
    work.count(Operation::PixelTest, u64::from(mask.pixels()));
    work.count(Operation::WordCopied, words * neighbours as u64);
    work.count(Operation::PlaneTest, left * neighbours as u64);
    work.count(Operation::PatchUpdate, patches as u64);
    let hits = (0..patches).map(|patch| (patch as u32, form_factor(patch)));
    Shot {
        hits: hits.filter(|&(_, form_factor)| form_factor > 0.0).collect(),
        backs: form_factor(patches),
        escaped: form_factor(patches + 1),
        medium: 0.0,
        outgoing: std::array::from_fn(|side| {
            let form_factor = form_factor(patches + 2 + side);
            outgoing[side].take().map(|mask| Outgoing { mask, form_factor })
        }),
        work,
    }
}
