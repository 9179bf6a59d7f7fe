//! The local environments of one compute node, their light, and the choice among their patches.

use std::collections::BTreeSet;
use std::sync::Arc;

use radiosity::{Emitter, Greatest, Light, LocalEnvironment, Operation, Rgb, Shot, Work};

use super::node_result::EnvironmentResult;
use super::rules::{Rules, Selection};
use crate::problem::{Problem, Shooting, Source};
use crate::wire::PatchUpdate;

/// The part of the scene that one compute node owns.
pub(super) struct Region {
    problem: Arc<Problem>,
    selection: Selection,
    shooting: Shooting,
    /// Shots of local patches so far.
    shots: u32,
    /// Local patches below this value are not selected.
    threshold: f64,
    /// The environments, by rising number.
    environments: Vec<Environment>,
    /// The value of the best patch of each environment.
    bests: Greatest,
    /// Environments whose light has changed since the last search for the best patch.
    changed: BTreeSet<u32>,
}

/// One local environment and its light.
struct Environment {
    number: u32,
    light: Light,
    /// The values of its patches.
    values: Greatest,
    /// The best patch as last noted.
    best: Option<u32>,
    /// The sum of absolute unshot power, W; none since the light last changed.
    unshot: Option<Rgb>,
}

/// The best local patch.
#[derive(Clone, Copy)]
pub(super) struct BestPatch {
    pub value: f64,
    /// Place of its environment among those of the region.
    place: usize,
    patch: u32,
}

/// The place of an environment among these, of which it must be one.
fn place(environments: &[Environment], number: u32) -> usize {
    let found = environments.binary_search_by_key(&number, |one| one.number);
    found.expect("sources are sent to the owner of their environment")
}

impl Environment {
    /// A patch with its unshot power.
    fn emitter(&self, problem: &Problem, patch: u32) -> Emitter {
        let geometry = &problem.environments[self.number as usize];
        self.light.emitter(&problem.space, geometry, self.number, patch)
    }

    fn best_value(&self) -> f64 {
        self.values.best().map_or(0.0, |(value, _)| value)
    }
}

/// The value by which a patch is selected.
fn value(selection: Selection, geometry: &LocalEnvironment, light: &Light, patch: u32) -> f64 {
    let power = light.unshot[patch as usize];
    selection.value_of(power, power / geometry.radiosity_area(patch))
}

impl Region {
    /// The light of `environments`, by rising number, before the first shot.
    pub fn new(
        problem: &Arc<Problem>,
        environments: impl Iterator<Item = u32>,
        rules: &Rules,
        threshold: f64,
    ) -> Region {
        let Rules { selection, shooting, .. } = *rules;
        let environment = |number: u32| {
            let geometry = &problem.environments[number as usize];
            let light = Light::new(&problem.space, geometry);
            let patches = 0..light.unshot.len();
            let values = patches.map(|patch| value(selection, geometry, &light, patch as u32));
            let values = Greatest::new(values);
            Environment { number, light, values, best: None, unshot: None }
        };
        let environments: Vec<Environment> = environments.map(environment).collect();
        Region {
            problem: Arc::clone(problem),
            selection,
            shooting,
            shots: 0,
            threshold,
            bests: Greatest::new(environments.iter().map(Environment::best_value)),
            changed: environments.iter().map(|environment| environment.number).collect(),
            environments,
        }
    }

    /// The numbers of its environments.
    pub fn numbers(&self) -> impl Iterator<Item = u32> {
        self.environments.iter().map(|environment| environment.number)
    }

    /// The local patch with the greatest value at or above the threshold, of all environments or of one. Of
    /// equal patches, that with the lowest number.
    pub fn best_patch(&self, only: Option<u32>) -> Option<BestPatch> {
        let place = match only {
            Some(only) => place(&self.environments, only),
            None => self.bests.best()?.1 as usize,
        };
        let (value, patch) = self.environments[place].values.best()?;
        (value >= self.threshold).then_some(BestPatch { value, place, patch })
    }

    /// The environments that a search for the best patch has to look at: those whose light has changed.
    pub fn changed(&self) -> &BTreeSet<u32> {
        &self.changed
    }

    /// The operations of that search. The host looks the patch up; the virtual processor is charged for a
    /// linear search.
    ///
    /// Choice C16: the best patch of each environment is remembered, and searched again among all patches
    /// of the environment only when its light has changed. Like §5.3, which fixes the number of
    /// environments "in order to avoid super-linear speedup", this makes the cost of selection depend on
    /// the environments and not on the number of processors.
    pub fn search(&self) -> Work {
        let mut work = Work::NONE;
        work.count(Operation::PatchScan, self.environments.len() as u64);
        for &number in &self.changed {
            let patches = self.environments[place(&self.environments, number)].light.unshot.len();
            work.count(Operation::PatchScan, patches as u64);
        }
        work
    }

