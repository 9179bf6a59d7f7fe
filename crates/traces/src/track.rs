//! The events of one node in the order of time, with the messages that belong to each.

use desim::Time;
use virtwall::{Activity, MessageRecord, NodeRecord, Recording, Span};

use crate::sample::Sample;

pub(crate) enum Event<'a> {
    /// The span that began last ends.
    End,
    /// A span begins, with the messages that it sends or reads.
    Begin(Activity, &'a [usize]),
    /// A message is sent without a span.
    Sent(usize),
    /// A message is read without a span.
    Read(usize),
}

pub(crate) struct Track<'a> {
    pub(crate) rank: usize,
    pub(crate) node: &'a NodeRecord,
    pub(crate) sample: Sample,
    /// Those of all nodes.
    pub(crate) messages: &'a [MessageRecord],
    /// Numbers of those that the node sent, in the order of time.
    sent: Vec<usize>,
    /// Numbers of those that it read, in the order of time.
    read: Vec<usize>,
    is_service_node: bool,
}

impl<'a> Track<'a> {
    /// Every node, by rank.
    pub(crate) fn all(recording: &'a Recording, sample: Sample) -> impl Iterator<Item = Track<'a>> {
        let messages = &recording.messages[..];
        let mut sent = vec![Vec::new(); recording.nodes.len()];
        let mut read = sent.clone();
        for (number, message) in messages.iter().enumerate() {
            sent[message.from as usize].push(number);
            if message.read.is_some() {
                read[message.to as usize].push(number);
            }
        }
        read.iter_mut().for_each(|read| read.sort_by_key(|&number| messages[number].read));
        let nodes = recording.nodes.iter().zip(sent.into_iter().zip(read)).enumerate();
        nodes.map(move |(rank, (node, (sent, read)))| {
            let is_service_node = rank + 1 == recording.nodes.len();
            Track { rank, node, sample, messages, sent, read, is_service_node }
        })
    }

    pub(crate) fn name(&self) -> String {
        if self.is_service_node { "service node".to_owned() } else { format!("node {}", self.rank) }
    }

    /// All events, in the order of time, with spans of waiting only if `waits`. Spans that the sample
    /// leaves out count as waiting.
    ///
    /// A message belongs to the span that begins when it is sent or read. With a coprocessor, or where
    /// messages cost nothing, there is no such span, and the message is an event of its own.
    pub(crate) fn events(&self, waits: bool) -> Vec<(Time, Event<'_>)> {
        let sent_at = |number: usize| self.messages[number].sent;
        let read_at = |number: usize| self.messages[number].read.unwrap_or(Time::MAX);
        let mut sent = Queue { rest: &self.sent, time: sent_at, skipped: Vec::new() };
        let mut read = Queue { rest: &self.read, time: read_at, skipped: Vec::new() };
        // Either all nodes of a machine have coprocessors, or none has.
        let handed_over = self.messages.first().is_some_and(|message| message.handed_over);
        let mut events = Vec::new();
        for Span { activity, from, to } in self.node.spans() {
            let numbers = match activity {
                Activity::Send(_) if !handed_over => sent.take(from, 1),
                Activity::Receive => read.take(from, usize::MAX),
                _ => &[],
            };
            let is_message = matches!(activity, Activity::Send(_) | Activity::Receive);
            let shown = self.sample == Sample::ALL
                || !is_message
                || numbers.iter().any(|&number| self.sample.holds(number));
            let activity = if shown { activity } else { Activity::Wait };
            if waits || activity != Activity::Wait {
                events.extend([(from, Event::Begin(activity, numbers)), (to, Event::End)]);
            }
        }
        let shown = |number: &usize| self.sample.holds(*number);
        let sent = sent.without_span().filter(shown).map(|n| (sent_at(n), Event::Sent(n)));
        let read = read.without_span().filter(shown).map(|n| (read_at(n), Event::Read(n)));
        events.extend(read.chain(sent));
        events.sort_by_key(|(time, event)| (*time, event.order()));
        events
    }
}

impl Event<'_> {
    /// The order of events at one time: spans end before others begin, and messages without a span come last.
    fn order(&self) -> u8 {
        match self {
            Event::End => 0,
            Event::Begin(..) => 1,
            Event::Sent(_) | Event::Read(_) => 2,
        }
    }
}

/// Messages in the order of time that are not assigned to a span yet.
struct Queue<'a, F> {
    rest: &'a [usize],
    time: F,
    /// Those that no span begins with.
    skipped: Vec<usize>,
}

impl<'a, F: Fn(usize) -> Time> Queue<'a, F> {
    /// Takes the messages of this time, at most `most`; earlier ones have no span.
    fn take(&mut self, at: Time, most: usize) -> &'a [usize] {
        let before = self.rest.iter().take_while(|&&n| (self.time)(n) < at).count();
        let (skipped, rest) = self.rest.split_at(before);
        self.skipped.extend(skipped);
        let count = rest.iter().take(most).take_while(|&&n| (self.time)(n) == at).count();
        let (taken, rest) = rest.split_at(count);
        self.rest = rest;
        taken
    }

    fn without_span(self) -> impl Iterator<Item = usize> {
        self.skipped.into_iter().chain(self.rest.iter().copied())
    }
}
