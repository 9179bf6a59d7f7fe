//! Errors of scene files and of faces that do not form a scene.

use std::path::PathBuf;

use glam::DVec3;

use super::scene::{Material, Rgb};

/// Largest allowed coordinate, metres. Beyond it f64 no longer resolves the details of a scene.
pub(crate) const FARTHEST: f64 = 1e12;

/// Least and largest emission, W/m². Beyond them powers, and squares of them, could overflow or vanish.
const LEAST_EMISSION: f64 = 1e-30;
const MOST_EMISSION: f64 = 1e30;

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
        "{place}: corner at {}; expected finite coordinates of at most {FARTHEST:e} m",
        values(*at)
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
        self.check_reflectance().and_then(|()| self.check_emission()).map_err(SceneError::Invalid)
    }

    pub(crate) fn check_reflectance(&self) -> Result<(), String> {
        let Material { name, reflectance, .. } = self;
        if (reflectance.cmpge(Rgb::ZERO) & reflectance.cmple(Rgb::ONE)).all() {
            return Ok(());
        }
        let found = format!("material \"{name}\": reflectance (Kd) is {}", values(*reflectance));
        Err(format!("{found}; expected 0 to 1"))
    }

    pub(crate) fn check_emission(&self) -> Result<(), String> {
        let Material { name, emission, .. } = self;
        // NaN fails the comparison too.
        let possible = |&e: &f64| e == 0.0 || (LEAST_EMISSION..=MOST_EMISSION).contains(&e);
        if emission.to_array().iter().all(possible) {
            return Ok(());
        }
        let found = format!("material \"{name}\": emission (Ke) is {}", values(*emission));
        Err(format!("{found}; expected 0, or {LEAST_EMISSION:e} to {MOST_EMISSION:e} W/m²"))
    }
}

/// Three numbers as a message shows them: very large and very small ones with an exponent.
pub(crate) fn values(rgb: Rgb) -> String {
    let text = |value: f64| match value.abs() {
        size if size.is_finite() && size != 0.0 && !(1e-6..1e7).contains(&size) => {
            format!("{value:e}")
        }
        _ => value.to_string(),
    };
    rgb.to_array().map(text).join(" ")
}
