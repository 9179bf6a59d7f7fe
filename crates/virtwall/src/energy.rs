//! How the emitted energy moves while a run goes on.

use radiosity::{Rgb, Shot};

use crate::message::Source;
use crate::outcome::EnergyLedger;

/// A source that has been selected and not been shot yet is in transit, too, and so is what virtual walls
/// have gathered.
impl EnergyLedger {
    /// Before the first shot: all is unshot.
    pub fn at_first(emitted: Rgb) -> EnergyLedger {
        EnergyLedger { emitted, unshot: emitted, ..EnergyLedger::default() }
    }

    /// A source was selected: what a patch has not shot yet it gives away.
    pub fn selected(&mut self, source: &Source) {
        if source.is_local() {
            self.unshot -= source.emitter.power;
            self.in_transit += source.emitter.power;
        }
    }

    /// A source was shot, and patches reflect so much of it, W.
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
