//! Participating media that absorb light on its way (§3.2): how much of a ray's light is left.

use crate::bounds::Bounds;
use crate::ray::Ray;

/// A homogeneous medium that fills a box, absorbs and does not scatter. Where several overlap, their
/// absorption adds up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Where it is, in coordinates local to its scene's origin.
    pub bounds: Bounds,
    /// The coefficient σ of Beer and Lambert's law, 1/m: of a ray's light exp(-σd) is left after d metres.
    pub absorption: f64,
}

/// Optical depth of all media along a ray, as far as `limit` metres and only inside `within`. Of a space
/// that boxes part among them, the depths inside each add up to that of the whole.
pub fn optical_depth(media: &[Medium], ray: &Ray, within: &Bounds, limit: f64) -> f64 {
    let [start, end] = passage(ray, within, true);
    let (start, end) = (start.max(0.0), end.min(limit));
    let depth = |medium: &Medium| {
        let [enters, leaves] = passage(ray, &medium.bounds, false);
        medium.absorption * (leaves.min(end) - enters.max(start)).max(0.0)
    };
    media.iter().map(depth).sum()
}

/// Where a ray enters a box and where it leaves, metres from its origin; a ray that misses it leaves before
/// it enters. Whether one that runs in an upper side is inside is up to `closed`.
fn passage(ray: &Ray, around: &Bounds, closed: bool) -> [f64; 2] {
    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (low, high) = (around.min[axis], around.max[axis]);
        if ray.direction[axis] == 0.0 {
            let at = ray.origin[axis];
            if !(low <= at && (at < high || closed && at == high)) {
                return [f64::INFINITY, f64::NEG_INFINITY];
            }
            continue;
        }
        let crosses = |plane: f64| (plane - ray.origin[axis]) * ray.inverse[axis];
        let (one, other) = (crosses(low), crosses(high));
        enters = enters.max(one.min(other));
        leaves = leaves.min(one.max(other));
    }
    [enters, leaves]
}

/// How many bits a pixel of a mask has to hold the optical depth of media along its ray.
///
/// Choice C42: "Instead of using boolean values, an integer value could represent the percentage of
/// absorption along a given direction" (§3.2). Here it counts steps of optical depth: they add up from
/// environment to environment and are as fine in thick media, where percentages would have none left. The
/// greatest integer is a pixel that is false. Depth is rounded to the nearest step each time that a mask is
/// handed on, which changes what is left of the light by a factor of exp(±step/2) at most; light dimmed
/// beyond the last step is absorbed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthBits {
    /// Steps of 1/32: 1.6 % of the light each time, down to exp(-7.9) or 0.036 % of it.
    Eight,
    /// Steps of 1/4096: 0.012 % of the light each time, down to exp(-16) or 0.11 millionths of it.
    Sixteen,
}

impl DepthBits {
    /// Optical depth that a step stands for.
    pub fn step(self) -> f64 {
        match self {
            DepthBits::Eight => 1.0 / 32.0,
            DepthBits::Sixteen => 1.0 / 4_096.0,
        }
    }

    /// So many bits, if masks may have them.
    pub fn of(bits: u32) -> Option<DepthBits> {
        [DepthBits::Eight, DepthBits::Sixteen].into_iter().find(|depth| depth.bits() == bits)
    }

    /// Bits of a pixel.
    pub fn bits(self) -> u32 {
        match self {
            DepthBits::Eight => 8,
            DepthBits::Sixteen => 16,
        }
    }

    /// The integer of a pixel that is false.
    pub fn hidden(self) -> u16 {
        match self {
            DepthBits::Eight => u8::MAX.into(),
            DepthBits::Sixteen => u16::MAX,
        }
    }

    /// The nearest number of steps; none where that is more than there are.
    pub(crate) fn steps(self, depth: f64) -> Option<u16> {
        let steps = (depth / self.step()).round();
        (steps < f64::from(self.hidden())).then_some(steps as u16)
    }

    /// What is left of light after so many steps.
    pub(crate) fn transmittance(self, steps: u16) -> f64 {
        libm::exp(-f64::from(steps) * self.step())
    }
}
