//! How a run is while it is under way, in a few numbers.

use desim::Time;
use multicomputer::Rank;
use radiosity::{Rgb, Shot};
use virtwall::{EnergyLedger, MessageKind, Observer, Run, SentMessage, Source};

use crate::host::host_clock::Interval;

/// Host seconds between pulses.
const BETWEEN_PULSES: f64 = 0.1;

/// How a run is.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pulse {
    /// Virtual time, seconds.
    pub time_s: f64,
    /// Sources shot, local and received.
    pub shots: u64,
    /// Sources sent from processor to processor.
    pub messages: u64,
    /// Nodes that shoot.
    pub busy: usize,
    /// All compute nodes.
    pub nodes: usize,
    /// Of the emitted energy what is still to be shot, on patches and under way.
    pub unshot: f64,
}

/// Counts along with a run, and tells now and then.
pub struct Heart<T> {
    pulse: Pulse,
    energy: EnergyLedger,
    /// By rank, whether it shoots.
    shoots: Vec<bool>,
    interval: Interval,
    tell: T,
}

impl<T: FnMut(Pulse)> Heart<T> {
    /// Of a run.
    pub fn new(run: &Run, tell: T) -> Heart<T> {
        Heart {
            pulse: Pulse { nodes: run.processors, ..Pulse::default() },
            energy: EnergyLedger::at_first(run.problem.emitted_power()),
            shoots: vec![false; run.processors],
            interval: Interval::new(BETWEEN_PULSES),
            tell,
        }
    }

    fn pulse(&self, now: Time) -> Pulse {
        let EnergyLedger { emitted, unshot, in_transit, .. } = self.energy;
        let emitted = emitted.element_sum();
        let left = (unshot + in_transit).element_sum();
        Pulse {
            time_s: now.as_seconds_f64(),
            busy: self.shoots.iter().filter(|&&shoots| shoots).count(),
            unshot: if emitted > 0.0 { left / emitted } else { 0.0 },
            ..self.pulse
        }
    }
}

impl<T: FnMut(Pulse)> Observer for Heart<T> {
    fn sent(&mut self, _: Time, message: &SentMessage) {
        let is_source = matches!(message.kind, MessageKind::Source | MessageKind::WallPatch);
        self.pulse.messages += u64::from(is_source);
    }

    fn selected(&mut self, _: Time, rank: Rank, source: &Source) {
        self.shoots[rank] = true;
        self.energy.selected(source);
    }

    fn shot(&mut self, now: Time, rank: Rank, source: &Source, shot: &Shot, reflected: Rgb) {
        self.energy.shot(source, shot, reflected);
        self.pulse.shots += 1;
        if self.interval.is_due() {
            let pulse = self.pulse(now);
            (self.tell)(pulse);
        }
        self.shoots[rank] = false;
    }
}
