//! The light at given instants of a run: the run is made once more, and stopped to look at.
//!
//! Runs are the same to the bit each time, and shots are kept, so that this costs little more than
//! the events of the run; nothing needs to be stored for an instant that nobody asks for.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use desim::Time;
use multicomputer::{Machine, Network, Rank};
use radiosity::{Light, Rgb, Shot};

use crate::message::Parcel;
use crate::observer::{Observer, SharedObserver};
use crate::outcome::{EnergyLedger, Outcome};
use crate::problem::Problem;
use crate::run::{Run, RunError};
use crate::simulation::simulate_observed;

/// A run at an instant, after all that happened until then.
pub struct Instant<'a> {
    /// Virtual time.
    pub time: Time,
    /// Where the emitted energy is.
    pub energy: EnergyLedger,
    problem: &'a Problem,
    light: &'a [Light],
}

impl Instant<'_> {
    /// Radiosity in W/m², by environment and patch.
    pub fn radiosity(&self) -> impl Iterator<Item = impl Iterator<Item = Rgb>> {
        self.problem.environments.iter().zip(self.light).map(|(geometry, light)| {
            (0..geometry.patches.len() as u32).map(|patch| light.radiosity(geometry, patch))
        })
    }
}

/// Follows the light of a run and shows it at the instants asked for.
struct Follower<V> {
    problem: Arc<Problem>,
    /// By environment.
    light: Vec<Light>,
    energy: EnergyLedger,
    /// Instants to come, the next one last.
    times: Vec<Time>,
    visit: V,
}

impl<V: FnMut(Instant<'_>)> Follower<V> {
    fn new(problem: &Arc<Problem>, times: &[Time], visit: V) -> Follower<V> {
        let light = problem.environments.iter();
        let light = light.map(|geometry| Light::new(&problem.space, geometry)).collect();
        let mut times = times.to_vec();
        times.sort_unstable_by(|one, other| other.cmp(one));
        let energy = EnergyLedger::at_first(problem.emitted_power());
        Follower { problem: Arc::clone(problem), light, energy, times, visit }
    }

    /// Something happens now: shows the instants before.
    fn pass(&mut self, now: Time) {
        while self.times.last().is_some_and(|&time| time < now) {
            self.show_next();
        }
    }

    fn show_next(&mut self) {
        let Some(time) = self.times.pop() else { return };
        let Follower { problem, light, energy, .. } = self;
        (self.visit)(Instant { time, energy: *energy, problem, light });
    }
}

impl<V: FnMut(Instant<'_>)> Observer for Follower<V> {
    fn selected(&mut self, now: Time, _: Rank, source: &Parcel) {
        self.pass(now);
        self.energy.selected(source);
    }

    fn shot(&mut self, now: Time, _: Rank, source: &Parcel, shot: &Shot, reflected: Rgb) {
        self.pass(now);
        self.energy.shot(source, shot, reflected);
        self.light[source.environment as usize].receive(&source.source, shot);
    }
}

/// Simulates a run and shows it at each of `times`, in rising order. One after the end shows the end.
pub fn visit_instants(
    run: &Run,
    machine: &Machine,
    network: Box<dyn Network>,
    times: &[Time],
    visit: impl FnMut(Instant<'_>) + 'static,
) -> Result<Outcome, RunError> {
    let follower = Rc::new(RefCell::new(Follower::new(&run.problem, times, visit)));
    let observer: SharedObserver = follower.clone();
    let outcome = simulate_observed(run, machine, network, Some(observer))?;
    let mut follower = follower.borrow_mut();
    while !follower.times.is_empty() {
        follower.show_next();
    }
    drop(follower);
    Ok(outcome)
}

/// Radiosity in W/m² at each of `times`, in rising order, by environment and patch.
pub fn radiosity_at(
    run: &Run,
    machine: &Machine,
    network: Box<dyn Network>,
    times: &[Time],
) -> Result<Vec<Vec<Vec<Rgb>>>, RunError> {
    let all = Rc::new(RefCell::new(Vec::new()));
    let visit = {
        let all = Rc::clone(&all);
        move |instant: Instant<'_>| {
            let radiosity = instant.radiosity().map(Iterator::collect).collect();
            all.borrow_mut().push(radiosity);
        }
    };
    visit_instants(run, machine, network, times, visit)?;
    Ok(all.take())
}
