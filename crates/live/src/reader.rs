//! A viewer's place on the board.

use std::sync::Arc;

use crate::board::State;

/// What a viewer reads next.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Event {
    /// So many runs have ended, and these are under way.
    Runs { ended: usize, under_way: Vec<usize> },
    /// A run is told from its beginning.
    Begin(usize),
    /// What happened in it since.
    Part(Arc<str>),
    /// No more will be told of the run, though it goes on.
    Cut(usize),
    /// The run has ended, or was over before this viewer came to its end.
    End(usize),
    /// All is over.
    Finished,
}

/// Reads from a run's beginning to its end, then goes on to another: the one that has begun last. A
/// viewer that is slow loses no part of a run unless the run and another one end meanwhile.
pub(crate) struct Reader {
    /// The only run that it asks for.
    only: Option<usize>,
    reads: Option<usize>,
    /// Parts of it that were read.
    parts: usize,
    cut: bool,
    /// The run that was read last.
    last: Option<usize>,
    runs: Option<Event>,
}

impl Reader {
    pub fn new(only: Option<usize>) -> Reader {
        Reader { only, reads: None, parts: 0, cut: false, last: None, runs: None }
    }

    /// All that is there to be read; nothing if there is nothing new.
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
        if self.reads.is_none() {
            events.extend(self.begin(state));
        }
        self.go_on(state, &mut events);
        Some(events).filter(|events| !events.is_empty())
    }

    fn begin(&mut self, state: &State) -> Option<Event> {
        // One that is over and gone cannot be waited for.
        let only = self.only.filter(|run| state.runs.contains_key(run));
        let wanted = |run: &usize| only.is_none_or(|only| only == *run) && self.last != Some(*run);
        let mut known = state.under_way.iter().rev().chain(state.runs.keys()).copied();
        let run = known.find(wanted)?;
        (self.reads, self.parts, self.cut) = (Some(run), 0, false);
        Some(Event::Begin(run))
    }

    fn go_on(&mut self, state: &State, events: &mut Vec<Event>) {
        let Some(run) = self.reads else { return };
        let told = state.runs.get(&run);
        if let Some(told) = told {
            events.extend(told.parts[self.parts..].iter().cloned().map(Event::Part));
            self.parts = told.parts.len();
            if told.cut && !self.cut {
                self.cut = true;
                events.push(Event::Cut(run));
            }
        }
        if told.is_none_or(|told| told.ended) {
            self.last = self.reads.take();
            events.push(Event::End(run));
        }
    }
}
