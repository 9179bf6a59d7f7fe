//! Shooting a source through a local environment (§3.3, §4.2.3).

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

use super::dimmed::shoot_dimmed;
use super::form_factors::FormFactors;
use super::hemisphere::Hemisphere;
use super::mask::Mask;
use super::plain::cast_pixel;
use super::shot::{Emitter, Shot, Tally};
use super::work::Operation;
use crate::geometry::Waiting;
use crate::mesh::{LocalEnvironment, Side, Space};
use crate::shoot::bundle::{Lattice, Nearest, Rays, WIDTH, Walk, land};

/// Cast the rays of all true pixels of `mask` from `source` through `environment`.
///
/// Paper: a ray that hits an object clears its pixel; each neighbour gets a copy of the mask with
/// the pixels whose rays enter it. Of a source from elsewhere, `mask` holds the pixels whose rays
/// were not hit on their way here.
///
/// The rays of a word of the mask go together: first they find what they hit, then they walk through
/// the grid to count what the virtual processor would have done. Where polygons are so small that a
/// bundle meets very many, its rays go one by one. [`shoot_plainly`] is the obvious twin. In a scene with
/// participating media all rays go one by one.
///
/// [`shoot_plainly`]: crate::shoot_plainly
#[doc(alias = "compute_illumination")]
pub fn shoot(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    source: &Emitter,
    mask: &Mask,
) -> Shot {
    if !space.scene.media.is_empty() {
        return shoot_dimmed(space, environment, hemisphere, source, mask);
    }
    dispatch!(Level::new(), simd => shoot_on(simd, space, environment, hemisphere, source, mask))
}

/// [`shoot`] with the vector instructions that the host has.
#[inline(always)]
fn shoot_on<S: Simd>(
    simd: S,
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    source: &Emitter,
    mask: &Mask,
) -> Shot {
    let frame = hemisphere.frame(source.centre, source.normal);
    let form_factors = FormFactors::new(Tally::places(environment), hemisphere);
    let mut volley = Volley {
        space,
        environment,
        own_polygon: source.polygon,
        own_piece: environment.piece(source.polygon),
        rays: Rays::from(source.centre, frame),
        nearest: Nearest::new(),
        waiting: Waiting::default(),
        walk: Walk::new(Lattice::new(&space.grid, environment.block, source.centre)),
        tally: Tally::new(environment, mask, form_factors),
    };
    for (bundle, &word) in mask.words().iter().enumerate().filter(|&(_, &word)| word != 0) {
        volley.rays.aim(simd, &hemisphere.bundles, bundle);
        if volley.find_nearest(simd, word) {
            volley.count(simd, bundle, word);
        } else {
            volley.one_by_one(bundle, word);
        }
    }
    volley.tally.finish()
}

/// Polygons that a bundle is tested against before its rays go one by one: some two thirds of what
/// makes both cost the same, where a ray alone is tested against a dozen.
const MOST_POLYGONS: usize = 128;

/// A shot under way.
struct Volley<'a> {
    space: &'a Space,
    environment: &'a LocalEnvironment,
    /// The source's own polygon, which its rays cannot hit.
    own_polygon: u32,
    /// The same among those of the environment.
    own_piece: Option<u32>,
    rays: Rays,
    nearest: Nearest,
    waiting: Waiting,
    walk: Walk<'a>,
    tally: Tally<'a>,
}

impl Volley<'_> {
    /// Test the bundle against the polygons that it can meet, near ones first; whether they were few
    /// enough.
    #[inline(always)]
    fn find_nearest<S: Simd>(&mut self, simd: S, cast: u64) -> bool {
        let Volley { space, environment, own_piece, rays, nearest, waiting, .. } = self;
        nearest.clear(simd, cast);
        let mut polygons = 0;
        environment.tree.visit(simd, &rays.pyramid, waiting, |piece| {
            if Some(piece) != *own_piece {
                nearest.meet(simd, rays, &space.facets, environment.polygon(piece), piece);
            }
            polygons += 1;
            (polygons <= MOST_POLYGONS).then_some(nearest.limit)
        })
    }

    /// Cast the rays of a bundle plainly.
    fn one_by_one(&mut self, bundle: usize, word: u64) {
        let Volley { space, environment, own_polygon, rays, tally, .. } = self;
        for lane in (0..WIDTH).filter(|lane| word >> lane & 1 == 1) {
            let pixel = (bundle * WIDTH + lane) as u32;
            cast_pixel(space, environment, &rays.ray(lane), *own_polygon, pixel, tally);
        }
    }

    /// Walk the rays of a bundle, and count what they do and how they end.
    #[inline(always)]
    fn count<S: Simd>(&mut self, simd: S, bundle: usize, word: u64) {
        let Volley { environment, rays, nearest, walk, tally, .. } = self;
        let walked = walk.run(simd, rays, nearest, word);
        tally.work.count(Operation::Ray, u64::from(word.count_ones()));
        tally.work.count(Operation::CellStep, walked.steps);
        tally.work.count(Operation::PolygonTest, walked.tests);
        for (side, &left) in Side::ALL.into_iter().zip(&walked.left).filter(|&(_, &rays)| rays != 0)
        {
            tally.leave(side, bundle, left);
        }
        land(simd, rays, nearest, environment, walked.ended, |patch, rays| {
            tally.hit(patch, bundle, rays);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::super::hemisphere::HemisphereKind;
    use super::super::plain::shoot_plainly;
    use super::*;
    use crate::mesh::{Patch, PatchSize};
    use crate::scene::{Face, Material, Rgb, Scene};
    use glam::DVec3;

    /// A box seen from inside, with a slanted triangle and a plate in it.
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
        let material = Material {
            name: "grey".to_owned(),
            reflectance: Rgb::splat(0.5),
            emission: Rgb::ZERO,
            two_sided: false,
        };
        let faces: Vec<Face> = faces.collect();
        let scene = Scene::new(&faces, vec![material], vec!["all".to_owned()]);
        Space::new(scene.expect("a closed box").0, [5, 4, 3])
    }

    /// Shoots every patch through its own of two environments and on through the other.
    fn all_shots<S: Simd>(simd: S, space: &Space, environments: &[LocalEnvironment; 2]) {
        for kind in [HemisphereKind::Fibonacci, HemisphereKind::Concentric] {
            let hemisphere = Hemisphere::new(kind, 256, false).expect("a square");
            for (from, own) in environments.iter().enumerate() {
                for (patch, &Patch { centre, polygon, .. }) in own.patches.iter().enumerate() {
                    let source = Emitter {
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
                            || shoot_on(simd, space, environment, &hemisphere, &source, mask);
                        let shot = simd.vectorize(shot);
                        let plain = shoot_plainly(space, environment, &hemisphere, &source, mask);
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

    /// Hosts differ in their vector instructions; rays end in the same places on all of them.
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
