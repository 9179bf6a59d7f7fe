//! Where a mesh is to be finer: where radiosity changes, and nowhere else.
//!
//! A pilot finds much of the light on a mesh of half the patches' size, with few rays. By how much radiosity
//! changes from patch to patch there says what a patch of any size gets wrong by having one radiosity.

use glam::DVec3;

use super::solve::solve;
use crate::geometry::area_and_centroid;
use crate::mesh::{Block, LocalEnvironment, Patch, PatchSize, Piece, Space};
use crate::scene::{Rgb, Scene};
use crate::shoot::{Hemisphere, HemisphereError, HemisphereKind};

/// What is wanted of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// What constant radiosities on its patches may be off, relative to what is reflected, as a root mean
    /// square by area.
    pub relative_l2: f64,
    /// How often the edges of a patch are halved for that, at most.
    pub most_halvings: u32,
}

/// A pilot's mesh, and how often patches as large as its are to be halved.
pub struct Refinement {
    pilot: LocalEnvironment,
    depths: Vec<u32>,
    /// Shots of the pilot, of [`Refinement::RAYS`] each.
    pub shots: u64,
}

impl Refinement {
    /// Rays of a pilot's source.
    pub const RAYS: u32 = 1_024;

    /// What of the emitted power a pilot leaves unshot: it is spread evenly, or nearly so.
    const UNSHOT: f64 = 0.05;

    /// A pilot shoots no more often.
    const MOST_SHOTS: u64 = 5_000;

    /// Finds out where patches of a size are to be halved.
    ///
    /// Choice C44: an edge of a patch over which radiosity changes by d leaves d²/12 of mean square error,
    /// and a quarter of it after halving. Patches are halved, where that spares most a patch first, until
    /// the errors add up to no more than is wanted.
    ///
    /// # Errors
    /// None is known: hemispheres of so many pixels exist.
    pub fn new(
        space: &Space,
        size: PatchSize,
        wanted: Wanted,
    ) -> Result<Refinement, HemisphereError> {
        let size = PatchSize { reflector: size.reflector / 2.0, ..size };
        let pilot = LocalEnvironment::new(space, space.grid.whole(), size);
        let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, Refinement::RAYS, true)?;
        let (light, shots) =
            solve(space, &pilot, &hemisphere, Refinement::UNSHOT, Refinement::MOST_SHOTS);
        let radiosity: Vec<Rgb> =
            (0..pilot.patches.len() as u32).map(|patch| light.radiosity(&pilot, patch)).collect();
        let reflected = pilot.patches.iter().zip(&radiosity).map(|(patch, &radiosity)| {
            (radiosity - emission(&space.scene, patch.polygon)).length_squared() * patch.area
        });
        let budget = wanted.relative_l2 * wanted.relative_l2 * reflected.sum::<f64>();
        // How finely lamps are meshed decides how many shots there are: that is left alone.
        let lamp = |patch: &Patch| emission(&space.scene, patch.polygon) != Rgb::ZERO;
        let errors = errors(&pilot, &radiosity).into_iter().zip(&pilot.patches);
        let errors: Vec<f64> =
            errors.map(|(error, patch)| if lamp(patch) { 0.0 } else { error }).collect();
        let depths = depths(&errors, budget, wanted.most_halvings);
        Ok(Refinement { pilot, depths, shots })
    }

    /// Mesh a block of cells with patches of the size that it was made for, and smaller ones.
    pub fn mesh(&self, space: &Space, block: Block, size: PatchSize) -> LocalEnvironment {
        let depth = |polygon, slot: &[DVec3], edges| self.depth(polygon, slot, edges);
        LocalEnvironment::meshed(space, block, size, Some(&depth))
    }

    /// How often a slot of a polygon, with edges of such lengths, is to be halved: as often as a patch
    /// needs anywhere in it.
    fn depth(&self, polygon: u32, slot: &[DVec3], edges: [f64; 2]) -> u32 {
        let Some(piece) = self.pilot.piece(polygon) else { return 0 };
        let Piece { u, v, .. } = self.pilot.pieces[piece as usize];
        let (area, centre) = area_and_centroid(slot);
        let within = slot.iter().map(|&corner| (corner + centre) / 2.0).filter(|_| area > 0.0);
        let depth = |point: DVec3| {
            let patch = self.pilot.patch_of(piece, point)?;
            // Twice the pilot's edges, halved so often, are wanted here.
            let wanted = [u, v]
                .map(|along| 2.0 / along.length() / f64::from(1u32 << self.depths[patch as usize]));
            let halved = |depth: u32, edge: f64| edge / f64::from(1u32 << depth);
            let enough = |&depth: &u32| {
                (0..2).all(|axis| halved(depth, edges[axis]) <= wanted[axis] * (1.0 + 1e-9))
            };
            (0..MOST_HALVINGS).find(enough)
        };
        within.filter_map(depth).max().unwrap_or(0)
    }
}

