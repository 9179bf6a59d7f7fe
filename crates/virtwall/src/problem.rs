//! A scene made ready: meshed, cut into environments, with its hemisphere.

use radiosity::{
    Bounds, DepthBits, Emitter, Hemisphere, HemisphereError, LocalEnvironment, Mask, Outgoing,
    PatchSize, Refinement, Rgb, Scene, Shot, Side, Space, VirtualWalls, Wanted,
};
use thiserror::Error;

use crate::decomposition::Decomposition;
use crate::ladder::Ladder;
use crate::message::Source;
use crate::wall_patch::WallPatch;

/// How a scene is meshed and cut.
#[derive(Clone, Debug)]
pub struct ProblemOptions {
    /// Sizes that quad-trees go down to.
    pub patch_size: PatchSize,
    /// Cells of the global grid on each axis.
    pub cells: [u32; 3],
    /// Environments on each axis.
    pub cut: [u32; 3],
    /// The hemisphere over every source.
    pub hemisphere: Hemisphere,
}

/// Options that no problem can be made with.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ProblemError {
    /// No cell, or far too many.
    #[error("a grid of {0:?} cells; expected 1 to {MOST_CELLS} cells in all")]
    Cells([u32; 3]),
    /// Cut planes must lie on the grid.
    #[error("a cut into {cut:?} environments; expected 1 to {cells:?}, the cells of the grid")]
    Cut {
        /// What was asked for.
        cut: [u32; 3],
        /// What there is.
        cells: [u32; 3],
    },
    /// A size that no quad-tree can reach.
    #[error("a patch size of {0} m; expected a positive length of at least {1} m for this scene")]
    PatchSize(f64, f64),
}

/// The most cells that a grid may have: their index fits 32 bits and their table memory.
pub const MOST_CELLS: u64 = 1 << 28;

/// A scene, meshed and cut. Runs on any number of processors share one.
pub struct Problem {
    /// The scene in its grid.
    pub space: Space,
    /// How space is cut.
    pub decomposition: Decomposition,
    /// The environments by number.
    pub environments: Vec<LocalEnvironment>,
    /// The hemisphere over every source.
    pub hemisphere: Hemisphere,
    /// Smaller ones over dimmer sources.
    ladder: Ladder,
    /// What a pilot run found of where the mesh is to be finer, if one was made.
    pub refinement: Option<Refinement>,
    /// Virtual walls between environments; without them masks carry the light across.
    pub walls: Option<VirtualWalls>,
    /// Integers of masks, in a scene with participating media.
    pub depth_bits: DepthBits,
}

/// A scene in its grid, cut, its environments yet to be meshed: each by itself, on whatever thread.
pub struct CutScene {
    space: Space,
    decomposition: Decomposition,
    patch_size: PatchSize,
    hemisphere: Hemisphere,
    refinement: Option<Refinement>,
}

impl CutScene {
    /// Cut a scene.
    pub fn new(scene: Scene, options: ProblemOptions) -> Result<CutScene, ProblemError> {
        let ProblemOptions { patch_size, cells, cut, hemisphere } = options;
        let count = cells.iter().map(|&n| u64::from(n)).try_fold(1, u64::checked_mul);
        if !count.is_some_and(|count| (1..=MOST_CELLS).contains(&count)) {
            return Err(ProblemError::Cells(cells));
        }
        if (0..3).any(|axis| !(1..=cells[axis]).contains(&cut[axis])) {
            return Err(ProblemError::Cut { cut, cells });
        }
        let least = scene.bounds.size().length() * 1e-5;
        for size in [patch_size.reflector, patch_size.emitter] {
            if !(size >= least && size.is_finite()) {
                return Err(ProblemError::PatchSize(size, least));
            }
        }
        let space = Space::new(scene, cells);
        let decomposition = Decomposition::new(cells, cut);
        Ok(CutScene { space, decomposition, patch_size, hemisphere, refinement: None })
    }

    /// The same, its patches smaller where a pilot finds that this is wanted.
    ///
    /// # Errors
    /// Those of [`Refinement::new`].
    pub fn refined(self, wanted: Wanted) -> Result<CutScene, HemisphereError> {
        let refinement = Refinement::new(&self.space, self.patch_size, wanted)?;
        Ok(CutScene { refinement: Some(refinement), ..self })
    }

    /// How many environments there are.
    pub fn environments(&self) -> u32 {
        self.decomposition.environments()
    }

    /// Mesh one of them.
    pub fn environment(&self, number: u32) -> LocalEnvironment {
        let block = self.decomposition.block(number);
        match &self.refinement {
            Some(refinement) => refinement.mesh(&self.space, block, self.patch_size),
            None => LocalEnvironment::new(&self.space, block, self.patch_size),
        }
    }

    /// The problem that all of them, by number, make up.
    pub fn with(self, environments: Vec<LocalEnvironment>) -> Problem {
        let CutScene { space, decomposition, hemisphere, refinement, .. } = self;
        let (ladder, walls, depth_bits) = (Ladder::default(), None, DepthBits::Sixteen);
        Problem {
            space,
            decomposition,
            environments,
            hemisphere,
            ladder,
            refinement,
            walls,
            depth_bits,
        }
    }
}

