//! The difference between a solution and a reference on different meshes.

use radiosity::Rgb;
use radiosity::glam::DVec3;

use crate::form_factors::clipping::{Ring, above, fan};
use crate::form_factors::pair::Surface;
use crate::solutions::patches::Patches;

/// The overlaps of the patches of one mesh with those of another.
///
/// Both meshes are of the same polygons, and radiosity is constant on each patch. Solutions are compared by
/// their means over the patches of the reference, so its mesh sets the resolution of the comparison.
pub struct Overlaps {
    /// For each patch of the reference, patches of the other mesh and the areas that they share, m².
    shared: Vec<Vec<(usize, f64)>>,
}

/// The difference between two solutions on one mesh, relative to the reflected radiosity of the reference:
/// radiosity less emission, as an area-weighted root mean square over all patches and colours.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// The area-weighted root mean square of the difference, relative to it.
    pub relative_l2: f64,
    /// The greatest difference of any patch and colour, relative to it.
    pub maximum: f64,
}

impl Overlaps {
    /// The overlaps of the patches of a reference with those of another mesh of the same scene.
    pub fn new(reference: &Patches, other: &Patches) -> Overlaps {
        let polygons = other.surfaces.iter().map(|s| s.polygon as usize + 1).max().unwrap_or(0);
        let mut of_polygon = vec![Vec::new(); polygons];
        for (patch, surface) in other.surfaces.iter().enumerate() {
            of_polygon[surface.polygon as usize].push(patch);
        }
        let none = Vec::new();
        let shared = reference.surfaces.iter().map(|surface| {
            let others = of_polygon.get(surface.polygon as usize).unwrap_or(&none);
            let area = |&patch: &usize| (patch, shared_area(surface, &other.surfaces[patch]));
            others.iter().map(area).filter(|&(_, area)| area > 0.0).collect()
        });
        Overlaps { shared: shared.collect() }
    }

    /// Means of a solution on the other mesh over the patches of the reference; zero where nothing
    /// overlaps.
    pub fn means(&self, radiosity: &[Rgb]) -> Vec<Rgb> {
        let mean = |shared: &Vec<(usize, f64)>| {
            let area: f64 = shared.iter().map(|(_, area)| area).sum();
            let sum: Rgb = shared.iter().map(|&(patch, area)| radiosity[patch] * area).sum();
            if area > 0.0 { sum / area } else { Rgb::ZERO }
        };
        self.shared.iter().map(mean).collect()
    }
}

impl Difference {
    /// The difference between two solutions on the patches of a reference; `None` if the reference reflects
    /// nothing.
    pub fn between(
        patches: &Patches,
        reference: &[Rgb],
        one: &[Rgb],
        other: &[Rgb],
    ) -> Option<Difference> {
        let light = patches.reflected_square(reference);
        let differences = || one.iter().zip(other).map(|(&one, &other)| one - other);
        let area: f64 = 3.0 * patches.areas.iter().sum::<f64>();
        let there = differences().zip(&patches.areas).filter(|&(_, &area)| area > 0.0);
        let greatest = there.map(|(d, _)| d.abs().max_element()).fold(0.0, f64::max);
        (light > 0.0).then(|| Difference {
            relative_l2: (patches.square(differences()) / light).sqrt(),
            maximum: greatest / (light / area).sqrt(),
        })
    }
}

/// The area in which two patches of one polygon overlap, m².
fn shared_area(one: &Surface, other: &Surface) -> f64 {
    let Some(&last) = other.corners.last() else { return 0.0 };
    let mut ring: Ring = one.corners.clone();
    let mut before = last;
    for &here in &other.corners {
        let inwards = other.plane.normal.cross(here - before);
        ring = above(&ring, |p: DVec3| inwards.dot(p - before));
        before = here;
    }
    fan(&ring).map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum()
}
