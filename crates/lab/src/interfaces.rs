//! What carries light across from one local environment to the next, as an experiment says it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::experiment::Experiment;
use crate::quantity::{Counts, Fraction, Pair};
use crate::settings::WrongField;

/// What carries light across from one local environment to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Interfaces {
    /// Visibility masks. Paper: §3.2.
    #[default]
    Masks,
    /// Virtual walls, which masks came after. Paper: §3, reference [1].
    VirtualWalls,
}

impl Interfaces {
    pub(crate) fn are_masks(&self) -> bool {
        *self == Interfaces::Masks
    }
}

/// How virtual walls are meshed. Where "interfaces" are "masks" it does not matter.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct VirtualWalls {
    /// Wall patches of an interface between two local environments, along its two axes in the order x, y,
    /// z, such as "8x8". Choice C40: unpublished.
    pub patches: Pair,
    /// Bins along each side of the square of directions over a wall patch; 1 is a diffuse wall patch.
    /// Choice C40: unpublished.
    #[schemars(range(min = 1, max = 64))]
    pub directions: u32,
    /// Rays that a wall patch emits where all its bins hold energy. Default: the hemisphere's pixels.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub rays: Option<u32>,
    /// A wall patch hands nothing on under this share of what the brightest patch begins with; what it
    /// keeps counts as unshot. Choice C41: unpublished.
    pub threshold: Fraction,
}

impl Default for VirtualWalls {
    fn default() -> VirtualWalls {
        VirtualWalls {
            patches: Counts([8, 8]),
            directions: 8,
            rays: None,
            threshold: Fraction::parse("0.01 %").expect("0.01 % is a fraction"),
        }
    }
}

impl VirtualWalls {
    pub(crate) fn are_default(&self) -> bool {
        *self == VirtualWalls::default()
    }
}

/// A mesh of virtual walls: what of it decides what a shot does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct WallMesh {
    /// Wall patches along the two axes of an interface.
    pub patches: Pair,
    /// Bins along each side of the square of directions.
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
