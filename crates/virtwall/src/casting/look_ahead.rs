//! Gets the shots of one run, and has shots that it will need cast ahead of time.

use std::borrow::Cow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use radiosity::{Emitter, Shot};

use super::kept_shots::KeptShots;
use crate::problem::{Problem, Shooting, Source};

/// Obtains the shots of one run, and has those that it will ask for cast ahead by idle threads.
pub(crate) struct LookAhead {
    problem: Arc<Problem>,
    shooting: Shooting,
    kept: Arc<KeptShots>,
    /// Whether the last shot had been requested before. Then the following ones usually have been, too.
    known: AtomicBool,
}

impl LookAhead {
    pub fn new(problem: &Arc<Problem>, shooting: Shooting, kept: &Arc<KeptShots>) -> LookAhead {
        let (problem, kept) = (Arc::clone(problem), Arc::clone(kept));
        LookAhead { problem, shooting, kept, known: AtomicBool::default() }
    }

    /// The shot of a source: a kept one, or cast now.
    pub fn cast(&self, source: &Source) -> Shot {
        let (shot, known) = self.kept.shot(&self.problem, source);
        self.known.store(known, Ordering::Relaxed);
        shot
    }

    fn wants_jobs(&self) -> bool {
        !self.known.load(Ordering::Relaxed) && self.kept.helpers().want_jobs()
    }

    /// A patch will be shot sooner or later.
    pub fn foresee_patch(self: &Arc<Self>, emitter: &Emitter) {
        if self.wants_jobs() {
            // Where rays end does not depend on the number of the shot.
            let sources = self.problem.sources_of(0, *emitter, &self.shooting);
            sources.into_iter().for_each(|source| self.foresee(Cow::Owned(source)));
        }
    }

    /// A source will be shot: have it cast ahead, and those that it leads to as well. Where its rays end does
    /// not depend on what happens meanwhile.
    pub fn foresee(self: &Arc<Self>, source: Cow<'_, Source>) {
        // Most sources are known already. They are not copied.
        if !self.wants_jobs() || !self.kept.foresee(&source) {
            return;
        }
        let (run, source) = (Arc::clone(self), source.into_owned());
        self.kept.helpers().add(Box::new(move || {
            run.kept.cast_ahead(&run.problem, &source, |shot| {
                let onward = run.problem.onward(&source, shot);
                onward.for_each(|source| run.foresee(Cow::Owned(source)));
            });
        }));
    }
}
