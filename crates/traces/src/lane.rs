//! What happened on one node, in the order of time.

use desim::Time;
use virtwall::{Activity, MessageRecord, NodeRecord, Recording, Span};

use crate::sample::Sample;

/// The messages that a node sent and read, by number.
#[derive(Clone, Default)]
pub(crate) struct Mail {
    sent: Vec<usize>,
    read: Vec<usize>,
}

impl Mail {
    /// Every node's mail in the order of time, by rank.
    pub(crate) fn of(recording: &Recording) -> Vec<Mail> {
        let mut mail = vec![Mail::default(); recording.nodes.len()];
        for (number, message) in recording.messages.iter().enumerate() {
            mail[message.from as usize].sent.push(number);
            if message.read.is_some() {
                mail[message.to as usize].read.push(number);
            }
        }
        for mail in &mut mail {
            mail.read.sort_by_key(|&number| recording.messages[number].read);
        }
        mail
    }
}

/// Something on a node's lane.
pub(crate) enum Mark<'a> {
    /// The span that began last ends.
    End,
    /// A span begins, with the messages that it sends or takes in.
    Begin(Activity, &'a [usize]),
    /// A message goes onto the network by itself.
    Sent(usize),
    /// A message is read at no cost.
    Read(usize),
}

/// A node's lane.
pub(crate) struct Lane<'a> {
    pub(crate) messages: &'a [MessageRecord],
    pub(crate) node: &'a NodeRecord,
    pub(crate) mail: &'a Mail,
    pub(crate) sample: Sample,
}

impl<'a> Lane<'a> {
    /// All that is shown, in the order of time; waiting only if asked for. What is left out counts
    /// as waiting.
    ///
    /// A message belongs to the span of its kind that begins when it is sent or read. With a
    /// coprocessor, or where messages cost nothing, there is none, and it stands by itself.
    pub(crate) fn marks(&self, waits: bool) -> Vec<(Time, Mark<'a>)> {
        let sent_at = |number: usize| self.messages[number].sent;
        let read_at = |number: usize| self.messages[number].read.unwrap_or(Time::MAX);
        let mut sent = Pile { rest: &self.mail.sent, time: sent_at, alone: Vec::new() };
        let mut read = Pile { rest: &self.mail.read, time: read_at, alone: Vec::new() };
        let mut marks = Vec::new();
        for Span { activity, from, to } in self.node.spans() {
            let mine = match activity {
                Activity::Send(_) => sent.take(from, 1),
                Activity::Receive => read.take(from, usize::MAX),
                _ => &[],
            };
            let is_message = matches!(activity, Activity::Send(_) | Activity::Receive);
            let shown = self.sample.is_complete()
                || !is_message
                || mine.iter().any(|&number| self.sample.holds(number));
            let activity = if shown { activity } else { Activity::Wait };
            if waits || activity != Activity::Wait {
                marks.extend([(from, Mark::Begin(activity, mine)), (to, Mark::End)]);
            }
        }
        let shown = |number: &usize| self.sample.holds(*number);
        let sent = sent.left_alone().filter(shown).map(|n| (sent_at(n), Mark::Sent(n)));
        let read = read.left_alone().filter(shown).map(|n| (read_at(n), Mark::Read(n)));
        marks.extend(read.chain(sent));
        marks.sort_by_key(|(time, mark)| (*time, mark.order()));
        marks
    }
}

impl Mark<'_> {
    /// At one time spans end before others begin, and what is done meanwhile comes after.
    fn order(&self) -> u8 {
        match self {
            Mark::End => 0,
            Mark::Begin(..) => 1,
            Mark::Sent(_) | Mark::Read(_) => 2,
        }
    }
}

/// Messages in the order of time that have no span yet.
struct Pile<'a, F> {
    rest: &'a [usize],
    time: F,
    /// Those for which none came.
    alone: Vec<usize>,
}

impl<'a, F: Fn(usize) -> Time> Pile<'a, F> {
    /// Takes those of a moment off the pile, `most` of them; those before it have been left alone.
    fn take(&mut self, moment: Time, most: usize) -> &'a [usize] {
        let before = self.rest.iter().take_while(|&&n| (self.time)(n) < moment).count();
        let (alone, rest) = self.rest.split_at(before);
        self.alone.extend(alone);
        let count = rest.iter().take(most).take_while(|&&n| (self.time)(n) == moment).count();
        let (taken, rest) = rest.split_at(count);
        self.rest = rest;
        taken
    }

    fn left_alone(self) -> impl Iterator<Item = usize> {
        self.alone.into_iter().chain(self.rest.iter().copied())
    }
}
