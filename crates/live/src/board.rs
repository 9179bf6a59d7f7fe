//! The parts of all runs so far: the simulation writes them, viewers read them.

use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The most bytes of a run that are kept for viewers; later parts are dropped.
const MOST_BYTES: usize = 64 << 20;

/// What viewers may read. A writer never waits for a viewer: readers hold the lock only while they copy
/// references.
#[derive(Default)]
pub struct Board {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
pub(crate) struct State {
    /// Runs under way, and the one that ended last, by number.
    pub runs: BTreeMap<usize, Parts>,
    /// Numbers of runs in the order in which they began.
    pub under_way: Vec<usize>,
    /// The number of runs that have ended.
    pub ended: usize,
    /// Whether all runs have ended.
    pub finished: bool,
    /// The number of open streams.
    pub viewers: usize,
    /// The number of viewers that know of the end and have not fetched the page since.
    pub fetching: usize,
}

/// The parts of one run.
#[derive(Default)]
pub(crate) struct Parts {
    pub parts: Vec<Arc<str>>,
    bytes: usize,
    /// Whether parts were dropped.
    pub cut: bool,
    pub ended: bool,
}

impl Board {
    /// Adds a part of a run; the first part begins the run.
    pub fn add(&self, run: usize, part: String) {
        self.update(|state| {
            if !state.under_way.contains(&run) {
                state.under_way.push(run);
            }
            let parts = state.runs.entry(run).or_default();
            parts.bytes += part.len();
            match parts.bytes <= MOST_BYTES {
                true => parts.parts.push(part.into()),
                false => parts.cut = true,
            }
        });
    }

    /// A run has ended. The parts of runs that ended before it are dropped.
    pub fn end(&self, run: usize) {
        self.update(|state| {
            state.under_way.retain(|&other| other != run);
            state.ended += 1;
            state.runs.retain(|&other, parts| other == run || !parts.ended);
            state.runs.entry(run).or_default().ended = true;
        });
    }

    /// All runs have ended, and the site has its final page.
    pub fn finish(&self) {
        self.update(|state| state.finished = true);
    }

    /// Waits until every viewer knows of the end and has fetched the final page, at most for `time`.
    /// Returns the number of viewers that have not.
    pub fn wait_for_viewers(&self, time: Duration) -> usize {
        let waits = |state: &mut State| state.viewers + state.fetching > 0;
        let waited = self.changed.wait_timeout_while(self.lock(), time, waits);
        let (state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        state.viewers + state.fetching
    }

    /// The number of viewers.
    pub fn viewers(&self) -> usize {
        self.lock().viewers
    }

    /// Adds a viewer, unless there are `most`. Returns whether it was added.
    pub(crate) fn add_viewer(&self, most: usize) -> bool {
        let mut state = self.lock();
        let room = state.viewers < most;
        state.viewers += usize::from(room);
        room
    }

    pub(crate) fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(crate) fn update(&self, change: impl FnOnce(&mut State)) {
        change(&mut self.lock());
        self.changed.notify_all();
    }

    /// Waits until `look` finds something, at most for `time`.
    pub(crate) fn wait_for<T>(
        &self,
        time: Duration,
        mut look: impl FnMut(&State) -> Option<T>,
    ) -> Option<T> {
        let mut found = None;
        let nothing_found = |state: &mut State| {
            found = look(state);
            found.is_none()
        };
        // Whether the time is over or not, `found` has what the last look found.
        let _ = self.changed.wait_timeout_while(self.lock(), time, nothing_found);
        found
    }
}
