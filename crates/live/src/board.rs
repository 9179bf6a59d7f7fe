//! What has been told of the runs that are under way.

use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The most bytes of a run that are kept for viewers; what comes after is not told.
const MOST_BYTES: usize = 64 << 20;

/// What viewers may read. Who writes on it never waits for who reads: readers hold it only while they
/// copy references.
#[derive(Default)]
pub struct Board {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
pub(crate) struct State {
    /// Runs under way, and the one that has ended last, by number.
    pub runs: BTreeMap<usize, Told>,
    /// In the order in which they began.
    pub under_way: Vec<usize>,
    /// How many have ended.
    pub ended: usize,
    /// Whether all is over.
    pub finished: bool,
    /// Streams that are open.
    pub viewers: usize,
    /// Pages still to be fetched by viewers that have heard of the end.
    pub called: usize,
}

/// What was told of a run.
#[derive(Default)]
pub(crate) struct Told {
    pub parts: Vec<Arc<str>>,
    bytes: usize,
    /// Whether something was not kept.
    pub cut: bool,
    pub ended: bool,
}

impl Board {
    /// A part of a run: the first one begins it.
    pub fn tell(&self, run: usize, part: String) {
        let mut state = self.lock();
        if !state.under_way.contains(&run) {
            state.under_way.push(run);
        }
        let told = state.runs.entry(run).or_default();
        told.bytes += part.len();
        match told.bytes <= MOST_BYTES {
            true => told.parts.push(part.into()),
            false => told.cut = true,
        }
        self.changed.notify_all();
    }

    /// A run has ended. What was told of those that ended before it goes.
    pub fn end(&self, run: usize) {
        let mut state = self.lock();
        state.under_way.retain(|&other| other != run);
        state.ended += 1;
        state.runs.retain(|&other, told| other == run || !told.ended);
        state.runs.entry(run).or_default().ended = true;
        self.changed.notify_all();
    }

    /// All runs have ended, and another page is there for whoever asks.
    pub fn finish(&self) {
        self.lock().finished = true;
        self.changed.notify_all();
    }

    /// Waits until every viewer has heard of the end and has fetched the page that is there since, or
    /// until the time is over; says how many had not.
    pub fn wait_for_viewers(&self, time: Duration) -> usize {
        let waits = |state: &mut State| state.viewers + state.called > 0;
        let waited = self.changed.wait_timeout_while(self.lock(), time, waits);
        let (state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        state.viewers + state.called
    }

    /// How many viewers there are.
    pub fn viewers(&self) -> usize {
        self.lock().viewers
    }

    pub(crate) fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(crate) fn update<T>(&self, change: impl FnOnce(&mut State) -> T) -> T {
        let changed = change(&mut self.lock());
        self.changed.notify_all();
        changed
    }

    /// What `look` finds, as soon as it finds something, or nothing after that time.
    pub(crate) fn wait_for<T>(
        &self,
        time: Duration,
        mut look: impl FnMut(&State) -> Option<T>,
    ) -> Option<T> {
        let mut found = None;
        let nothing = |state: &mut State| {
            found = look(state);
            found.is_none()
        };
        // Whatever became of the time: what was found last counts.
        let _ = self.changed.wait_timeout_while(self.lock(), time, nothing);
        found
    }
}
