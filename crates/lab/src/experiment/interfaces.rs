//! The fields `interfaces` and `virtual_walls`: what carries light from one local environment to the next.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::files::counts::{Counts, Pair};
use crate::files::quantity::Fraction;

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
