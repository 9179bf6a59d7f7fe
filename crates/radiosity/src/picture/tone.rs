//! Tone mapping: from radiosity to brightness on a screen.

use crate::scene::Rgb;

/// How radiosity is scaled to brightness.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Exposure {
    /// The geometric mean of the visible radiosities is shown as middle grey.
    #[default]
    Auto,
    /// This radiosity, W/m², is shown as middle grey.
    MiddleGrey(f64),
}

/// How brightness above middle grey is compressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tone {
    /// Reinhard et al. 2002, equation 4, of the luminance. Six times middle grey is white.
    #[default]
    Reinhard,
    /// Proportional, middle grey at 0.18, clipped at 1: pictures can be read as radiosities.
    Linear,
}

/// Brightness of middle grey in a linear picture.
const MIDDLE: f64 = 0.18;

impl Tone {
    /// From radiosity relative to middle grey to linear brightness, 0 to 1.
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

/// Luminance (ITU-R BT.709).
fn luminance(rgb: Rgb) -> f64 {
    rgb.dot(Rgb::new(0.2126, 0.7152, 0.0722))
}

/// The weighted geometric mean luminance, W/m², used as middle grey. Values below a twentieth of
/// the arithmetic mean are raised to it, so that dark rooms do not make others too bright.
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

/// The sRGB transfer function, rounded to eight bits.
pub(crate) fn srgb(linear: f64) -> u8 {
    let encoded = if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
    };
    (encoded * 255.0 + 0.5) as u8
}
