//! Why something is not a scene.

use std::path::PathBuf;

use glam::DVec3;

use super::scene::{Material, Rgb};

/// Greatest coordinate, metres; farther out f64 no longer resolves what a scene is made of.
pub(crate) const FARTHEST: f64 = 1e12;

/// Why faces and materials do not make a scene.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// A file that cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A file that does not say what it should.
    #[error("{place}: {problem}")]
    InFile {
        /// File, and line where it is known.
        place: String,
        /// What is wrong there, with the value and what was expected.
        problem: String,
    },
    /// Nothing that light could fall on.
    #[error("no surface: {faces} faces, none with an area; expected at least one")]
    NoSurface {
        /// Faces given.
        faces: usize,
    },
    /// More than 32-bit indices can count.
    #[error("{corners} corners of faces; expected at most {}", u32::MAX / 2)]
    TooMany {
        /// Corners of all faces.
        corners: usize,
    },
    /// A corner that is nowhere.
    #[error(
        "{place}: corner at ({}, {}, {}); expected finite coordinates of at most {FARTHEST:e} m",
        at.x, at.y, at.z
    )]
    Corner {
        /// The face.
        place: String,
        /// Its corner, world coordinates.
        at: DVec3,
    },
    /// A face of a material or an object that does not exist.
    #[error("face {face} has {what} {index}; expected less than {count}")]
    Index {
        /// Number of the face, from 1.
        face: usize,
        /// "material" or "object".
        what: &'static str,
        /// Its index.
        index: u32,
        /// How many there are.
        count: usize,
    },
    /// A surface that would send back more than falls on it, or less than nothing.
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
    /// Negative light.
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
    /// Refuses reflectances and emissions that no surface can have.
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
