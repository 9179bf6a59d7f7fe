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
    /// Measures errors against an answer on its own patches.
    ///
    /// # Errors
    /// If the answer reflects no light.
    pub fn new(answer: &Arc<Answer>, problem: &Problem) -> Result<ErrorMeasure, String> {
        answer.check()?;
        let own = Patches::of_all(&problem.space, &problem.environments);
        let overlaps = Overlaps::new(&answer.patches, &own);
        Ok(ErrorMeasure { answer: Arc::clone(answer), overlaps })
    }

    /// How far two solutions, as means over the answer's patches, are apart.
    pub fn between(&self, one: &[Rgb], other: &[Rgb]) -> Difference {
        let Answer { patches, radiosity, .. } = &*self.answer;
        // Some light is reflected, as `new` has checked.
        Difference::between(patches, radiosity, one, other).unwrap_or_default()
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
