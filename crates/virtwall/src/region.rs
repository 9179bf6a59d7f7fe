//! The environments of one processor, their light, and the choice among their patches.

use std::sync::Arc;

use radiosity::{Light, Mask, Rgb, Shot};

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
    patches: u64,
}

/// One environment and its light.
struct Holding {
    environment: u32,
    light: Light,
    /// The best patch and its value: looked for again only after the light has changed.
    best: Option<(f64, u32)>,
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
            let best = best_patch(problem, selection, environment, &light);
            Holding { environment, light, best }
        };
        let holdings: Vec<Holding> = environments.map(hold).collect();
        let patches = holdings.iter().map(|h| h.light.unshot.len() as u64).sum();
        Region { problem: Arc::clone(problem), selection, threshold, holdings, patches }
    }

    /// The greatest value of any patch.
    pub(crate) fn greatest_value(&self) -> f64 {
        self.holdings.iter().filter_map(|h| h.best).map(|(value, _)| value).fold(0.0, f64::max)
    }

    /// Number of patches: what the paper's linear search looks at.
    pub(crate) fn patches(&self) -> u64 {
        self.patches
    }

    /// The local patch with the greatest value at or above the threshold: its value, holding and
    /// number; of equals the lowest number.
    pub(crate) fn best_patch(&self) -> Option<(f64, usize, u32)> {
        let candidates = self.holdings.iter().enumerate().filter_map(|(holding, h)| {
            let (value, patch) = h.best?;
            (value >= self.threshold).then_some((value, holding, patch))
        });
        candidates.reduce(|best, other| if other.0 > best.0 { other } else { best })
    }

    /// Take a patch's unshot power as a source with an all-true mask (Figure 2).
    pub(crate) fn take(&mut self, holding: usize, patch: u32) -> Parcel {
        let problem = &self.problem;
        let held = &mut self.holdings[holding];
        let environment = &problem.environments[held.environment as usize];
        let source = held.light.take_source(&problem.space, environment, held.environment, patch);
        held.best = best_patch(problem, self.selection, held.environment, &held.light);
        let mask = Mask::all(problem.hemisphere.pixels());
        Parcel { environment: held.environment, source, mask, form_factor: 1.0 }
    }

    /// Update the radiosities of the environment in which a source was shot.
    pub(crate) fn receive(&mut self, parcel: &Parcel, shot: &Shot) {
        let place = self.holdings.binary_search_by_key(&parcel.environment, |h| h.environment);
        let Ok(place) = place else { return };
        let held = &mut self.holdings[place];
        held.light.receive(&parcel.source, shot);
        held.best = best_patch(&self.problem, self.selection, held.environment, &held.light);
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
fn best_patch(
    problem: &Problem,
    selection: Selection,
    environment: u32,
    light: &Light,
) -> Option<(f64, u32)> {
    let geometry = &problem.environments[environment as usize];
    let values = light.unshot.iter().zip(0u32..).map(|(&power, patch)| {
        (selection.value_of(power, power / geometry.radiosity_area(patch)), patch)
    });
    values
        .filter(|&(value, _)| value > 0.0)
        .reduce(|best, other| if other.0 > best.0 { other } else { best })
}
