//! Smaller hemispheres for dimmer sources, so that all rays carry about the same power.
//!
//! The length of a source's mask says which hemisphere it was shot with; every node that receives it casts
//! that hemisphere's rays.

use radiosity::{Hemisphere, Mask, Rgb};

/// Hemispheres smaller than the problem's own, and the power that their rays may carry.
#[derive(Default)]
pub(super) struct SmallerHemispheres {
    /// The hemispheres, by rising size.
    hemispheres: Vec<Hemisphere>,
    /// Power of a ray of the brightest patch when that is first shot, W.
    ray_power: f64,
}

/// Powers that differ by less than this fraction count as equal. Lights of equal emission have areas, and so
/// powers, in simple proportions; rounding must not decide between two hemispheres.
const ROUNDING: f64 = 1e-9;

impl SmallerHemispheres {
    pub fn new(mut hemispheres: Vec<Hemisphere>, ray_power: f64) -> SmallerHemispheres {
        hemispheres.sort_by_key(Hemisphere::pixels);
        SmallerHemispheres { hemispheres, ray_power }
    }

    /// The hemisphere for a source of this power, W; none if it needs all rays.
    ///
    /// Choice C43: the smallest whose rays carry no more than those of the brightest patch do at the start.
    pub fn for_power(&self, power: Rgb) -> Option<&Hemisphere> {
        let most = self.ray_power * (1.0 + ROUNDING);
        let carried = |one: &Hemisphere| power.abs().element_sum() / f64::from(one.pixels());
        self.hemispheres.iter().find(|one| carried(one) <= most)
    }

    /// The hemisphere that a mask belongs to, if it is one of these.
    pub fn of_mask(&self, mask: &Mask) -> Option<&Hemisphere> {
        self.hemispheres.iter().find(|one| one.pixels() == mask.pixels())
    }

    /// All hemispheres, the largest first.
    pub fn all(&self) -> impl Iterator<Item = &Hemisphere> {
        self.hemispheres.iter().rev()
    }
}
