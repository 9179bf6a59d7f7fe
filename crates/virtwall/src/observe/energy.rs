//! Where the emitted energy is, at any moment of a run.

use radiosity::{Rgb, Shot};

use crate::problem::Source;

/// Where the emitted energy is, W.
///
/// During a run, the power of a source that is selected and not shot yet is in transit, and so is the power
/// that virtual walls have gathered. At the end of a run, power that is still on virtual walls is unshot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyLedger {
    /// Emitted by all patches.
    pub emitted: Rgb,
    /// Absorbed by patches and by backs of polygons.
    pub absorbed: Rgb,
    /// Not shot: on patches and, at the end of a run, on virtual walls.
    pub unshot: Rgb,
    /// In sources that are selected or sent, and not shot yet.
    pub in_transit: Rgb,
    /// Left the scene.
    pub escaped: Rgb,
    /// Absorbed by participating media.
    pub medium: Rgb,
}

impl EnergyLedger {
    /// |emitted − (absorbed + unshot + in transit + escaped + medium)| / emitted, colours summed; 0 when
    /// nothing is emitted.
    pub fn error(&self) -> f64 {
        let found = self.absorbed + self.unshot + self.in_transit + self.escaped + self.medium;
        fraction((self.emitted - found).abs(), self.emitted)
    }

    /// Before the first shot all is unshot.
    pub fn at_first(emitted: Rgb) -> EnergyLedger {
        EnergyLedger { emitted, unshot: emitted, ..EnergyLedger::default() }
    }

    /// A source was selected: its patch gives the power away.
    pub fn selected(&mut self, source: &Source) {
        if source.is_local() {
            self.unshot -= source.emitter.power;
            self.in_transit += source.emitter.power;
        }
    }

    /// A source was shot, and patches reflect this power of it, W.
    pub fn shot(&mut self, source: &Source, shot: &Shot, reflected: Rgb) {
        let power = source.emitter.power;
        let fallen: f64 = shot.hits.iter().map(|(_, form_factor)| form_factor).sum();
        let onward: f64 = shot.outgoing.iter().flatten().map(|out| out.form_factor).sum();
        self.absorbed += power * (fallen + shot.backs) - reflected;
        self.escaped += power * shot.escaped;
        self.medium += power * shot.medium;
        self.in_transit += power * (onward - source.form_factor);
        self.unshot += reflected;
    }
}

/// The ratio of a part to the whole, colours summed; 0 if the whole is 0.
pub(crate) fn fraction(part: Rgb, whole: Rgb) -> f64 {
    if whole == Rgb::ZERO { 0.0 } else { part.element_sum() / whole.element_sum() }
}
