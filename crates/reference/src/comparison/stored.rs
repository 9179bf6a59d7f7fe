//! The file format of a reference solution.

use radiosity::Rgb;
use serde::{Deserialize, Serialize};

use crate::solutions::dense::Solution;
use crate::solutions::patches::Patches;
use crate::solutions::paths::Problem;

/// A solution with its problem and method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// The problem that it solves.
    #[serde(flatten)]
    pub subject: Subject,
    /// The error relative to the reflected radiosity (radiosity less emission), both as area-weighted root
    /// mean squares over all patches and colours.
    pub relative_l2_error: f64,
    /// Radiosity of each patch: red, green, blue, W/m².
    pub radiosity: Vec<[f64; 3]>,
    /// Error of each patch, W/m²: a bound for the dense method, a standard error for paths.
    pub error: Vec<[f64; 3]>,
}

/// Scene, mesh, problem and method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Subject {
    /// The scene's name.
    pub scene: String,
    /// SHA-256 of the patches: shapes, reflectances, emissions ([`Patches::digest`]).
    pub patches_sha256: String,
    /// Longest edge of a patch, metres.
    pub patch_size_m: f64,
    /// Longest edge of a patch that emits light, metres.
    pub emitter_patch_size_m: f64,
    /// Cells along x, y and z.
    pub cells: [u32; 3],
    /// The problem.
    pub problem: Problem,
    /// The method.
    pub method: Method,
}

/// The method by which a reference was computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Exact form factors, and their system solved to machine precision.
    Dense {
        /// Bound of the sum of the errors of the form factors of a patch.
        tolerance: f64,
    },
    /// Paths from the emitters.
    Paths {
        /// Paths in each round.
        paths_a_round: u32,
        /// Number of independent rounds.
        rounds: u32,
        /// Seed of the random numbers.
        seed: u64,
    },
}

/// Why a solution can't be a reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoReference {
    /// Errors are relative to the light that is reflected.
    #[error("no light is reflected; expected some, since errors are relative to it")]
    Dark,
    /// A radiosity or an error is NaN or infinite.
    #[error("patch {0} has a radiosity or an error that is not finite; expected finite numbers")]
    NotFinite(usize),
}

impl Reference {
    /// The reference for a solution on the given patches.
    ///
    /// # Errors
    /// If the solution reflects nothing, or if a number is not finite.
    pub fn new(
        subject: Subject,
        patches: &Patches,
        solution: &Solution,
    ) -> Result<Reference, NoReference> {
        let finite = |(radiosity, error): (&Rgb, &Rgb)| radiosity.is_finite() && error.is_finite();
        if let Some(patch) = solution.radiosity.iter().zip(&solution.error).position(|p| !finite(p))
        {
            return Err(NoReference::NotFinite(patch));
        }
        let errors: Vec<[f64; 3]> = solution.error.iter().map(|c| c.to_array()).collect();
        let both = solution.radiosity.iter().map(|c| c.to_array()).zip(&errors);
        let shortened = |(radiosity, error): ([f64; 3], &[f64; 3])| {
            [0, 1, 2].map(|colour| rounded(radiosity[colour], error[colour]))
        };
        let whole = |error: &[f64; 3]| error.map(|error| rounded(error, error));
        Ok(Reference {
            subject,
            relative_l2_error: solution.relative_l2_error(patches).ok_or(NoReference::Dark)?,
            radiosity: both.map(shortened).collect(),
            error: errors.iter().map(whole).collect(),
        })
    }
}

/// A number rounded to about a hundredth of its error, to keep files short.
fn rounded(number: f64, error: f64) -> f64 {
    let exponent = format!("{error:e}").split_once('e').and_then(|(_, e)| e.parse::<i32>().ok());
    match exponent {
        Some(exponent) if error > 0.0 && exponent > -15 => {
            let decimals = (2 - exponent).max(0) as usize;
            format!("{number:.decimals$}").parse().unwrap_or(number)
        }
        _ => number,
    }
}
