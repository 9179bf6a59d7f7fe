//! The error of a run: how far its radiosities are from the reference solution.

use std::sync::Arc;

use radiosity::Rgb;
use reference::{Difference, Overlaps, Patches};
use virtwall::Problem;

use crate::accuracy::answer::Answer;
use crate::engine::error_figures::ErrorFigures;

/// Measures errors against an answer: the answer, and the overlaps of its patches with a problem's.
pub struct ErrorMeasure {
    pub answer: Arc<Answer>,
    pub overlaps: Overlaps,
}

impl ErrorMeasure {
    pub fn new(answer: &Arc<Answer>, problem: &Problem) -> ErrorMeasure {
        let own = Patches::of_all(&problem.space, &problem.environments);
        let overlaps = Overlaps::new(&answer.patches, &own);
        ErrorMeasure { answer: Arc::clone(answer), overlaps }
    }

    /// How far two solutions, as means over the answer's patches, are apart.
    pub fn between(&self, one: &[Rgb], other: &[Rgb]) -> Difference {
        let Answer { patches, radiosity, .. } = &*self.answer;
        Difference::between(patches, radiosity, one, other)
    }

    /// How far a solution is from the answer.
    pub fn errors(&self, radiosity: &[Vec<Rgb>]) -> ErrorFigures {
        let found = self.between(&self.overlaps.means(&radiosity.concat()), &self.answer.radiosity);
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
