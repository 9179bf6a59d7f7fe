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
    /// No face has an area.
    #[error("no surface: {faces} faces, none with an area; expected at least one")]
    NoSurface {
        /// Faces given.
        faces: usize,
    },
    /// More corners than 32-bit indices can count.
    #[error("{corners} corners of faces; expected at most {}", u32::MAX / 2)]
    TooMany {
        /// Corners of all faces.
        corners: usize,
    },
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
    /// A face refers to a material or an object that does not exist.
    #[error("face {face} has {what} {index}; expected less than {count}")]
    Index {
        /// Number of the face, from 1.
        face: usize,
        /// "material" or "object".
        what: &'static str,
        /// Its index.
        index: u32,
        /// Number of materials or objects.
        count: usize,
    },
    /// A reflectance is not in [0, 1).
    #[error(
        "material \"{material}\": reflectance (Kd) is {} {} {}; expected 0 or more and less than 1",
        value.x, value.y, value.z
    )]
    Reflectance {
        /// Name of the material.
        material: String,
        /// Its reflectance.
        value: Rgb,
    },
    /// An emission is negative or not finite.
    #[error(
        "material \"{material}\": emission (Ke) is {} {} {}; expected finite values, 0 or more",
        value.x, value.y, value.z
    )]
    Emission {
        /// Name of the material.
        material: String,
        /// Its emission, W/m².
        value: Rgb,
    },
}

impl Material {
    /// Checks that reflectance and emission are physically possible.
    ///
    /// # Errors
    /// [`SceneError::Reflectance`] or [`SceneError::Emission`].
    pub fn check(&self) -> Result<(), SceneError> {
        let (reflectance, emission) = (self.reflectance, self.emission);
        if !(reflectance.cmpge(Rgb::ZERO) & reflectance.cmplt(Rgb::ONE)).all() {
            return Err(SceneError::Reflectance {
                material: self.name.clone(),
                value: reflectance,
            });
        }
        if !(emission.is_finite() && emission.cmpge(Rgb::ZERO).all()) {
            return Err(SceneError::Emission { material: self.name.clone(), value: emission });
        }
        Ok(())
    }
}
