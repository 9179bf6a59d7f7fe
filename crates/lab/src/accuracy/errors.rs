//! How far a run's radiosities are from the answer, as columns of the results.

use std::sync::Arc;

use radiosity::Rgb;
use reference::{Difference, Overlaps, Patches};
use serde::{Deserialize, Serialize};
use virtwall::Problem;

use crate::accuracy::answer::Answer;
use crate::engine::error_causes::Causes;

/// The columns of runs.csv: [`ErrorFigures`] by name.
pub const COLUMNS: [&str; 3] = ["error_l2", "error_max", "reference_error"];

/// How far a run's radiosities are from the answer, relative to what is reflected, as
/// [`Difference`] says.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorFigures {
    /// Area-weighted root mean square.
    pub l2: f64,
    /// The greatest of any patch and colour.
    pub maximum: f64,
    /// What the answer says of its own error.
    pub reference: f64,
    /// What makes up the first, if that was asked for.
    pub causes: Option<Causes>,
}

/// Radiosities of a problem's patches, by environment.
pub type Radiosity = [Vec<Rgb>];

/// An answer, and how its patches lie on those of a problem.
pub struct Yardstick {
    answer: Arc<Answer>,
    overlaps: Overlaps,
}

impl Yardstick {
    /// Lays an answer on a problem.
    pub fn new(answer: &Arc<Answer>, problem: &Problem) -> Yardstick {
        let own = Patches::of_all(&problem.space, &problem.environments);
        let overlaps = Overlaps::new(&answer.patches, &own);
        Yardstick { answer: Arc::clone(answer), overlaps }
    }

    /// What the answer says, on its own patches.
    pub fn radiosity(&self) -> &[Rgb] {
        &self.answer.radiosity
    }

    /// Means over the patches of the answer of a solution on those of the problem, one environment
    /// after the other.
    pub fn means(&self, radiosity: &[Rgb]) -> Vec<Rgb> {
        self.overlaps.means(radiosity)
    }

    /// How far two solutions, as means over the answer's patches, are apart.
    pub fn between(&self, one: &[Rgb], other: &[Rgb]) -> Difference {
        let Answer { patches, radiosity, .. } = &*self.answer;
        Difference::between(patches, radiosity, one, other)
    }

    /// How far a solution is from the answer.
    pub fn errors(&self, radiosity: &Radiosity) -> ErrorFigures {
        let found = self.between(&self.means(&radiosity.concat()), self.radiosity());
        ErrorFigures {
            l2: found.relative_l2,
            maximum: found.maximum,
            reference: self.answer.error,
            causes: None,
        }
    }
}

/// An answer as means over the patches of a problem, W/m².
pub fn laid_on(answer: &Answer, problem: &Problem) -> Vec<Rgb> {
    let own = Patches::of_all(&problem.space, &problem.environments);
    Overlaps::new(&own, &answer.patches).means(&answer.radiosity)
}

impl ErrorFigures {
    /// The cell of a column.
    pub fn cell(&self, column: &str) -> Option<String> {
        let value = match column {
            "error_l2" => self.l2,
            "error_max" => self.maximum,
            "reference_error" => self.reference,
            _ => return self.causes?.cell(column),
        };
        Some(format!("{value:.6e}"))
    }
}
