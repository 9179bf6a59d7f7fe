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

use crate::ambient;
use crate::message::Source;
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
    ambient: bool,
}

impl Instant<'_> {
    /// The ambient term: what light that was not shot gives a surface that reflects all, W/m².
    pub fn ambient(&self) -> Rgb {
        ambient::term(self.problem, self.energy.unshot + self.energy.in_transit)
    }

    /// Radiosity in W/m², by environment and patch, with the ambient term if the rules say so.
    pub fn radiosity(&self) -> impl Iterator<Item = impl Iterator<Item = Rgb>> {
        let Instant { energy, problem, light, .. } = self;
        let environments = problem.environments.iter().zip(*light);
        let mut radiosity: Vec<Vec<Rgb>> = environments
            .map(|(geometry, light)| {
                let patches = 0..geometry.patches.len() as u32;
                patches.map(|patch| light.radiosity(geometry, patch)).collect()
            })
            .collect();
        if self.ambient {
            ambient::add(problem, energy.unshot + energy.in_transit, &mut radiosity);
        }
        radiosity.into_iter().map(Vec::into_iter)
    }
}

/// The light of a run as it goes.
pub(crate) struct Follower {
    problem: Arc<Problem>,
    /// By environment.
    pub light: Vec<Light>,
    energy: EnergyLedger,
    ambient: bool,
}

impl Follower {
    pub fn new(run: &Run) -> Follower {
        let problem = Arc::clone(&run.problem);
        let light = problem.environments.iter();
        let light = light.map(|geometry| Light::new(&problem.space, geometry)).collect();
        let energy = EnergyLedger::at_first(problem.emitted_power());
        Follower { problem, light, energy, ambient: run.rules.shooting.ambient }
    }

    pub fn selected(&mut self, source: &Source) {
        self.energy.selected(source);
    }

    pub fn shot(&mut self, source: &Source, shot: &Shot, reflected: Rgb) {
        self.energy.shot(source, shot, reflected);
        self.light[source.environment as usize].receive(&source.emitter, shot);
    }

    pub fn instant(&self, time: Time) -> Instant<'_> {
        let Follower { problem, light, energy, ambient } = self;
        Instant { time, energy: *energy, problem, light, ambient: *ambient }
    }
}

/// Shows the light of a run at the instants asked for.
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

    /// Something happens now: shows the instants before.
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
        self.follower.selected(source);
    }

    fn shot(&mut self, now: Time, _: Rank, source: &Source, shot: &Shot, reflected: Rgb) {
        self.pass(now);
        self.follower.shot(source, shot, reflected);
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
