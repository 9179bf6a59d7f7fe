//! A scene made ready: meshed, cut into environments, with its hemisphere.

use radiosity::{Hemisphere, LocalEnvironment, Outgoing, PatchSize, Rgb, Scene, Shot, Side, Space};
use thiserror::Error;

use crate::decomposition::Decomposition;
use crate::message::Parcel;

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
}

impl Problem {
    /// Mesh and cut a scene.
    pub fn new(scene: Scene, options: ProblemOptions) -> Result<Problem, ProblemError> {
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
        let environments = (0..decomposition.environments())
            .map(|e| LocalEnvironment::new(&space, decomposition.block(e), patch_size))
            .collect();
        Ok(Problem { space, decomposition, environments, hemisphere })
    }

    /// Number of patches in all environments.
    pub fn patches(&self) -> usize {
        self.environments.iter().map(|e| e.patches.len()).sum()
    }

    /// A source with what is left of its mask, for each neighbour that it enters (§4.2.3).
    pub fn onward(
        &self,
        parcel: &Parcel,
        shot: &Shot,
        pixels_a_bit: u32,
    ) -> impl Iterator<Item = Parcel> {
        let (from, source) = (parcel.environment, parcel.source);
        Side::ALL.into_iter().zip(&shot.outgoing).filter_map(move |(side, outgoing)| {
            let Outgoing { mask, form_factor } = outgoing.clone()?;
            let environment = self.decomposition.neighbour(from, side);
            let parcel = Parcel { environment, source, mask, form_factor };
            Some(if pixels_a_bit == 1 { parcel } else { self.coarsened(parcel, pixels_a_bit) })
        })
    }

    /// A parcel whose mask has a bit for so many pixels, and as much energy as before.
    fn coarsened(&self, mut parcel: Parcel, pixels_a_bit: u32) -> Parcel {
        parcel.mask = parcel.mask.coarsened(pixels_a_bit);
        let form_factor = self.hemisphere.form_factor(&parcel.mask);
        if form_factor > 0.0 {
            parcel.source.power *= parcel.form_factor / form_factor;
            parcel.form_factor = form_factor;
        }
        parcel
    }

    /// Power that the scene emits, W.
    pub fn emitted_power(&self) -> Rgb {
        let power = |e: &LocalEnvironment| -> Rgb {
            (0..e.patches.len() as u32).map(|p| e.emitted_power(&self.space, p)).sum()
        };
        self.environments.iter().map(power).sum()
    }
}
