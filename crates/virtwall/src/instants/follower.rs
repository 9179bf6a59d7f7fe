//! Keeps the light of a simulated run up to date while the run is under way.

use std::sync::Arc;

use desim::Time;
use radiosity::{Light, Rgb, Shot};

use crate::observe::EnergyLedger;
use crate::problem::{Problem, Source};
use crate::run::Run;

/// A run at an instant.
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
    /// The ambient term: what unshot light would give a white surface, W/m².
    pub fn ambient(&self) -> Rgb {
        self.problem.ambient_term(self.energy.unshot + self.energy.in_transit)
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
            problem.add_ambient_term(energy.unshot + energy.in_transit, &mut radiosity);
        }
        radiosity.into_iter().map(Vec::into_iter)
    }
}

/// The light of a run, updated with each event.
pub(super) struct Follower {
    problem: Arc<Problem>,
    /// By environment.
    pub light: Vec<Light>,
    pub energy: EnergyLedger,
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

    pub fn shot(&mut self, source: &Source, shot: &Shot, reflected: Rgb) {
        self.energy.shot(source, shot, reflected);
        self.light[source.environment as usize].receive(&source.emitter, shot);
    }

    pub fn instant(&self, time: Time) -> Instant<'_> {
        let Follower { problem, light, energy, ambient } = self;
        Instant { time, energy: *energy, problem, light, ambient: *ambient }
    }
}
