//! The environments of one processor, their light, and the choice among their patches.

use std::collections::BTreeSet;
use std::mem;
use std::sync::Arc;

use radiosity::{Emitter, Greatest, Light, LocalEnvironment, Operation, Part, Rgb, Shot, Work};

use crate::gathered::Gathered;
use crate::message::{PatchUpdate, Source};
use crate::problem::Problem;
use crate::rules::{Rules, Selection};
use crate::shooting::Shooting;
use crate::wall_patch::WallPatch;

/// What one processor owns of the scene.
pub struct Region {
    problem: Arc<Problem>,
    selection: Selection,
    shooting: Shooting,
    /// Local patches below this value are not selected.
    threshold: f64,
    holdings: Vec<Holding>,
    /// The value of the best patch of each holding.
    bests: Greatest,
    /// Holdings whose light has changed since the best patch was last looked for.
    changed: BTreeSet<usize>,
    /// Holdings whose light has changed since new best sources were last asked for.
    untold: BTreeSet<usize>,
}

/// One environment and its light.
struct Holding {
    environment: u32,
    light: Light,
    /// What virtual walls have gathered of it on its way out.
    gathered: Gathered,
    /// The values of its patches.
    values: Greatest,
    /// The best patch when last asked for new ones.
    best: Option<u32>,
    /// The sum of unshot power, W; none since the light last changed.
    unshot: Option<Rgb>,
}

impl Holding {
    fn best_value(&self) -> f64 {
        self.values.best().map_or(0.0, |(value, _)| value)
    }
}

impl Region {
    /// The light of `environments`, by rising number, before the first shot.
    pub(crate) fn new(
        problem: &Arc<Problem>,
        environments: impl Iterator<Item = u32>,
        rules: &Rules,
        threshold: f64,
    ) -> Region {
        let Rules { selection, shooting, .. } = *rules;
        let hold = |environment: u32| {
            let geometry = &problem.environments[environment as usize];
            let light = Light::new(&problem.space, geometry);
            let value = |patch: usize| value(selection, geometry, &light, patch as u32);
            let values = Greatest::new((0..light.unshot.len()).map(value));
            let gathered = Gathered::default();
            Holding { environment, light, gathered, values, best: None, unshot: None }
        };
        let holdings: Vec<Holding> = environments.map(hold).collect();
        Region {
            problem: Arc::clone(problem),
            selection,
            shooting,
            threshold,
            bests: Greatest::new(holdings.iter().map(Holding::best_value)),
            changed: (0..holdings.len()).collect(),
            untold: (0..holdings.len()).collect(),
            holdings,
        }
    }

    fn note_change(&mut self, holding: usize) {
        let held = &mut self.holdings[holding];
        held.unshot = None;
        self.bests.set(holding as u32, held.best_value());
        self.changed.insert(holding);
        self.untold.insert(holding);
    }

    /// The local patch, or that of one environment, with the greatest value at or above the threshold: its
    /// value, holding and number; of equals the lowest number.
    pub(crate) fn best_patch(&self, only: Option<u32>) -> Option<(f64, usize, u32)> {
        let holding = match only {
            Some(only) => self.place(only)?,
            None => self.bests.best()?.1 as usize,
        };
        let (value, patch) = self.holdings[holding].values.best()?;
        (value >= self.threshold).then_some((value, holding, patch))
    }

    /// The place of an environment among those held.
    fn place(&self, environment: u32) -> Option<usize> {
        self.holdings.binary_search_by_key(&environment, |h| h.environment).ok()
    }

    /// The best patch of each environment, if it is at or above the threshold and another than the
    /// last time.
    pub(crate) fn new_best_sources(&mut self, mut tell: impl FnMut(Source)) {
        for i in mem::take(&mut self.untold) {
            let held = &mut self.holdings[i];
            let best = held.values.best().filter(|&(value, _)| value >= self.threshold);
            let best = best.map(|(_, patch)| patch);
            if let (true, Some(patch)) = (mem::replace(&mut held.best, best) != best, best) {
                self.parcels(i, patch).into_iter().for_each(&mut tell);
            }
        }
    }

    /// The environments that it is looked for in: those whose light has changed.
    pub(crate) fn changed(&self) -> impl Iterator<Item = u32> {
        self.changed.iter().map(|&holding| self.holdings[holding].environment)
    }

    /// The work of looking for it. The host looks it up; the virtual processor is charged for a linear
    /// search.
    ///
    /// Choice C16: the best patch of each environment is remembered, and looked for again among all
    /// patches of the environment only when its light has changed. Like §5.3, which fixes the number
    /// of environments "in order to avoid super-linear speedup", this makes the cost of selection
    /// depend on the environments and not on the processors that share them out.
    pub(crate) fn scan(&mut self) -> Work {
        let mut work = Work::NONE;
        work.count(Operation::PatchScan, self.holdings.len() as u64);
        for holding in mem::take(&mut self.changed) {
            work.count(Operation::PatchScan, self.holdings[holding].light.unshot.len() as u64);
        }
        work
    }

    /// Take a patch's unshot power as a source with an all-true mask (Figure 2), or as several.
    pub(crate) fn take(&mut self, holding: usize, patch: u32) -> Vec<Source> {
        let parcels = self.parcels(holding, patch);
        let share = self.share(holding, patch);
        let held = &mut self.holdings[holding];
        let unshot = &mut held.light.unshot[patch as usize];
        // Over-shot, it has less than nothing left.
        *unshot *= 1.0 - share;
        let geometry = &self.problem.environments[held.environment as usize];
        let value = value(self.selection, geometry, &held.light, patch);
        held.values.set(patch, value);
        self.note_change(holding);
        parcels
    }

