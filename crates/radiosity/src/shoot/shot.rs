//! What becomes of a source in one environment.

use glam::DVec3;

use super::form_factors::FormFactors;
use super::mask::Mask;
use super::work::{Operation, Work};
use crate::mesh::{LocalEnvironment, Side};
use crate::scene::Rgb;

/// A patch that shoots, as every environment needs to know it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emitter {
    /// Environment of the patch.
    pub environment: u32,
    /// The patch in that environment.
    pub patch: u32,
    /// Its polygon, which its own rays cannot hit.
    pub polygon: u32,
    /// Where its rays start.
    pub centre: DVec3,
    /// Unit normal, the hemisphere's axis.
    pub normal: DVec3,
    /// Unshot power that is being shot, W.
    pub power: Rgb,
    /// The same a unit of area, W/m²: the delta-radiosity of §4.2.2.
    pub radiosity: Rgb,
}

/// What became of a source's pixels in one environment. It depends on geometry alone, so a shot can
/// be kept and used again whatever power the source has.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// Patches hit and the form factor that each got, by rising patch.
    pub hits: Vec<(u32, f64)>,
    /// Form factor of what fell on backs of polygons.
    pub backs: f64,
    /// Form factor of what left the scene.
    pub escaped: f64,
    /// Form factor of what participating media absorbed.
    pub medium: f64,
    /// For each side the pixels that leave through it, where there are any ([`Side::index`]).
    pub outgoing: [Option<Outgoing>; 6],
    /// Operations counted.
    pub work: Work,
}

/// A mask on its way to a neighbour.
#[derive(Clone, Debug, PartialEq)]
pub struct Outgoing {
    /// True for the pixels whose ray first leaves through this interface.
    ///
    /// Choice C12: §4.2.3 says "hits the plane". Taken of the unbounded plane, one pixel would reach
    /// several neighbours and its energy would double.
    pub mask: Mask,
    /// Their form factor together, dimmed by participating media.
    pub form_factor: f64,
}

/// A shot while its pixels are counted.
pub(crate) struct Tally<'a> {
    environment: &'a LocalEnvironment,
    mask: &'a Mask,
    form_factors: FormFactors<'a>,
    outgoing: [Option<Mask>; 6],
    pub(crate) work: Work,
}

impl<'a> Tally<'a> {
    /// Nothing counted yet; `form_factors` with room for [`Tally::places`].
    pub(crate) fn new(
        environment: &'a LocalEnvironment,
        mask: &'a Mask,
        form_factors: FormFactors<'a>,
    ) -> Tally<'a> {
        Tally { environment, mask, form_factors, outgoing: Default::default(), work: Work::NONE }
    }

    /// Form factors to be counted: of each patch, of backs, of what leaves the scene
    /// and of what leaves by each side for a neighbour.
    pub(crate) fn places(environment: &LocalEnvironment) -> usize {
        environment.patches.len() + 2 + Side::ALL.len()
    }

    /// Rays of the bundle, a bit each, hit the front of a patch, or a back.
    #[inline]
    pub(crate) fn hit(&mut self, patch: Option<u32>, bundle: usize, rays: u64) {
        let place = patch.map_or(self.environment.patches.len(), |patch| patch as usize);
        self.form_factors.add(place, bundle, rays);
        self.work.count(Operation::Hit, u64::from(rays.count_ones()));
    }

    /// Rays of the bundle, a bit each, leave by a side: to a neighbour, or out of the scene.
    pub(crate) fn leave(&mut self, side: Side, bundle: usize, rays: u64) {
        let escaped = self.environment.patches.len() + 1;
        if !self.environment.has_neighbour(side) {
            self.form_factors.add(escaped, bundle, rays);
            return;
        }
        self.form_factors.add(escaped + 1 + side.index(), bundle, rays);
        self.outgoing[side.index()]
            .get_or_insert_with(|| Mask::none(self.mask.pixels()))
            .set_in_word(bundle, rays);
    }

    pub(crate) fn finish(self) -> Shot {
        let Tally { environment, mask, form_factors, mut outgoing, work } = self;
        let patches = environment.patches.len();
        let hits = (0..patches).map(|patch| (patch as u32, form_factors.of(patch)));
        let mut shot = Shot {
            hits: hits.filter(|&(_, form_factor)| form_factor > 0.0).collect(),
            backs: form_factors.of(patches),
            escaped: form_factors.of(patches + 1),
            medium: 0.0,
            outgoing: std::array::from_fn(|side| {
                let form_factor = form_factors.of(patches + 2 + side);
                outgoing[side].take().map(|mask| Outgoing { mask, form_factor })
            }),
            work,
        };
        count_passes(&mut shot, environment, mask);
        shot
    }
}

/// Count what §4.2.3 does apart from casting: every pixel of the mask is looked at, each neighbour
/// gets a copy of the mask, each pixel still true is tested against that neighbour's plane, and the
/// radiosities of all local patches are updated.
pub(crate) fn count_passes(shot: &mut Shot, environment: &LocalEnvironment, mask: &Mask) {
    let left: u64 = shot.outgoing.iter().flatten().map(|o| u64::from(o.mask.count())).sum();
    let neighbours = Side::ALL.iter().filter(|&&side| environment.has_neighbour(side)).count();
    let words = mask.words().len() as u64 * u64::from(mask.bits_a_pixel());
    shot.work.count(Operation::PixelTest, u64::from(mask.pixels()));
    shot.work.count(Operation::WordCopied, words * neighbours as u64);
    shot.work.count(Operation::PlaneTest, left * neighbours as u64);
    shot.work.count(Operation::PatchUpdate, environment.patches.len() as u64);
}
