//! Optical depth as an integer for each pixel of a mask.

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
