//! Errors of scene files and of faces that do not form a scene.

use std::path::PathBuf;

use glam::DVec3;

use super::scene::{Material, Rgb};

/// Largest allowed coordinate, metres. Beyond it f64 no longer resolves the details of a scene.
pub(crate) const FARTHEST: f64 = 1e12;

/// Why a scene cannot be read or built.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// A file cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// A file has invalid content.
    #[error("{place}: {problem}")]
    InFile {
        /// File, and line if it is known.
        place: String,
        /// The problem, with the value found and what was expected.
        problem: String,
    },
    /// Faces or materials that do not make a scene: what was found and what was expected.
    #[error("{0}")]
    Invalid(String),
    /// A coordinate is not finite or too large.
    #[error(
        "{place}: corner at ({}, {}, {}); expected finite coordinates of at most {FARTHEST:e} m",
        at.x, at.y, at.z
    )]
    Corner {
        /// Object and number of the face.
        place: String,
        /// The corner, world coordinates.
        at: DVec3,
    },
}

impl Material {
    /// Checks that reflectance and emission are physically possible.
    ///
    /// # Errors
    /// [`SceneError::Invalid`].
    pub fn check(&self) -> Result<(), SceneError> {
        let Material { name, reflectance, emission, .. } = self;
        let wrong = |what: &str, Rgb { x, y, z }: Rgb, expected: &str| {
            let found = format!("material \"{name}\": {what} is {x} {y} {z}");
            Err(SceneError::Invalid(format!("{found}; expected {expected}")))
        };
        if !(reflectance.cmpge(Rgb::ZERO) & reflectance.cmplt(Rgb::ONE)).all() {
            return wrong("reflectance (Kd)", *reflectance, "0 or more and less than 1");
        }
        if !(emission.is_finite() && emission.cmpge(Rgb::ZERO).all()) {
            return wrong("emission (Ke)", *emission, "finite values, 0 or more");
        }
        Ok(())
    }
}
