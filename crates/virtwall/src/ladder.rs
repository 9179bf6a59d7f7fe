//! Rays scaled by unshot energy: smaller hemispheres for dimmer sources.
//!
//! All rays then carry about as much, and so does the noise that each leaves behind. Which hemisphere a
//! source was shot with travels as the length of its mask; all who receive it cast that one's rays.

use radiosity::{Hemisphere, Mask, Rgb};

/// Smaller hemispheres than the problem's own, and the power that their rays are to carry.
#[derive(Default)]
pub(crate) struct Ladder {
    /// By rising size.
    rungs: Vec<Hemisphere>,
    /// What a ray of the brightest patch carries when it is first shot, W.
    a_ray: f64,
}

/// What powers may differ by and count as the same: lights of equal emission have areas, and so powers,
/// in simple proportions, which rounding is not to decide on.
const ROUNDING: f64 = 1e-9;

impl Ladder {
    pub(crate) fn new(mut rungs: Vec<Hemisphere>, a_ray: f64) -> Ladder {
        rungs.sort_by_key(Hemisphere::pixels);
        Ladder { rungs, a_ray }
    }

    /// The rung for a source of so much power, W; none if it is to have all rays.
    ///
    /// Choice C43: the least whose rays carry no more than those of the brightest patch do at the start.
    pub(crate) fn rung_for(&self, power: Rgb) -> Option<&Hemisphere> {
        let most = self.a_ray * (1.0 + ROUNDING);
        let carried = |rung: &Hemisphere| power.abs().element_sum() / f64::from(rung.pixels());
        self.rungs.iter().find(|rung| carried(rung) <= most)
    }

    /// The rung that a mask belongs to, if to any.
    pub(crate) fn rung_of(&self, mask: &Mask) -> Option<&Hemisphere> {
        self.rungs.iter().find(|rung| rung.pixels() == mask.pixels())
    }

    /// All of them, the largest first.
    pub(crate) fn rungs(&self) -> impl Iterator<Item = &Hemisphere> {
        self.rungs.iter().rev()
    }
}
