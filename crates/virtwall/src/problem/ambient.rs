//! The ambient term: what the unshot light would add if it were spread evenly over all surfaces.

use radiosity::{Patch, Rgb};

use super::problem::Problem;

impl Problem {
    /// Radiosity in W/m² that `unshot` power (W) would give a white surface: it falls evenly on all
    /// surfaces, and so does every reflection of it.
    ///
    /// Source: Cohen, Chen, Wallace and Greenberg, "A progressive refinement approach to fast radiosity
    /// image generation", 1988.
    pub(crate) fn ambient_term(&self, unshot: Rgb) -> Rgb {
        let reflectance = |patch: &Patch| self.space.scene.material_of(patch.polygon).reflectance;
        let patches = || self.environments.iter().flat_map(|environment| &environment.patches);
        let area: f64 = patches().map(|patch| patch.area).sum();
        let reflecting: Rgb = patches().map(|patch| reflectance(patch) * patch.area).sum();
        let left = Rgb::ONE - reflecting / area;
        match area > 0.0 && left.min_element() > 0.0 {
            true => unshot / area / left,
            false => Rgb::ZERO,
        }
    }

    /// Add the ambient term to radiosities by environment and patch, W/m².
    pub(crate) fn add_ambient_term(&self, unshot: Rgb, radiosity: &mut [Vec<Rgb>]) {
        let ambient = self.ambient_term(unshot);
        for (environment, radiosity) in self.environments.iter().zip(radiosity) {
            for (patch, radiosity) in environment.patches.iter().zip(radiosity) {
                let material = self.space.scene.material_of(patch.polygon);
                *radiosity += material.reflectance * ambient;
            }
        }
    }
}
