//! What a run has done so far, by its shots.

use std::sync::{Arc, Mutex};

use virtwall::{Problem, ShotMeter, Source};

use crate::host::held::held;

/// What a run has done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Done {
    /// Sources shot, local and received.
    pub shots: u64,
    /// Power of the patches that it shot, over the emitted power: 1 when all lights are shot, more later.
    pub power: f64,
    /// Shots so far of all runs of its problem that were not in memory when they were asked for.
    pub new: u64,
    /// Host seconds for which all runs of its problem have waited for shots so far.
    pub waited_s: f64,
}

/// Shots of a run.
pub struct ShotSum {
    /// Emitted power of the problem, W.
    emitted: f64,
    meter: Arc<ShotMeter>,
    /// The number of shots, and the power of those of patches, W.
    sum: Mutex<(u64, f64)>,
}

impl ShotSum {
    /// No shot of a problem, whose meter this is.
    pub fn new(problem: &Problem, meter: &Arc<ShotMeter>) -> ShotSum {
        let emitted = problem.emitted_power().element_sum();
        ShotSum { emitted, meter: Arc::clone(meter), sum: Mutex::default() }
    }

    /// Adds the shot of a source; returns how many there are.
    pub fn add(&self, source: &Source) -> u64 {
        let mut sum = held(&self.sum);
        if source.is_of_a_patch() {
            sum.1 += source.power().element_sum();
        }
        sum.0 += 1;
        sum.0
    }

    /// What the run has done.
    pub fn done(&self) -> Done {
        let (shots, power) = *held(&self.sum);
        let power = if self.emitted > 0.0 { power / self.emitted } else { 0.0 };
        let (new, waited_s) = self.meter.read();
        Done { shots, power, new, waited_s }
    }
}
