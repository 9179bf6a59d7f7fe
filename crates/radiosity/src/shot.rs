//! What becomes of a source in one environment.

use glam::DVec3;

use crate::environment::LocalEnvironment;
use crate::grid::Side;
use crate::mask::Mask;
use crate::scene::Rgb;
use crate::work::{Operation, Work};

/// A patch that shoots, as every environment needs to know it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Source {
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
    /// Their form factor together.
    pub form_factor: f64,
}

/// A shot while its pixels are counted.
pub(crate) struct Tally {
    pub(crate) shot: Shot,
    form_factors: Vec<f64>,
    pixels: u32,
}

impl Tally {
    pub(crate) fn new(environment: &LocalEnvironment, mask: &Mask) -> Tally {
        let shot = Shot {
            hits: Vec::new(),
            backs: 0.0,
            escaped: 0.0,
            outgoing: Default::default(),
            work: Work::NONE,
        };
        Tally { shot, form_factors: vec![0.0; environment.patches.len()], pixels: mask.pixels() }
    }

    /// A pixel's ray hits the front of a patch, or a back.
    pub(crate) fn hit(&mut self, patch: Option<u32>, weight: f64) {
        match patch {
            Some(patch) => self.form_factors[patch as usize] += weight,
            None => self.shot.backs += weight,
        }
        self.shot.work.count(Operation::Hit, 1);
    }

    /// A pixel's ray leaves by a side: to a neighbour, or out of the scene.
    pub(crate) fn leaves(
        &mut self,
        environment: &LocalEnvironment,
        side: Side,
        pixel: u32,
        weight: f64,
    ) {
        if !environment.has_neighbour(side) {
            self.shot.escaped += weight;
            return;
        }
        let outgoing = self.shot.outgoing[side.index()]
            .get_or_insert_with(|| Outgoing { mask: Mask::none(self.pixels), form_factor: 0.0 });
        outgoing.mask.set(pixel);
        outgoing.form_factor += weight;
    }

    /// Count operations.
    #[inline]
    pub(crate) fn work(&mut self, operation: Operation, times: u64) {
        self.shot.work.count(operation, times);
    }

    pub(crate) fn finish(mut self, environment: &LocalEnvironment, mask: &Mask) -> Shot {
        let patches = self.form_factors.into_iter().enumerate();
        let patches = patches.map(|(patch, form_factor)| (patch as u32, form_factor));
        self.shot.hits = patches.filter(|&(_, form_factor)| form_factor > 0.0).collect();
        count_passes(&mut self.shot, environment, mask);
        self.shot
    }
}

/// Count what §4.2.3 does apart from casting: every pixel of the mask is looked at, each neighbour
/// gets a copy of the mask, each pixel still true is tested against that neighbour's plane, and the
/// radiosities of all local patches are updated.
fn count_passes(shot: &mut Shot, environment: &LocalEnvironment, mask: &Mask) {
    let left: u64 = shot.outgoing.iter().flatten().map(|o| u64::from(o.mask.count())).sum();
    let neighbours = Side::ALL.iter().filter(|&&side| environment.has_neighbour(side)).count();
    let words = mask.words().len() as u64;
    shot.work.count(Operation::PixelTest, u64::from(mask.pixels()));
    shot.work.count(Operation::WordCopied, words * neighbours as u64);
    shot.work.count(Operation::PlaneTest, left * neighbours as u64);
    shot.work.count(Operation::PatchUpdate, environment.patches.len() as u64);
}
