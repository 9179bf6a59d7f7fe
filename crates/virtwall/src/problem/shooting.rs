//! How a patch is shot, beyond RR-3008: options that trade accuracy for time.

use radiosity::{LocalEnvironment, Part, Rgb, Space};

/// How a patch is shot. The default is RR-3008's way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shooting {
    /// How many sources a patch is cut into.
    pub split: SourceSplit,
    /// What a patch that does not emit shoots, over what it has not shot; the excess is subtracted from
    /// what it shoots later. Source: Feda and Purgathofer 1992.
    pub overshoot: f64,
    /// Whether the radiosities of the result include an estimate of what the unshot light would have
    /// added. Source: Cohen, Chen, Wallace and Greenberg 1988.
    pub ambient: bool,
}

impl Default for Shooting {
    fn default() -> Shooting {
        Shooting { split: SourceSplit::NONE, overshoot: 1.0, ambient: false }
    }
}

impl Shooting {
    /// The part of a patch's unshot power that it shoots. Patches that emit are never over-shot: most of
    /// what they send out is known from the start.
    pub(crate) fn share(&self, emitted: Rgb) -> f64 {
        if emitted == Rgb::ZERO { self.overshoot } else { 1.0 }
    }
}

/// How many sources a patch is cut into, each with a hemisphere of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SourceSplit {
    /// Distance from a part to everything in front of the patch, in edges of the part, that cutting must
    /// reach, seen from the patch's centre; infinite: all patches are cut into `most`.
    pub nearer_than: f64,
    /// The most parts along each of a patch's two directions.
    pub most: u32,
}

impl SourceSplit {
    /// Patches shoot from their centres.
    pub const NONE: SourceSplit = SourceSplit { nearer_than: f64::INFINITY, most: 1 };

    /// The parts that a patch of an environment is cut into.
    pub fn parts(&self, space: &Space, environment: &LocalEnvironment, patch: u32) -> Vec<Part> {
        let along = match self.nearer_than.is_finite() {
            true => environment.parts_needed(space, patch, self.nearer_than, self.most),
            false => self.most,
        };
        environment.parts(space, patch, along)
    }
}
