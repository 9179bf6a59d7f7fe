//! A mesh of virtual walls.

use serde::Serialize;

use crate::experiment::fields::Experiment;
use crate::experiment::interfaces::VirtualWalls;
use crate::files::WrongField;
use crate::files::counts::Pair;

/// A mesh of virtual walls: the part of the settings that decides shots.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct WallMesh {
    pub patches: Pair,
    pub directions: u32,
    /// Rays a wall patch.
    pub rays: u32,
}

impl WallMesh {
    /// The mesh of an experiment's virtual walls, if it has any.
    ///
    /// # Errors
    /// A threshold that would let ever less energy go on for ever.
    pub fn of(point: &Experiment) -> Result<Option<WallMesh>, WrongField> {
        if point.interfaces.are_masks() {
            return Ok(None);
        }
        let VirtualWalls { patches, directions, rays, threshold } = &point.virtual_walls;
        if threshold.value() == 0.0 {
            let message = "0 %; expected more: virtual walls hand on ever less, for ever";
            return Err(("virtual_walls.threshold", message.to_owned()));
        }
        let rays = rays.unwrap_or(point.hemisphere.pixels);
        Ok(Some(WallMesh { patches: *patches, directions: *directions, rays }))
    }
}
