//! How far a solution is from the truth, told by several independent and noisy ones.
//!
//! A witness is light followed along some paths, without any mesh: right on average, and so noisy that no
//! patch of it can be believed. But how far a solution is from one witness, times how far it is from another,
//! is on average the square of its own error, since their noises know nothing of each other; and summed over
//! all patches and pairs of witnesses it is so soon, long before the paths would make a reference.

use radiosity::{LocalEnvironment, Rgb, Space};

use crate::patches::Patches;
use crate::paths::{Paths, Problem};

/// How many there are: enough to tell how sure they are together.
const COUNT: u32 = 16;

/// The least paths of a witness.
const FEWEST: usize = 64;

/// Independent witnesses of a scene's light.
pub struct Witnesses {
    space: Space,
    environment: LocalEnvironment,
    patches: Patches,
    seed: u64,
    /// Paths of each in a round, and rounds so far.
    paths: u32,
    rounds: u32,
    /// What has fallen on the patches in all rounds, W, by witness.
    received: Vec<Vec<Rgb>>,
    /// What they say is reflected: the sum over patches and colours of area × radiosity².
    light: f64,
}

/// What witnesses say of the error of a solution.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Testimony {
    /// The square of its relative error; noise may leave less than nothing of it.
    pub square: f64,
    /// The standard error of that.
    pub deviation: f64,
}

impl Testimony {
    /// The relative error, as a reference tells it: a root mean square over what is reflected.
    pub fn error(&self) -> f64 {
        self.square.max(0.0).sqrt()
    }
}

impl Witnesses {
    /// Of an environment that is all of the space, after one round.
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
        witnesses.hear(1, threads);
        witnesses
    }

    /// The patches on which solutions are told.
    pub fn patches(&self) -> &Patches {
        &self.patches
    }

    /// Paths followed so far.
    pub fn paths(&self) -> u64 {
        u64::from(self.rounds) * u64::from(COUNT) * u64::from(self.paths)
    }

    /// Follows as many paths again as so far: half the standard error.
    pub fn double(&mut self, threads: usize) {
        self.hear(self.rounds, threads);
    }

    fn hear(&mut self, rounds: u32, threads: usize) {
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
        let heard = parallel::map(COUNT as usize, threads, of_one);
        for (received, heard) in self.received.iter_mut().zip(heard) {
            received.iter_mut().zip(heard).for_each(|(sum, power)| *sum += power);
        }
        self.rounds += rounds;
        let dark = self.patches.emission.clone();
        self.light = self.square(&dark).square;
    }

    /// What they say of a solution, as means over their patches, W/m².
    pub fn error(&self, means: &[Rgb]) -> Testimony {
        let Testimony { square, deviation } = self.square(means);
        match self.light > 0.0 {
            true => Testimony { square: square / self.light, deviation: deviation / self.light },
            false => Testimony::default(),
        }
    }

    /// The square of a solution's distance from the truth, summed over areas; with its standard error by
    /// leaving out each witness in turn.
    fn square(&self, means: &[Rgb]) -> Testimony {
        let n = f64::from(COUNT);
        // With d the distances from each witness and s their sum: s², each s·d, each d².
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
