//! The patches of a scene as one environment: shapes, reflectances, emissions.

use radiosity::{LocalEnvironment, Rgb, Space};
use sha2::{Digest, Sha256};

use crate::form_factors::pair::Surface;

/// The properties of patches that a solution depends on, in the order of the environment.
#[derive(Clone)]
pub struct Patches {
    /// Shapes; a patch without area has no corners.
    pub surfaces: Vec<Surface>,
    /// Areas, m².
    pub areas: Vec<f64>,
    /// Reflectances.
    pub reflectance: Vec<Rgb>,
    /// Emitted radiosity, W/m².
    pub emission: Vec<Rgb>,
}

impl Patches {
    /// The patches of an environment that covers the whole space.
    pub fn new(space: &Space, environment: &LocalEnvironment) -> Patches {
        Patches::of_all(space, std::slice::from_ref(environment))
    }

    /// The patches of environments that together cover the whole space, one environment after the other.
    pub fn of_all(space: &Space, environments: &[LocalEnvironment]) -> Patches {
        let polygon = |patch: &radiosity::Patch| &space.scene.polygons[patch.polygon as usize];
        let patches = || environments.iter().flat_map(|environment| &environment.patches);
        // Patches smaller than the tolerance have no area: what they see would depend on rounding.
        let least = space.scene.tolerance().powi(2);
        let area = |patch: &radiosity::Patch| if patch.area > least { patch.area } else { 0.0 };
        let surfaces = environments.iter().flat_map(|environment| {
            (0..).zip(&environment.patches).map(move |(number, patch)| Surface {
                corners: match area(patch) > 0.0 {
                    true => environment.outline(space, number),
                    false => Vec::new(),
                },
                plane: polygon(patch).plane,
                polygon: patch.polygon,
            })
        });
        Patches {
            surfaces: surfaces.collect(),
            areas: patches().map(area).collect(),
            reflectance: patches().map(|p| space.scene.material(polygon(p)).reflectance).collect(),
            emission: patches().map(|p| space.scene.material(polygon(p)).emission).collect(),
        }
    }

    /// The reflected part of radiosities: radiosity less emission, squared and integrated over area.
    pub(crate) fn reflected_square(&self, radiosity: &[Rgb]) -> f64 {
        let both = radiosity.iter().zip(&self.emission);
        self.square(both.map(|(&leaving, &emitted)| leaving - emitted))
    }

    /// Radiosities, one for each patch, squared and integrated over area, summed over colours.
    pub(crate) fn square(&self, colours: impl Iterator<Item = Rgb>) -> f64 {
        colours.zip(&self.areas).map(|(c, area)| c.length_squared() * area).sum()
    }

    /// The number of patches.
    pub fn count(&self) -> usize {
        self.areas.len()
    }

    /// SHA-256 of all properties, in hexadecimal. It identifies the problem of a stored solution,
    /// independently of the format of the scene files.
    pub fn digest(&self) -> String {
        let mut digest = Sha256::new();
        let mut put = |number: f64| digest.update(number.to_le_bytes());
        for (i, surface) in self.surfaces.iter().enumerate() {
            put(f64::from(surface.polygon));
            put(self.areas[i]);
            surface.corners.iter().for_each(|p| p.to_array().into_iter().for_each(&mut put));
            for colour in [self.reflectance[i], self.emission[i]] {
                colour.to_array().into_iter().for_each(&mut put);
            }
        }
        digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}
