//! Radiosities by light paths from the emitters, with standard errors, for scenes of any size. Rays are cast one
//! by one by the kernel's single-ray test.

use radiosity::glam::{DVec3, dvec3};
use radiosity::{End, LocalEnvironment, Ray, Rgb, Space, Work, cast};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use crate::form_factors::sampling::point_of;
use crate::solutions::dense::Solution;
use crate::solutions::patches::Patches;

/// The problem that is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Problem {
    /// Radiosity is constant on each patch: the problem that radiosity solves on this mesh.
    Patches,
    /// Radiosity varies continuously; the mesh is used only for averages.
    Continuum,
}

/// Follows light through a scene in independent rounds.
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

/// Power received by each patch, summed over rounds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Received {
    /// Number of rounds.
    pub rounds: u32,
    /// Sums, W.
    sum: Vec<[f64; 3]>,
    /// Sums of squares, W².
    squares: Vec<[f64; 3]>,
}

/// Upper limit of the probability that a path continues, so that paths end even if reflectances are 1.
const MAX_CONTINUATION: f64 = 0.999;

impl<'a> Paths<'a> {
    /// Rounds of `paths` paths each through an environment that covers the whole space.
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

    /// The power received by each patch in one round, W. It depends only on the seed and the number of the
    /// round.
    pub fn round(&self, number: u32) -> Vec<Rgb> {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(u64::from(number));
        let mut received = vec![Rgb::ZERO; self.patches.count()];
        let all: f64 = self.emitted.iter().sum();
        if all > 0.0 {
            // Stratified: the power is divided into equal parts, and one path starts in each.
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

    /// Follows a path from a random point of a patch.
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
            let continues = (reflected.max_element() / power.max_element()).min(MAX_CONTINUATION);
            if random.random::<f64>() >= continues {
                return;
            }
            power = reflected / continues;
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

    /// Radiosities and their standard errors, after at least two rounds. The error is at least the
    /// contribution of one path, for patches that received little light.
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
    /// No rounds yet, for this number of patches.
    pub fn new(patches: usize) -> Received {
        let zero = vec![[0.0; 3]; patches];
        Received { rounds: 0, sum: zero.clone(), squares: zero }
    }

    /// Adds the next round.
    pub fn add(&mut self, round: &[Rgb]) {
        for (i, &power) in round.iter().enumerate() {
            self.sum[i] = (Rgb::from(self.sum[i]) + power).to_array();
            self.squares[i] = (Rgb::from(self.squares[i]) + power * power).to_array();
        }
        self.rounds += 1;
    }

    /// Whether it has this number of patches.
    pub fn is_of(&self, patches: usize) -> bool {
        self.sum.len() == patches && self.squares.len() == patches
    }
}

/// A random direction with cosine-weighted probability (Nusselt's analogue).
fn cosine_weighted(normal: DVec3, random: &mut ChaCha8Rng) -> DVec3 {
    let (square, turn): (f64, f64) = (random.random(), random.random());
    let (sin, cos) = libm::sincos(std::f64::consts::TAU * turn);
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    let flat = dvec3(cos, sin, 0.0) * square.sqrt();
    tangent * flat.x + bitangent * flat.y + normal * (1.0 - square).sqrt()
}
