//! A scene in its grid, cut into local environments that are not meshed yet.

use radiosity::{
    DepthBits, Hemisphere, LocalEnvironment, PatchSize, Refinement, RefinementError, Scene, Space,
    TooManyPatches, Wanted,
};
use thiserror::Error;

use super::decomposition::Decomposition;
use super::hemispheres::SmallerHemispheres;
use super::problem::Problem;

/// How a scene is meshed and cut.
#[derive(Clone, Debug)]
pub struct ProblemOptions {
    /// Longest edges of patches.
    pub patch_size: PatchSize,
    /// Cells of the global grid along each axis.
    pub cells: [u32; 3],
    /// Local environments along each axis.
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
    /// No environment along an axis, or more than cells: cut planes must be planes of the grid.
    #[error("a cut into {cut:?} environments; expected 1 to {cells:?}, the cells of the grid")]
    Cut {
        /// Environments asked for, along each axis.
        cut: [u32; 3],
        /// Cells of the grid, along each axis.
        cells: [u32; 3],
    },
    /// A size that no quad-tree can reach.
    #[error("a patch size of {0} m; expected a positive length of at least {1} m for this scene")]
    PatchSize(f64, f64),
    /// A size that makes too many patches.
    #[error(transparent)]
    Patches(#[from] TooManyPatches),
}

/// The most cells of a grid: a cell's index fits 32 bits, and their table fits memory.
const MOST_CELLS: u64 = 1 << 28;

/// A scene in its grid, cut. Its local environments can be meshed one by one, on any thread.
pub struct CutScene {
    space: Space,
    decomposition: Decomposition,
    patch_size: PatchSize,
    hemisphere: Hemisphere,
    refinement: Option<Refinement>,
}

impl CutScene {
    /// Cut a scene.
    ///
    /// # Errors
    /// If the options are impossible for this scene.
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
        patch_size.check(&scene)?;
        let space = Space::new(scene, cells);
        let decomposition = Decomposition::new(cells, cut);
        Ok(CutScene { space, decomposition, patch_size, hemisphere, refinement: None })
    }

    /// The same with smaller patches where a pilot run finds that radiosity changes.
    ///
    /// # Errors
    /// Those of [`Refinement::new`].
    pub fn refined(self, wanted: Wanted) -> Result<CutScene, RefinementError> {
        let refinement = Refinement::new(&self.space, self.patch_size, wanted)?;
        Ok(CutScene { refinement: Some(refinement), ..self })
    }

    /// The number of local environments.
    pub fn environments(&self) -> u32 {
        self.decomposition.environments()
    }

    /// Mesh one local environment.
    pub fn environment(&self, number: u32) -> LocalEnvironment {
        let block = self.decomposition.block(number);
        match &self.refinement {
            Some(refinement) => refinement.mesh(&self.space, block, self.patch_size),
            None => LocalEnvironment::new(&self.space, block, self.patch_size),
        }
    }

    /// The problem, from its meshed local environments in the order of their numbers.
    pub fn with(self, environments: Vec<LocalEnvironment>) -> Problem {
        Problem {
            space: self.space,
            decomposition: self.decomposition,
            environments,
            hemisphere: self.hemisphere,
            smaller_hemispheres: SmallerHemispheres::default(),
            refinement: self.refinement,
            walls: None,
            depth_bits: DepthBits::Sixteen,
        }
    }
}

impl Problem {
    /// Mesh and cut a scene.
    ///
    /// # Errors
    /// If the options are impossible for this scene.
    pub fn new(scene: Scene, options: ProblemOptions) -> Result<Problem, ProblemError> {
        let cut = CutScene::new(scene, options)?;
        let environments = (0..cut.environments()).map(|e| cut.environment(e)).collect();
        Ok(cut.with(environments))
    }
}
