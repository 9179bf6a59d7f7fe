//! A participating medium of a scene description.

use radiosity::glam::DVec3;
use radiosity::{Bounds, Medium};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::files::quantity::Absorption;

/// A homogeneous medium that fills a box, absorbs light and does not scatter it. Paper: §3.2.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MediumFields {
    /// Least corner of the box: x, y and z in metres, in the coordinates of the OBJ file.
    pub min: [f64; 3],
    /// Greatest corner of the box.
    pub max: [f64; 3],
    /// What it absorbs, such as "0.5 /m": of a ray's light exp(-0.5) is left after a metre. Media that
    /// overlap add up.
    pub absorption: Absorption,
}

impl MediumFields {
    /// What is wrong with it, if anything is.
    pub fn fault(&self) -> Option<String> {
        let (min, max) = (self.min, self.max);
        let right = (0..3).all(|axis| min[axis] < max[axis] && (max[axis] - min[axis]).is_finite());
        (!right).then(|| format!("a box from {min:?} to {max:?}; expected \"min\" below \"max\""))
    }

    /// The medium in a scene whose coordinates begin at `origin`.
    pub fn medium(&self, origin: DVec3) -> Medium {
        let [min, max] = [self.min, self.max].map(|corner| DVec3::from(corner) - origin);
        Medium { bounds: Bounds { min, max }, absorption: self.absorption.value() }
    }
}
