//! Progress counters of a run that is under way.

use desim::Time;
use multicomputer::Rank;
use radiosity::{Rgb, Shot};
use virtwall::{EnergyLedger, MessageKind, Observer, Run, SentMessage, Source};

use crate::host::host_clock::Interval;

/// Host seconds between reports.
const BETWEEN_REPORTS: f64 = 0.1;

/// Progress counters of a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counters {
    /// Virtual time, seconds.
    pub time_s: f64,
    /// Sources shot, local and received.
    pub shots: u64,
    /// Sources sent from processor to processor.
    pub messages: u64,
    /// Nodes that are shooting.
    pub busy: usize,
    /// All compute nodes.
    pub nodes: usize,
    /// Share of the emitted energy that is still to be shot, on patches or in transit.
    pub unshot: f64,
}

/// Observes a run and reports its counters at intervals of host time.
pub struct ProgressObserver<T> {
    counters: Counters,
    energy: EnergyLedger,
    /// By rank, whether it shoots.
    shoots: Vec<bool>,
    interval: Interval,
    report: T,
}

impl<T: FnMut(Counters)> ProgressObserver<T> {
    /// An observer of `run` that calls `report` with its counters.
    pub fn new(run: &Run, report: T) -> ProgressObserver<T> {
        ProgressObserver {
            counters: Counters { nodes: run.processors, ..Counters::default() },
            energy: EnergyLedger::at_first(run.problem.emitted_power()),
            shoots: vec![false; run.processors],
            interval: Interval::new(BETWEEN_REPORTS),
            report,
        }
    }

    fn counters(&self, now: Time) -> Counters {
        let EnergyLedger { emitted, unshot, in_transit, .. } = self.energy;
        let emitted = emitted.element_sum();
        let left = (unshot + in_transit).element_sum();
        Counters {
            time_s: now.as_seconds_f64(),
            busy: self.shoots.iter().filter(|&&shoots| shoots).count(),
            unshot: if emitted > 0.0 { left / emitted } else { 0.0 },
            ..self.counters
        }
    }
}

impl<T: FnMut(Counters)> Observer for ProgressObserver<T> {
    fn sent(&mut self, _: Time, message: &SentMessage) {
        let is_source = matches!(message.kind, MessageKind::Source | MessageKind::WallPatch);
        self.counters.messages += u64::from(is_source);
    }

    fn selected(&mut self, _: Time, rank: Rank, source: &Source) {
        self.shoots[rank] = true;
        self.energy.selected(source);
    }

    fn shot(&mut self, now: Time, rank: Rank, source: &Source, shot: &Shot, reflected: Rgb) {
        self.energy.shot(source, shot, reflected);
        self.counters.shots += 1;
        if self.interval.is_due() {
            let counters = self.counters(now);
            (self.report)(counters);
        }
        self.shoots[rank] = false;
    }
}