    /// The part of its unshot power that a patch shoots.
    fn share(&self, holding: usize, patch: u32) -> f64 {
        let geometry = &self.problem.environments[self.holdings[holding].environment as usize];
        self.shooting.share(geometry.emitted_power(&self.problem.space, patch))
    }

    /// The source that a patch would be now, or several where it is to be cut.
    fn parcels(&self, holding: usize, patch: u32) -> Vec<Source> {
        let Problem { space, environments, .. } = &*self.problem;
        let Holding { environment, light, .. } = &self.holdings[holding];
        let geometry = &environments[*environment as usize];
        let mut source = light.emitter(space, geometry, *environment, patch);
        source.power *= self.share(holding, patch);
        let parcel = |part: Part| Source {
            environment: *environment,
            emitter: Emitter { centre: part.centre, power: source.power * part.share, ..source },
            mask: self.problem.clear_mask(source.power),
            form_factor: 1.0,
        };
        let parts = self.shooting.split.parts(space, geometry, patch);
        parts.into_iter().map(parcel).collect()
    }

    /// Update the radiosities of the environment in which a source was shot. Returns the power that
    /// its patches reflect of it, W.
    pub(crate) fn receive(&mut self, parcel: &Source, shot: &Shot) -> Rgb {
        let Some(place) = self.place(parcel.environment) else { return Rgb::ZERO };
        let held = &mut self.holdings[place];
        let reflected = held.light.receive(&parcel.emitter, shot);
        let geometry = &self.problem.environments[held.environment as usize];
        for &(patch, _) in &shot.hits {
            let value = value(self.selection, geometry, &held.light, patch);
            held.values.set(patch, value);
        }
        self.note_change(place);
        reflected
    }

    /// Virtual walls: gather what of a source leaves the environment in which it was shot.
    pub(crate) fn gather(&mut self, parcel: &Source, shot: &Shot) -> Work {
        let mut work = Work::NONE;
        let Some(place) = self.place(parcel.environment) else { return work };
        let held = &mut self.holdings[place];
        let pixels = held.gathered.gather(&self.problem, parcel, shot);
        held.unshot = None;
        work.count(Operation::Hit, pixels);
        work
    }

    /// Virtual walls: hand on what wall patches have gathered, where that is worth `least` or more.
    pub(crate) fn hand_on(&mut self, least: f64) -> (Vec<WallPatch>, Work) {
        let (mut handed, mut work) = (Vec::new(), Work::NONE);
        let selection = self.selection;
        let worth = |power, radiosity| selection.value_of(power, radiosity) >= least;
        for held in &mut self.holdings {
            work.count(Operation::PatchScan, held.gathered.len());
            handed.extend(held.gathered.hand_on(&self.problem, held.environment, worth));
            held.unshot = None;
        }
        work.count(Operation::WordCopied, handed.iter().map(WallPatch::words).sum());
        (handed, work)
    }

    /// By how much the radiosity of each patch that shots of one source hit has grown.
    pub(crate) fn updates(&self, parcels: &[Source], shots: &[Shot]) -> Vec<PatchUpdate> {
        let mut updates: Vec<PatchUpdate> = Vec::new();
        for (parcel, shot) in parcels.iter().zip(shots) {
            updates.extend(self.updates_by(parcel, shot));
        }
        // Bins of a wall patch hit the same patches again and again.
        updates.sort_by_key(|update| update.patch);
        updates.dedup_by(|next, update| {
            let same = next.patch == update.patch;
            (0..3).filter(|_| same).for_each(|i| update.radiosity[i] += next.radiosity[i]);
            same
        });
        updates
    }

    fn updates_by(&self, parcel: &Source, shot: &Shot) -> impl Iterator<Item = PatchUpdate> {
        let (environment, arriving) = (parcel.environment, parcel.emitter.power);
        let geometry = &self.problem.environments[environment as usize];
        let scene = &self.problem.space.scene;
        shot.hits.iter().map(move |&(patch, form_factor)| {
            let polygon = geometry.patches[patch as usize].polygon;
            let reflectance = scene.material(&scene.polygons[polygon as usize]).reflectance;
            let power = arriving * form_factor * reflectance;
            let radiosity = (power / geometry.radiosity_area(patch)).to_array();
            PatchUpdate { environment, patch, radiosity: radiosity.map(|x| x as f32) }
        })
    }

    /// Power on virtual walls that was not handed on, W.
    pub(crate) fn gathered_power(&self) -> Rgb {
        self.holdings.iter().map(|held| held.gathered.power()).sum()
    }

    /// Unshot power of all patches and virtual walls, W; summed anew only where it has changed.
    pub(crate) fn unshot_power(&mut self) -> Rgb {
        let sum = |held: &mut Holding| {
            let sum = || held.light.unshot_power() + held.gathered.power();
            *held.unshot.get_or_insert_with(sum)
        };
        self.holdings.iter_mut().map(sum).sum()
    }

    /// The light of each environment, with its number.
    pub fn lights(&self) -> impl Iterator<Item = (u32, &Light)> {
        self.holdings.iter().map(|h| (h.environment, &h.light))
    }
}

/// The value by which a patch is selected.
fn value(selection: Selection, geometry: &LocalEnvironment, light: &Light, patch: u32) -> f64 {
    let power = light.unshot[patch as usize];
    selection.value_of(power, power / geometry.radiosity_area(patch))
}