    /// Mark the search as done; returns the environments that it looked at.
    pub fn searched(&mut self) -> BTreeSet<u32> {
        std::mem::take(&mut self.changed)
    }

    /// The best patch of each of these environments in which it has changed.
    pub fn new_bests(&mut self, environments: &BTreeSet<u32>) -> Vec<Emitter> {
        let Region { problem, threshold, environments: own, changed, .. } = self;
        let new_best = |&number: &u32| {
            let place = place(own, number);
            let environment = &mut own[place];
            let best = environment.values.best().filter(|(value, _)| value >= threshold);
            let best = best.map(|(_, patch)| patch);
            let known = std::mem::replace(&mut environment.best, best);
            best.filter(|_| known != best).map(|patch| environment.emitter(problem, patch))
        };
        environments.union(changed).filter_map(new_best).collect()
    }

    /// Take the unshot power of a patch as a source, or as several (Figure 2).
    pub fn take(&mut self, best: BestPatch) -> Vec<Source> {
        let BestPatch { place, patch, .. } = best;
        let emitter = self.environments[place].emitter(&self.problem, patch);
        let geometry = &self.problem.environments[emitter.environment as usize];
        let share = self.shooting.share(geometry.emitted_power(&self.problem.space, patch));
        // The unshot power of a patch becomes negative by over-shooting.
        self.environments[place].light.unshot[patch as usize] *= 1.0 - share;
        self.revalue(place, [patch].into_iter());
        self.shots = self.shots.wrapping_add(1);
        self.problem.sources_of(self.shots, emitter, &self.shooting)
    }

    /// The unshot power of these patches has changed.
    fn revalue(&mut self, place: usize, patches: impl Iterator<Item = u32>) {
        let environment = &mut self.environments[place];
        let geometry = &self.problem.environments[environment.number as usize];
        for patch in patches {
            let value = value(self.selection, geometry, &environment.light, patch);
            environment.values.set(patch, value);
        }
        environment.unshot = None;
        self.bests.set(place as u32, environment.best_value());
        self.changed.insert(environment.number);
    }

    /// Update the radiosities of the environment in which a source was shot (§4.2.3). Returns the power that
    /// its patches reflect of it, W.
    pub fn receive(&mut self, source: &Source, shot: &Shot) -> Rgb {
        let place = place(&self.environments, source.environment);
        let reflected = self.environments[place].light.receive(&source.emitter, shot);
        self.revalue(place, shot.hits.iter().map(|&(patch, _)| patch));
        reflected
    }

    /// The increase of radiosity of each patch that a shot hit.
    pub fn updates(&self, source: &Source, shot: &Shot) -> Vec<PatchUpdate> {
        let (environment, arriving) = (source.environment, source.emitter.power);
        let geometry = &self.problem.environments[environment as usize];
        let scene = &self.problem.space.scene;
        let update = |&(patch, form_factor): &(u32, f64)| {
            let polygon = geometry.patches[patch as usize].polygon;
            let reflectance = scene.material_of(polygon).reflectance;
            let power = arriving * form_factor * reflectance;
            let radiosity = (power / geometry.radiosity_area(patch)).to_array();
            PatchUpdate { environment, patch, radiosity: radiosity.map(|x| x as f32) }
        };
        shot.hits.iter().map(update).collect()
    }

    /// The absolute unshot power of all patches, W; summed again only where it has changed.
    pub fn unshot_magnitude(&mut self) -> Rgb {
        let sum = |one: &mut Environment| {
            let sum = || one.light.unshot.iter().fold(Rgb::ZERO, |sum, power| sum + power.abs());
            *one.unshot.get_or_insert_with(sum)
        };
        self.environments.iter_mut().map(sum).sum()
    }

    /// The light of each environment.
    pub fn results(&self) -> Vec<EnvironmentResult> {
        let result = |&Environment { number, ref light, .. }: &Environment| {
            let geometry = &self.problem.environments[number as usize];
            let patches = 0..geometry.patches.len() as u32;
            EnvironmentResult {
                environment: number,
                absorbed: light.absorbed,
                escaped: light.escaped,
                medium: light.medium,
                unshot: light.unshot_power(),
                radiosity: patches.map(|patch| light.radiosity(geometry, patch)).collect(),
            }
        };
        self.environments.iter().map(result).collect()
    }
}
