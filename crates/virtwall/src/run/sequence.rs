//! How many shots of patches a program on one processor needs at most.

use crate::problem::{Problem, Shooting};
use crate::program::{Order, Rules, Selection};

/// The greatest reflectance that is counted on: light that all surfaces reflected would not end, so that some
/// leaves or is absorbed. Assumed.
const MOST_REFLECTANCE: f64 = 0.9999;

/// Sides of a local environment, each a wall to another one at most.
const SIDES: f64 = 6.0;

/// Shots after which 1/e of the light is left at most, where one processor shoots the brightest patch each time.
///
/// The brightest of `n` patches has 1/n of the light that is left, or more, and surfaces absorb at least
/// 1 - reflectance of what it shoots. So each shot leaves the part 1 - (1 - reflectance) / n at most, and
/// n / (1 - reflectance) shots leave 1/e. Where virtual walls hold light, their bins count as patches.
pub(crate) fn shots_to_fall(problem: &Problem, shooting: &Shooting) -> f64 {
    let scene = &problem.space.scene;
    let materials = (0..scene.polygons.len() as u32).map(|polygon| scene.material_of(polygon));
    let greatest = materials.map(|material| material.reflectance.max_element());
    let absorbed = 1.0 - greatest.fold(0.0, f64::max).min(MOST_REFLECTANCE);
    let parts = f64::from(shooting.split.most).powi(2);
    let bins = problem.walls.as_ref().map_or(0.0, |walls| {
        let of_a_wall = f64::from(walls.patches()) * f64::from(walls.bins());
        of_a_wall * SIDES * problem.environments.len() as f64
    });
    (problem.patches() as f64 * parts + bins) / absorbed
}

/// The most shots of patches that one processor needs until no patch reaches the threshold; infinite without a
/// threshold. None where it does not always shoot the patch with the most energy, and no more than that.
pub fn most_shots_in_sequence(problem: &Problem, rules: &Rules) -> Option<f64> {
    let Rules { selection, order, shooting, patch_threshold, .. } = rules;
    let plain = *selection == Selection::Energy && *order == Order::Best && problem.walls.is_none();
    if !plain || shooting.overshoot > 1.0 {
        return None;
    }
    let least = patch_threshold * problem.brightest(|power, _| selection.value_of(power, power));
    let falls = (problem.emitted_power().element_sum() / least).ln();
    // The last shot is that of a patch just above the threshold.
    Some(1.0 + shots_to_fall(problem, shooting) * falls.max(0.0))
}
