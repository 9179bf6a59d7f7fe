//! From radiosity to what a screen can show.

use crate::scene::Rgb;

/// How radiosity becomes brightness.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Exposure {
    /// The geometric mean of what is seen becomes middle grey.
    #[default]
    Auto,
    /// This radiosity, W/m², becomes middle grey.
    MiddleGrey(f64),
}

/// How what is brighter than middle grey nears white.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tone {
    /// Reinhard et al. 2002, equation 4, on the luminance, so that colours stay what they are. Six
    /// times middle grey is white.
    #[default]
    Reinhard,
    /// In proportion, middle grey at 0.18, until it is cut off at 1: what was can be read back.
    Linear,
}

/// Brightness of middle grey where all is in proportion, of 1.
const MIDDLE: f64 = 0.18;

impl Tone {
    /// From radiosity over middle grey to the screen's 0..1, in proportion to light.
    pub fn map(self, relative: Rgb) -> Rgb {
        const KEY: f64 = 0.35;
        const WHITE: f64 = KEY * 6.0;
        let scale = match self {
            Tone::Reinhard => {
                let light = luminance(relative) * KEY;
                KEY * (1.0 + light / (WHITE * WHITE)) / (1.0 + light)
            }
            Tone::Linear => MIDDLE,
        };
        (relative * scale).clamp(Rgb::ZERO, Rgb::ONE)
    }
}

/// Brightness to the eye (ITU-R BT.709).
fn luminance(rgb: Rgb) -> f64 {
    rgb.dot(Rgb::new(0.2126, 0.7152, 0.0722))
}

/// The geometric mean of radiosities, each with its weight, as middle grey, W/m². What is all but
/// black counts for a twentieth of the mean, or rooms not lit yet would turn the others white.
pub(crate) fn geometric_mean(seen: &(impl Iterator<Item = (Rgb, f64)> + Clone)) -> f64 {
    let weight: f64 = seen.clone().map(|(_, weight)| weight).sum();
    let seen = || seen.clone().map(|(rgb, weight)| (luminance(rgb), weight));
    let least = 0.05 * seen().map(|(light, weight)| light * weight).sum::<f64>() / weight;
    if least > 0.0 {
        let logarithms = seen().map(|(light, weight)| libm::log(light.max(least)) * weight);
        libm::exp(logarithms.sum::<f64>() / weight)
    } else {
        1.0
    }
}

/// sRGB's transfer function, in eight bits.
pub(crate) fn srgb(linear: f64) -> u8 {
    let encoded = if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
    };
    (encoded * 255.0 + 0.5) as u8
}
