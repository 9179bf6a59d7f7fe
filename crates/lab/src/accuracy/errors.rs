//! The error of a run: how far its radiosities are from the reference solution.

use std::sync::Arc;

use radiosity::Rgb;
use reference::{Difference, Overlaps, Patches};
use virtwall::Problem;

use crate::accuracy::answer::Answer;
use crate::engine::error_figures::ErrorFigures;

/// Radiosities of a problem's patches, by environment.
pub type Radiosity = [Vec<Rgb>];

/// Measures errors against an answer: the answer, and the overlaps of its patches with a problem's.
pub struct ErrorMeasure {
    answer: Arc<Answer>,
    overlaps: Overlaps,
}

impl ErrorMeasure {
    pub fn new(answer: &Arc<Answer>, problem: &Problem) -> ErrorMeasure {
        let own = Patches::of_all(&problem.space, &problem.environments);
        let overlaps = Overlaps::new(&answer.patches, &own);
        ErrorMeasure { answer: Arc::clone(answer), overlaps }
    }

    /// The answer's radiosities, on its own patches.
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
