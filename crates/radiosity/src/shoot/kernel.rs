//! `shoot`: the rays of an emitter through a local environment, a bundle of 64 at a time.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

use super::dimmed::shoot_dimmed;
use super::form_factors::FormFactors;
use super::hemisphere::Hemisphere;
use super::mask::Mask;
use super::plain::cast_pixel;
use super::shot::{Emitter, Shot, Tally};
use super::work::Operation;
use crate::geometry::VisitStack;
use crate::mesh::{LocalEnvironment, Side, Space};
use crate::shoot::bundle::{GridView, Nearest, Rays, WIDTH, Walk, find_patches};

/// Casts the rays of all true pixels of `mask` from `emitter` through `environment`.
///
/// Paper: §3.3, §4.2.3. A ray that hits an object clears its pixel; each neighbour gets a copy of
/// the mask with the pixels whose rays enter it. For an emitter of another environment, `mask` has
/// the pixels whose rays have not hit anything so far.
///
/// The rays of one word of the mask form a bundle. First their nearest hits are found. Then they
/// walk through the grid, to count the operations of the simulated processor. If the polygons are
/// so small that a bundle meets too many of them, its rays are cast one by one. In a scene with
/// participating media all rays are. [`shoot_plainly`](crate::shoot_plainly) is the simple version
/// that gives the same result.
#[doc(alias = "compute_illumination")]
pub fn shoot(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    emitter: &Emitter,
    mask: &Mask,
) -> Shot {
    if !space.scene.media.is_empty() {
        return shoot_dimmed(space, environment, hemisphere, emitter, mask);
    }
    dispatch!(Level::new(), simd => shoot_on(simd, space, environment, hemisphere, emitter, mask))
}

/// [`shoot`] with a given set of vector instructions.
#[inline(always)]
fn shoot_on<S: Simd>(
    simd: S,
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    emitter: &Emitter,
    mask: &Mask,
) -> Shot {
    let frame = hemisphere.frame(emitter.centre, emitter.normal);
    let form_factors = FormFactors::new(Tally::places(environment), hemisphere);
    let mut shot = BundleShot {
        space,
        environment,
        own_polygon: emitter.polygon,
        own_piece: environment.piece(emitter.polygon),
        rays: Rays::from(emitter.centre, frame),
        nearest: Nearest::new(),
        stack: VisitStack::default(),
        walk: Walk::new(GridView::new(&space.grid, environment.block, emitter.centre)),
        tally: Tally::new(environment, mask, form_factors),
    };
    for (bundle, &word) in mask.words().iter().enumerate().filter(|&(_, &word)| word != 0) {
        shot.rays.aim(simd, &hemisphere.bundles, bundle);
        if shot.find_nearest(simd, word) {
            let touching = shot.hits_of_touching();
            shot.count(simd, bundle, word & !touching);
            shot.one_by_one(bundle, touching);
        } else {
            shot.one_by_one(bundle, word);
        }
    }
    shot.tally.finish()
}

/// Number of polygons tested for a bundle before its rays are cast one by one: about two thirds of
/// where both cost the same, if a single ray is tested against a dozen.
const MOST_POLYGONS: usize = 128;

/// A shot in progress.
struct BundleShot<'a> {
    space: &'a Space,
    environment: &'a LocalEnvironment,
    /// The polygon of the emitter, which its rays cannot hit.
    own_polygon: u32,
    /// Its piece in the environment, if it has one.
    own_piece: Option<u32>,
    rays: Rays,
    nearest: Nearest,
    stack: VisitStack,
    walk: Walk<'a>,
    tally: Tally<'a>,
}

