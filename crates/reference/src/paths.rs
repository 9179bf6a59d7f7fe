//! Light followed along its paths from the emitters: an answer for scenes of any size, with rays cast
//! one by one by the kernel's exact test, and with a standard error.

use radiosity::glam::{DVec3, dvec3};
use radiosity::{End, LocalEnvironment, Ray, Rgb, Space, Work, cast};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use crate::dense::Solution;
use crate::patches::Patches;
use crate::sampling::point_of;

/// Which problem the answer is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Problem {
    /// Each patch sends out light evenly all over it: what radiosity solves on this mesh.
    Patches,
    /// Light goes on from where it falls, and the mesh is only what it is averaged over.
    Continuum,
}

/// Follows light through a scene, round after round.
pub struct Paths<'a> {
    space: &'a Space,
    environment: &'a LocalEnvironment,
    patches: &'a Patches,
    problem: Problem,
    seed: u64,
    paths: u32,
    /// Emitted power of each patch, summed over colours, W.
    emitted: Vec<f64>,
}

/// Power that has fallen on each patch, summed over rounds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Received {
    /// Rounds so far.
    pub rounds: u32,
    /// W.
    sum: Vec<[f64; 3]>,
    /// W².
    squares: Vec<[f64; 3]>,
}

/// A path goes on with at most this probability, so that it ends even between mirrors.
const GOES_ON: f64 = 0.999;

impl<'a> Paths<'a> {
    /// Rounds of `paths` paths each through an environment that is all of the space.
    pub fn new(
        space: &'a Space,
        environment: &'a LocalEnvironment,
        patches: &'a Patches,
        problem: Problem,
        paths: u32,
        seed: u64,
    ) -> Paths<'a> {
        let powers = patches.emission.iter().zip(&patches.areas);
        let emitted = powers.map(|(emission, area)| emission.element_sum() * area).collect();
        Paths { space, environment, patches, problem, seed, paths, emitted }
    }

    /// The power that falls on each patch in one round, W: a function of seed and number alone.
    pub fn round(&self, number: u32) -> Vec<Rgb> {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(u64::from(number));
        let mut received = vec![Rgb::ZERO; self.patches.count()];
        let all: f64 = self.emitted.iter().sum();
        if all > 0.0 {
            // One path starts in each of as many equal parts of the power.
            let mut below = 0.0;
            let mut emitter = 0;
            for path in 0..self.paths {
                let place =
                    (f64::from(path) + random.random::<f64>()) / f64::from(self.paths) * all;
                while emitter + 1 < self.emitted.len() && below + self.emitted[emitter] <= place {
                    below += self.emitted[emitter];
                    emitter += 1;
                }
                let share = all / self.emitted[emitter] / f64::from(self.paths);
                let power = self.patches.emission[emitter] * self.patches.areas[emitter] * share;
                self.follow(emitter, power, &mut random, &mut received);
            }
        }
        received
    }

    /// Follow a path from a random point of a patch.
    fn follow(
        &self,
        mut patch: usize,
        mut power: Rgb,
        random: &mut ChaCha8Rng,
        received: &mut [Rgb],
    ) {
        let mut work = Work::NONE;
        let mut point = self.point_on(patch, random);
        loop {
            let polygon = self.patches.surfaces[patch].polygon;
            let normal = self.patches.surfaces[patch].plane.normal;
            let ray = Ray::new(point, cosine_weighted(normal, random));
            let end = cast(self.space, self.environment, &ray, polygon, &mut work);
            let End::Hit { polygon, distance } = end else { return };
            let hit = ray.at(distance);
            let front = self.space.facets.faces(polygon, &ray);
            let Some(at) = self.environment.patch_at(polygon, hit).filter(|_| front) else {
                return;
            };
            patch = at as usize;
            received[patch] += power;

            let reflected = power * self.patches.reflectance[patch];
            let goes_on = (reflected.max_element() / power.max_element()).min(GOES_ON);
            if random.random::<f64>() >= goes_on {
                return;
            }
            power = reflected / goes_on;
            point = match self.problem {
                Problem::Patches => self.point_on(patch, random),
                Problem::Continuum => hit,
            };
        }
    }

    fn point_on(&self, patch: usize, random: &mut ChaCha8Rng) -> DVec3 {
        let corners = &self.patches.surfaces[patch].corners;
        let (u, v) = (random.random(), random.random());
        if corners.is_empty() {
            return self.environment.patches[patch].centre;
        }
        point_of(corners, u, v)
    }

    /// Radiosities and their standard errors, after two rounds or more. Where little light has
    /// fallen the error is at least that of one path.
    pub fn solution(&self, received: &Received) -> Solution {
        let n = f64::from(received.rounds);
        let one: f64 = self.emitted.iter().sum::<f64>() / (f64::from(self.paths) * n);
        let zero = vec![Rgb::ZERO; self.patches.count()];
        let mut solution = Solution { radiosity: zero.clone(), error: zero };
        for patch in 0..self.patches.count() {
            let area = self.environment.radiosity_area(patch as u32);
            let factor = self.patches.reflectance[patch] / area;
            let mean = Rgb::from(received.sum[patch]) / n;
            let variance = (Rgb::from(received.squares[patch]) / n - mean * mean) / (n - 1.0);
            let error = variance.max(Rgb::ZERO).map(f64::sqrt).max(Rgb::splat(one));
            solution.radiosity[patch] = self.patches.emission[patch] + mean * factor;
            solution.error[patch] = error * factor;
        }
        solution
    }
}

impl Received {
    /// Nothing yet, of so many patches.
    pub fn new(patches: usize) -> Received {
        let zero = vec![[0.0; 3]; patches];
        Received { rounds: 0, sum: zero.clone(), squares: zero }
    }

    /// Count the next round.
    pub fn add(&mut self, round: &[Rgb]) {
        for (i, &power) in round.iter().enumerate() {
            self.sum[i] = (Rgb::from(self.sum[i]) + power).to_array();
            self.squares[i] = (Rgb::from(self.squares[i]) + power * power).to_array();
        }
        self.rounds += 1;
    }

    /// Whether it is of so many patches.
    pub fn is_of(&self, patches: usize) -> bool {
        self.sum.len() == patches && self.squares.len() == patches
    }
}

/// A random direction over a normal; probability in proportion to the cosine (Nusselt's analogue).
fn cosine_weighted(normal: DVec3, random: &mut ChaCha8Rng) -> DVec3 {
    let (square, turn): (f64, f64) = (random.random(), random.random());
    let (sin, cos) = libm::sincos(std::f64::consts::TAU * turn);
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    let flat = dvec3(cos, sin, 0.0) * square.sqrt();
    tangent * flat.x + bitangent * flat.y + normal * (1.0 - square).sqrt()
}
