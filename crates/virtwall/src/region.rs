//! The environments of one processor, their light, and the choice among their patches.

use std::sync::Arc;

use radiosity::{Light, Mask, Operation, Rgb, Shot, Work};

use crate::message::{Parcel, PatchUpdate};
use crate::problem::Problem;
use crate::rules::Selection;

/// What one processor owns of the scene.
pub struct Region {
    problem: Arc<Problem>,
    selection: Selection,
    /// Local patches below this value are not selected.
    threshold: f64,
    holdings: Vec<Holding>,
}

/// One environment and its light.
struct Holding {
    environment: u32,
    light: Light,
    best: Best,
}

/// The patch of an environment with the greatest value.
#[derive(Clone, Copy)]
enum Best {
    /// The light has changed since it was last looked for.
    Unknown,
    /// Its value and number; `None` when no patch has unshot light.
    Known(Option<(f64, u32)>),
}

impl Region {
    /// The light of `environments`, by rising number, before the first shot.
    pub(crate) fn new(
        problem: &Arc<Problem>,
        environments: impl Iterator<Item = u32>,
        selection: Selection,
        threshold: f64,
    ) -> Region {
        let hold = |environment: u32| {
            let light = Light::new(&problem.space, &problem.environments[environment as usize]);
            Holding { environment, light, best: Best::Unknown }
        };
        let holdings = environments.map(hold).collect();
        Region { problem: Arc::clone(problem), selection, threshold, holdings }
    }

    /// The local patch with the greatest value at or above the threshold: its value, holding and
    /// number; of equals the lowest number. Also the work of looking for it.
    ///
    /// Choice C16: the best patch of each environment is remembered, and looked for again among all
    /// patches of the environment only when its light has changed. Like §5.3, which fixes the number
    /// of environments "in order to avoid super-linear speedup", this makes the cost of selection
    /// depend on the environments and not on the processors that share them out.
    pub(crate) fn best_patch(&mut self) -> (Option<(f64, usize, u32)>, Work) {
        let mut work = Work::NONE;
        let mut best: Option<(f64, usize, u32)> = None;
        work.count(Operation::PatchScan, self.holdings.len() as u64);
        for (holding, held) in self.holdings.iter_mut().enumerate() {
            let of_environment = match held.best {
                Best::Known(found) => found,
                Best::Unknown => {
                    work.count(Operation::PatchScan, held.light.unshot.len() as u64);
                    let found = best_patch(&self.problem, self.selection, held);
                    held.best = Best::Known(found);
                    found
                }
            };
            let Some((value, patch)) = of_environment else { continue };
            if value >= self.threshold && best.is_none_or(|(other, ..)| value > other) {
                best = Some((value, holding, patch));
            }
        }
        (best, work)
    }

    /// Take a patch's unshot power as a source with an all-true mask (Figure 2).
    pub(crate) fn take(&mut self, holding: usize, patch: u32) -> Parcel {
        let problem = &self.problem;
        let held = &mut self.holdings[holding];
        let environment = &problem.environments[held.environment as usize];
        let source = held.light.take_source(&problem.space, environment, held.environment, patch);
        held.best = Best::Unknown;
        let mask = Mask::all(problem.hemisphere.pixels());
        Parcel { environment: held.environment, source, mask, form_factor: 1.0 }
    }

    /// Update the radiosities of the environment in which a source was shot.
    pub(crate) fn receive(&mut self, parcel: &Parcel, shot: &Shot) {
        let place = self.holdings.binary_search_by_key(&parcel.environment, |h| h.environment);
        let Ok(place) = place else { return };
        let held = &mut self.holdings[place];
        held.light.receive(&parcel.source, shot);
        held.best = Best::Unknown;
    }

    /// By how much the radiosity of each patch that a shot hit has grown.
    pub(crate) fn updates(&self, parcel: &Parcel, shot: &Shot) -> Vec<PatchUpdate> {
        let environment = parcel.environment;
        let geometry = &self.problem.environments[environment as usize];
        let scene = &self.problem.space.scene;
        let update = |&(patch, form_factor): &(u32, f64)| {
            let polygon = geometry.patches[patch as usize].polygon;
            let reflectance = scene.material(&scene.polygons[polygon as usize]).reflectance;
            let power = parcel.source.power * form_factor * reflectance;
            let radiosity = (power / geometry.radiosity_area(patch)).to_array();
            PatchUpdate { environment, patch, radiosity: radiosity.map(|x| x as f32) }
        };
        shot.hits.iter().map(update).collect()
    }

    /// Unshot power of all patches, W.
    pub(crate) fn unshot_power(&self) -> Rgb {
        self.holdings.iter().map(|h| h.light.unshot_power()).sum()
    }

    /// The light of each environment, with its number.
    pub fn lights(&self) -> impl Iterator<Item = (u32, &Light)> {
        self.holdings.iter().map(|h| (h.environment, &h.light))
    }
}

/// The patch of one environment with the greatest value, if any is positive.
fn best_patch(problem: &Problem, selection: Selection, held: &Holding) -> Option<(f64, u32)> {
    let geometry = &problem.environments[held.environment as usize];
    let values = held.light.unshot.iter().zip(0u32..).map(|(&power, patch)| {
        (selection.value_of(power, power / geometry.radiosity_area(patch)), patch)
    });
    values
        .filter(|&(value, _)| value > 0.0)
        .reduce(|best, other| if other.0 > best.0 { other } else { best })
}
