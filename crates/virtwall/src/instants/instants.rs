//! The light at given instants of a run.
//!
//! Runs are the same to the bit each time, and their shots are kept, so that running again costs little more than
//! the events of the run; nothing has to be stored in advance.

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

/// Visits the instants asked for while a run goes on.
struct Visitor<V> {
    follower: Follower,
    /// Instants to come, the next one last.
    times: Vec<Time>,
    visit: V,
}

impl<V: FnMut(Instant<'_>)> Visitor<V> {
    fn new(run: &Run, times: &[Time], visit: V) -> Visitor<V> {
        let mut times = times.to_vec();
        times.sort_unstable_by(|one, other| other.cmp(one));
        Visitor { follower: Follower::new(run), times, visit }
    }

    /// Something happens now: show the instants before it.
    fn pass(&mut self, now: Time) {
        while self.times.last().is_some_and(|&time| time < now) {
            self.show_next();
        }
    }

    fn show_next(&mut self) {
        let Some(time) = self.times.pop() else { return };
        (self.visit)(self.follower.instant(time));
    }
}

impl<V: FnMut(Instant<'_>)> Observer for Visitor<V> {
    fn selected(&mut self, now: Time, _: Rank, source: &Source) {
        self.pass(now);
        self.follower.energy.selected(source);
    }

    fn shot(&mut self, now: Time, _: Rank, source: &Source, shot: &Shot, reflected: Rgb) {
        self.pass(now);
        self.follower.shot(source, shot, reflected);
    }
}

/// Simulate a run and visit it at each of `times`, in rising order. A time after the end shows the end.
pub fn visit_instants(
    run: &Run,
    machine: &Machine,
    network: Box<dyn Network>,
    times: &[Time],
    visit: impl FnMut(Instant<'_>) + 'static,
) -> Result<Outcome, RunError> {
    let visitor = Rc::new(RefCell::new(Visitor::new(run, times, visit)));
    let observer: SharedObserver = visitor.clone();
    let outcome = simulate_observed(run, machine, network, Some(observer))?;
    let mut visitor = visitor.borrow_mut();
    while !visitor.times.is_empty() {
        visitor.show_next();
    }
    drop(visitor);
    Ok(outcome)
}
