//! A source: an emitter and its visibility mask, on its way through the local environments (§3.1).

use radiosity::{Emitter, Mask, Rgb};

/// An emitter and what is still visible of it, for one local environment.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// The local environment that it is for.
    pub environment: u32,
    /// The number of the emitter's shots by its node: with the emitter's environment and patch, the identity of
    /// a shot. Two shots of one patch are two sources, also where their power is the same.
    pub shot: u32,
    /// Geometry and photometry of the emitter.
    pub emitter: Emitter,
    /// True for the pixels that arrive there.
    pub mask: Mask,
    /// The sum of their form factors.
    pub form_factor: f64,
}

impl Source {
    /// Whether the emitter is in the environment that the source is for. A source that has left an
    /// environment never comes back: environments are boxes, and rays are straight.
    pub fn is_local(&self) -> bool {
        self.environment == self.emitter.environment
    }

    /// Whether it is a patch that begins to shoot: neither handed on, nor a bin of a virtual wall.
    pub fn is_of_a_patch(&self) -> bool {
        self.is_local() && !self.emitter.is_of_a_wall()
    }

    /// The power that it carries into its environment, W.
    pub fn power(&self) -> Rgb {
        self.emitter.power * self.form_factor
    }
}
