//! Shooting a source through a local environment (§3.3, §4.2.3).

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

use crate::bundle::{Rays, WIDTH};
use crate::environment::LocalEnvironment;
use crate::form_factors::FormFactors;
use crate::grid::Side;
use crate::hemisphere::Hemisphere;
use crate::landing::land;
use crate::lattice::Lattice;
use crate::mask::Mask;
use crate::nearest::Nearest;
use crate::plain::cast_pixel;
use crate::shot::{Shot, Source, Tally};
use crate::space::Space;
use crate::tree::Waiting;
use crate::walk::Walk;
use crate::work::Operation;

/// Cast the rays of all true pixels of `mask` from `source` through `environment`.
///
/// Paper: a ray that hits an object clears its pixel; each neighbour gets a copy of the mask with
/// the pixels whose rays enter it. Of a source from elsewhere, `mask` holds the pixels whose rays
/// were not hit on their way here.
///
/// The rays of a word of the mask go together: first they find what they hit, then they walk through
/// the grid to count what the virtual processor would have done. Where polygons are so small that a
/// bundle meets very many, its rays go one by one. [`shoot_plainly`] is the obvious twin.
///
/// [`shoot_plainly`]: crate::shoot_plainly
#[doc(alias = "compute_illumination")]
pub fn shoot(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    source: &Source,
    mask: &Mask,
) -> Shot {
    dispatch!(Level::new(), simd => shoot_on(simd, space, environment, hemisphere, source, mask))
}

/// [`shoot`] with the vector instructions that the host has.
#[inline(always)]
fn shoot_on<S: Simd>(
    simd: S,
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    source: &Source,
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
        for (side, &left) in Side::ALL.into_iter().zip(&walked.left).filter(|&(_, &rays)| rays != 0) {
            tally.leave(side, bundle, left);
        }
        land(simd, rays, nearest, environment, walked.ended, |patch, rays| {
            tally.hit(patch, bundle, rays);
        });
    }
}