impl BundleShot<'_> {
    /// Tests the bundle against the polygons it can meet, near ones first; false if too many.
    #[inline(always)]
    fn find_nearest<S: Simd>(&mut self, simd: S, cast: u64) -> bool {
        let BundleShot { space, environment, own_piece, rays, nearest, stack, .. } = self;
        nearest.clear(simd, cast);
        let mut polygons = 0;
        environment.tree.visit(simd, &rays.pyramid, stack, |piece| {
            if Some(piece) != *own_piece {
                let polygon = environment.pieces[piece as usize].polygon;
                nearest.meet(simd, rays, &space.facets, polygon, piece);
            }
            polygons += 1;
            (polygons <= MOST_POLYGONS).then_some(nearest.limit)
        })
    }

    /// The rays whose nearest polygon only touches the environment. There are hardly any.
    fn hits_of_touching(&self) -> u64 {
        let touches = |piece: u32| self.environment.pieces[piece as usize].touches;
        let touching = self.nearest.hits.iter().filter(|hit| touches(hit.piece));
        touching.fold(0, |rays, hit| rays | hit.rays)
    }

    /// Casts the rays of a bundle one by one.
    fn one_by_one(&mut self, bundle: usize, word: u64) {
        let BundleShot { space, environment, own_polygon, rays, tally, .. } = self;
        let mut rest = word;
        while rest != 0 {
            let lane = rest.trailing_zeros() as usize;
            rest &= rest - 1;
            let pixel = (bundle * WIDTH + lane) as u32;
            cast_pixel(space, environment, &rays.ray(lane), *own_polygon, pixel, tally);
        }
    }

    /// Walks the rays of a bundle through the grid, and counts their operations and how they end.
    #[inline(always)]
    fn count<S: Simd>(&mut self, simd: S, bundle: usize, word: u64) {
        let BundleShot { environment, rays, nearest, walk, tally, .. } = self;
        let walked = walk.run(simd, rays, nearest, word);
        tally.work.count(Operation::Ray, u64::from(word.count_ones()));
        tally.work.count(Operation::CellStep, walked.steps);
        tally.work.count(Operation::PolygonTest, walked.tests);
        for (side, &left) in Side::ALL.into_iter().zip(&walked.left).filter(|&(_, &rays)| rays != 0)
        {
            tally.leave(side, bundle, left);
        }
        find_patches(simd, rays, nearest, environment, walked.ended, |patch, rays| {
            tally.hit(patch, bundle, rays);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Patch, PatchSize};
    use crate::scene::{Face, Material, Rgb, Scene};
    use crate::shoot::hemisphere::HemisphereKind;
    use crate::shoot::plain::shoot_plainly;
    use glam::DVec3;

    /// A box seen from inside, with a slanted triangle and a plate inside.
    fn space() -> Space {
        let corner = |i: usize| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64);
        let sides =
            [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
        let mut faces: Vec<Vec<DVec3>> =
            sides.iter().map(|side| side.iter().map(|&i| corner(i)).collect()).collect();
        faces.push(vec![DVec3::splat(0.3), DVec3::new(0.8, 0.3, 0.4), DVec3::new(0.5, 0.7, 0.6)]);
        let plate = [[0.2, 0.2], [0.2, 0.5], [0.7, 0.5], [0.7, 0.2]];
        faces.push(plate.iter().map(|&[x, y]| DVec3::new(x, y, 0.25)).collect());
        let faces = faces.into_iter().map(|points| Face { points, material: 0, object: 0 });
        let faces: Vec<Face> = faces.collect();
        let scene = Scene::new(&faces, vec![Material::default()], vec!["all".to_owned()]);
        Space::new(scene.expect("a closed box").0, [5, 4, 3])
    }

    /// Shoots every patch through its own environment, and then through the other one.
    fn all_shots<S: Simd>(simd: S, space: &Space, environments: &[LocalEnvironment; 2]) {
        for kind in [HemisphereKind::Fibonacci, HemisphereKind::Concentric] {
            let hemisphere = Hemisphere::new(kind, 256, false).expect("a square");
            for (from, own) in environments.iter().enumerate() {
                for (patch, &Patch { centre, polygon, .. }) in own.patches.iter().enumerate() {
                    let emitter = Emitter {
                        environment: from as u32,
                        patch: patch as u32,
                        polygon,
                        centre,
                        normal: space.scene.polygons[polygon as usize].plane.normal,
                        power: Rgb::ONE,
                        radiosity: Rgb::ONE,
                    };
                    let shoot_through = |environment: &LocalEnvironment, mask: &Mask| {
                        let shot =
                            || shoot_on(simd, space, environment, &hemisphere, &emitter, mask);
                        let shot = simd.vectorize(shot);
                        let plain = shoot_plainly(space, environment, &hemisphere, &emitter, mask);
                        assert!(shot == plain, "patch {patch} of {from}");
                        shot
                    };
                    let shot = shoot_through(own, &Mask::all(hemisphere.pixels()));
                    for outgoing in shot.outgoing.iter().flatten() {
                        shoot_through(&environments[1 - from], &outgoing.mask);
                    }
                }
            }
        }
    }

    /// Results do not depend on the vector instructions of the host.
    #[test]
    fn all_vector_instructions_shoot_as_single_rays_do() {
        let space = space();
        let whole = space.grid.whole();
        let size = PatchSize { reflector: 0.3, emitter: 0.3 };
        let (mut low, mut high) = (whole, whole);
        (low.high[0], high.low[0]) = (2, 2);
        let environments = [low, high].map(|block| LocalEnvironment::new(&space, block, size));
        let level = Level::new();
        dispatch!(level, simd => all_shots(simd, &space, &environments));
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(simd) = level.as_avx2() {
                all_shots(simd, &space, &environments);
            }
            if let Some(simd) = level.as_sse4_2() {
                all_shots(simd, &space, &environments);
            }
            if let Some(simd) = level.as_sse2() {
                all_shots(simd, &space, &environments);
            }
        }
    }
}
