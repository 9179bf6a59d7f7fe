//! One viewer's position on the board.

use std::sync::Arc;

use crate::board::State;

/// Bytes of parts after which a viewer writes what it has read: parts that it holds stay in memory.
const BATCH: usize = 1 << 20;

/// What a viewer reads next.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Event {
    /// The number of runs that have ended, and those under way.
    Runs { ended: usize, under_way: Vec<usize> },
    /// Parts of this run follow, from its beginning.
    Begin(usize),
    /// What happened in it since the last part.
    Part(Arc<str>),
    /// No more parts of this run follow, though it goes on.
    Cut(usize),
    /// The run has ended, and possibly was dropped before this viewer had read all of it.
    End(usize),
    /// All runs have ended.
    Finished,
}

/// Reads a run from its beginning to its end, then the run that began last. A slow viewer loses no part
/// of a run unless the run and another one end before it has read them.
pub(crate) struct Reader {
    /// The only run that the viewer asks for.
    only: Option<usize>,
    current: Option<usize>,
    /// The number of its parts that were read.
    parts: usize,
    cut: bool,
    /// The run that was read last.
    last: Option<usize>,
    /// The last `Runs` event.
    runs: Option<Event>,
}

impl Reader {
    pub fn new(only: Option<usize>) -> Reader {
        Reader { only, current: None, parts: 0, cut: false, last: None, runs: None }
    }

    /// All new events, if there are any.
    pub fn read(&mut self, state: &State) -> Option<Vec<Event>> {
        if state.finished {
            return Some(vec![Event::Finished]);
        }
        let mut events = Vec::new();
        let runs = Event::Runs { ended: state.ended, under_way: state.under_way.clone() };
        if self.runs.as_ref() != Some(&runs) {
            self.runs = Some(runs.clone());
            events.push(runs);
        }
        if self.current.is_none() {
            events.extend(self.begin(state));
        }
        self.continue_run(state, &mut events);
        Some(events).filter(|events| !events.is_empty())
    }

    fn begin(&mut self, state: &State) -> Option<Event> {
        // A run that is over and was dropped cannot be waited for.
        let only = self.only.filter(|run| state.runs.contains_key(run));
        let wanted = |run: &usize| only.is_none_or(|only| only == *run) && self.last != Some(*run);
        let mut known = state.under_way.iter().rev().chain(state.runs.keys()).copied();
        let run = known.find(wanted)?;
        (self.current, self.parts, self.cut) = (Some(run), 0, false);
        Some(Event::Begin(run))
    }

    fn continue_run(&mut self, state: &State, events: &mut Vec<Event>) {
        let Some(run) = self.current else { return };
        let parts = state.runs.get(&run);
        if let Some(parts) = parts {
            let mut bytes = 0;
            while let Some(part) = parts.parts.get(self.parts) {
                if bytes >= BATCH {
                    return;
                }
                bytes += part.len();
                events.push(Event::Part(Arc::clone(part)));
                self.parts += 1;
            }
            if parts.cut && !self.cut {
                self.cut = true;
                events.push(Event::Cut(run));
            }
        }
        if parts.is_none_or(|parts| parts.ended) {
            self.last = self.current.take();
            events.push(Event::End(run));
        }
    }
}
