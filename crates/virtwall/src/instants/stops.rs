//! The results that a run in one local environment would have had at higher thresholds.
//!
//! Patches are shot in the order of their values. So until the best value falls below a threshold, a run with
//! a lower threshold is the same. With several environments this does not hold: a part of a patch that was sent
//! to another environment is worth less than the patch. Patches below the threshold may then be shot before it,
//! and its light may raise others above the threshold.

use std::cell::RefCell;
use std::rc::Rc;

use desim::Time;
use multicomputer::{Machine, Network, Rank};
use radiosity::{Rgb, Shot};

use super::follower::{Follower, Instant};
use crate::observe::{Observer, SharedObserver};
use crate::on::RunError;
use crate::on::simulated::simulate_observed;
use crate::problem::Source;
use crate::run::{Outcome, Run};

/// Visits a run whenever its best patch falls below a threshold.
struct Stops<V> {
    follower: Follower,
    /// The run, for its rules.
    run: Run,
    /// Values to come, the next and greatest one last.
    values: Vec<f64>,
    /// Parts to come of the patch that was selected last.
    parts: usize,
    visit: V,
}

impl<V: FnMut(Instant<'_>)> Stops<V> {
    fn new(run: &Run, thresholds: &[f64], visit: V) -> Stops<V> {
        let (follower, run) = (Follower::new(run), run.clone());
        let selection = run.rules.selection;
        let brightest = run.problem.brightest(|power, b| selection.value_of(power, b));
        let mut values: Vec<f64> = thresholds.iter().map(|part| brightest * part).collect();
        values.sort_unstable_by(f64::total_cmp);
        Stops { follower, run, values, parts: 0, visit }
    }

    /// The value by which a patch is selected.
    fn value(&self, (environment, patch): (u32, u32)) -> f64 {
        let power = self.follower.light[environment as usize].unshot[patch as usize];
        let area = self.run.problem.environments[environment as usize].radiosity_area(patch);
        self.run.rules.selection.value_of(power, power / area)
    }

    /// A patch gives away what it shoots, with all its parts at once.
    fn take(&mut self, (environment, patch): (u32, u32)) {
        let Run { problem, rules, .. } = &self.run;
        let geometry = &problem.environments[environment as usize];
        let left = 1.0 - rules.shooting.share(geometry.emitted_power(&problem.space, patch));
        self.follower.light[environment as usize].unshot[patch as usize] *= left;
        self.parts = rules.shooting.split.parts(&problem.space, geometry, patch).len();
    }
}

impl<V: FnMut(Instant<'_>)> Observer for Stops<V> {
    fn selected(&mut self, now: Time, _: Rank, source: &Source) {
        if source.is_local() {
            if self.parts == 0 {
                let patch = (source.environment, source.emitter.patch);
                let value = self.value(patch);
                while self.values.pop_if(|threshold| value < *threshold).is_some() {
                    (self.visit)(self.follower.instant(now));
                }
                self.take(patch);
            }
            self.parts -= 1;
        }
        self.follower.energy.selected(source);
    }

    fn shot(&mut self, _: Time, _: Rank, source: &Source, shot: &Shot, reflected: Rgb) {
        self.follower.shot(source, shot, reflected);
    }
}

/// Simulate a run in one environment and visit what it would have ended with at each of `thresholds`, parts
/// of the brightest patch, in falling order. Those below the run's own show its end.
pub fn visit_stops(
    run: &Run,
    machine: &Machine,
    network: Box<dyn Network>,
    thresholds: &[f64],
    visit: impl FnMut(Instant<'_>) + 'static,
) -> Result<Outcome, RunError> {
    let stops = Rc::new(RefCell::new(Stops::new(run, thresholds, visit)));
    let observer: SharedObserver = stops.clone();
    let outcome = simulate_observed(run, machine, network, Some(observer))?;
    let mut stops = stops.borrow_mut();
    let Stops { follower, values, visit, .. } = &mut *stops;
    values.drain(..).for_each(|_| visit(follower.instant(outcome.time)));
    drop(stops);
    Ok(outcome)
}