/// Patches are halved less often than this.
const MOST_HALVINGS: u32 = 8;

fn emission(scene: &Scene, polygon: u32) -> Rgb {
    scene.material(&scene.polygons[polygon as usize]).emission
}

/// What each patch of a pilot would add to the square of the error, were it as large as those of the mesh
/// that is to be refined: twice as long and as wide.
fn errors(pilot: &LocalEnvironment, radiosity: &[Rgb]) -> Vec<f64> {
    // Sums and numbers of squares of the change towards neighbours along u and along v.
    let mut changes = vec![[(0.0, 0u32); 2]; pilot.patches.len()];
    for piece in pilot.pieces.iter().filter(|piece| !piece.is_back()) {
        let patch = |i: u32, j: u32| pilot.slots[(piece.first_slot + j * piece.nu + i) as usize];
        for (i, j) in (0..piece.nv).flat_map(|j| (0..piece.nu).map(move |i| (i, j))) {
            let next = [
                (i + 1 < piece.nu).then(|| patch(i + 1, j)),
                (j + 1 < piece.nv).then(|| patch(i, j + 1)),
            ];
            for (axis, other) in next.into_iter().enumerate() {
                let (one, Some(other)) = (patch(i, j), other) else { continue };
                let change = radiosity[one as usize] - radiosity[other as usize];
                for patch in [one, other].into_iter().filter(|_| one != other) {
                    let (sum, count) = &mut changes[patch as usize][axis];
                    *sum += change.length_squared();
                    *count += 1;
                }
            }
        }
    }
    let mean = |(sum, count): (f64, u32)| if count > 0 { sum / f64::from(count) } else { 0.0 };
    let areas = pilot.patches.iter().map(|patch| patch.area);
    areas.zip(changes).map(|(area, [u, v])| area * 4.0 * (mean(u) + mean(v)) / 12.0).collect()
}

/// How often each patch is to be halved for the errors to add up to a budget, or as often as may be: what
/// a halving spares for each patch that it adds falls to a sixteenth from one to the next.
fn depths(errors: &[f64], budget: f64, most: u32) -> Vec<u32> {
    let most = most.min(MOST_HALVINGS - 1);
    let left = |error: f64, depth: u32| error / f64::from(4u32.pow(depth));
    let mut depths = vec![0; errors.len()];
    let mut worth = errors.iter().copied().fold(0.0, f64::max);
    let sum =
        |depths: &[u32]| -> f64 { errors.iter().zip(depths).map(|(&e, &d)| left(e, d)).sum() };
    // Beyond so many halvings of the worth of halving there is nothing left to spare.
    for _ in 0..64 {
        if sum(&depths) <= budget {
            break;
        }
        worth /= 2.0;
        for (depth, &error) in depths.iter_mut().zip(errors) {
            while *depth < most && left(left(error, *depth), *depth) > worth {
                *depth += 1;
            }
        }
    }
    depths
}
