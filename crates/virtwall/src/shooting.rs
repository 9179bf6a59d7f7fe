//! How a patch is shot, beyond what RR-3008 does: knobs that trade accuracy for time.

use radiosity::{LocalEnvironment, Part, Rgb, Space};

/// How a patch is shot. The default is what RR-3008 does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shooting {
    /// Into how many sources a patch is cut.
    pub split: SourceSplit,
    /// What a patch that does not emit shoots, over what it has not shot; what is too much is missing
    /// from what it will shoot later (Feda and Purgathofer 1992).
    pub overshoot: f64,
    /// Whether radiosities as they are told at the end include an estimate of what the light that was
    /// not shot would have added (Cohen, Chen, Wallace and Greenberg 1988).
    pub ambient: bool,
}

impl Default for Shooting {
    fn default() -> Shooting {
        Shooting { split: SourceSplit::NONE, overshoot: 1.0, ambient: false }
    }
}

impl Shooting {
    /// The part of a patch's unshot power that it shoots; patches that emit are never over-shot, as
    /// most of what they send out is known from the start.
    pub(crate) fn share(&self, emitted: Rgb) -> f64 {
        if emitted == Rgb::ZERO { self.overshoot } else { 1.0 }
    }
}

/// Into how many sources a patch is cut, each with a hemisphere of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SourceSplit {
    /// Parts are so many of their edges away from all that is in front of the patch, seen from its
    /// centre; infinite: all patches are cut into `most`.
    pub nearer_than: f64,
    /// The most parts along each of a patch's two directions.
    pub most: u32,
}

impl SourceSplit {
    /// Patches shoot from their centres.
    pub const NONE: SourceSplit = SourceSplit { nearer_than: f64::INFINITY, most: 1 };

    /// The sources that a patch of an environment is cut into.
    pub fn parts(&self, space: &Space, environment: &LocalEnvironment, patch: u32) -> Vec<Part> {
        let along = match self.nearer_than.is_finite() {
            true => environment.parts_needed(space, patch, self.nearer_than, self.most),
            false => self.most,
        };
        environment.parts(space, patch, along)
    }
}
