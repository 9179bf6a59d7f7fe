//! A reference as it is stored, for others to be held against.

use serde::{Deserialize, Serialize};

use crate::dense::Solution;
use crate::patches::Patches;
use crate::paths::Problem;

/// A solution, what it is of, and how it was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// What it is of.
    #[serde(flatten)]
    pub subject: Subject,
    /// The errors over what is reflected, radiosity less emission, both as area-weighted root mean
    /// squares over all patches and colours.
    pub relative_l2_error: f64,
    /// Radiosity of each patch: red, green, blue, W/m².
    pub radiosity: Vec<[f64; 3]>,
    /// How far each may be off, W/m²: a bound if dense, a standard error of paths.
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
    /// Which problem it solves.
    pub problem: Problem,
    /// How.
    pub method: Method,
}

/// How a reference was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Exact form factors, and their system solved to machine precision.
    Dense {
        /// What the errors of a patch's form factors may add up to.
        tolerance: f64,
    },
    /// Paths from the emitters.
    Paths {
        /// Of each round.
        paths_a_round: u32,
        /// Independent of one another.
        rounds: u32,
        /// Of the random numbers.
        seed: u64,
    },
}

impl Reference {
    /// A solution of a subject, on the patches that it is of.
    pub fn new(subject: Subject, patches: &Patches, solution: &Solution) -> Reference {
        let errors: Vec<[f64; 3]> = solution.error.iter().map(|c| c.to_array()).collect();
        let both = solution.radiosity.iter().map(|c| c.to_array()).zip(&errors);
        let told = |(radiosity, error): ([f64; 3], &[f64; 3])| {
            [0, 1, 2].map(|colour| rounded(radiosity[colour], error[colour]))
        };
        let whole = |error: &[f64; 3]| error.map(|error| rounded(error, error));
        Reference {
            subject,
            relative_l2_error: solution.relative_l2_error(patches),
            radiosity: both.map(told).collect(),
            error: errors.iter().map(whole).collect(),
        }
    }
}

/// A number to some hundredths of its error, as a file need tell no more.
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
