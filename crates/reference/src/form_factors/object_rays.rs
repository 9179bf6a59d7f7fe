//! Form factors between objects by rays of the kernel, from points all over the object.

use radiosity::glam::DVec3;
use radiosity::{
    Emitter, Hemisphere, HemisphereError, HemisphereKind, LocalEnvironment, Mask, PatchSize, Rgb,
    Space, shoot,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::form_factors::cubature::Estimate;
use crate::form_factors::objects::Objects;
use crate::form_factors::sampling::{choose, point_of, spread};

/// Shoots from random points of objects.
pub struct ObjectRays<'a> {
    objects: &'a Objects<'a>,
    space: &'a Space,
    /// Each polygon one patch.
    environment: LocalEnvironment,
    hemisphere: Hemisphere,
    /// Points of each set.
    points: u32,
    seed: u64,
}

/// Sets of points, each evenly spread with a random shift. The spread of their results gives the standard
/// error of the mean.
const SETS: u32 = 16;

/// Rays from a point. Few, since more points reduce the error more than more rays from a point.
const PIXELS: u32 = 1_024;

impl<'a> ObjectRays<'a> {
    /// About `rays` rays from each object, from at least sixteen points.
    ///
    /// # Errors
    /// Those of [`Hemisphere::new`]; they cannot occur with this number of pixels.
    pub fn new(
        objects: &'a Objects<'a>,
        space: &'a Space,
        rays: u64,
        seed: u64,
    ) -> Result<ObjectRays<'a>, HemisphereError> {
        let size = PatchSize { reflector: f64::INFINITY, emitter: f64::INFINITY };
        let points = rays.div_ceil(u64::from(PIXELS * SETS)).min(u64::from(u32::MAX));
        Ok(ObjectRays {
            objects,
            space,
            environment: LocalEnvironment::new(space, space.grid.whole(), size),
            hemisphere: Hemisphere::new(HemisphereKind::Fibonacci, PIXELS, true)?,
            points: points as u32,
            seed,
        })
    }

    /// The form factors from one object to all; the errors are standard errors.
    pub fn from(&self, object: usize) -> Vec<Estimate> {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(object as u64);
        let mut sums = vec![(0.0, 0.0); self.objects.count()];
        for _ in 0..SETS {
            let shift = [random.random(), random.random()];
            for (sum, mean) in sums.iter_mut().zip(self.mean(object, shift)) {
                *sum = (sum.0 + mean, sum.1 + mean * mean);
            }
        }
        let n = f64::from(SETS);
        let estimate = |(sum, squares): (f64, f64)| {
            let value = sum / n;
            let variance = (squares / n - value * value).max(0.0) / (n - 1.0);
            Estimate { value, error: variance.sqrt() }
        };
        sums.into_iter().map(estimate).collect()
    }

    /// The mean over one set of points.
    fn mean(&self, object: usize, shift: [f64; 2]) -> Vec<f64> {
        let mut means = vec![0.0; self.objects.count()];
        let mask = Mask::all(self.hemisphere.pixels());
        let faces = self.objects.faces(object);
        for i in 0..self.points {
            let [u, v] = spread(i, shift);
            let areas = faces.iter().map(|&face| self.space.scene.polygons[face as usize].area);
            let (face, u) = choose(areas, u);
            let source = self.source(faces[face], u, v);
            let shot = shoot(self.space, &self.environment, &self.hemisphere, &source, &mask);
            for (patch, form_factor) in shot.hits {
                let polygon = self.environment.patches[patch as usize].polygon;
                means[self.objects.of_face(polygon)] += form_factor / f64::from(self.points);
            }
        }
        means
    }

    fn source(&self, polygon: u32, u: f64, v: f64) -> Emitter {
        let face = &self.space.scene.polygons[polygon as usize];
        let corners: Vec<DVec3> = self.space.scene.corners(face).collect();
        Emitter {
            environment: 0,
            patch: 0,
            polygon,
            centre: point_of(&corners, u, v),
            normal: face.plane.normal,
            power: Rgb::ONE,
            radiosity: Rgb::ONE,
        }
    }
}
