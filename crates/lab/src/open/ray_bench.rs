//! Rays from random points of a scene, to compare the speed of the kernel with that of other ray tracers.

use std::ops::Add;

use radiosity::glam::DVec3;
use radiosity::{
    Emitter, Hemisphere, HemisphereError, HemisphereKind, LocalEnvironment, Mask, PatchSize, Rgb,
    Space, Work, shoot, shoot_plainly,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::open::open_scene::OpenScene;

/// A scene as one environment, and the sources to be shot through it.
pub struct RayBench {
    /// The scene, in coordinates of its own.
    pub space: Space,
    whole: LocalEnvironment,
    /// The rays of each source: cosine-weighted, turned as [`Hemisphere::frame`] says.
    pub hemisphere: Hemisphere,
    /// Random points of random polygons.
    pub sources: Vec<Emitter>,
}

impl RayBench {
    /// Rays from `sources` points that `seed` draws, `rays` from each.
    pub fn new(
        open: OpenScene,
        sources: u32,
        rays: u32,
        seed: u64,
    ) -> Result<RayBench, HemisphereError> {
        let space = Space::new(open.scene, open.cells);
        let size = PatchSize { reflector: open.patch_size, emitter: open.emitter_patch_size };
        let whole = LocalEnvironment::new(&space, space.grid.whole(), size);
        let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, rays, true)?;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let sources = (0..sources).map(|_| random_source(&space, &mut random)).collect();
        Ok(RayBench { space, whole, hemisphere, sources })
    }

    /// Cast all rays of all sources on one thread, and count what was done; `plain` casts a ray at a
    /// time, polygon by polygon.
    pub fn cast(&self, plain: bool) -> Work {
        self.cast_from(&self.sources, plain)
    }

    /// Like [`RayBench::cast`], with the sources shared out among `threads`.
    pub fn cast_on(&self, threads: usize, plain: bool) -> Work {
        let share = self.sources.len().div_ceil(threads).max(1);
        let shares: Vec<&[Emitter]> = self.sources.chunks(share).collect();
        let cast = |number: usize| self.cast_from(shares[number], plain);
        parallel::map(shares.len(), threads, cast).into_iter().fold(Work::NONE, Work::add)
    }

    fn cast_from(&self, sources: &[Emitter], plain: bool) -> Work {
        let mask = Mask::all(self.hemisphere.pixels());
        let cast = if plain { shoot_plainly } else { shoot };
        let shots =
            sources.iter().map(|s| cast(&self.space, &self.whole, &self.hemisphere, s, &mask));
        shots.fold(Work::NONE, |work, shot| work + shot.work)
    }
}

/// A random point of a random polygon, as a source.
fn random_source(space: &Space, random: &mut ChaCha8Rng) -> Emitter {
    let polygon = random.random_range(0..space.scene.polygons.len());
    let face = &space.scene.polygons[polygon];
    let corners: Vec<DVec3> = space.scene.corners(face).collect();
    // A random triangle of the fan, then a random point of it.
    let corner = random.random_range(1..corners.len() - 1);
    let (mut a, mut b) = (random.random::<f64>(), random.random::<f64>());
    if a + b > 1.0 {
        (a, b) = (1.0 - a, 1.0 - b);
    }
    let [p, q, r] = [corners[0], corners[corner], corners[corner + 1]];
    Emitter {
        environment: 0,
        patch: 0,
        polygon: polygon as u32,
        centre: p + (q - p) * a + (r - p) * b,
        normal: face.plane.normal,
        power: Rgb::ONE,
        radiosity: Rgb::ONE,
    }
}
