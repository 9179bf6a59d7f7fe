//! Shooting a source through a local environment (§3.3, §4.2.3).

use crate::bundle::{Rays, WIDTH};
use crate::environment::LocalEnvironment;
use crate::hemisphere::Hemisphere;
use crate::mask::Mask;
use crate::plain::cast_pixel;
use crate::shot::{Shot, Source, Tally};
use crate::space::Space;
use crate::tree::Waiting;
use crate::walk::{LANES, Walks};
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
    let frame = hemisphere.frame(source.centre, source.normal);
    let mut volley = Volley {
        space,
        environment,
        hemisphere,
        source,
        own_piece: environment.piece(source.polygon),
        start: space.grid.cell_of(source.centre),
        rays: Rays::from(source.centre, frame),
        waiting: Waiting::default(),
        walks: Walks::new(&space.grid, environment.block, source.centre),
        tally: Tally::new(environment, mask),
    };
    let bounds = space.grid.bounds(&environment.block);
    for (bundle, &word) in mask.words().iter().enumerate().filter(|&(_, &word)| word != 0) {
        volley.rays.aim(&hemisphere.bundles, bundle, word, &bounds);
        if !volley.find_hits() {
            volley.one_by_one(bundle, word);
            continue;
        }
        for first in (0..WIDTH).step_by(LANES) {
            volley.walk(first, word >> first);
            for lane in (first..first + LANES).filter(|lane| word >> lane & 1 == 1) {
                volley.end(lane, bundle * WIDTH + lane);
            }
        }
    }
    volley.tally.finish(environment, mask)
}

/// Polygons that a bundle is tested against before its rays go one by one: some two thirds of what
/// makes both cost the same, where a ray alone is tested against a dozen.
const MOST_POLYGONS: usize = 128;

/// A shot under way.
struct Volley<'a> {
    space: &'a Space,
    environment: &'a LocalEnvironment,
    hemisphere: &'a Hemisphere,
    source: &'a Source,
    /// The source's own polygon among those of the environment, which its rays cannot hit.
    own_piece: Option<u32>,
    /// The cell of the source.
    start: [u32; 3],
    rays: Rays,
    waiting: Waiting,
    walks: Walks<'a>,
    tally: Tally,
}

impl Volley<'_> {
    /// Test the bundle against the polygons that it can meet, near ones first; whether they were few
    /// enough.
    fn find_hits(&mut self) -> bool {
        let Volley { space, environment, own_piece, rays, waiting, .. } = self;
        let (pyramid, limit) = (rays.pyramid, rays.limit);
        let mut polygons = 0;
        environment.tree.visit(&pyramid, limit, waiting, |piece| {
            if Some(piece) != *own_piece {
                rays.meet(&space.facets, environment.polygon(piece), piece);
            }
            polygons += 1;
            (polygons <= MOST_POLYGONS).then_some(rays.limit)
        })
    }

    /// Cast the rays of a bundle plainly.
    fn one_by_one(&mut self, bundle: usize, word: u64) {
        let Volley { space, environment, hemisphere, source, rays, tally, .. } = self;
        for lane in (0..WIDTH).filter(|lane| word >> lane & 1 == 1) {
            let pixel = bundle * WIDTH + lane;
            let pixel = (pixel as u32, hemisphere.weights[pixel]);
            cast_pixel(space, environment, &rays.ray(lane), source.polygon, pixel, tally);
        }
    }

    /// Walk the rays from `first` on that are `cast`, from the source or from where they enter.
    fn walk(&mut self, first: usize, cast: u64) {
        let Volley { space, environment, start, rays, walks, .. } = self;
        if environment.block.contains(*start) {
            walks.start_together(*start, &rays.lanes(first), cast);
        } else {
            walks.clear();
            for lane in (0..LANES).filter(|lane| cast >> lane & 1 == 1) {
                let ray = rays.ray(first + lane);
                if let Some(passage) = space.grid.enter(&environment.block, &ray, *start) {
                    let hit = rays.hit(first + lane);
                    let distance = hit.map_or(f64::INFINITY, |hit| hit.distance);
                    walks.start(lane, &ray, passage.cell, passage.next, distance);
                }
            }
        }
        walks.run();
    }

    /// Count how the ray of a pixel ends.
    fn end(&mut self, lane: usize, pixel: usize) {
        let Volley { space, environment, hemisphere, rays, walks, tally, .. } = self;
        let counted = walks.counted(lane % LANES);
        tally.work(Operation::Ray, 1);
        tally.work(Operation::CellStep, counted.steps);
        tally.work(Operation::PolygonTest, counted.tests);
        let weight = hemisphere.weights[pixel];
        let side = match (counted.side, rays.hit(lane)) {
            (None, Some(hit)) if counted.steps > 0 => {
                let point = rays.ray(lane).at(hit.distance);
                let patch = environment.patch_of(hit.piece, point).filter(|_| hit.front);
                return tally.hit(patch, weight);
            }
            (Some(side), _) if counted.steps > 0 => side,
            // The ray never enters.
            _ => space.grid.side_towards(&environment.block, &rays.ray(lane)),
        };
        tally.leaves(environment, side, pixel as u32, weight);
    }
}
