//! Optical depth as an integer for each pixel of a mask.

/// How many bits of a mask store the optical depth along the ray of a pixel.
///
/// Choice C42: "Instead of using boolean values, an integer value could represent the percentage of
/// absorption along a given direction" (§3.2). Here the integer counts steps of optical depth: they
/// add up from environment to environment, and stay equally fine in thick media. The largest
/// integer marks a pixel that is false. The depth is rounded to the nearest step each time a mask
/// is sent on, which changes the remaining light by a factor of at most exp(±step/2). Beyond the
/// last step, all light counts as absorbed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthBits {
    /// Steps of 1/32: up to 1.6 % error per rounding, down to exp(-7.9) or 0.036 % of the light.
    Eight,
    /// Steps of 1/4096: up to 0.012 % error per rounding, down to exp(-16) of the light.
    Sixteen,
}

impl DepthBits {
    /// Optical depth of one step.
    pub fn step(self) -> f64 {
        match self {
            DepthBits::Eight => 1.0 / 32.0,
            DepthBits::Sixteen => 1.0 / 4_096.0,
        }
    }

    /// The variant with a number of bits, if there is one.
    pub fn of(bits: u32) -> Option<DepthBits> {
        [DepthBits::Eight, DepthBits::Sixteen].into_iter().find(|depth| depth.bits() == bits)
    }

    /// Bits per pixel.
    pub fn bits(self) -> u32 {
        match self {
            DepthBits::Eight => 8,
            DepthBits::Sixteen => 16,
        }
    }

    /// The integer that marks a false pixel.
    pub fn hidden(self) -> u16 {
        match self {
            DepthBits::Eight => u8::MAX.into(),
            DepthBits::Sixteen => u16::MAX,
        }
    }

    /// The nearest number of steps, or `None` beyond the last step.
    pub(crate) fn steps(self, depth: f64) -> Option<u16> {
        let steps = (depth / self.step()).round();
        (steps < f64::from(self.hidden())).then_some(steps as u16)
    }

    /// Fraction of the light that is left after a number of steps.
    pub(crate) fn transmittance(self, steps: u16) -> f64 {
        libm::exp(-f64::from(steps) * self.step())
    }
}
