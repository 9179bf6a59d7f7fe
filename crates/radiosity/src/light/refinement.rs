//! Mesh refinement: smaller patches where radiosity changes.
//!
//! A pilot solution with few rays, on patches of half the size, finds most of the light. The change
//! of its radiosity from patch to patch gives the error of constant radiosity on patches of any
//! size.

use glam::DVec3;

use super::solve::solve;
use crate::geometry::area_and_centroid;
use crate::mesh::{Block, LocalEnvironment, Patch, PatchSize, Piece, Space, TooManyPatches};
use crate::scene::{Rgb, Scene};
use crate::shoot::{Hemisphere, HemisphereError, HemisphereKind};

/// The accuracy wanted of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// Allowed error of constant radiosities on patches: root mean square by area, relative to the
    /// reflected radiosity.
    pub relative_l2: f64,
    /// Largest number of times that the edges of a patch are halved.
    pub most_halvings: u32,
}

/// The mesh of a pilot solution, and how often a patch at each place must be halved.
pub struct Refinement {
    pilot: LocalEnvironment,
    depths: Vec<u32>,
    /// Number of shots of the pilot solution, of [`Refinement::RAYS`] rays each.
    pub shots: u64,
}

/// Why a mesh cannot be refined.
#[derive(Debug, thiserror::Error)]
pub enum RefinementError {
    /// None in practice: the hemisphere of the pilot is possible.
    #[error(transparent)]
    Hemisphere(#[from] HemisphereError),
    /// The pilot, or the refined mesh, would have too many patches.
    #[error(transparent)]
    Patches(#[from] TooManyPatches),
}

impl Refinement {
    /// Number of rays of a shot of the pilot solution.
    pub const RAYS: u32 = 1_024;

    /// Fraction of the emitted power that the pilot leaves unshot: it varies little in space.
    const UNSHOT: f64 = 0.05;

    /// Largest number of shots of the pilot.
    const MOST_SHOTS: u64 = 5_000;

    /// Finds where patches of a size must be halved.
    ///
    /// Choice C44: if radiosity changes by d along an edge of a patch, the mean square error is
    /// d²/12, and a quarter of it after halving. Patches are halved, those with the largest gain
    /// per new patch first, until the errors add up to at most the wanted one.
    ///
    /// # Errors
    /// Too many patches, of the pilot or of the refined mesh.
    pub fn new(
        space: &Space,
        size: PatchSize,
        wanted: Wanted,
    ) -> Result<Refinement, RefinementError> {
        let coarse = size;
        let size = PatchSize { reflector: size.reflector / 2.0, ..size };
        size.check(&space.scene)?;
        let pilot = LocalEnvironment::new(space, space.grid.whole(), size);
        let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, Refinement::RAYS, true)?;
        let (light, shots) =
            solve(space, &pilot, &hemisphere, Refinement::UNSHOT, Refinement::MOST_SHOTS, |_| ());
        let radiosity: Vec<Rgb> =
            (0..pilot.patches.len() as u32).map(|patch| light.radiosity(&pilot, patch)).collect();
        let reflected = pilot.patches.iter().zip(&radiosity).map(|(patch, &radiosity)| {
            (radiosity - emission(&space.scene, patch.polygon)).length_squared() * patch.area
        });
        let budget = wanted.relative_l2 * wanted.relative_l2 * reflected.sum::<f64>();
        // The patches of lamps determine the number of shots, so they are not refined.
        let lamp = |patch: &Patch| emission(&space.scene, patch.polygon) != Rgb::ZERO;
        let errors = errors(&pilot, &radiosity).into_iter().zip(&pilot.patches);
        let errors: Vec<f64> =
            errors.map(|(error, patch)| if lamp(patch) { 0.0 } else { error }).collect();
        let depths = depths(&errors, budget, wanted.most_halvings);
        let refinement = Refinement { pilot, depths, shots };
        let depth = |polygon, slot: &[DVec3], edges| refinement.depth(polygon, slot, edges);
        coarse.check_refined(&space.scene, Some(&depth))?;
        Ok(refinement)
    }

    /// Meshes a block of cells with patches of the given size, and smaller ones where needed.
    pub fn mesh(&self, space: &Space, block: Block, size: PatchSize) -> LocalEnvironment {
        let depth = |polygon, slot: &[DVec3], edges| self.depth(polygon, slot, edges);
        LocalEnvironment::meshed(space, block, size, Some(&depth))
    }

    /// How often a slot with given edge lengths must be halved: the most needed anywhere in it.
    fn depth(&self, polygon: u32, slot: &[DVec3], edges: [f64; 2]) -> u32 {
        let Some(piece) = self.pilot.piece(polygon) else { return 0 };
        let Piece { u, v, .. } = self.pilot.pieces[piece as usize];
        let (area, centre) = area_and_centroid(slot);
        let within = slot.iter().map(|&corner| (corner + centre) / 2.0).filter(|_| area > 0.0);
        let depth = |point: DVec3| {
            let patch = self.pilot.patch_of(piece, point)?;
            // Twice the edges of the pilot's patch, halved `depths[patch]` times.
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

/// The number of halvings stays below this.
const MOST_HALVINGS: u32 = 8;

fn emission(scene: &Scene, polygon: u32) -> Rgb {
    scene.material_of(polygon).emission
}

/// Squared error of each patch, if it were twice as long and wide, as in the mesh to refine.
fn errors(pilot: &LocalEnvironment, radiosity: &[Rgb]) -> Vec<f64> {
    // Sum and number of squared changes towards the neighbours along u and along v.
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

/// How often each patch must be halved so that the sum of the errors is within a budget, if
/// possible. From one halving of a patch to the next, the gain per new patch falls to a sixteenth.
fn depths(errors: &[f64], budget: f64, most: u32) -> Vec<u32> {
    let most = most.min(MOST_HALVINGS - 1);
    let left = |error: f64, depth: u32| error / f64::from(4u32.pow(depth));
    let mut depths = vec![0; errors.len()];
    let mut threshold = errors.iter().copied().fold(0.0, f64::max);
    let sum =
        |depths: &[u32]| -> f64 { errors.iter().zip(depths).map(|(&e, &d)| left(e, d)).sum() };
    // After this many steps there is nothing more to gain.
    for _ in 0..64 {
        if sum(&depths) <= budget {
            break;
        }
        threshold /= 2.0;
        for (depth, &error) in depths.iter_mut().zip(errors) {
            while *depth < most && left(left(error, *depth), *depth) > threshold {
                *depth += 1;
            }
        }
    }
    depths
}
