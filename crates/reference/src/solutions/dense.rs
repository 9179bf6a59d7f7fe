//! The radiosity system with exact form factors, solved to machine precision.

use radiosity::{Rgb, Scene};

use crate::form_factors::cubature::{Estimate, Tolerance};
use crate::form_factors::pair::Pair;
use crate::solutions::conjugate_gradients::{Symmetric, solve};
use crate::solutions::patches::Patches;

/// Form factors between all patches of a scene.
pub struct Dense {
    patches: Patches,
    /// Area times form factor, m²; symmetric by reciprocity.
    exchange: Symmetric,
    /// Error of each, m².
    error: Symmetric,
}

/// Radiosities and their errors.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Radiosity of each patch, W/m².
    pub radiosity: Vec<Rgb>,
    /// Error for each patch, W/m².
    pub error: Vec<Rgb>,
}

impl Solution {
    /// The error relative to the reflected radiosity (radiosity less emission), both as area-weighted root
    /// mean squares over all patches and colours; `None` if nothing is reflected.
    pub fn relative_l2_error(&self, patches: &Patches) -> Option<f64> {
        let light = patches.reflected_square(&self.radiosity);
        let error = patches.square(self.error.iter().copied());
        (light > 0.0).then(|| (error / light).sqrt())
    }
}

/// Patches of less than this share of the mean area need not be as accurate as others: their light does not count,
/// and the form factors of slivers along an edge would take most of the time.
const SLIVER: f64 = 1e-3;

impl Dense {
    /// Form factors whose errors add up to about `tolerance` for each patch, more where the quadrature
    /// reached its limit of cells. Calls `done` after each patch.
    pub fn new(
        scene: &Scene,
        patches: Patches,
        tolerance: f64,
        threads: usize,
        done: impl Fn() + Sync,
    ) -> Dense {
        let all: f64 = patches.areas.iter().sum();
        let least = SLIVER * all / patches.count() as f64;
        let exchange = |from: usize, to: usize| {
            let pair = Pair::new(scene, &patches.surfaces[from], &patches.surfaces[to]);
            // Half of the tolerance is shared by area, half by form factor.
            let area = |patch: usize| patches.areas[patch].max(least);
            let absolute = tolerance * area(from) * area(to) / all;
            let tolerance = Tolerance { absolute, relative: tolerance };
            pair.map_or(Estimate::default(), |pair| pair.exchange(tolerance))
        };
        let row = |from: usize| {
            let row: Vec<_> = (0..from).map(|to| exchange(from, to)).collect();
            done();
            row
        };
        let rows = parallel::map(patches.count(), threads, row);
        let part = |of: fn(&Estimate) -> f64| {
            Symmetric::new(rows.iter().map(|row| row.iter().map(of).collect()).collect())
        };
        let (exchange, error) = (part(|found| found.value), part(|found| found.error));
        Dense { patches, exchange, error }
    }

    /// The form factor from one patch to another.
    pub fn form_factor(&self, from: usize, to: usize) -> f64 {
        self.exchange.at(from, to) / self.patches.areas[from].max(f64::MIN_POSITIVE)
    }

    /// The patches of the system.
    pub fn patches(&self) -> &Patches {
        &self.patches
    }

    /// Radiosities: B = E + ρ F B, colour by colour.
    pub fn solve(&self) -> Solution {
        let zero = vec![Rgb::ZERO; self.patches.count()];
        let mut solution = Solution { radiosity: zero.clone(), error: zero };
        for colour in 0..3 {
            let (radiosity, error) = self.solve_colour(colour);
            for patch in 0..self.patches.count() {
                solution.radiosity[patch][colour] = radiosity[patch];
                solution.error[patch][colour] = error[patch];
            }
        }
        solution
    }

    /// Radiosities of one colour and their errors. The errors of the form factors are propagated through the
    /// same system, which gives a bound since no entry of the inverse is negative; the error of the solver is
    /// added.
    fn solve_colour(&self, colour: usize) -> (Vec<f64>, Vec<f64>) {
        let reflectance: Vec<f64> = self.patches.reflectance.iter().map(|r| r[colour]).collect();
        let emission: Vec<f64> = self.patches.emission.iter().map(|e| e[colour]).collect();
        let leaving = |irradiance: Vec<f64>, emission: &[f64]| -> Vec<f64> {
            let reflected = irradiance.iter().zip(&reflectance).map(|(h, r)| r * h);
            reflected.zip(emission).map(|(reflected, emitted)| emitted + reflected).collect()
        };
        let areas = &self.patches.areas;
        let (irradiance, off) =
            solve(&self.exchange, areas, &reflectance, &self.exchange.times(&emission));
        let radiosity = leaving(irradiance, &emission);
        let (error, error_off) =
            solve(&self.exchange, areas, &reflectance, &self.error.times(&radiosity));
        let error = error.iter().map(|error| error + error_off + off).collect();
        (radiosity, leaving(error, &vec![0.0; areas.len()]))
    }
}
