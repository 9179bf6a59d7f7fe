//! The ambient term: what light that was not shot would have added, had it gone everywhere alike.

use radiosity::Rgb;

use crate::problem::Problem;

/// Radiosity in W/m² that `unshot` power (W) gives a surface that reflects all: it falls on all surfaces
/// alike, and what they reflect of it does so again and again.
///
/// Source: Cohen, Chen, Wallace and Greenberg, "A progressive refinement approach to fast radiosity
/// image generation", 1988.
pub(crate) fn term(problem: &Problem, unshot: Rgb) -> Rgb {
    let patches = || problem.environments.iter().flat_map(|environment| &environment.patches);
    let area: f64 = patches().map(|patch| patch.area).sum();
    let reflecting: Rgb = patches().map(|p| reflectance(problem, p.polygon) * p.area).sum();
    let left = Rgb::ONE - reflecting / area;
    match area > 0.0 && left.min_element() > 0.0 {
        true => unshot / area / left,
        false => Rgb::ZERO,
    }
}

/// Adds to radiosities, by environment and patch, their share of the term.
pub(crate) fn add(problem: &Problem, unshot: Rgb, radiosity: &mut [Vec<Rgb>]) {
    let ambient = term(problem, unshot);
    for (environment, told) in problem.environments.iter().zip(radiosity) {
        for (patch, radiosity) in environment.patches.iter().zip(told) {
            *radiosity += reflectance(problem, patch.polygon) * ambient;
        }
    }
}

fn reflectance(problem: &Problem, polygon: u32) -> Rgb {
    let scene = &problem.space.scene;
    scene.material(&scene.polygons[polygon as usize]).reflectance
}
