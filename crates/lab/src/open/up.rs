//! The upward direction of a scene description.

use radiosity::glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The axis that points up. It changes pictures, not light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
pub enum Up {
    #[serde(rename = "x")]
    X,
    #[serde(rename = "-x")]
    MinusX,
    #[serde(rename = "y")]
    Y,
    #[serde(rename = "-y")]
    MinusY,
    #[default]
    #[serde(rename = "z")]
    Z,
    #[serde(rename = "-z")]
    MinusZ,
}

impl Up {
    /// As a unit vector.
    pub fn direction(self) -> DVec3 {
        match self {
            Up::X => DVec3::X,
            Up::MinusX => DVec3::NEG_X,
            Up::Y => DVec3::Y,
            Up::MinusY => DVec3::NEG_Y,
            Up::Z => DVec3::Z,
            Up::MinusZ => DVec3::NEG_Z,
        }
    }
}