impl Problem {
    /// Mesh and cut a scene.
    pub fn new(scene: Scene, options: ProblemOptions) -> Result<Problem, ProblemError> {
        let cut = CutScene::new(scene, options)?;
        let environments = (0..cut.environments()).map(|e| cut.environment(e)).collect();
        Ok(cut.with(environments))
    }

    /// The same with virtual walls in place of masks.
    pub fn with_walls(self, walls: VirtualWalls) -> Problem {
        Problem { walls: Some(walls), ..self }
    }

    /// The same with other integers than of sixteen bits in masks, where there are media.
    pub fn with_depth_bits(self, depth_bits: DepthBits) -> Problem {
        Problem { depth_bits, ..self }
    }

    /// The same with these hemispheres over dimmer sources, each smaller than its own.
    pub fn with_smaller_hemispheres(mut self, smaller: Vec<Hemisphere>) -> Problem {
        let powers = self.environments.iter().flat_map(|environment| {
            let patches = 0..environment.patches.len() as u32;
            patches.map(|patch| environment.emitted_power(&self.space, patch).element_sum())
        });
        let brightest = powers.fold(0.0, f64::max);
        self.ladder = Ladder::new(smaller, brightest / f64::from(self.hemisphere.pixels()));
        self
    }

    /// The hemisphere over a source of so much power, W.
    pub fn hemisphere_for(&self, power: Rgb) -> &Hemisphere {
        self.ladder.rung_for(power).unwrap_or(&self.hemisphere)
    }

    /// The hemisphere that a mask belongs to.
    pub fn hemisphere_of(&self, mask: &Mask) -> &Hemisphere {
        self.ladder.rung_of(mask).unwrap_or(&self.hemisphere)
    }

    /// All hemispheres, the largest first.
    pub(crate) fn hemispheres(&self) -> impl Iterator<Item = &Hemisphere> {
        [&self.hemisphere].into_iter().chain(self.ladder.rungs())
    }

    /// The mask that a patch shoots so much power with, W: all visible, nothing dimmed (§3.3).
    pub(crate) fn clear_mask(&self, power: Rgb) -> Mask {
        let mask = Mask::all(self.hemisphere_for(power).pixels());
        let dims = !self.space.scene.media.is_empty() && self.walls.is_none();
        if dims { mask.with_depths(self.depth_bits) } else { mask }
    }

    /// Number of patches in all environments.
    pub fn patches(&self) -> usize {
        self.environments.iter().map(|e| e.patches.len()).sum()
    }

    /// A source with what is left of its mask, for each neighbour that it enters (§4.2.3); for none where
    /// virtual walls gather what leaves.
    pub fn onward(&self, parcel: &Source, shot: &Shot) -> impl Iterator<Item = Source> {
        let (from, source, masks) = (parcel.environment, parcel.emitter, self.walls.is_none());
        Side::ALL.into_iter().zip(&shot.outgoing).filter_map(move |(side, outgoing)| {
            let Outgoing { mask, form_factor } = outgoing.as_ref().filter(|_| masks)?;
            Some(Source {
                environment: self.decomposition.neighbour(from, side),
                emitter: source,
                mask: mask.clone(),
                form_factor: *form_factor,
            })
        })
    }

    /// The sources that a wall patch is for the environment behind it: its bins that hold power.
    pub(crate) fn bins_of(&self, wall_patch: &WallPatch) -> Vec<Source> {
        let WallPatch { environment, side, patch, power } = wall_patch;
        let Some(walls) = &self.walls else { return Vec::new() };
        let (around, side) = (self.bounds(*environment), Side::ALL[usize::from(*side)]);
        let powers = (0u32..).zip(power).filter(|(_, power)| **power != [0.0; 3]);
        let bin = |(bin, power): (u32, &[f32; 3])| {
            let power = Rgb::from_array(power.map(f64::from));
            let source = walls.emitter(&around, side, [*patch, bin], power);
            let mask = Mask::all(walls.rays_of(&source).map_or(0, Hemisphere::pixels));
            Source { environment: *environment, emitter: source, mask, form_factor: 1.0 }
        };
        powers.map(bin).collect()
    }

    /// Bins of directions on all virtual walls of an environment.
    pub(crate) fn wall_bins(&self, environment: u32) -> usize {
        let environment = &self.environments[environment as usize];
        let sides = Side::ALL.iter().filter(|&&side| environment.has_neighbour(side)).count();
        self.walls.as_ref().map_or(0, |walls| sides * (walls.patches() * walls.bins()) as usize)
    }

    /// The rays over a source, a pixel of its mask each.
    pub(crate) fn rays_of(&self, source: &Emitter, mask: &Mask) -> &Hemisphere {
        let of_wall = self.walls.as_ref().and_then(|walls| walls.rays_of(source));
        of_wall.unwrap_or_else(|| self.hemisphere_of(mask))
    }

    /// Where an environment lies.
    pub(crate) fn bounds(&self, environment: u32) -> Bounds {
        self.space.grid.bounds(&self.environments[environment as usize].block)
    }

    /// Power that the scene emits, W.
    pub fn emitted_power(&self) -> Rgb {
        let power = |e: &LocalEnvironment| -> Rgb {
            (0..e.patches.len() as u32).map(|p| e.emitted_power(&self.space, p)).sum()
        };
        self.environments.iter().map(power).sum()
    }
}
