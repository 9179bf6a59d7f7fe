//! What all nodes of a run share, and the look-ahead that they feed.

use std::borrow::Cow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use multicomputer::Rank;
use radiosity::Shot;

use crate::kept_shots::KeptShots;
use crate::message::Source;
use crate::problem::Problem;
use crate::rules::Rules;

/// What all nodes of a run know.
pub(crate) struct Shared {
    pub problem: Arc<Problem>,
    pub rules: Rules,
    pub kept: Arc<KeptShots>,
    pub owners: Vec<Rank>,
    pub processors: usize,
    /// What a wall patch must be worth to be handed on.
    pub wall_threshold: f64,
    pub on_shot: Arc<dyn Fn() + Send + Sync>,
    /// Whether the last shot was one that an earlier run, or this, had asked for: then so are those
    /// that follow, as a rule.
    pub known: AtomicBool,
}

impl Shared {
    /// The service node's rank follows those of the compute nodes.
    pub(crate) fn service_node(&self) -> Rank {
        self.processors
    }

    /// Cast a source's rays, or find where they end.
    pub(crate) fn shot(&self, parcel: &Source) -> Shot {
        let (shot, known) = self.kept.shot(&self.problem, parcel);
        self.known.store(known, Ordering::Relaxed);
        shot
    }

    /// Whether it makes sense to look for shots to be cast ahead.
    pub(crate) fn want_jobs(&self) -> bool {
        !self.known.load(Ordering::Relaxed) && self.kept.helpers().want_jobs()
    }

    /// Have a shot that this run will ask for cast ahead by threads that have nothing else to do, and
    /// those that it leads to as well. Where its rays end does not depend on what happens meanwhile.
    pub(crate) fn foresee(self: &Arc<Self>, parcel: Cow<'_, Source>) {
        if !self.want_jobs() {
            return;
        }
        if !self.kept.foresee(&parcel) {
            return;
        }
        let (shared, parcel) = (Arc::clone(self), parcel.into_owned());
        self.kept.helpers().add(Box::new(move || {
            let Shared { problem, kept, .. } = &*shared;
            kept.cast_ahead(problem, &parcel, |shot| {
                let onward = problem.onward(&parcel, shot);
                onward.for_each(|parcel| shared.foresee(Cow::Owned(parcel)));
            });
        }));
    }
}
