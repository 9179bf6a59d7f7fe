//! The radiosity system with form factors from points of patches, exact to rounding: the limit of shooting
//! from these points with infinitely many rays.

use radiosity::glam::DVec3;
use radiosity::{Rgb, Scene};

use crate::form_factors::pair::Pair;
use crate::solutions::patches::Patches;

/// Form factors from points of patches.
pub struct Centres {
    patches: Patches,
    /// By source, then by receiver.
    form_factors: Vec<Vec<f64>>,
}

/// Iteration stops when no radiosity changes by more than this, relative to the greatest.
const SOLVED: f64 = 1e-13;
/// Most iterations, for reflectances near 1.
const MOST_ROUNDS: usize = 100_000;

impl Centres {
    /// Form factors from `points` of each patch, each with its share of the power of the patch.
    pub fn new(
        scene: &Scene,
        patches: Patches,
        points: &[Vec<(DVec3, f64)>],
        threads: usize,
    ) -> Centres {
        let seen = |from: usize, to: usize| -> f64 {
            let pair = Pair::new(scene, &patches.surfaces[from], &patches.surfaces[to]);
            let from_points = |pair: Pair| {
                points[from].iter().map(|&(point, share)| share * pair.from_element(point)).sum()
            };
            pair.map_or(0.0, from_points)
        };
        let row = |from: usize| (0..patches.count()).map(|to| seen(from, to)).collect::<Vec<_>>();
        let form_factors = parallel::map(patches.count(), threads, row);
        Centres { patches, form_factors }
    }

    /// The form factor from one patch to another.
    pub fn form_factor(&self, from: usize, to: usize) -> f64 {
        self.form_factors[from][to]
    }

    /// Radiosities, W/m², by Jacobi iteration.
    pub fn solve(&self) -> Vec<Rgb> {
        let Patches { areas, reflectance, emission, .. } = &self.patches;
        let mut radiosity = emission.clone();
        for _ in 0..MOST_ROUNDS {
            let mut arriving = vec![Rgb::ZERO; areas.len()];
            for (from, row) in self.form_factors.iter().enumerate() {
                let power = radiosity[from] * areas[from];
                row.iter().zip(&mut arriving).for_each(|(&seen, sum)| *sum += power * seen);
            }
            let (mut greatest, mut change) = (0.0_f64, 0.0_f64);
            for patch in (0..areas.len()).filter(|&patch| areas[patch] > 0.0) {
                let new = emission[patch] + reflectance[patch] * arriving[patch] / areas[patch];
                change = change.max((new - radiosity[patch]).abs().max_element());
                greatest = greatest.max(new.max_element());
                radiosity[patch] = new;
            }
            if change <= SOLVED * greatest {
                break;
            }
        }
        radiosity
    }
}
