//! The ambient term: what light that was not shot would have added, had it gone everywhere alike.

use radiosity::Rgb;

use crate::problem::Problem;

/// Adds to radiosities, by environment and patch, their share of `unshot` power (W): it falls on all
/// surfaces alike, and what they reflect of it does so again and again.
///
/// Source: Cohen, Chen, Wallace and Greenberg, "A progressive refinement approach to fast radiosity
/// image generation", 1988.
pub(crate) fn add(problem: &Problem, unshot: Rgb, radiosity: &mut [Vec<Rgb>]) {
    let patches = || problem.environments.iter().flat_map(|environment| &environment.patches);
    let scene = &problem.space.scene;
    let reflectance = |polygon: u32| scene.material(&scene.polygons[polygon as usize]).reflectance;
    let area: f64 = patches().map(|patch| patch.area).sum();
    let reflecting: Rgb = patches().map(|p| reflectance(p.polygon) * p.area).sum();
    let left = Rgb::ONE - reflecting / area;
    if !(area > 0.0 && left.min_element() > 0.0) {
        return;
    }
    let ambient = unshot / area / left;
    for (environment, told) in problem.environments.iter().zip(radiosity) {
        for (patch, radiosity) in environment.patches.iter().zip(told) {
            *radiosity += reflectance(patch.polygon) * ambient;
        }
    }
}
