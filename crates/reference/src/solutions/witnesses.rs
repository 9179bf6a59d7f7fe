//! The error of a solution, estimated by independent sets of light paths, without a reference.
//!
//! A witness is a set of light paths, followed without a mesh. It is unbiased but too noisy to be a reference.
//! The noise of different witnesses is independent, so the product of the differences of a solution from two
//! witnesses is on average the square of its error. Summed over all patches and pairs of witnesses this
//! converges with far fewer paths than a reference needs.

use radiosity::{LocalEnvironment, Rgb, Space};

use crate::solutions::patches::Patches;
use crate::solutions::paths::{Paths, Problem};

/// The number of witnesses, enough for a standard error.
const COUNT: u32 = 16;

/// The fewest paths of a witness in a round.
const FEWEST: usize = 64;

/// Independent sets of light paths through a scene.
pub struct Witnesses {
    space: Space,
    environment: LocalEnvironment,
    patches: Patches,
    seed: u64,
    /// Paths of each witness in a round, and number of rounds.
    paths: u32,
    rounds: u32,
    /// Power received by the patches in all rounds, W, by witness.
    received: Vec<Vec<Rgb>>,
    /// Estimate of the reflected light: the sum over patches and colours of area × radiosity².
    light: f64,
}

/// An estimate of the error of a solution.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Testimony {
    /// The square of the relative error; noise may make it negative.
    pub square: f64,
    /// The standard error of that.
    pub deviation: f64,
}

impl Testimony {
    /// The relative error: root mean square, relative to the reflected light.
    pub fn error(&self) -> f64 {
        self.square.max(0.0).sqrt()
    }
}

impl Witnesses {
    /// Witnesses for an environment that covers the whole space, after one round.
    pub fn new(
        space: Space,
        environment: LocalEnvironment,
        seed: u64,
        threads: usize,
    ) -> Witnesses {
        let patches = Patches::new(&space, &environment);
        let paths = patches.count().div_ceil(COUNT as usize).max(FEWEST) as u32;
        let received = vec![vec![Rgb::ZERO; patches.count()]; COUNT as usize];
        let (rounds, light) = (0, 0.0);
        let mut witnesses =
            Witnesses { space, environment, patches, seed, paths, rounds, received, light };
        witnesses.follow(1, threads);
        witnesses
    }

    /// The patches on which solutions are compared.
    pub fn patches(&self) -> &Patches {
        &self.patches
    }

    /// The number of paths followed.
    pub fn paths(&self) -> u64 {
        u64::from(self.rounds) * u64::from(COUNT) * u64::from(self.paths)
    }

    /// Doubles the number of paths, which halves the standard error of the square.
    pub fn double(&mut self, threads: usize) {
        self.follow(self.rounds, threads);
    }

    fn follow(&mut self, rounds: u32, threads: usize) {
        let Witnesses { space, environment, patches, seed, .. } = &*self;
        let paths = Paths::new(space, environment, patches, Problem::Continuum, self.paths, *seed);
        let first = self.rounds;
        let of_one = |witness: usize| {
            let mut sum = vec![Rgb::ZERO; patches.count()];
            for round in first..first + rounds {
                let number = round * COUNT + witness as u32;
                sum.iter_mut().zip(paths.round(number)).for_each(|(sum, power)| *sum += power);
            }
            sum
        };
        let followed = parallel::map(COUNT as usize, threads, of_one);
        for (received, followed) in self.received.iter_mut().zip(followed) {
            received.iter_mut().zip(followed).for_each(|(sum, power)| *sum += power);
        }
        self.rounds += rounds;
        let dark = self.patches.emission.clone();
        self.light = self.square(&dark).square;
    }

    /// The error of a solution, given as means over the patches, W/m²; infinite if no path reflects light.
    pub fn error(&self, means: &[Rgb]) -> Testimony {
        let Testimony { square, deviation } = self.square(means);
        match self.reflect_light() {
            true => Testimony { square: square / self.light, deviation: deviation / self.light },
            false => Testimony { square: f64::INFINITY, deviation: 0.0 },
        }
    }

    /// Whether the paths found light that is reflected, to which errors are relative.
    pub fn reflect_light(&self) -> bool {
        self.light > 0.0
    }

    /// The square of the error of a solution, integrated over area, with its standard error by the
    /// jackknife: each witness is left out in turn.
    fn square(&self, means: &[Rgb]) -> Testimony {
        let n = f64::from(COUNT);
        // With d the difference from each witness and s their sum: s², each s·d, each d².
        let mut whole = 0.0;
        let mut parts = [(0.0, 0.0); COUNT as usize];
        for (patch, &mean) in means.iter().enumerate() {
            let area = self.patches.areas[patch];
            let factor = self.patches.reflectance[patch]
                / (self.environment.radiosity_area(patch as u32) * f64::from(self.rounds));
            let reflected = mean - self.patches.emission[patch];
            let distance = |received: &Vec<Rgb>| reflected - received[patch] * factor;
            let sum: Rgb = self.received.iter().map(distance).sum();
            whole += area * sum.length_squared();
            for ((with_sum, square), received) in parts.iter_mut().zip(&self.received) {
                let distance = distance(received);
                *with_sum += area * sum.dot(distance);
                *square += area * distance.length_squared();
            }
        }
        let squares: f64 = parts.iter().map(|(_, square)| square).sum();
        let without = |&(with_sum, square): &(f64, f64)| {
            let pairs = whole - 2.0 * with_sum + square - (squares - square);
            pairs / ((n - 1.0) * (n - 2.0))
        };
        let square = (whole - squares) / (n * (n - 1.0));
        let spread: f64 = parts.iter().map(|part| (without(part) - square).powi(2)).sum();
        Testimony { square, deviation: (spread * (n - 1.0) / n).sqrt() }
    }
}
